"""The goal-directed tasks of the CARLA paper, as environments for learning have them: what is seen, done and rewarded.

Dosovitskiy et al., "CARLA: An Open Urban Driving Simulator", CoRL 2017: tasks, reward, success and infractions are its.
reprise.gym drives one vehicle by these, reprise.zoo several.
"""
from __future__ import annotations

import functools
import json
import os
import pathlib
import shutil
from typing import Any, Sequence

import numpy as np
from gymnasium import spaces

from .arguments import shown
from .driver import Control, Ego, Observation
from .simulation import find_program
from .state import COMMANDS, SIZE, Measured, StateVector

TASKS = ("straight", "one_turn", "navigation", "navigation_dynamic")
CARS = {"town1": 20, "town2": 15}  # of navigation_dynamic, as the paper's benchmark has them
PICTURES = {"rgb84": (84, 84), "rgb200x88": (200, 88)}  # [px] width, height; the paper's agents saw such
SHARE = 0.3  # of the footprint: beyond it an infraction
LONGEST = 2.0  # [s] of one infraction; what lasts longer counts again


def _scenarios() -> pathlib.Path:
    """Where the program keeps its towns: in its source tree, or installed."""
    program = pathlib.Path(shutil.which(find_program()) or find_program()).resolve().parent
    for place in (program / "../../../scenarios", program / "../share/reprise/scenarios"):
        if place.is_dir():
            return place.resolve()
    raise FileNotFoundError(f"no folder 'scenarios' belongs to {program}: name one by tasks=")


@functools.lru_cache(maxsize=None)
def _read_tasks(path: str) -> dict[str, list[dict[str, Any]]]:
    return json.loads(pathlib.Path(path).read_text())["tasks"]


def read_episodes(town: str, task: str, path: str | os.PathLike | None = None) -> list[dict[str, Any]]:
    """The episodes of a kind of task: 'start' and 'goal', each with 'lane' and 's' [m]. `path` of another tasks.json
    than the town's own. Raises ValueError for what is no task."""
    if task not in TASKS:
        raise ValueError(f"no task '{task}'; there are {', '.join(TASKS)}")
    towns = _scenarios() / "towns"
    file = os.fspath(path) if path else str(towns / town / "tasks.json")
    if not path and not os.path.isfile(file):
        there = ", ".join(sorted(one.parent.name for one in towns.glob("*/tasks.json")))
        raise ValueError(f"no tasks are there of the town '{town}', but of {there}; a file of your own is named by tasks=")
    return _read_tasks(file)["navigation" if task == "navigation_dynamic" else task]


def cars_of(town: str, task: str, cars: int | None) -> int:
    """How many others drive: those asked for, or the task's own."""
    moving = CARS.get(town, 20) if task == "navigation_dynamic" else 0
    return moving if cars is None else cars


def rig_of(obs: str) -> list[dict[str, Any]]:
    """The cameras that an observation needs. Raises ValueError for what is none."""
    if obs != "state" and obs not in PICTURES:
        raise ValueError(f"no observation '{obs}'; there are 'state', {', '.join(map(repr, PICTURES))}")
    return [dict(name="front", width=PICTURES[obs][0], height=PICTURES[obs][1])] if obs in PICTURES else []


def action_space() -> spaces.Box:
    """float32 (2,): steer in [-1, 1], left positive; pedals in [-1, 1], throttle above 0, brake below."""
    return spaces.Box(-1.0, 1.0, (2,), np.float32)


def observation_space(obs: str) -> spaces.Box:
    """Of 'state', float32 (22,), or of a camera's picture, uint8 (height, width, 3)."""
    if obs in PICTURES:
        width, height = PICTURES[obs]
        return spaces.Box(0, 255, (height, width, 3), np.uint8)
    return spaces.Box(-np.inf, np.inf, (SIZE,), np.float32)


def control_of(action: Sequence[float] | np.ndarray) -> Control:
    """What a car can do of an action."""
    try:
        steer, pedals = (min(max(float(one), -1.0), 1.0) for one in action)
    except (TypeError, ValueError):
        raise ValueError(f"action={shown(action)}: expected two numbers in [-1, 1], steer and pedals") from None
    return Control(throttle=max(pedals, 0.0), brake=max(-pedals, 0.0), steer=steer)


class Infractions:
    """Counts, as the paper does: one lasts at most two seconds."""

    KINDS = ("opposite_lane", "sidewalk", "collision_static", "collision_vehicle", "collision_walker")

    def __init__(self) -> None:
        self.counts = dict.fromkeys(self.KINDS, 0)
        self._until = dict.fromkeys(self.KINDS, -1.0)
        self._impulses = (0.0, 0.0, 0.0)

    def look(self, seen: Observation) -> None:
        """Counts what happens in the next ticks, up to the one that is seen."""
        for tick in seen.passed:
            self._count(Ego(tick, seen.run.actor), tick.index * seen.run.step)
        self._count(seen.ego, seen.time)

    def _count(self, ego: Ego, time: float) -> None:
        impulses = (ego.impulse_static, ego.impulse_vehicles, ego.impulse_walkers)
        now = [ego.on_opposite_lane > SHARE, ego.on_sidewalk > SHARE]
        now += [new > old for new, old in zip(impulses, self._impulses)]
        self._impulses = impulses
        for kind, happens in zip(self.KINDS, now):
            if happens and time >= self._until[kind]:
                self.counts[kind] += 1
                self._until[kind] = time + LONGEST


class Journey:
    """One vehicle's task in an episode, tick by tick: `observation` as the space has it, and what look() and arrive()
    return, the five terms of the paper's reward since the tick before."""

    def __init__(self, obs: str, seen: Observation) -> None:
        self._observe = _picture if obs in PICTURES else StateVector(seen.run)
        self._infractions = Infractions()
        self._seen, self._measured = seen, Measured.of(seen)
        self.observation: np.ndarray = self._observe(seen, self._measured)

    def look(self, seen: Observation) -> dict[str, float]:
        """The next tick."""
        now = Measured.of(seen)
        self._seen, self.observation = seen, self._observe(seen, now)
        self._infractions.look(seen)
        return self._go_on(now)

    def stay(self) -> dict[str, float]:
        """The episode ended in a tick that nobody is shown."""
        return self._go_on(self._measured)

    def arrive(self) -> dict[str, float]:
        """The same, at the goal."""
        return self._go_on(self._measured._replace(way=0.0))

    def _go_on(self, now: Measured) -> dict[str, float]:
        before, self._measured = self._measured, now
        return reward_terms(before, now)

    def info(self) -> dict[str, Any]:
        """'command' and 'way_to_goal' [m] of the last tick, 'infractions' so far."""
        return {
            "command": self._seen.turning,
            "way_to_goal": self._seen.way_to_goal,
            "infractions": dict(self._infractions.counts),
        }


def reward_terms(before: Measured, now: Measured) -> dict[str, float]:
    """The paper's five, of two ticks one after the other."""
    return {
        "way": 1000 * (before.way - now.way),
        "speed": 0.05 * (now.speed - before.speed),
        "damage": -0.00002 * (now.damage - before.damage),
        "sidewalk": -2 * (now.sidewalk - before.sidewalk),
        "opposite_lane": -2 * (now.opposite_lane - before.opposite_lane),
    }


def _picture(seen: Observation, _: Measured) -> np.ndarray:
    return seen.images["front"].copy()
