"""The 22 numbers that reprise.gym and reprise.zoo show of a tick as obs='state'. A learner asks for them in each tick:
what stays the same in a run is worked out once, and what is of four vehicles is no array."""
from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .driver import Observation, Run
from .nouns import points

COMMANDS = ("follow_lane", "straight", "left", "right")
NEAR = 4  # other vehicles in an observation
FAR = 50.0  # [m] where they end
SIZE = 14 + 2 * NEAR
_NONE = 0xFFFFFFFF


class Measured(NamedTuple):
    """What the paper's reward is of: way [km], speed [km/h], damage [N s], shares of the footprint."""

    way: float
    speed: float
    damage: float
    sidewalk: float
    opposite_lane: float

    @staticmethod
    def of(seen: Observation) -> Measured:
        ego = seen.ego
        damage = ego.impulse_vehicles + ego.impulse_walkers + ego.impulse_static
        return Measured(seen.way_to_goal / 1000, float(ego.speed) * 3.6, float(damage), float(ego.on_sidewalk),
                        float(ego.on_opposite_lane))  # fmt: skip


class _Centre:
    """A lane's centre line from above. Arrays of (n - 1,) for n points: begin [m], way to the next [m]."""

    def __init__(self, line: np.ndarray) -> None:
        self._x, self._y = line[:-1, 0].copy(), line[:-1, 1].copy()
        self._along_x, self._along_y = np.diff(line[:, 0]), np.diff(line[:, 1])
        self._squared = np.maximum(self._along_x**2 + self._along_y**2, 1e-12)

    def yaw(self, x: float, y: float) -> float:
        """[rad] of the stretch nearest to a place."""
        from_x, from_y = x - self._x, y - self._y
        share = (from_x * self._along_x + from_y * self._along_y) / self._squared
        share = np.minimum(np.maximum(share, 0.0), 1.0)
        from_x, from_y = from_x - share * self._along_x, from_y - share * self._along_y
        nearest = (from_x * from_x + from_y * from_y).argmin()
        return math.atan2(self._along_y[nearest], self._along_x[nearest])


class StateVector:
    """Of one run: float32 (SIZE,), as reprise.gym.Navigation describes them."""

    def __init__(self, run: Run) -> None:
        self._run = run
        self._centres: dict[int, _Centre] = {}

    def __call__(self, seen: Observation, measured: Measured) -> np.ndarray:
        ego = seen.ego
        x, y, _ = ego.position.tolist()
        angle = ego.yaw - self._lane_yaw(int(ego.lane), x, y) if ego.lane != _NONE else 0.0
        turning = seen.turning
        return np.array([
            ego.speed, measured.way, *(turning == name for name in COMMANDS), ego.lane_t, math.sin(angle), math.cos(angle),
            ego.gap_ahead, measured.opposite_lane, measured.sidewalk, measured.damage / 1000, ego.steering_angle,
            *self._near(seen, x, y),
        ], np.float32)  # fmt: skip

    def _lane_yaw(self, lane: int, x: float, y: float) -> float:
        centre = self._centres.get(lane)
        if centre is None:
            centre = self._centres[lane] = _Centre(points(self._run.town.lanes[lane].centre))
        return centre.yaw(x, y)

    def _near(self, seen: Observation, x: float, y: float) -> list[float]:
        """Ahead and left [m] of the nearest others, one after the other."""
        others, bodies = seen.cars["position"], seen.vehicles
        if len(bodies) > 1:
            others = np.concatenate([others, bodies["position"][bodies["id"] != self._run.actor]])
        away_x, away_y = others["x"] - x, others["y"] - y
        nearest = (away_x * away_x + away_y * away_y).argsort(kind="stable")[:NEAR].tolist()
        cos, sin = math.cos(seen.ego.yaw), math.sin(seen.ego.yaw)
        found = [FAR] * (2 * NEAR)
        for number, one in enumerate(nearest):
            ahead, left = float(away_x[one]), float(away_y[one])
            ahead, left = ahead * cos + left * sin, left * cos - ahead * sin
            found[2 * number] = min(max(ahead, -FAR), FAR)
            found[2 * number + 1] = min(max(left, -FAR), FAR)
        return found
