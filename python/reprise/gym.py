"""The goal-directed tasks of the CARLA paper as Gymnasium environments.

    import gymnasium, reprise.gym
    env = gymnasium.make('reprise/Navigation-v0', town='town1', task='one_turn', obs='state')

or, without the import, gymnasium.make('reprise.gym:reprise/Navigation-v0').

Dosovitskiy et al., "CARLA: An Open Urban Driving Simulator", CoRL 2017: tasks, reward, success and infractions are its.
Needs gymnasium, which nothing else of this package does. Each environment has a process of its own, so that
gymnasium.make_vec(..., vectorization_mode='async') runs several at once.
"""
from __future__ import annotations

import functools
import json
import math
import os
import pathlib
import shutil
from typing import Any

import gymnasium
import numpy as np

from .driver import Control, Observation
from .nouns import points
from .simulation import Simulation, find_program

NONE = 0xFFFFFFFF
TASKS = ("straight", "one_turn", "navigation", "navigation_dynamic")
COMMANDS = ("follow_lane", "straight", "left", "right")
CARS = {"town1": 20, "town2": 15}  # of navigation_dynamic, as the paper's benchmark has them
NEAR = 4  # other vehicles in an observation
FAR = 50.0  # [m] where they end
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
def read_tasks(path: str) -> dict[str, list[dict[str, Any]]]:
    """The episodes of each kind of task, as scenarios/towns/*/tasks.json has them."""
    return json.loads(pathlib.Path(path).read_text())["tasks"]


class Infractions:
    """Counts, as the paper does: one lasts at most two seconds."""

    KINDS = ("opposite_lane", "sidewalk", "collision_static", "collision_vehicle", "collision_walker")

    def __init__(self) -> None:
        self.counts = dict.fromkeys(self.KINDS, 0)
        self._until = dict.fromkeys(self.KINDS, -1.0)
        self._impulses = (0.0, 0.0, 0.0)

    def look(self, seen: Observation) -> None:
        ego = seen.ego
        impulses = (ego.impulse_static, ego.impulse_vehicles, ego.impulse_walkers)
        now = [ego.on_opposite_lane > SHARE, ego.on_sidewalk > SHARE]
        now += [new > old for new, old in zip(impulses, self._impulses)]
        self._impulses = impulses
        for kind, happens in zip(self.KINDS, now):
            if happens and seen.time >= self._until[kind]:
                self.counts[kind] += 1
                self._until[kind] = seen.time + LONGEST


