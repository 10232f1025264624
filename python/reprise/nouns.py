"""Reads the nouns (world/*.fbs) out of FlatBuffers bytes: tables by name, vectors of structs as numpy arrays.

Nothing is copied: an array looks into the bytes of the message that it came in, and keeps them alive.
"""
from __future__ import annotations

import functools
from typing import Any, Iterator

import numpy as np
from flatbuffers.table import Table

from . import schema

_SCALARS = {
    "bool": "?", "ubyte": "u1", "byte": "i1", "ushort": "<u2", "short": "<i2", "uint": "<u4", "int": "<i4",
    "ulong": "<u8", "long": "<i8", "float": "<f4", "double": "<f8",
}  # fmt: skip


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
        if position is None:
            position = int(np.frombuffer(data, "<u4", 1)[0])
        self._name = name
        self._table = Table(data, position)

    def __dir__(self) -> Iterator[str]:
        return iter(schema.TABLES[self._name])

    def __repr__(self) -> str:
        return f"<{self._name}: {', '.join(schema.TABLES[self._name])}>"

    def __getattr__(self, field: str) -> Any:
        fields = schema.TABLES[self._name]
        if field not in fields:
            raise AttributeError(f"{self._name} has no field '{field}': {', '.join(fields)}")
        number, of = fields[field]
        offset = self._table.Offset(4 + 2 * number)
        value = self._vector(of[1:-1], offset) if of.startswith("[") else self._single(of, offset)
        setattr(self, field, value)  # the next look is a plain attribute
        return value

    def _single(self, of: str, offset: int) -> Any:
        at = offset + self._table.Pos
        if of == "string":
            return self._table.String(at).decode() if offset else ""
        full = _space(of, self._name)
        if full in schema.TABLES:
            return Noun(self._table.Bytes, full, self._table.Indirect(at)) if offset else None
        kind = dtype(of, self._name)
        if not offset:
            return np.zeros((), kind)[()] if kind.names else kind.type(0).item()
        value = np.frombuffer(self._table.Bytes, kind, 1, at)[0]
        return value if kind.names else value.item()

    def _vector(self, of: str, offset: int) -> Any:
        full = _space(of, self._name)
        begin = self._table.Vector(offset) if offset else 0
        length = self._table.VectorLen(offset) if offset else 0
        if of == "string":
            return [self._table.String(begin + 4 * i).decode() for i in range(length)]
        if full in schema.TABLES:
            return [Noun(self._table.Bytes, full, self._table.Indirect(begin + 4 * i)) for i in range(length)]
        kind = dtype(of, self._name)
        return np.frombuffer(self._table.Bytes, kind, length, begin) if length else np.zeros(0, kind)


def points(vectors: np.ndarray) -> np.ndarray:
    """A vector of Vec3, such as a lane's centre, as an array of shape (n, 3) [m]."""
    return vectors.view("<f8").reshape(-1, 3)
