"""Drive in Reprise: `reprise.drive(lambda tick: reprise.Control(throttle=0.4))`. See docs/drivers.md, docs/python.md."""
try:
    from .driver import Control, Driver, Ego, Observation, Run, drive
    from .nouns import Noun, dtype, enum, points
    from .pictures import Images, Sensors
    from .simulation import Fault, Outcome, Simulation
    from .trace import Trace, TraceError
    from .way import Way
    from .wire import WireError
except ModuleNotFoundError as missing:
    if missing.name not in ("numpy", "flatbuffers"):
        raise
    # A machine has several Pythons, and `python3` in a driver's command need not be the one that has them.
    import sys

    raise ImportError(
        f"reprise needs {missing.name}, which this Python ({sys.executable}) lacks: {sys.executable} -m pip install numpy "
        "flatbuffers, or use Debian's /usr/bin/python3 (apt install python3-numpy python3-flatbuffers)"
    ) from None

__all__ = [
    "Control", "Driver", "Ego", "Fault", "Images", "Noun", "Observation", "Outcome", "Run", "Sensors", "Simulation", "Trace",
    "TraceError", "Way", "WireError", "drive", "dtype", "enum", "points",
]  # fmt: skip
