"""Drive in Reprise: `reprise.drive(lambda tick: reprise.Control(throttle=0.4))`. See docs/drivers.md."""
from .driver import Control, Driver, Ego, Observation, Run, drive
from .nouns import Noun, dtype, enum, points
from .trace import Trace, TraceError
from .wire import WireError

__all__ = [
    "Control", "Driver", "Ego", "Noun", "Observation", "Run", "Trace", "TraceError", "WireError", "drive", "dtype", "enum", "points",
]  # fmt: skip
