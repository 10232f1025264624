"""Drive in Reprise: `reprise.drive(lambda tick: reprise.Control(throttle=0.4))`. See docs/drivers.md, docs/python.md."""
from .driver import Control, Driver, Ego, Observation, Run, drive
from .nouns import Noun, dtype, enum, points
from .pictures import Images, Sensors
from .simulation import Fault, Outcome, Simulation
from .trace import Trace, TraceError
from .way import Way
from .wire import WireError

__all__ = [
    "Control", "Driver", "Ego", "Fault", "Images", "Noun", "Observation", "Outcome", "Run", "Sensors", "Simulation", "Trace",
    "TraceError", "Way", "WireError", "drive", "dtype", "enum", "points",
]  # fmt: skip
