"""Tables as textures: 2-D, single precision or 32-bit integer, read with `texelFetch` alone.

Row r, column c of the array is texel ivec2(c, r). There are no mip-maps and no filtering: hardware interpolates with
few bits (8 in the fraction on common devices), which is coarser than a thermal sensor resolves.
"""

from typing import Any

import moderngl
import numpy as np
import numpy.typing as npt

from sensorsim.errors import GraphicsError

_COMPONENTS = {"f4": (1, 2, 4), "i4": (1, 4)}


def float_table(ctx: moderngl.Context, name: str, data: npt.NDArray[np.floating[Any]]) -> moderngl.Texture:
    """A texture R32F, RG32F or RGBA32F of an array (rows, columns) or (rows, columns, 1, 2 or 4).

    Raises GraphicsError, naming the table, for another shape or type, for a side beyond the driver's limit and for a
    value that is not finite in single precision.
    """
    return _create(ctx, name, data, "f4")


def integer_table(ctx: moderngl.Context, name: str, data: npt.NDArray[np.integer[Any]]) -> moderngl.Texture:
    """A texture R32I or RGBA32I of an integer array (rows, columns) or (rows, columns, 1 or 4); otherwise as above."""
    return _create(ctx, name, data, "i4")


def update_table(texture: moderngl.Texture, data: npt.NDArray[Any]) -> None:
    """Rewrite a table in place with an array of the same shape and kind; raises GraphicsError for any other."""
    name = texture.extra["name"]
    converted = _converted(name, data, texture.dtype)
    rows, columns, components = converted.shape
    if (columns, rows) != texture.size or components != texture.components:
        old = (texture.height, texture.width, texture.components)
        raise GraphicsError(f"table '{name}': update of shape {converted.shape} for a table of shape {old}")
    texture.write(converted)


def _create(ctx: moderngl.Context, name: str, data: npt.NDArray[Any], dtype: str) -> moderngl.Texture:
    converted = _converted(name, data, dtype)
    rows, columns, components = converted.shape
    limit = ctx.info["GL_MAX_TEXTURE_SIZE"]
    if max(rows, columns) > limit:
        raise GraphicsError(
            f"table '{name}': {rows} rows x {columns} columns, but this OpenGL allows {limit} a side; split the table"
        )
    texture = ctx.texture((columns, rows), components, converted, dtype=dtype)
    texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
    texture.repeat_x = texture.repeat_y = False
    texture.extra = {"name": name}
    return texture


def _converted(name: str, data: npt.NDArray[Any], dtype: str) -> npt.NDArray[Any]:
    """The array as (rows, columns, components), contiguous, in the texture's own type."""
    kinds = "f" if dtype == "f4" else "iu"
    if data.dtype.kind not in kinds:
        raise GraphicsError(
            f"table '{name}': array of {data.dtype}, expected {'floats' if kinds == 'f' else 'integers'}"
        )
    shaped = data[:, :, np.newaxis] if data.ndim == 2 else data
    if shaped.ndim != 3 or shaped.size == 0 or shaped.shape[2] not in _COMPONENTS[dtype]:
        raise GraphicsError(
            f"table '{name}': shape {data.shape}, expected (rows, columns[, c]), c one of {_COMPONENTS[dtype]}, none 0"
        )
    if dtype == "i4":
        limits = np.iinfo(np.int32)
        if shaped.min() < limits.min or shaped.max() > limits.max:
            raise GraphicsError(f"table '{name}': a value does not fit 32 bits")
        return np.ascontiguousarray(shaped, np.int32)
    with np.errstate(over="ignore"):  # what overflows becomes infinite and is refused next
        single = np.ascontiguousarray(shaped, np.float32)
    bad = np.argwhere(~np.isfinite(single))
    if bad.size:
        raise GraphicsError(f"table '{name}': entry {tuple(bad[0].tolist())} is {shaped[tuple(bad[0])]}, not finite")
    return single
