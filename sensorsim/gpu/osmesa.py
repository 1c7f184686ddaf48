"""Mesa's off-screen library as a context loader for moderngl, for machines where EGL finds no device.

moderngl asks a loader for function addresses and tells it when the context is entered and released; glcontext, which
supplies the other back ends, has none for OSMesa. Mesa 25.1 and later no longer ship the library.
"""

import ctypes

from sensorsim.errors import GraphicsError

LIBRARIES = ("libOSMesa.so.8", "libOSMesa.so.6")

# Names and values as in Mesa's GL/osmesa.h and GL/gl.h.
_GL_UNSIGNED_BYTE = 0x1401
_GL_RGBA = 0x1908
_OSMESA_FORMAT = 0x22
_OSMESA_PROFILE = 0x33
_OSMESA_CORE_PROFILE = 0x34
_OSMESA_CONTEXT_MAJOR_VERSION = 0x36
_OSMESA_CONTEXT_MINOR_VERSION = 0x37
_ATTRIBUTES = (
    *(_OSMESA_FORMAT, _GL_RGBA),
    *(_OSMESA_PROFILE, _OSMESA_CORE_PROFILE),
    *(_OSMESA_CONTEXT_MAJOR_VERSION, 3),
    *(_OSMESA_CONTEXT_MINOR_VERSION, 3),
    0,
)


class OSMesaLoader:
    """One OpenGL 3.3 core context of OSMesa, current in the calling thread after construction.

    Raises GraphicsError when the library is absent or refuses the context. The picture memory that OSMesa insists on
    is a single pixel: frames are drawn to framebuffer objects.
    """

    def __init__(self) -> None:
        self._library = _load_library()
        attributes = (ctypes.c_int * len(_ATTRIBUTES))(*_ATTRIBUTES)
        self._context = self._library.OSMesaCreateContextAttribs(attributes, None)
        if not self._context:
            raise GraphicsError("OSMesaCreateContextAttribs refused an OpenGL 3.3 core context")
        self._pixel = (ctypes.c_ubyte * 4)()
        self.__enter__()

    def load_opengl_function(self, name: str) -> int:
        """Address of an OpenGL function, 0 where OSMesa has none of that name."""
        return self._library.OSMesaGetProcAddress(name.encode("ascii")) or 0

    def __enter__(self) -> "OSMesaLoader":
        if not self._library.OSMesaMakeCurrent(self._context, self._pixel, _GL_UNSIGNED_BYTE, 1, 1):
            raise GraphicsError("OSMesaMakeCurrent failed")
        return self

    def __exit__(self, *_: object) -> None:
        """Leave the context current: whoever draws next enters a context of its own."""

    def release(self) -> None:
        """Destroy the context; a second call does nothing."""
        if self._context:
            self._library.OSMesaDestroyContext(self._context)
            self._context = None


def _load_library() -> ctypes.CDLL:
    problems = []
    for name in LIBRARIES:
        try:
            library = ctypes.CDLL(name)
        except OSError as error:
            problems.append(str(error))
            continue
        return _declare_functions(library)
    raise GraphicsError("; ".join(problems))


def _declare_functions(library: ctypes.CDLL) -> ctypes.CDLL:
    pointer = ctypes.c_void_p
    library.OSMesaCreateContextAttribs.restype = pointer
    library.OSMesaCreateContextAttribs.argtypes = [ctypes.POINTER(ctypes.c_int), pointer]
    library.OSMesaMakeCurrent.restype = ctypes.c_ubyte
    library.OSMesaMakeCurrent.argtypes = [pointer, pointer, ctypes.c_uint, ctypes.c_int, ctypes.c_int]
    library.OSMesaGetProcAddress.restype = pointer
    library.OSMesaGetProcAddress.argtypes = [ctypes.c_char_p]
    library.OSMesaDestroyContext.restype = None
    library.OSMesaDestroyContext.argtypes = [pointer]
    return library
