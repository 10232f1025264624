"""Episodes that a program begins itself: steps, resets, at a server of its own or one that runs already."""
from __future__ import annotations

import contextlib
import dataclasses
import os
import pathlib
import select
import shutil
import socket
import subprocess
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Sequence, TypeVar

from . import arguments
from .arguments import Place, shown
from .driver import Control, Driver, Observation, Run, values_of
from .nouns import Noun
from .wire import POLLING, VERSION, Wire, WireError

if TYPE_CHECKING:
    from .view import View

_Client = TypeVar("_Client", bound="Client")


class Fault(ValueError):
    """The server cannot do what was asked: one line that says why, `line` of the scenario where there is one.

    The simulation lives on: reset() begins another episode.
    """

    def __init__(self, text: str, line: int) -> None:
        super().__init__(text)
        self.line = line


@dataclasses.dataclass(frozen=True)
class Outcome:
    """How an episode ended: `verdict` is 'passed', 'failed' or, without checks, 'completed'."""

    verdict: str
    reason: str
    ticks: int


def find_program() -> str:
    """The program `reprise`: what the variable REPRISE names, or the first in PATH."""
    program = os.environ.get("REPRISE") or shutil.which("reprise")
    if not program:
        raise FileNotFoundError("no program 'reprise' in PATH: install it, or name it in the variable REPRISE")
    return program


class _Server:
    """A `reprise serve` of our own, for one client; ends with us however we end, as it loses its socket then."""

    def __init__(self, folder: str) -> None:
        if not os.path.isdir(folder):
            raise NotADirectoryError(f"folder={shown(folder)}: there is no such folder")
        self.channel, its_own = socket.socketpair(socket.AF_UNIX, socket.SOCK_STREAM)
        number = its_own.fileno()
        try:
            self._process = subprocess.Popen(
                [find_program(), "serve", "--socket", f"fd:{number}", "--folder", folder],
                pass_fds=[number], stdin=subprocess.DEVNULL, start_new_session=True,
            )  # fmt: skip
        except BaseException:
            self.channel.close()
            raise
        finally:
            its_own.close()

    def end_of_it(self) -> str:
        """For a message: how it ended, if it did; nobody but us lets it."""
        try:
            code = self._process.wait(1)
        except subprocess.TimeoutExpired:
            return ""
        return f": its server was ended by signal {-code}" if code < 0 else f": its server ended with exit code {code}"

    def end(self) -> None:
        for ask in (lambda: None, self._process.terminate, self._process.kill):
            ask()
            try:
                self._process.wait(5)
                return
            except subprocess.TimeoutExpired:
                continue


_OF_TASKS = ("town", "cars", "weather", "model", "start", "goal", "rig")
#: of the plan of an episode, where nothing else is said
_UNASKED: dict[str, Any] = dict(town="town1", cars=0, weather="clear_noon", model="sedan")
_MOST = 2 << 20  # [bytes] of a message, as servers take them


