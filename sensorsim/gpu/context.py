"""An OpenGL 3.3 core context without a window: EGL, then OSMesa, then X11."""

import os
from collections.abc import Callable, Mapping
from typing import Any

import moderngl

from sensorsim.errors import GraphicsError, InputError
from sensorsim.gpu.osmesa import OSMesaLoader

BACKENDS = ("egl", "osmesa", "x11")
BACKEND_VARIABLE = "SENSORSIM_GL"
REQUIRED_VERSION = 330  # more is never asked for: 3.3 is what every back end and driver in use has

_REMEDY = (
    "on Debian, for EGL: apt-get install libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri; "
    "for OSMesa: apt-get install libosmesa6"
)
_LIMITS = (
    "GL_MAX_TEXTURE_SIZE",
    "GL_MAX_VIEWPORT_DIMS",
    "GL_MAX_COLOR_ATTACHMENTS",
    "GL_MAX_DRAW_BUFFERS",
    "GL_MAX_TEXTURE_IMAGE_UNITS",
    "GL_MAX_UNIFORM_BLOCK_SIZE",
    "GL_MAX_UNIFORM_BUFFER_BINDINGS",
)


def create_context(backend: str = "auto", *, device_index: int | None = None) -> moderngl.Context:
    """Open a windowless OpenGL 3.3 core context and make it current.

    `backend` is 'egl', 'osmesa', 'x11' or 'auto'. 'auto' takes the name in the environment variable SENSORSIM_GL and,
    where that is unset or 'auto' too, tries the three in that order. `device_index` picks one of EGL's devices (their
    order is EGL's own) and therefore leaves EGL as the only choice. The context remembers its back end in `ctx.extra`.
    EGL and OSMesa share state inside Mesa: use one back end per process.

    Raises InputError for an unknown name, GraphicsError naming every attempt and the packages to install.
    """
    attempts = []
    for name in _order(backend, device_index):
        try:
            ctx = _CREATORS[name](device_index)
        except Exception as error:  # glcontext raises plain Exception for whatever the platform refuses
            attempts.append(f"{name}: {' '.join(str(error).split())}")
            continue
        ctx.extra = {"backend": name}
        return ctx
    raise GraphicsError(f"no OpenGL 3.3 context: {'; '.join(attempts)}. Remedy: {_REMEDY}")


def context_info(ctx: moderngl.Context, backend: str | None = None) -> dict[str, Any]:
    """Back end, driver strings, versions and limits of a context, as plain data that JSON can hold.

    `backend` names the origin of a context that was opened elsewhere, such as a window's.
    """
    known = ctx.extra["backend"] if isinstance(ctx.extra, Mapping) and "backend" in ctx.extra else "external"
    info = ctx.info
    major, minor = divmod(ctx.version_code // 10, 10)
    return {
        "backend": backend or known,
        "vendor": info["GL_VENDOR"],
        "renderer": info["GL_RENDERER"],
        "version": info["GL_VERSION"],
        "glsl": f"{major}.{minor}0",  # numbered as OpenGL itself from 3.3 on
        "limits": {name.removeprefix("GL_").lower(): info[name] for name in _LIMITS},
    }


def _order(backend: str, device_index: int | None) -> tuple[str, ...]:
    where, entry, chosen = "create_context", "backend", backend
    if backend == "auto":
        where, entry, chosen = "environment", BACKEND_VARIABLE, os.environ.get(BACKEND_VARIABLE) or "auto"
    if chosen not in ("auto", *BACKENDS):
        raise InputError(where, entry, chosen, "is no OpenGL back end", f"use auto, {', '.join(BACKENDS)}")
    if device_index is None:
        return BACKENDS if chosen == "auto" else (chosen,)
    if chosen not in ("auto", "egl") or device_index < 0:
        raise InputError(where, "device_index", device_index, f"picks no device of {chosen}", "use 0 or more with egl")
    return ("egl",)


def _create_egl(device_index: int | None) -> moderngl.Context:
    chosen: dict[str, Any] = {} if device_index is None else {"device_index": device_index}
    return moderngl.create_context(require=REQUIRED_VERSION, standalone=True, backend="egl", **chosen)  # type: ignore[arg-type]


def _create_osmesa(_device_index: int | None) -> moderngl.Context:
    return moderngl.create_context(require=REQUIRED_VERSION, standalone=True, context=OSMesaLoader())  # type: ignore[arg-type]


def _create_x11(_device_index: int | None) -> moderngl.Context:
    if not os.environ.get("DISPLAY"):
        raise GraphicsError("DISPLAY is not set")
    return moderngl.create_context(require=REQUIRED_VERSION, standalone=True)


_CREATORS: Mapping[str, Callable[[int | None], moderngl.Context]] = {
    "egl": _create_egl,
    "osmesa": _create_osmesa,
    "x11": _create_x11,
}
