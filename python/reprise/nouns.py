"""Reads the nouns (world/*.fbs) out of FlatBuffers bytes: tables by name, vectors of structs as numpy arrays.

Nothing is copied: an array looks into the bytes of the message that it came in, and keeps them alive.
"""
from __future__ import annotations

import functools
import struct
from typing import Any, Callable, Iterator

import numpy as np

from . import schema

_SCALARS = {
    "bool": "?", "ubyte": "u1", "byte": "i1", "ushort": "<u2", "short": "<i2", "uint": "<u4", "int": "<i4",
    "ulong": "<u8", "long": "<i8", "float": "<f4", "double": "<f8",
}  # fmt: skip

_ushort, _int, _uint = (struct.Struct(kind).unpack_from for kind in ("<H", "<i", "<I"))


def _space(name: str, beside: str) -> str:
    """The full name of a type that is named beside another one."""
    return name if "." in name else f"{beside.split('.')[0]}.{name}"


@functools.lru_cache(maxsize=None)
def dtype(name: str, beside: str = "world.") -> np.dtype:
    """numpy's type of a scalar, an enum or a struct of the schemas, such as dtype('CarState')."""
    if name in _SCALARS:
        return np.dtype(_SCALARS[name])
    full = _space(name, beside)
    if full in schema.ENUMS:
        return dtype(schema.ENUMS[full][0])
    return np.dtype([(field, dtype(of, full)) for field, of in schema.STRUCTS[full]])


def enum(name: str) -> dict[str, int]:
    """The values of an enum by their names, such as enum('SignalColor')['red']."""
    return schema.ENUMS[_space(name, "world.")][1]


class Noun:
    """A table of the schemas. Its fields are attributes: numbers, strings, other nouns, numpy records for structs,
    numpy arrays for vectors of numbers and structs, sequences for vectors of tables and strings. What the writer
    left out is 0, '' or empty.
    """

    def __init__(self, data: bytes | memoryview, name: str, position: int | None = None) -> None:
        self._data, self._name = data, name
        self._at: int = _uint(data, 0)[0] if position is None else position
        self._vtable: int = self._at - _int(data, self._at)[0]
        self._readers = _readers(name)

    def __dir__(self) -> Iterator[str]:
        return iter(schema.TABLES[self._name])

    def __repr__(self) -> str:
        return f"<{self._name}: {', '.join(schema.TABLES[self._name])}>"

    def __getattr__(self, field: str) -> Any:
        if field.startswith("_"):
            raise AttributeError(field)  # of what was not made by __init__, such as a copy in the making
        if field not in self._readers:
            raise AttributeError(f"{self._name} has no field '{field}': {', '.join(schema.TABLES[self._name])}")
        slot, read = self._readers[field]
        value = self.__dict__[field] = read(self._data, self._place(slot))  # the next look is a plain attribute
        return value

    def _place(self, slot: int) -> int:
        """Where a field is in the data; 0: the writer left it out."""
        if slot >= _ushort(self._data, self._vtable)[0]:
            return 0
        offset = _ushort(self._data, self._vtable + slot)[0]
        return self._at + offset if offset else 0

    def nested(self, field: str, name: str) -> Noun | None:
        """The table that a field of bytes holds, with its own root; None without it."""
        place = self._place(self._readers[field][0])
        begin = place and place + _uint(self._data, place)[0] + 4
        if not begin or not _uint(self._data, begin - 4)[0]:
            return None
        return Noun(self._data, name, begin + _uint(self._data, begin)[0])


_Reader = Callable[["bytes | memoryview", int], Any]  # of the data, and where the field is in it or 0


@functools.lru_cache(maxsize=None)
def _readers(name: str) -> dict[str, tuple[int, _Reader]]:
    """How each field of a table is read: its place in the vtable, and the function."""
    return {
        field: (4 + 2 * number, _of_vector(of[1:-1], name) if of.startswith("[") else _of_one(of, name))
        for field, (number, of) in schema.TABLES[name].items()
    }


def _text(data: bytes | memoryview, place: int) -> str:
    begin = place + _uint(data, place)[0] + 4
    return bytes(data[begin : begin + _uint(data, begin - 4)[0]]).decode()


def _of_one(of: str, beside: str) -> _Reader:
    full = _space(of, beside)
    if of == "string":
        return lambda data, place: _text(data, place) if place else ""
    if full in schema.TABLES:
        return lambda data, place: Noun(data, full, place + _uint(data, place)[0]) if place else None
    kind = dtype(of, beside)
    if kind.names:
        return lambda data, place: np.frombuffer(data, kind, 1, place)[0] if place else np.zeros((), kind)[()]
    left_out = kind.type(0).item()
    unpack = struct.Struct("<" + kind.char).unpack_from
    return lambda data, place: unpack(data, place)[0] if place else left_out


def _of_vector(of: str, beside: str) -> _Reader:
    full = _space(of, beside)
    kind = None if of == "string" or full in schema.TABLES else dtype(of, beside)

    def read(data: bytes | memoryview, place: int) -> Any:
        begin = place and place + _uint(data, place)[0] + 4
        length = _uint(data, begin - 4)[0] if place else 0
        if kind is not None:
            return np.frombuffer(data, kind, length, begin) if length else np.zeros(0, kind)
        places = range(begin, begin + 4 * length, 4)
        if of == "string":
            return [_text(data, at) for at in places]
        return [Noun(data, full, at + _uint(data, at)[0]) for at in places]

    return read


def points(vectors: np.ndarray) -> np.ndarray:
    """A vector of Vec3, such as a lane's centre, as an array of shape (n, 3) [m]."""
    return vectors.view("<f8").reshape(-1, 3)
