"""Episodes in which one program drives several vehicles, each over a connection of its own."""
from __future__ import annotations

import contextlib
import os
import select
import socket
from typing import Any, Mapping, Sequence

from .arguments import shown
from .driver import Control, Driver, Observation, Run, values_of
from .simulation import Client, Fault, Outcome
from .wire import Wire, WireError


class MultiSimulation(Client):
    """Episodes in which this program drives all vehicles that are named, in lockstep, among others and each other.

        with reprise.MultiSimulation(('a', 'b'), 'two.lua') as sim:
            seen = sim.reset()                                # {'a': Observation, 'b': Observation}
            while seen:
                seen = sim.step({name: reprise.Control(throttle=0.4) for name in seen})
            print(sim.outcome)

    `scenario` as of reprise.Simulation; it spawns each of `drivers` with driver = 'external', when and where it likes.
    Who has not appeared yet, or was taken away (`ego:despawn()`), is not in what reset() and step() return; without
    anybody on the road the run goes on until somebody appears, or to its end. Rigs are the scenario's; so is who is shown
    each few ticks only (`every`): only who is in what was returned is told what to do.

    `settings`, `seed`, `seconds`, `trace`, `folder` and `server` as of reprise.Simulation; a server must be reached by
    the path of its socket, as connections cannot be handed over through a port.
    """

    def __init__(self, drivers: Sequence[str], scenario: str | os.PathLike, *, settings: Mapping[str, Any] | None = None,
                 seed: int | None = None, seconds: float = 0.0, trace: str | None = None, server: str | None = None,
                 token: str | None = None, folder: str | os.PathLike = ".") -> None:  # fmt: skip
        self.runs: dict[str, Run] = {}  #: of those on the road, by name; also `seen[name].run`
        self._wires: dict[str, Wire] = {}  # of those that drive, or may come
        self._seen: dict[str, Observation] = {}
        self._due: dict[str, int] = {}  # the next tick that each on the road is shown, by name
        self._is_on = False  # an episode whose last word was not heard yet
        super().__init__(dict(drivers=drivers, scenario=scenario, settings=settings, seed=seed, seconds=seconds,
                              trace=trace), server, token, folder)  # fmt: skip

    def _check_plan(self) -> None:
        names = self._plan["drivers"]
        is_list = isinstance(names, (tuple, list)) and all(isinstance(name, str) for name in names)
        if not is_list or not names or len(set(names)) < len(names):
            raise ValueError(f"drivers={shown(names)}: expected the names of different vehicles, such as ('a', 'b')")
        if self._plan["scenario"] is None:
            raise ValueError("scenario=None: expected a scenario that spawns " + ", ".join(names))

    def _leave_episode(self) -> None:
        self._let_go()

    def _let_go(self) -> None:
        for wire in self._wires.values():
            wire.close()
        self._wires, self._seen, self._due, self.runs = {}, {}, {}, {}

    def _last_word(self) -> None:
        """The run's, on our own connection. Raises Fault."""
        self._let_go()
        self._is_on = False
        _, message = self._hear()
        self.outcome = Outcome(message.verdict, message.reason, message.ticks)

    def reset(self, **changes: Any) -> dict[str, Observation]:
        """Begins an episode; returns what those see who appear first, by name. `changes` as of Simulation.reset()."""
        with self._asked(changes):
            return self._begin()

    def _begin(self) -> dict[str, Observation]:
        if self._is_on:  # it ends when its drivers are gone
            with contextlib.suppress(Fault):
                self._last_word()
        self.outcome = None
        self._say("reset", **self._message(), drivers=list(self._plan["drivers"]))
        self._is_on = False
        for _ in self._plan["drivers"]:
            _, message = self._hear(first=True)
            self._wires[message.name] = Wire(socket.socket(fileno=self._open_wire().descriptor()))
        self._is_on = True
        seen = self._look()
        if not seen:
            raise Fault("the episode ended before a vehicle of " + ", ".join(self._plan["drivers"]) + " was there", 0)
        return seen

    def _look(self) -> dict[str, Observation]:
        """What the next tick in which somebody is shown anything shows. Empty: the run is over."""
        self._seen, waiting = {}, {name for name in self.runs if self._due[name] == min(self._due.values())}
        while waiting or not self._seen:
            wires = {name: wire for name, wire in self._wires.items() if name in waiting or name not in self.runs}
            ready, _, _ = select.select([*wires.values(), self._open_wire()], [], [])
            # Who appears says hello before anybody is shown that tick, so nobody is missed.
            said = [name for name in self._plan["drivers"] if wires.get(name) in ready]
            if not said or any([self._take(name, waiting) for name in said]):
                self._last_word()
                return {}
        return dict(self._seen)

    def _take(self, name: str, waiting: set[str]) -> bool:
        """What was said to one of the drivers. True: the run is over."""
        wire = self._wires[name]
        try:
            kind, message = wire.receive() if name in self.runs else wire.receive_first()
        except WireError:
            return True
        if kind == "hello":
            wire.ready()
            self.runs[name] = Run(message, wire.descriptor())
            waiting.add(name)
        elif kind == "observation":
            seen = self._seen[name] = Observation(self.runs[name], message)
            waiting.discard(name)
            self._due[name] = seen.index + self.runs[name].every
            # Who has just appeared is shown that tick; those who are shown later ones are not waited for.
            waiting -= {other for other in waiting if self._due.get(other, 0) > seen.index}
        elif kind == "goodbye" and not message.verdict:  # taken away, and the run goes on
            wire.close()
            del self._wires[name], self.runs[name]
            self._due.pop(name, None)
            waiting.discard(name)
        else:
            return True
        return False

    def step(self, controls: Mapping[str, Control]) -> dict[str, Observation]:
        """One tick with a control for each that was in what reset() or step() returned last. Returns what the next tick
        shows, by name; empty when the episode is over, and `outcome` says how it ended."""
        if not self._seen:
            raise RuntimeError("no episode runs: reset() begins one")
        self._open_wire()  # nothing is said where it is not ours
        if set(controls) != set(self._seen):
            raise ValueError(f"step: expected a control for each of {', '.join(self._seen)}, got {', '.join(controls) or 'none'}")
        values = {name: values_of(control) for name, control in controls.items()}  # all of them, before one is said
        for name, seen in self._seen.items():
            with contextlib.suppress(WireError):  # then the run's last word is waiting
                self._wires[name].control(seen.index, *values[name])
        return self._look()

    def run(self, drivers: Mapping[str, Driver], ticks: int | None = None) -> Outcome | None:
        """Lets drivers drive, by name, from a reset where no episode runs, until the end or for so many ticks."""
        seen = self._seen or self.reset()
        while seen and (ticks is None or ticks > 0):
            seen = self.step({name: drivers[name](one) for name, one in seen.items()})
            ticks = None if ticks is None else ticks - 1
        return self.outcome