class Client:
    """A connection with a server of episodes, and the plan of the next one: what Simulation and MultiSimulation share."""

    def __init__(self, plan: dict[str, Any], server: str | None, token: str | None, folder: str | os.PathLike,
                 polling: float = POLLING) -> None:  # fmt: skip
        self.outcome: Outcome | None = None  #: of the last episode, once it has ended
        self._process = os.getpid()
        self._plan = plan
        self._check_plan()
        self._check_asked(plan)
        self._wire: Wire | None = None
        self._server = None if server else _Server(os.fspath(folder))
        try:
            self._wire = Wire(self._server.channel if self._server else server, polling)
            self._say("open", version=VERSION, schema=self._wire.digest, token=token)
            kind, answer = self._hear()
            if kind == "hello":
                raise WireError(f"{shown(server)}: no server is there, but a run that waits for a driver: reprise.drive()")
            if kind != "open" or answer.version != VERSION:
                raise WireError(f"the server speaks another version of the wire than this package ({VERSION})")
        except BaseException:
            self.close()
            raise

    def __enter__(self: _Client) -> _Client:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def _leave_episode(self) -> None:
        """Lets go of what belongs to the episode that runs."""

    def close(self) -> None:
        """Leaves; the episode that runs ends. May be called again. In a process that was forked from the one that
        made this nothing ends: the connection is the other one's."""
        wire, self._wire = self._wire, None
        if self._process != os.getpid():
            if wire:
                wire.close()
            self._server = None
        elif wire:
            self._leave_episode()
            with contextlib.suppress(WireError):  # it went first
                wire.say("goodbye", reason="closed")
            wire.close()
        elif self._server:
            self._server.channel.close()
        server, self._server = self._server, None
        if server:
            server.end()

    def _open_wire(self) -> Wire:
        if self._process != os.getpid():  # two that step the same episode would not hear each its own answers
            raise RuntimeError("this simulation is of the process that this one was forked from: make another one here")
        if self._wire is None:
            raise WireError("this simulation is closed")
        return self._wire

    def _explained(self, error: WireError) -> WireError:
        return WireError(f"{error}{self._server.end_of_it()}") if self._server else error

    def _say(self, kind: str, **values: Any) -> None:
        arguments.refuse_nul(kind, values)
        try:
            self._open_wire().say(kind, _MOST, **values)
        except WireError as error:
            raise self._explained(error) from None

    def _hear(self, first: bool = False) -> tuple[str, Noun]:
        wire = self._open_wire()
        try:
            kind, message = wire.receive_first() if first else wire.receive()
        except WireError as error:
            raise self._explained(error) from None
        if kind == "fault":
            raise Fault(message.text, message.line)
        return kind, message

    def _change_plan(self, changes: dict[str, Any]) -> None:
        for name in changes:
            if name not in self._plan:
                raise TypeError(f"reset: no {name!r}; there are {', '.join(self._plan)}")
        self._plan = {**self._plan, **changes}
        self._check_plan()
        self._check_asked(changes)

    @contextlib.contextmanager
    def _asked(self, changes: dict[str, Any]) -> Iterator[None]:
        """What is asked for stays for the resets after it, but what cannot be does not."""
        before = self._plan
        try:
            self._change_plan(changes)
            yield
        except Exception:  # a Fault, a file that is not there
            self._plan = before
            raise

    def _check_plan(self) -> None:
        if self._plan["scenario"] is not None and self._plan["walkers"] != 0:
            raise ValueError("walkers: a scenario says itself how many people walk: walkers = 100 in its header")
        if self._plan["scenario"] is not None and self._plan["every"] != 1:
            raise ValueError("every: a scenario says itself how often its driver is asked: spawn{ every = 2 }")
        arguments.whole("every", self._plan["every"], 1, 100, "ticks")

    def _check_asked(self, asked: Mapping[str, Any]) -> None:
        """What was asked for now must not be passed over."""
        for name, value in asked.items():
            if arguments.is_unsaid(value) or (isinstance(value, (str, int)) and value == _UNASKED.get(name)):
                continue
            if self._plan["scenario"] is not None and name in _OF_TASKS:
                raise ValueError(f"{name}={shown(value)}: is for tasks, a scenario says that itself")
            if self._plan["scenario"] is None and name == "settings":
                raise ValueError(f"settings={shown(value)}: is for scenarios, a task has none")

    def _message(self) -> dict[str, Any]:
        plan = self._plan
        message: dict[str, Any] = dict(seeded=plan["seed"] is not None, seed=0 if plan["seed"] is None else plan["seed"],
                                       seconds=0.0 if plan["seconds"] is None else plan["seconds"], trace=plan["trace"])  # fmt: skip
        if plan["scenario"] is None:
            message["task"] = dict(town=plan["town"], cars=plan["cars"], walkers=plan["walkers"],
                                   walker_seeded=plan["walker_seed"] is not None,
                                   walker_seed=0 if plan["walker_seed"] is None else plan["walker_seed"], weather=plan["weather"], model=plan["model"],
                                   start=arguments.place("start", plan["start"]),
                                   goal=arguments.place("goal", plan["goal"]), rig=arguments.sensors(plan["rig"]),
                                   every=plan["every"])  # fmt: skip
            return message
        scenario = arguments.path_or_text("scenario", plan["scenario"])
        if "\n" in scenario and isinstance(plan["scenario"], str):
            message.update(source=scenario)
        elif "/" in scenario or "\n" in scenario:
            path = pathlib.Path(scenario)
            message.update(source=path.read_text(), name=path.name)
        else:
            message.update(file=scenario)
        message["settings"] = arguments.settings(plan["settings"])
        return message


