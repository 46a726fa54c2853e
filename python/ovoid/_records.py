"""Records of results without NumPy: the bytes of an Array as lists and dicts."""

import re
import struct

_FIELD = re.compile(r"(?:\((\d+)\))?([A-Za-z]):(\w+):|(\d+)x")


def unpack(view, format):
    """The items of a memoryview of an Array with that format (PEP 3118): nested lists, of records dicts."""
    if not format.startswith("T{"):
        return view.tolist()
    fields = []
    layout = "="
    for count, code, name, padding in _FIELD.findall(format[2:-1]):
        fields.append((name, int(count or 0)) if name else None)
        layout += f"{padding}x" if padding else f"{count}{code}"
    return [_make_record(fields, row) for row in struct.iter_unpack(layout, view.cast("B"))]


def _make_record(fields, row):
    numbers = iter(row)
    made = {}
    for field in filter(None, fields):
        name, count = field
        made[name] = [next(numbers) for _ in range(count)] if count else next(numbers)
    return made
