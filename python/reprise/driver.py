"""What a driver sees and says, and the loop that takes it through a run."""
from __future__ import annotations

import contextlib
import dataclasses
import functools
import math
import operator
import os
import struct
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from .arguments import printable
from .nouns import Noun, dtype, enum
from .pictures import Frames, Images, Sensors
from .wire import POLLING, VERSION, Wire, WireError

if TYPE_CHECKING:
    from .view import View

_NO_TRAFFIC = struct.pack("<IHHi", 8, 4, 4, 4)  # a table in which nothing is said: who sees sensors only has no other

_STATE, _MEASURED = dtype("VehicleState").names, dtype("Measurement").names
_TURNINGS = {number: name for name, number in enum("remote.Turning").items()}


@dataclasses.dataclass(frozen=True)
class Control:
    """What a driver does from the next tick on. Raises ValueError for what no car can do."""

    throttle: float = 0.0  #: [0, 1]
    brake: float = 0.0  #: [0, 1]
    steer: float = 0.0  #: [-1, 1], left positive, share of the largest steering angle
    hand_brake: bool = False
    reverse: bool = False
    lamps: int = 0  #: bits of world/models/catalogue.h

    def __post_init__(self) -> None:
        try:
            if (0 <= self.throttle <= 1 and 0 <= self.brake <= 1 and -1 <= self.steer <= 1
                    and self.hand_brake in (False, True) and self.reverse in (False, True)
                    and 0 <= operator.index(self.lamps) <= 0xFFFF):  # fmt: skip
                return
        except (TypeError, ValueError):  # a text, an array
            pass
        self._refuse()

    def _refuse(self) -> None:
        """Says which of the values cannot be."""
        for name, low in (("throttle", 0), ("brake", 0), ("steer", -1)):
            value = getattr(self, name)
            try:
                is_possible = bool(low <= value <= 1)
            except (TypeError, ValueError):
                is_possible = False
            if not is_possible:
                raise ValueError(f"Control({name}={value!r}): expected a number in [{low}, 1]")
        for name in ("hand_brake", "reverse"):
            value = getattr(self, name)
            if not isinstance(value, (bool, int, np.bool_)) or value not in (False, True):
                raise ValueError(f"Control({name}={value!r}): expected a bool in [False, True]")
        raise ValueError(f"Control(lamps={self.lamps!r}): expected the bits of lamps, an integer in [0, 65535]")


class Run:
    """What stays the same in a run.

    Attributes: `actor` id of the driven vehicle, `name` the scenario's word for it, `step` [s] between ticks, `town`
    and `episode` nouns (world/town.fbs, world/episode.fbs); `town.lanes[i].centre` is a centre line; `sensors.rig` what
    the vehicle carries (Sensor of world/tick.fbs), `route` the set_route in force, with the stops that are left, for who
    takes over in the middle of a run (Command of world/tick.fbs; else None: routes are in the ticks), `every` [ticks] from
    one that the driver is shown to the next.
    """

    def __init__(self, hello: Noun, memory: int | None = None) -> None:
        self.actor: int = hello.actor
        self.name: str = hello.name
        self.step: float = hello.step_ns * 1e-9
        self.town = Noun(hello.town.data, "world.Town")
        self.episode = Noun(hello.episode.data, "world.Episode")
        self.route: Noun | None = Noun(hello.route.data, "world.Command") if len(hello.route) else None
        pause = Noun(hello.spawn.data, "world.Command").duration if len(hello.spawn) else 0.0
        self.every: int = round(pause / self.step) if pause else 1
        self.sensors = Sensors.of(hello, memory)


