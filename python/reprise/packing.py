"""Writes the nouns (remote/wire.fbs) as FlatBuffers bytes: tables by name, from plain values."""
from __future__ import annotations

import math
from typing import Any, Mapping

import flatbuffers
import numpy as np

from . import schema
from .arguments import shown
from .nouns import dtype

_SLOTS = {
    "?": "PrependBoolSlot", "u1": "PrependUint8Slot", "i1": "PrependInt8Slot", "<u2": "PrependUint16Slot",
    "<i2": "PrependInt16Slot", "<u4": "PrependUint32Slot", "<i4": "PrependInt32Slot", "<u8": "PrependUint64Slot",
    "<i8": "PrependInt64Slot", "<f4": "PrependFloat32Slot", "<f8": "PrependFloat64Slot",
}  # fmt: skip


def pack(name: str, values: Mapping[str, Any]) -> bytearray:
    """A table such as 'remote.Reset' with these fields; tables in it are mappings, enums words. None is left out."""
    builder = flatbuffers.Builder(256)
    builder.Finish(_table(builder, name, values))
    return builder.Output()


def _full(of: str, name: str) -> str:
    return of if "." in of else f"{name.split('.')[0]}.{of}"


def _table(builder: flatbuffers.Builder, name: str, values: Mapping[str, Any]) -> int:
    fields = schema.TABLES[name]
    for field in values:
        if field not in fields:
            raise AttributeError(f"{name} has no field '{field}': {', '.join(fields)}")
    given = {field: value for field, value in values.items() if value is not None}
    # Whatever lies outside of the table comes before it.
    offsets = {field: _outside(builder, field, fields[field][1], name, value) for field, value in given.items()}
    builder.StartObject(1 + max(number for number, _ in fields.values()))
    for field, value in given.items():
        number, of = fields[field]
        if offsets[field] is not None:
            builder.PrependUOffsetTRelativeSlot(number, offsets[field], 0)
            continue
        full = _full(of, name)
        if full in schema.ENUMS and isinstance(value, str):
            value = schema.ENUMS[full][1][value]
        kind = dtype(of, name)
        text = "?" if kind.kind == "b" else kind.str.replace("|", "")
        getattr(builder, _SLOTS[text])(number, _number(field, kind, value), 0)
    return builder.EndObject()


def _number(field: str, kind: np.dtype, value: Any) -> bool | int | float:
    """`value` as the field holds it. Raises ValueError: numpy would round it, wrap it around, or take any text for True."""
    if kind.kind == "f":
        low, high, words = -math.inf, math.inf, "a number"
    elif kind.kind == "b":
        low, high, words = 0, 1, "True or False"
    else:
        low, high = np.iinfo(kind).min, np.iinfo(kind).max
        words = f"a whole number in [{low}, {high}]"
    try:
        number = float(value) if kind.kind == "f" else int(value)
        is_possible = not isinstance(value, (str, bytes)) and (number != number or number == value and low <= number <= high)
    except (TypeError, ValueError, OverflowError):
        is_possible = False
    if not is_possible:
        raise ValueError(f"{field}: expected {words}, got {shown(value)}")
    return kind.type(number).item()


def _outside(builder: flatbuffers.Builder, field: str, of: str, name: str, value: Any) -> int | None:
    if of == "string":
        if not isinstance(value, str):
            raise ValueError(f"{field}: expected a text, got {shown(value)}")
        return builder.CreateString(value)
    if of.startswith("["):
        items = [_outside(builder, field, of[1:-1], name, item) for item in value]
        builder.StartVector(4, len(items), 4)
        for item in reversed(items):
            builder.PrependUOffsetTRelative(item)
        return builder.EndVector()
    full = _full(of, name)
    return _table(builder, full, value) if full in schema.TABLES else None
