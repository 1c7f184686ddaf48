"""Dear ImGui drawn by moderngl: letters, panels and pictures as textured triangles. Needs the extra `viewer`."""

import ctypes
from typing import Any

import moderngl
import numpy as np
import numpy.typing as npt
from imgui_bundle import imgui

from sensorsim.gpu import Field, UniformBlock, bind_samplers, build_program
from sensorsim.viewer.palettes import Colours
from sensorsim.viewer.window import TEXT_KEYS, Events

PANEL = UniformBlock(
    name="Panel",
    binding=0,
    fields=(Field("scale", "vec4", "factors, then offsets, from window pixels to clip space"),),
)
TEXT_SIZE = 15.0  # [pixels]


class Gui:
    """One ImGui context over one window's OpenGL context."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._imgui = imgui.create_context()
        self._io = imgui.get_io()
        self._io.set_ini_filename("")
        self._io.backend_flags |= imgui.BackendFlags_.renderer_has_textures
        self._io.fonts.add_font_default_vector()
        _style()
        self._program = build_program(
            ctx, vertex="viewer/panel.vert", fragment="viewer/panel.frag", blocks=(PANEL,), samplers=("panel_picture",)
        )
        bind_samplers(self._program, {"panel_picture": 0})
        self._block = ctx.buffer(reserve=PANEL.dtype.itemsize)
        self._textures: dict[int, moderngl.Texture] = {}
        self._pictures: dict[int, moderngl.Texture] = {}  # by place in the window
        self._reserve(1 << 16, 1 << 17)

    def begin(self, size: tuple[int, int], seconds: float, events: Events) -> None:
        """Begin a frame of the window's size [pixels], `seconds` after the last."""
        io = self._io
        io.display_size = imgui.ImVec2(*size)
        io.delta_time = max(seconds, 1e-4)
        io.add_mouse_pos_event(*events.cursor)
        for button, down in events.clicks:
            io.add_mouse_button_event(button, down)
        if events.wheel:
            io.add_mouse_wheel_event(0.0, events.wheel)
        for name, down in events.keys:
            if name in TEXT_KEYS:
                io.add_key_event(_imgui_key(name), down)
            elif name in ("LEFT_CONTROL", "RIGHT_CONTROL"):
                io.add_key_event(imgui.Key.mod_ctrl, down)
        io.add_input_characters_utf8(events.text)
        imgui.new_frame()

    @property
    def takes_mouse(self) -> bool:
        """Whether the mouse is over a panel."""
        return bool(self._io.want_capture_mouse)

    @property
    def takes_keys(self) -> bool:
        """Whether a number is being typed."""
        return bool(self._io.want_text_input)

    def picture(self, place: int, colours: Colours) -> Any:
        """A picture (height, width, 3) for ImGui to draw; `place` tells apart those on show at once."""
        height, width = colours.shape[:2]
        texture = self._pictures.get(place)
        if texture is None or texture.size != (width, height):
            if texture is not None:
                self._textures.pop(place + 1).release()
            texture = self._ctx.texture((width, height), 3, alignment=1)
            texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
            texture.repeat_x = texture.repeat_y = False
            self._pictures[place] = self._textures[place + 1] = texture
        texture.write(colours, alignment=1)
        return imgui.ImTextureRef(place + 1)

    def end(self) -> None:
        """Draw the frame to the window."""
        imgui.render()
        self._draw(self._ctx.screen)

    def read(self) -> npt.NDArray[np.uint8]:
        """The last frame again, as colours (height, width, 3) from the top."""
        size = (int(self._io.display_size.x), int(self._io.display_size.y))
        target = self._ctx.simple_framebuffer(size, components=3)
        self._draw(target)
        data = np.frombuffer(target.read(components=3, alignment=1), dtype=np.uint8)
        target.release()
        return np.ascontiguousarray(data.reshape(size[1], size[0], 3)[::-1])

    def release(self) -> None:
        """Give the ImGui context back; what is in OpenGL goes with the window."""
        for texture in imgui.get_platform_io().textures:
            texture.set_tex_id(0)
            texture.status = imgui.ImTextureStatus.destroyed
        imgui.destroy_context(self._imgui)

    def _draw(self, target: moderngl.Framebuffer) -> None:
        data = imgui.get_draw_data()
        self._renew_textures()
        width, height = int(self._io.display_size.x), int(self._io.display_size.y)
        if width == 0 or height == 0:
            return
        target.use()
        target.viewport = target.scissor = (0, 0, width, height)
        target.clear(0.05, 0.05, 0.06, 1.0)
        self._block.write(PANEL.pack(scale=np.array([2.0 / width, -2.0 / height, -1.0, 1.0])))
        self._block.bind_to_uniform_block(PANEL.binding)
        self._ctx.enable_only(moderngl.BLEND)
        self._ctx.blend_func = moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA
        for commands in data.cmd_lists:
            self._draw_list(target, commands, height)
        target.scissor = (0, 0, width, height)

    def _draw_list(self, target: moderngl.Framebuffer, commands: Any, height: int) -> None:
        corners = ctypes.string_at(commands.vtx_buffer.data_address(), commands.vtx_buffer.size() * imgui.VERTEX_SIZE)
        indices = ctypes.string_at(commands.idx_buffer.data_address(), commands.idx_buffer.size() * imgui.INDEX_SIZE)
        if not corners or not indices:
            return
        if len(corners) > self._corners.size or len(indices) > self._indices.size:
            self._reserve(2 * len(corners), 2 * len(indices))
        self._corners.orphan()
        self._indices.orphan()
        self._corners.write(corners)
        self._indices.write(indices)
        for command in commands.cmd_buffer:
            left, top, right, bottom = (int(value) for value in command.clip_rect)
            if right <= left or bottom <= top or command.elem_count == 0:
                continue
            target.scissor = (left, height - bottom, right - left, bottom - top)
            self._textures[command.tex_ref.get_tex_id()].use(0)
            self._shape.render(moderngl.TRIANGLES, vertices=command.elem_count, first=command.idx_offset)

    def _reserve(self, corners: int, indices: int) -> None:
        """Buffers of so many bytes."""
        self._corners = self._ctx.buffer(reserve=corners, dynamic=True)
        self._indices = self._ctx.buffer(reserve=indices, dynamic=True)
        self._shape = self._ctx.vertex_array(
            self._program,
            [(self._corners, "2f 2f 4f1", "place", "texture_place", "tint")],
            index_buffer=self._indices,
            index_element_size=imgui.INDEX_SIZE,
        )

    def _renew_textures(self) -> None:
        """Textures of letters, as ImGui asks for them."""
        for wanted in imgui.get_platform_io().textures:
            if wanted.status == imgui.ImTextureStatus.want_destroy:
                self._textures.pop(wanted.get_tex_id()).release()
                wanted.set_tex_id(0)
                wanted.status = imgui.ImTextureStatus.destroyed
            elif wanted.status != imgui.ImTextureStatus.ok:
                pixels = np.ascontiguousarray(wanted.get_pixels_array())
                if wanted.status == imgui.ImTextureStatus.want_create:
                    number = 1000 + wanted.unique_id  # far from the pictures'
                    self._textures[number] = self._ctx.texture((wanted.width, wanted.height), 4)
                    wanted.set_tex_id(number)
                self._textures[wanted.get_tex_id()].write(pixels.tobytes())
                wanted.status = imgui.ImTextureStatus.ok


def _imgui_key(name: str) -> Any:
    names = {"LEFT": "left_arrow", "RIGHT": "right_arrow"}
    return getattr(imgui.Key, names.get(name, name.lower()))


def _style() -> None:
    """Dark, square, and large enough to read."""
    imgui.style_colors_dark()
    style = imgui.get_style()
    style.font_size_base = TEXT_SIZE
    style.window_rounding, style.frame_rounding = 0.0, 3.0
    style.item_spacing = imgui.ImVec2(8.0, 5.0)
    style.window_border_size = 0.0