class Ego:
    """The driven vehicle: the fields of its VehicleState and of its Measurement (world/tick.fbs).

    `position` [m] and `velocity` [m/s] are arrays (3,) in the world's frame, x east, y north, z up; `yaw` [rad]
    counter-clockwise from east; `speed` [m/s] along its own x axis.
    """

    def __init__(self, tick: Noun, actor: int) -> None:
        self._tick, self._actor = tick, actor

    @functools.cached_property
    def _state(self) -> np.void:
        vehicles = self._tick.vehicles
        return vehicles[vehicles["id"].searchsorted(self._actor)]

    @functools.cached_property
    def _measured(self) -> np.void:
        measured = self._tick.measurements
        return measured[measured["actor"].searchsorted(self._actor)]

    @functools.cached_property
    def position(self) -> np.ndarray:
        return np.array(self._state["position"].item())

    @functools.cached_property
    def velocity(self) -> np.ndarray:
        return np.array(self._state["velocity"].item())

    @functools.cached_property
    def yaw(self) -> float:
        w, x, y, z = self._state["orientation"].item()
        return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))

    def __getattr__(self, field: str) -> Any:
        for fields, of in ((_STATE, "_state"), (_MEASURED, "_measured")):
            if field in fields:
                value = self.__dict__[field] = getattr(self, of)[field]  # the next look is a plain attribute
                return value
        raise AttributeError(f"no '{field}': {', '.join(_STATE + _MEASURED)}")


class Observation:
    """A tick. `tick` and `traffic` are nouns with all that is recorded; the rest are short words for what is asked most.

    The arrays look into the message: they may not be written, and cost nothing until they are looked at.
    """

    def __init__(self, run: Run, message: Noun) -> None:
        self.run = run
        self.tick = message.nested("tick", "world.Tick")
        self._message = message

    @functools.cached_property
    def images(self) -> Images:
        """By the names of their sensors: those that were due in this tick."""
        return Images(self.run.sensors, self._message.pictures)

    def image(self, name: str) -> np.ndarray | None:
        """What the sensor of that name sees in this tick; None where it makes no frame of it (`every`).

        rgb: (height, width, 3) uint8; depth: (height, width) float32 [m] along the optical axis, inf where only sky is;
        semantic: (height, width) uint8, CARLA 0.9.14's classes. A view into shared memory that may not be written: it
        stays as it is until the driver has answered the next tick; what is to be kept longer is copied (`.copy()`).
        Raises KeyError for a sensor that the vehicle does not carry.
        """
        return self.images.get(name)

    @functools.cached_property
    def sensors(self) -> Frames:
        """What all sensors of the rig saw in this tick, by their names: images of cameras, and of others rows with
        named columns (docs/sensors.md), float32 of what measures by rays and float64 of readings.

        `seen.sensors['roof']['intensity']`, `reprise.xyz(seen.sensors['roof'])`, `seen.sensors['imu']['gyroscope_z'][0]`.
        `collision` and `lane_invasion` have a row for each thing that happened, so mostly none. Views, as of image().
        """
        return Frames(self.run.sensors, self._message.pictures)

    @functools.cached_property
    def traffic(self) -> Noun:
        """world.Traffic: what moves without mass."""
        return self._message.nested("traffic", "world.Traffic") or Noun(_NO_TRAFFIC, "world.Traffic")

    @functools.cached_property
    def passed(self) -> tuple[Noun, ...]:
        """The ticks since the one before, of a driver that is shown each few only (`every`): what was said and what
        happened in them is there, and nowhere else."""
        return tuple(one.nested("tick", "world.Tick") for one in self._message.passed)

    @property
    def index(self) -> int:
        """Of the tick; 1 is the first of the run."""
        return self.tick.index

    @property
    def time(self) -> float:
        """[s] of simulated time since the start."""
        return self.index * self.run.step

    @property
    def turning(self) -> str:
        """What to do at the next junction: 'follow_lane', 'straight', 'left' or 'right'; 'none' without a goal."""
        return _TURNINGS[self._message.turning]

    @property
    def way_to_goal(self) -> float:
        """[m] along the shortest way; 0 without a goal."""
        return self._message.way_to_goal

    @functools.cached_property
    def ego(self) -> Ego:
        """The driven vehicle."""
        return Ego(self.tick, self.run.actor)

    def show(self, radius: float | None = 60.0) -> View:
        """From above, for a notebook or `.save('now.html')`: so many metres around the driven vehicle, in red; None: all."""
        from .view import view_of_tick

        return view_of_tick(self.run.town, self.tick, self.traffic, self.run.step, {self.run.actor}, radius)

    @property
    def vehicles(self) -> np.ndarray:
        """All vehicles with mass, the own one included: VehicleState (world/tick.fbs), sorted by id."""
        return self.tick.vehicles

    @property
    def cars(self) -> np.ndarray:
        """Background and parked cars: CarState (world/traffic.fbs), sorted by id."""
        return self.traffic.cars

    @property
    def walkers(self) -> np.ndarray:
        """WalkerState (world/traffic.fbs), sorted by id."""
        return self.traffic.walkers

    @property
    def signals(self) -> np.ndarray:
        """SignalColor of each of `run.town.signals`."""
        return self.tick.signals


