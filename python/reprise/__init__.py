"""Drive in Reprise: `reprise.drive(lambda tick: reprise.Control(throttle=0.4))`. See docs/drivers.md, docs/python.md.

Each part is loaded when it is first asked for: a driver does not wait for what reads traces.
"""
from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .dataset import Dataset
    from .driver import Control, Driver, Ego, Observation, Run, drive
    from .multi_simulation import MultiSimulation
    from .nouns import Noun, dtype, enum, points
    from .pictures import Frames, Images, Sensors, xyz
    from .simulation import Fault, Outcome, Simulation
    from .trace import Trace, TraceError
    from .view import View
    from .way import Way
    from .wire import WireError

_PARTS = {
    "dataset": ("Dataset",),
    "driver": ("Control", "Driver", "Ego", "Observation", "Run", "drive"),
    "multi_simulation": ("MultiSimulation",),
    "nouns": ("Noun", "dtype", "enum", "points"),
    "pictures": ("Frames", "Images", "Sensors", "xyz"),
    "simulation": ("Fault", "Outcome", "Simulation"),
    "trace": ("Trace", "TraceError"),
    "view": ("View",),
    "way": ("Way",),
    "wire": ("WireError",),
}
_PART_OF = {name: part for part, names in _PARTS.items() for name in names}

__all__ = [
    "Control", "Dataset", "Driver", "Ego", "Fault", "Frames", "Images", "MultiSimulation", "Noun", "Observation", "Outcome", "Run", "Sensors", "Simulation",
    "Trace", "TraceError", "View", "Way", "WireError", "drive", "dtype", "enum", "points", "xyz",
]  # fmt: skip


def _load(part: str) -> ModuleType:
    try:
        return importlib.import_module(f".{part}", __name__)
    except ModuleNotFoundError as error:
        missing = error.name
        if missing not in ("numpy", "flatbuffers"):
            raise
    # A machine has several Pythons, and `python3` in a driver's command need not be the one that has them.
    raise ImportError(
        f"reprise needs {missing}, which this Python ({sys.executable}) lacks: {sys.executable} -m pip install numpy "
        "flatbuffers, or use Debian's /usr/bin/python3 (apt install python3-numpy python3-flatbuffers)"
    ) from None


def __getattr__(name: str) -> Any:
    if name in _PARTS:
        return _load(name)
    if name not in _PART_OF:
        raise AttributeError(f"module 'reprise' has no attribute '{name}'; there are {', '.join(__all__)}")
    value = getattr(_load(_PART_OF[name]), name)
    globals()[name] = value  # the next look is a plain attribute
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
