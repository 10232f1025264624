"""What people hand over: read here, or refused in one line that says what was expected."""
from __future__ import annotations

import numbers
import operator
import os
from typing import Any, Mapping, Sequence, Union

Place = Union[str, int, "tuple[str, float]", None]

#: of a sensor, where nothing else is said
_SENSOR = dict(kind="rgb", width=800, height=600, fov_deg=90.0, x=1.0, y=0.0, z=1.4, yaw_deg=0.0, pitch_deg=0.0,
               roll_deg=0.0, every=0)  # fmt: skip
_LONGEST = 80  # characters of a value in a message


def printable(text: str) -> str:
    """For a message of one line: what cannot be seen, or would begin another line, is written out, as in '\\n'."""
    return "".join(one if one.isprintable() else repr(one)[1:-1] for one in text)


def shown(value: Any) -> str:
    """A value in a message: in one line, and not all of it where it is long."""
    text = printable(" ".join(repr(value).split()))
    return text if len(text) <= _LONGEST else text[:_LONGEST] + " ..."


def is_unsaid(value: Any) -> bool:
    """None, and what is empty."""
    return value is None or (isinstance(value, (str, tuple, list, dict)) and not value)


def _is_whole(value: Any) -> bool:
    try:
        operator.index(value)
    except TypeError:  # an array has __index__ as well, and refuses then
        return False
    return True


def whole(name: str, value: Any, low: int, high: int, unit: str) -> int:
    """A whole number in [low, high]. Raises ValueError."""
    number = operator.index(value) if _is_whole(value) else low - 1
    if not low <= number <= high:
        raise ValueError(f"{name}={shown(value)}: expected {low} to {high} {unit}")
    return number


def place(name: str, said: Place) -> dict[str, Any] | None:
    """Where a task begins or ends, as the wire has it. Raises ValueError."""
    if said is None:
        return None
    if isinstance(said, str):
        return {"kind": "drawn"} if said == "drawn" else {"kind": "lane", "lane": said, "s": 10.0}
    if isinstance(said, (tuple, list)):
        if len(said) == 2 and isinstance(said[0], str) and isinstance(said[1], numbers.Real):
            return {"kind": "lane", "lane": said[0], "s": float(said[1])}
    elif not isinstance(said, bool) and _is_whole(said):
        return {"kind": "spawn_point", "spawn_point": whole(name, said, 0, 0xFFFFFFFF, "as the number of a spawn point")}
    raise ValueError(f"{name}={shown(said)}: expected a lane, with or without metres along it ('b1_b2_1' or ('b1_b2_1', 30.0)), "
                     "the number of a spawn point, 'drawn' or None")  # fmt: skip


def sensors(said: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]] | None:
    """The rig of a task, as the wire has it. Raises ValueError."""
    if not isinstance(said, (tuple, list)) or not all(isinstance(one, Mapping) for one in said):
        if is_unsaid(said):
            return None
        raise ValueError(f"rig={shown(said)}: expected a list of sensors, each a dict, such as "
                         "[dict(name='front', kind='rgb', width=84, height=84)]")  # fmt: skip
    return [_sensor(one) for one in said] or None


def _sensor(said: Mapping[str, Any]) -> dict[str, Any]:
    for key in said:
        if key not in _SENSOR and key not in ("name", "attributes"):
            raise ValueError(f"rig: a sensor has no {shown(key)}; there are name, {', '.join(_SENSOR)}, attributes")
    if "name" not in said:
        raise ValueError(f"rig: {shown(dict(said))} has no name: its frames are asked for by that, seen.image('front')")
    sensor = {**_SENSOR, **said}
    attributes = sensor.pop("attributes", None)
    attributes = {} if attributes is None else attributes
    if not isinstance(attributes, Mapping) or not all(
            isinstance(name, str) and isinstance(value, numbers.Real) for name, value in attributes.items()):  # fmt: skip
        raise ValueError(f"attributes={shown(attributes)}: expected a dict of names and numbers, such as dict(channels=16)")
    sensor["attributes"] = [dict(name=name, value=float(value)) for name, value in attributes.items()] or None
    return sensor


def settings(said: Mapping[str, Any] | None) -> list[dict[str, str]] | None:
    """The parameters of a scenario, as the wire has them. Raises ValueError."""
    if is_unsaid(said):
        return None
    if not isinstance(said, Mapping) or not all(isinstance(key, str) for key in said):
        raise ValueError(f"settings={shown(said)}: expected a dict of the scenario's parameters, such as dict(gap=12)")
    return [dict(key=key, value=str(value).lower() if isinstance(value, bool) else str(value)) for key, value in said.items()]


def refuse_nul(name: str, said: Any) -> None:
    """Of what is to be said: a server's messages, and much else, end at that character. Raises ValueError."""
    if isinstance(said, str) and "\0" in said:
        raise ValueError(f"{name}: expected a text without the character NUL, got {shown(said)}")
    if isinstance(said, (list, dict)):
        for key, value in said.items() if isinstance(said, dict) else ((name, one) for one in said):
            refuse_nul(key, value)


def path_or_text(name: str, said: str | os.PathLike) -> str:
    """Raises ValueError for what is neither."""
    found = os.fspath(said) if isinstance(said, os.PathLike) else said
    if not isinstance(found, str):
        raise ValueError(f"{name}={shown(said)}: expected a text or a path")
    return found
