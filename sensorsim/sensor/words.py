"""Whole numbers of 32 bits for compiled loops: numba widens them to 64, for which vectors are slow and half as long."""

from typing import Any

from numba import types
from numba.extending import intrinsic


def _plus(_typing: Any, _first: Any, _second: Any) -> Any:
    """Sum of two uint32, without what is carried over."""
    return types.uint32(types.uint32, types.uint32), lambda _context, builder, _signature, given: builder.add(*given)


def _times(_typing: Any, _first: Any, _second: Any) -> Any:
    """Product of two uint32, its lower half."""
    return types.uint32(types.uint32, types.uint32), lambda _context, builder, _signature, given: builder.mul(*given)


def _folded(_typing: Any, _word: Any) -> Any:
    """A uint32, its upper half laid over its lower one."""

    def build(_context: Any, builder: Any, _signature: Any, given: Any) -> Any:
        word = given[0]
        return builder.xor(word, builder.lshr(word, word.type(16)))

    return types.uint32(types.uint32), build


plus: Any = intrinsic(_plus)
times: Any = intrinsic(_times)
folded: Any = intrinsic(_folded)