Driver = Callable[[Observation], Control]


def drive(driver: Driver, address: str | None = None, *, polling: float = POLLING) -> int:
    """Drives until the run is over. Returns how often it was asked.

    `driver` is asked once for each tick that it is shown. What it raises ends the run with the verdict driver_lost, and is raised here; the run
    is told what it was, and in which tick.
    `address` is a socket's path or '127.0.0.1:PORT'; without it the program must have been started by `reprise run
    --driver`. Raises WireError where the place is taken.
    `polling` [s]: for so long it looks again and again for each tick before it sleeps, and the run need not wake it; less
    often where somebody else wants its processor. 0: it always sleeps (docs/drivers.md).
    """
    wire = Wire(address, polling)
    ticks, where = 0, "before its first tick"
    try:
        try:
            kind, hello = wire.receive_first()
        except WireError as error:
            hint = "; at a `reprise serve` a reprise.Simulation begins episodes" if address else ""
            raise WireError(f"{error} before it said hello{hint}") from None
        if kind == "fault":
            raise WireError(hello.text)
        if kind == "goodbye":
            return ticks  # it ended before there was somebody to drive
        if kind != "hello":
            raise WireError("the run did not begin with hello")
        wire.ready()
        if hello.version != VERSION:
            raise WireError(f"the run speaks version {hello.version} of the wire, this package {VERSION}")
        run = Run(hello, wire.descriptor())
        while True:
            kind, message = wire.receive()
            if kind != "observation":
                return ticks
            seen = Observation(run, message)
            where = f"in tick {seen.index}"
            control = values_of(driver(seen))
            try:
                wire.control(seen.index, *control)
            except WireError:
                continue  # then the run's last word is waiting
            ticks += 1
    except WireError:
        raise
    except BaseException as error:
        with contextlib.suppress(WireError):  # the run may have gone first
            wire.goodbye(last_words(error, where))
        raise
    finally:
        wire.close()


def last_words(error: BaseException, where: str) -> str:
    """Why a driver gave up, for people who see one line of it: what, in which tick, and where in its code."""
    if isinstance(error, KeyboardInterrupt):
        return f"it was interrupted (Ctrl-C) {where}"
    if isinstance(error, SystemExit):
        return f"it called sys.exit({'' if error.code is None else repr(error.code)}) {where}"
    line, step = "", error.__traceback__
    while step is not None:
        path = step.tb_frame.f_code.co_filename
        if os.path.isfile(path) and os.path.dirname(path) != os.path.dirname(__file__) and "-packages" not in path:
            line = f" ({os.path.basename(path)}:{step.tb_lineno})"
        step = step.tb_next
    told = printable(str(error))  # the run takes 300 bytes; the place shall be among them
    told = told if len(told) <= 160 else told[:160] + " ..."
    return f"{type(error).__name__} {where}: {told}{line}"


def values_of(control: Control) -> tuple[float, float, float, bool, bool, int]:
    if not isinstance(control, Control):
        hint = {type(None): " (is a `return` missing?)", dict: " (reprise.Control(**values) makes one of it)"}
        raise TypeError(f"a driver returns a reprise.Control, not {control!r}{hint.get(type(control), '')}")
    return (control.throttle, control.brake, control.steer, control.hand_brake, control.reverse, control.lamps)
