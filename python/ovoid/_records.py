"""The bytes of arrays without NumPy: records of results as lists and dicts, solids as pickles."""

from __future__ import annotations

import re
import struct
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._ovoid import Solid

_FIELD = re.compile(r"(?:\((\d+)\))?([A-Za-z]):(\w+):|(\d+)x")


def unpack(view: memoryview, format: str) -> list[Any]:
    """The items of a memoryview of an Array with that format (PEP 3118): nested lists, of records dicts."""
    if not format.startswith("T{"):
        return view.tolist()
    fields: list[tuple[str, int] | None] = []
    layout = "="
    for count, code, name, padding in _FIELD.findall(format[2:-1]):
        fields.append((name, int(count or 0)) if name else None)
        layout += f"{padding}x" if padding else f"{count}{code}"
    return [_make_record(fields, row) for row in struct.iter_unpack(layout, view.cast("B"))]


def _make_record(fields: list[tuple[str, int] | None], row: tuple[Any, ...]) -> dict[str, Any]:
    numbers = iter(row)
    made: dict[str, Any] = {}
    for field in filter(None, fields):
        name, count = field
        made[name] = [next(numbers) for _ in range(count)] if count else next(numbers)
    return made


def reduce_solid(solid: Solid) -> tuple[Any, tuple[str, bytes, bytes]]:
    """How pickle makes a Solid again: of the bytes of its points and triangles."""
    return make_solid, (sys.byteorder, bytes(memoryview(solid.vertices).cast("B")), bytes(memoryview(solid.faces).cast("B")))


def make_solid(order: str, vertices: bytes, faces: bytes) -> Solid:
    """The Solid of these bytes: doubles and 32-bit indices in that order of bytes."""
    from ._ovoid import Solid

    if order != sys.byteorder:
        raise ValueError(f"a Solid pickled on a {order}-endian machine is not read on a {sys.byteorder}-endian one")
    return Solid.from_triangles(*(memoryview(data).cast(kind, [len(data) // (3 * struct.calcsize(kind)), 3])
                                  for data, kind in ((vertices, "d"), (faces, "I"))))