class Navigation(gymnasium.Env):
    """From a place to a goal, told only the next turning.

    Action, float32 (2,): steer in [-1, 1], left positive; pedals in [-1, 1], throttle above 0, brake below.

    Observation 'state', float32 (22,): speed [m/s], way to the goal [km], the command one-hot (COMMANDS), place left of
    the lane's centre [m], sine and cosine of the angle to the lane, gap ahead [m], shares of the footprint on the
    opposite lane and on the sidewalk, damage (impulse) [1000 N s], steering angle [rad], and of the NEAR nearest
    vehicles where they are ahead and left [m], FAR where there is none.

    Observation 'rgb84', uint8 (84, 84, 3), and 'rgb200x88', uint8 (88, 200, 3): a camera behind the windscreen, 90 degrees.

    An episode is one of 25 of its kind, chosen by the seed, or options={'episode': 3}. It terminates on arrival; the
    time of the way at 10 km/h truncates it. `info`: 'success' at the end, 'infractions' so far, 'command',
    'way_to_goal' [m], 'reward_terms'.

    `weather` is a preset's name, or a list to draw from. `cars` take the place of the task's own number. `server` and
    `token` as of reprise.Simulation; `tasks` is the path of another tasks.json.
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, town: str = "town1", task: str = "navigation", weather: str | list[str] = "clear_noon",
                 obs: str = "state", cars: int | None = None, server: str | None = None, token: str | None = None,
                 tasks: str | os.PathLike | None = None, render_mode: str | None = None) -> None:  # fmt: skip
        if task not in TASKS:
            raise ValueError(f"no task '{task}'; there are {', '.join(TASKS)}")
        if obs != "state" and obs not in PICTURES:
            raise ValueError(f"no observation '{obs}'; there are 'state', {', '.join(map(repr, PICTURES))}")
        path = os.fspath(tasks) if tasks else str(_scenarios() / "towns" / town / "tasks.json")
        self.render_mode = render_mode
        self.episodes = read_tasks(path)["navigation" if task == "navigation_dynamic" else task]
        self.weathers = [weather] if isinstance(weather, str) else list(weather)
        size = PICTURES.get(obs)
        moving = CARS.get(town, 20) if task == "navigation_dynamic" else 0
        self._sim = Simulation(town, cars=moving if cars is None else cars, server=server, token=token,
                               rig=[dict(name="front", width=size[0], height=size[1])] if size else ())
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (2,), np.float32)
        self.observation_space = (
            gymnasium.spaces.Box(0, 255, (size[1], size[0], 3), np.uint8)
            if size
            else gymnasium.spaces.Box(-np.inf, np.inf, (14 + 2 * NEAR,), np.float32)
        )
        self._observe = self._picture if size else self._vector
        self._seen: Observation | None = None

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None):
        super().reset(seed=seed)
        chosen = int(self.np_random.integers(len(self.episodes)))
        traffic = int(self.np_random.integers(2**31))
        weather = self.weathers[int(self.np_random.integers(len(self.weathers)))]
        options = options or {}
        chosen = int(options.get("episode", chosen))
        task = self.episodes[chosen]
        start, goal = ((task[end]["lane"], task[end]["s"]) for end in ("start", "goal"))
        self._sim.reset(seed=traffic, weather=weather, start=start, goal=goal, trace=options.get("trace"))
        self._seen = self._sim.step()  # the goal is known from the tick after the vehicle appeared
        self._infractions = Infractions()
        self._measured = self._measure(self._seen)
        self._last = self._observe(self._seen)
        return self._last, {"episode": chosen, **self._info()}

    def step(self, action):
        steer, pedals = np.clip(np.asarray(action, np.float64), -1.0, 1.0)
        control = Control(throttle=max(pedals, 0.0), brake=max(-pedals, 0.0), steer=steer)
        before, seen = self._measured, self._sim.step(control)
        if seen is not None:
            self._seen, self._last = seen, self._observe(seen)
            self._infractions.look(seen)
            self._measured = self._measure(seen)
        success = seen is None and self._sim.outcome.verdict == "passed"
        if success:
            self._measured = {**self._measured, "way": 0.0}
        terms = self.reward_terms(before, self._measured)
        info = {**self._info(), "reward_terms": terms}
        if seen is None:
            info["success"] = success
        return self._last, float(sum(terms.values())), success, seen is None and not success, info

    def close(self) -> None:
        self._sim.close()

    @staticmethod
    def reward_terms(before: dict[str, float], now: dict[str, float]) -> dict[str, float]:
        """The paper's five, of two ticks one after the other."""
        return {
            "way": 1000 * (before["way"] - now["way"]),
            "speed": 0.05 * (now["speed"] - before["speed"]),
            "damage": -0.00002 * (now["damage"] - before["damage"]),
            "sidewalk": -2 * (now["sidewalk"] - before["sidewalk"]),
            "opposite_lane": -2 * (now["opposite_lane"] - before["opposite_lane"]),
        }

    @staticmethod
    def _measure(seen: Observation) -> dict[str, float]:
        """way [km], speed [km/h], damage [N s], shares."""
        ego = seen.ego
        damage = ego.impulse_vehicles + ego.impulse_walkers + ego.impulse_static
        return dict(way=seen.way_to_goal / 1000, speed=float(ego.speed) * 3.6, damage=float(damage),
                    sidewalk=float(ego.on_sidewalk), opposite_lane=float(ego.on_opposite_lane))  # fmt: skip

    def _info(self) -> dict[str, Any]:
        return {
            "command": self._seen.turning,
            "way_to_goal": self._seen.way_to_goal,
            "infractions": dict(self._infractions.counts),
        }

    def _picture(self, seen: Observation) -> np.ndarray:
        return seen.image("front").copy()

    def _vector(self, seen: Observation) -> np.ndarray:
        ego, measured = seen.ego, self._measure(seen)
        angle = 0.0
        if ego.lane != NONE:
            angle = ego.yaw - _lane_yaw(points(seen.run.town.lanes[int(ego.lane)].centre), ego.position)
        others = np.concatenate(
            [
                points(np.ascontiguousarray(seen.cars["position"]))[:, :2],
                points(np.ascontiguousarray(seen.vehicles["position"][seen.vehicles["id"] != seen.run.actor]))[:, :2],
            ]
        )
        away = others - ego.position[:2]
        away = away[np.argsort(np.hypot(away[:, 0], away[:, 1]), kind="stable")[:NEAR]]
        cos, sin = math.cos(ego.yaw), math.sin(ego.yaw)
        near = np.full((NEAR, 2), FAR)
        near[: len(away)] = np.clip(np.column_stack([away @ [cos, sin], away @ [-sin, cos]]), -FAR, FAR)
        command = [1.0 if seen.turning == name else 0.0 for name in COMMANDS]
        head = [ego.speed, measured["way"], *command, ego.lane_t, math.sin(angle), math.cos(angle), ego.gap_ahead,
                measured["opposite_lane"], measured["sidewalk"], measured["damage"] / 1000, ego.steering_angle]  # fmt: skip
        return np.concatenate([head, near.ravel()]).astype(np.float32)


def _lane_yaw(centre: np.ndarray, position: np.ndarray) -> float:
    """[rad] of the centre line's stretch nearest to a place."""
    begin, along = centre[:-1, :2], np.diff(centre[:, :2], axis=0)
    share = np.clip(((position[:2] - begin) * along).sum(1) / np.maximum((along**2).sum(1), 1e-12), 0, 1)
    away = begin + share[:, None] * along - position[:2]
    nearest = int(np.argmin((away**2).sum(1)))
    return math.atan2(along[nearest, 1], along[nearest, 0])


if "reprise/Navigation-v0" not in gymnasium.registry:
    gymnasium.register("reprise/Navigation-v0", entry_point="reprise.gym:Navigation")
