"""A std140 uniform block defined once, in Python: NumPy layout, GLSL text and documentation from one field list.

Offsets follow the std140 rules of the OpenGL 3.3 core specification, section 2.11.4. Arrays are allowed of vec4 and
mat4 only: their elements are multiples of 16 bytes, so no driver and no reader can disagree about the stride.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from sensorsim.errors import GraphicsError


@dataclass(frozen=True, slots=True)
class _Type:
    """How one GLSL type lies in memory."""

    base: str  # NumPy scalar type
    shape: tuple[int, ...]
    size: int  # [byte]
    alignment: int  # [byte]


_TYPES: Mapping[str, _Type] = {
    "float": _Type("<f4", (), 4, 4),
    "int": _Type("<i4", (), 4, 4),
    "uint": _Type("<u4", (), 4, 4),
    "vec2": _Type("<f4", (2,), 8, 8),
    "vec3": _Type("<f4", (3,), 12, 16),
    "vec4": _Type("<f4", (4,), 16, 16),
    "mat4": _Type("<f4", (4, 4), 64, 16),
}
_ARRAY_TYPES = ("vec4", "mat4")
_BLOCK_NAME = re.compile(r"([A-Z][a-z0-9]*)+")
_FIELD_NAME = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")


@dataclass(frozen=True, slots=True)
class Field:
    """One member of a block; `count` makes it an array of vec4 or mat4."""

    name: str
    type: str
    description: str  # with the unit in brackets
    count: int | None = None

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the value in NumPy: (4, 4) for a mat4, (n, 4) for an array of vec4."""
        own = _TYPES[self.type].shape
        return own if self.count is None else (self.count, *own)


@dataclass(frozen=True, slots=True, kw_only=True)
class UniformBlock:
    """A block of shader parameters. Raises GraphicsError when defined with a name or type that GLSL cannot hold.

    `name` is in CamelCase ('ViewFrame'); shaders include `generated/view_frame_block.glsl` and write
    `view_frame.clip_from_world`. Matrices are stored by rows: `pack` takes a matrix as mathematics writes it, and
    GLSL's `matrix * vector` is NumPy's `matrix @ vector`.
    """

    name: str
    binding: int
    fields: tuple[Field, ...]

    def __post_init__(self) -> None:
        if not _BLOCK_NAME.fullmatch(self.name) or self.binding < 0 or not self.fields:
            raise GraphicsError(
                f"block {self.name}: needs a CamelCase name, a binding from 0 up and at least one field"
            )
        names = [field.name for field in self.fields]
        for field in self.fields:
            if not _FIELD_NAME.fullmatch(field.name) or names.count(field.name) > 1:
                raise GraphicsError(f"block {self.name}: field '{field.name}' is not in snake_case or given twice")
            if field.type not in _TYPES:
                raise GraphicsError(f"block {self.name}: {field.name} is '{field.type}'; use {', '.join(_TYPES)}")
            if field.count is not None and (field.type not in _ARRAY_TYPES or field.count < 1):
                raise GraphicsError(f"block {self.name}: {field.name}: arrays are of one or more vec4 or mat4")

    @property
    def instance(self) -> str:
        """Name through which a shader reads the block: 'view_frame' for ViewFrame."""
        return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", self.name).lower()

    @property
    def include_name(self) -> str:
        """Name of the generated text: shaders include `generated/<include_name>.glsl`."""
        return f"{self.instance}_block"

    @property
    def dtype(self) -> np.dtype[np.void]:
        """The block in memory, padding included; its itemsize is the size of the GL block [byte]."""
        return _layout(self.fields)

    def glsl(self) -> str:
        """Declaration for `generated/<include_name>.glsl`. GL 3.3 sets the binding from Python, not in the text."""
        members = [
            f"    {field.type} {field.name}{'' if field.count is None else f'[{field.count}]'};  // {field.description}"
            for field in self.fields
        ]
        return "\n".join((f"layout(std140, row_major) uniform {self.name} {{", *members, f"}} {self.instance};", ""))

    def table_rows(self) -> list[tuple[str, str, int, str]]:
        """Rows of a documentation table: name, GLSL type, offset [byte], description."""
        suffix = {field.name: "" if field.count is None else f"[{field.count}]" for field in self.fields}
        places: Mapping[str, tuple[Any, ...]] = self.dtype.fields or {}
        return [
            (field.name, field.type + suffix[field.name], places[field.name][1], field.description)
            for field in self.fields
        ]

    def pack(self, **values: npt.ArrayLike) -> bytes:
        """Bytes of the block. Every field is given, in its own shape and finite; anything else raises GraphicsError."""
        names = [field.name for field in self.fields]
        missing = [name for name in names if name not in values]
        unknown = sorted(values.keys() - set(names))
        if missing or unknown:
            raise GraphicsError(f"block {self.name}: missing {missing or 'none'}, unknown {unknown or 'none'}")
        record = np.zeros((), self.dtype)
        for field in self.fields:
            record[field.name] = self._checked(field, np.asarray(values[field.name]))
        return record.tobytes()

    def _checked(self, field: Field, value: npt.NDArray[Any]) -> npt.NDArray[Any]:
        where = f"block {self.name}: {field.name}"
        if value.shape != field.shape:
            raise GraphicsError(f"{where} has shape {value.shape}, expected {field.shape}")
        base = np.dtype(_TYPES[field.type].base)
        if value.dtype.kind not in ("iuf" if base.kind == "f" else "iu"):
            raise GraphicsError(f"{where} is of type {value.dtype}, expected {base.name}")
        limits = np.finfo(np.float32) if base.kind == "f" else np.iinfo(base)
        # Written so that NaN, which is least and greatest and compares as false, is refused as well.
        if not (value.min() >= limits.min and value.max() <= limits.max):
            raise GraphicsError(f"{where} = {value.tolist()} is not finite or does not fit {base.name}")
        return value


@cache
def _layout(fields: tuple[Field, ...]) -> np.dtype[np.void]:
    offsets, end = [], 0
    for field in fields:
        kind = _TYPES[field.type]
        offsets.append(-(-end // kind.alignment) * kind.alignment)
        end = offsets[-1] + kind.size * (field.count or 1)
    return np.dtype(
        {
            "names": [field.name for field in fields],
            "formats": [(_TYPES[field.type].base, field.shape) for field in fields],
            "offsets": offsets,
            "itemsize": -(-end // 16) * 16,
        }
    )