class Simulation(Client):
    """Episodes in which this program drives the vehicle 'ego', in lockstep: nothing moves between two steps.

        with reprise.Simulation('town1', cars=100, seed=7) as sim:
            seen = sim.reset()
            while seen is not None:
                seen = sim.step(throttle=0.4)
            print(sim.outcome)

    `town`, `cars`, `weather`, `model`, `start` and `goal` make a task: a place is a lane ('b1_b2_1', or with metres
    along it ('b1_b2_1', 30.0)), the number of a spawn point, or 'drawn' (by the seed). No `start` is drawn as well; no
    `goal` is none. With a goal the episode ends on arrival ('passed'), or when the time is over that the way takes at
    10 km/h ('failed'). `seconds` limits an episode; without it a task lasts two hours.

    `scenario` takes the place of a task: a file's name in the server's folder, a path (read here), or Lua text, whose
    parameters `settings` changes; it spawns 'ego' with driver = 'external'.

    `walkers` people go on foot; who they are and where they go follows from `walker_seed`, or from `seed` without one.

    `rig` of a task: sensors of the vehicle, in the words of a scenario's rig, such as [dict(name='front', kind='rgb',
    width=84, height=84), dict(name='roof', kind='lidar', z=1.8, attributes=dict(channels=16))]; `seen.image('front')`
    is what a camera sees, `seen.sensors['roof']` what another one does. A process that renders is started in each reset.

    `every` [ticks] of a task: each so many are shown, and what is said holds until the next; its sensors look as often
    unless they say otherwise. `seen.passed` are the ticks between.

    `trace` is a name in the folder, such as 'a.mcap'; each reset writes it anew. Equal arguments give equal ticks,
    whatever was driven before, here or elsewhere.

    `server` is the socket of a `reprise serve` that runs already, 'PATH' or 'HOST:PORT' (then with its `token`, if
    it wants one); without it this starts one of its own, in `folder`, and ends it with close() or the `with`.

    `polling` [s]: for so long it looks again and again for each tick before it sleeps, and the run need not wake it; less
    often where somebody else wants its processor. 0: it always sleeps (docs/drivers.md).
    """

    def __init__(self, town: str = "town1", *, cars: int = 0, seed: int | None = None, weather: str = "clear_noon",
                 start: Place = None, goal: Place = None, model: str = "sedan", scenario: str | os.PathLike | None = None,
                 settings: Mapping[str, Any] | None = None, seconds: float = 0.0, trace: str | None = None,
                 rig: Sequence[Mapping[str, Any]] = (), walkers: int = 0, walker_seed: int | None = None, every: int = 1,
                 server: str | None = None,
                 token: str | None = None, folder: str | os.PathLike = ".", polling: float = POLLING) -> None:  # fmt: skip
        self.run_info: Run | None = None  #: what stays the same in this episode; also `seen.run`
        self._seen: Observation | None = None
        self._is_unheard = False  # a control was said, and what came of it was not read
        super().__init__(
            dict(town=town, cars=cars, walkers=walkers, walker_seed=walker_seed, seed=seed, weather=weather, start=start, goal=goal, model=model,
                 scenario=scenario, settings=settings, seconds=seconds, trace=trace, rig=rig, every=every),
            server, token, folder, polling)  # fmt: skip

    def _hear(self, first: bool = False) -> tuple[str, Noun]:
        try:
            return super()._hear(first)
        except Fault:
            self._seen = None
            raise

    def reset(self, **changes: Any) -> Observation:
        """Begins an episode and returns what its first tick shows. `changes` to the arguments of the class, such as
        seed=8, stay for the resets after it, unless they cannot be. Raises Fault for what cannot be, such as a mistake in a scenario."""
        with self._asked(changes):
            return self._begin()

    def _begin(self) -> Observation:
        if self._is_unheard and select.select([self._open_wire()], [], [], 0)[0]:
            with contextlib.suppress(Fault):  # Ctrl-C came while we waited for it: perhaps that episode's last word
                self._hear()
        self._seen, self.outcome, self._is_unheard = None, None, False
        self._say("reset", **self._message())
        kind, message = self._hear(first=True)
        while kind == "observation":  # of the episode before, where Ctrl-C came while we waited for it
            kind, message = self._hear(first=True)
        if kind == "goodbye":
            self.outcome = Outcome(message.verdict, message.reason, message.ticks)
            raise Fault("the episode ended before a vehicle 'ego' with driver = 'external' was there", 0)
        wire = self._open_wire()
        wire.ready()
        self.run_info = Run(message, wire.descriptor())
        seen = self._look()
        if seen is None:
            raise Fault("the episode ended in the tick in which 'ego' appeared", 0)
        return seen

    def _look(self) -> Observation | None:
        kind, message = self._hear()
        if kind == "observation" and self.run_info is not None:
            self._seen = Observation(self.run_info, message)
        else:
            self._seen, self.outcome = None, Outcome(message.verdict, message.reason, message.ticks)
        return self._seen

    def step(self, control: Control | None = None, **values: Any) -> Observation | None:
        """One tick (`seen.run.step` seconds), or `every`, with this control, given whole or by its fields: step(throttle=0.4).
        Returns what the next tick shows; None when the episode is over, and `outcome` says how it ended."""
        if self._seen is None:
            raise RuntimeError("no episode runs: reset() begins one")
        if control is not None and values:
            raise TypeError(f"step: a control whole, or by its fields ({', '.join(values)}), not both")
        self.say(control if control is not None else Control(**values))
        return self.hear()

    def say(self, control: Control) -> None:
        """The first half of step(): hands the control over. Who says to several simulations what they shall do, and only
        then hears what came of it, lets them work at once."""
        if self._seen is None:
            raise RuntimeError("no episode runs: reset() begins one")
        if self._is_unheard:  # Ctrl-C came while we waited for it
            raise RuntimeError("what came of the last control was not heard yet: hear() waits for it, reset() begins anew")
        try:
            self._open_wire().control(self._seen.index, *values_of(control))
        except WireError as error:
            raise self._explained(error) from None
        self._is_unheard = True

    def hear(self) -> Observation | None:
        """The other half: waits for what the next tick shows, as step() returns it. Once for each say()."""
        if not self._is_unheard:
            raise RuntimeError("nothing is on its way: say() comes before hear()")
        seen = self._look()
        self._is_unheard = False
        return seen

    def show(self, radius: float | None = 60.0) -> View:
        """What `seen.show()` of the last tick shows."""
        if self._seen is None:
            raise RuntimeError("no episode runs: reset() begins one")
        return self._seen.show(radius)

    def run(self, driver: Driver, ticks: int | None = None) -> Outcome | None:
        """Lets a driver drive, from a reset where no episode runs, until the end or for so many ticks."""
        seen: Observation | None = self._seen or self.reset()
        while seen is not None and (ticks is None or ticks > 0):
            self.say(driver(seen))
            seen = self.hear()
            ticks = None if ticks is None else ticks - 1
        return self.outcome
