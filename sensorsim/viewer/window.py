"""The window: GLFW, its OpenGL context for moderngl, and what hand and gamepad do. Needs the extra `viewer`."""

from dataclasses import dataclass, field
from typing import Any

import glfw
import moderngl

from sensorsim.errors import GraphicsError
from sensorsim.viewer.keys import known_keys
from sensorsim.viewer.motion import Motion, stick_motion

_REMEDY = "run it where there is a display (DISPLAY or WAYLAND_DISPLAY is set), or under: xvfb-run -a"
TEXT_KEYS = ("BACKSPACE", "DELETE", "ENTER", "TAB", "LEFT", "RIGHT", "HOME", "END", "ESCAPE")
_MORE_KEYS = ("LEFT_CONTROL", "RIGHT_CONTROL", *TEXT_KEYS)


@dataclass(slots=True, kw_only=True)
class Events:
    """What happened since the events were last taken, and what is held."""

    held: set[str] = field(default_factory=set)
    buttons: set[int] = field(default_factory=set)
    cursor: tuple[float, float] = (-1.0, -1.0)  # right and down of the upper left corner [pixels]
    keys: list[tuple[str, bool]] = field(default_factory=list)  # went down, or came up
    clicks: list[tuple[int, bool]] = field(default_factory=list)
    wheel: float = 0.0
    text: str = ""

    def clear(self) -> None:
        """Forget what is done with; what is held stays."""
        self.keys.clear()
        self.clicks.clear()
        self.wheel, self.text = 0.0, ""


class _Loader:
    """The window's context as moderngl asks for one."""

    def __init__(self, window: Any) -> None:
        self._window = window

    def load_opengl_function(self, name: str) -> int:
        """Address of an OpenGL function, 0 where there is none of that name."""
        address: Any = glfw.get_proc_address(name)
        return int(getattr(address, "value", address) or 0)

    def __enter__(self) -> "_Loader":
        glfw.make_context_current(self._window)
        return self

    def __exit__(self, *_: object) -> None:
        """Leave no context current: those off screen may be of another kind, and the two do not share a thread."""
        nothing: Any = None
        glfw.make_context_current(nothing)

    def release(self) -> None:
        """The window gives its context back itself."""


def check_display() -> None:
    """Raise GraphicsError where no window can be opened."""
    problems: list[str] = []

    def note(_code: int, text: Any) -> None:
        problems.append(_plain(text))

    glfw.set_error_callback(note)
    if not glfw.init():
        raise GraphicsError(f"no window: {'; '.join(problems) or 'GLFW gives no reason'}. Remedy: {_REMEDY}")


class Window:
    """A window with an OpenGL 3.3 core context, current only inside `with window.ctx`."""

    def __init__(self, title: str, size: tuple[int, int]) -> None:
        check_display()
        self._problems: list[str] = []
        glfw.set_error_callback(self._on_error)
        for hint, value in (
            (glfw.CONTEXT_VERSION_MAJOR, 3),
            (glfw.CONTEXT_VERSION_MINOR, 3),
            (glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE),
            (glfw.OPENGL_FORWARD_COMPAT, True),
        ):
            glfw.window_hint(hint, value)
        self._window = glfw.create_window(*size, title, None, None)
        if not self._window:
            glfw.terminate()
            raise GraphicsError(f"no window: {'; '.join(self._problems)}. Remedy: {_REMEDY}")
        glfw.make_context_current(self._window)
        glfw.swap_interval(0)
        self.ctx = moderngl.create_context(require=330, context=_Loader(self._window))  # type: ignore[arg-type]
        self.events = Events()
        self._names = {getattr(glfw, f"KEY_{name}"): name for name in known_keys() | set(_MORE_KEYS)}
        self._listen()

    @property
    def size(self) -> tuple[int, int]:
        """Width and height [pixels]."""
        width, height = glfw.get_framebuffer_size(self._window)
        return int(width), int(height)

    @property
    def is_closing(self) -> bool:
        """Whether the user has closed it."""
        return bool(glfw.window_should_close(self._window))

    def poll(self) -> Events:
        """Take in what happened; the events are the caller's to clear."""
        glfw.poll_events()
        return self.events

    def stick(self) -> Motion:
        """Motion that the first gamepad asks for."""
        if not glfw.joystick_is_gamepad(glfw.JOYSTICK_1):
            return Motion()
        state = glfw.get_gamepad_state(glfw.JOYSTICK_1)
        return stick_motion(list(state.axes), list(state.buttons)) if state else Motion()

    def show(self) -> None:
        """Bring what was drawn to the screen."""
        glfw.swap_buffers(self._window)

    def release(self) -> None:
        """Close it."""
        glfw.destroy_window(self._window)
        glfw.terminate()

    def _listen(self) -> None:
        glfw.set_key_callback(self._window, self._on_key)
        glfw.set_char_callback(self._window, self._on_char)
        glfw.set_cursor_pos_callback(self._window, self._on_cursor)
        glfw.set_mouse_button_callback(self._window, self._on_button)
        glfw.set_scroll_callback(self._window, self._on_wheel)
        glfw.set_window_focus_callback(self._window, self._on_focus)

    def _on_error(self, _code: int, text: Any) -> None:
        self._problems.append(_plain(text))

    def _on_key(self, _window: Any, code: int, _scancode: int, action: int, _mods: int) -> None:
        name = self._names.get(code)
        if name is None or action == glfw.REPEAT:
            return
        down = action == glfw.PRESS
        self.events.keys.append((name, down))
        (self.events.held.add if down else self.events.held.discard)(name)

    def _on_char(self, _window: Any, code: int) -> None:
        self.events.text += chr(code)

    def _on_cursor(self, _window: Any, x: float, y: float) -> None:
        self.events.cursor = (x, y)

    def _on_button(self, _window: Any, button: int, action: int, _mods: int) -> None:
        down = action == glfw.PRESS
        self.events.clicks.append((button, down))
        (self.events.buttons.add if down else self.events.buttons.discard)(button)

    def _on_wheel(self, _window: Any, _x: float, y: float) -> None:
        self.events.wheel += y

    def _on_focus(self, _window: Any, focused: int) -> None:
        if not focused:  # the keys come up somewhere else
            self.events.held.clear()


def _plain(text: Any) -> str:
    """GLFW's message, which comes as bytes or as text."""
    return text.decode("utf-8", "replace") if isinstance(text, bytes) else str(text)
