"""The way along lanes to where a scenario sends a car: what a driver follows that plans no roads of its own."""
from __future__ import annotations

import heapq

import numpy as np

from .nouns import Noun, enum, points

NONE = 0xFFFFFFFF
_TURN_AROUND = 1000.0  # [m] of detour that it is worth


def _change(room: float) -> float:
    """[m] of detour that a change of lanes is worth with so much room [m]; as world/lanes/planner.cpp has it."""
    return 10_000.0 if room < 20 else 200.0 if room < 40 else 40.0


class Way:
    """The shortest way for cars from a place on a lane through others, as `set_route` and `route_to` name them.

    `points` (n, 2) [m], about one each metre; `bends` (n) [1/m] how sharply it bends there; `limits` (n) [m/s] the
    speed limits; `stops` (index of the point before the junction, index in `town.signals`) of each signal on the way.
    Raises ValueError where no way leads.
    """

    def __init__(self, town: Noun, lane: int, s: float, through: list[int], goal_s: float) -> None:
        self._town = town
        lanes, at = [int(lane)], float(s)
        for stop in map(int, through):
            lanes += self._search(lanes[-1], at, stop, goal_s)
            at = 0.0
        self._draw(lanes, float(s), goal_s)
        self._here = 0

    def index(self, position: np.ndarray) -> int:
        """Of the nearest point, searched from where it was found last time."""
        near = self.points[self._here : self._here + 30] - position[:2]
        self._here += int(np.argmin((near * near).sum(axis=1)))
        return self._here

    def _next(self, lane: int, room: float, goal: int, goal_s: float) -> list[tuple[int, float]]:
        """The lanes that one can go to from here, and what that costs [m]."""
        noun = self._town.lanes[lane]
        found = []
        for link in noun.links:
            to = int(link["via"] if link["via"] != NONE else link["to"])
            around = link["turn"] == enum("Turn")["around"]
            if self._town.lanes[to].kind in _FOR_CARS:
                found.append((to, room + (_TURN_AROUND if around else 0.0)))
        for beside in (noun.left, noun.right):
            if beside != NONE and self._town.lanes[beside].kind == _DRIVING:
                found.append((beside, _change(min(room, goal_s) if beside == goal else room)))
        return found

    def _search(self, lane: int, s: float, goal: int, goal_s: float) -> list[int]:
        """Dijkstra's. The lanes behind `lane` up to the goal."""
        start = (lane, s > goal_s or lane != goal)  # a goal behind us needs a way around
        best = {start: 0.0}
        before: dict[tuple[int, bool], tuple[int, bool]] = {}
        queue = [(0.0, start)]
        while queue:
            cost, node = heapq.heappop(queue)
            if node == (goal, False) or (node[0] == goal and node != start):
                lanes = []
                while node != start:
                    lanes.append(node[0])
                    node = before[node]
                return lanes[::-1]
            if cost > best[node]:
                continue
            length = self._town.lanes[node[0]].length
            for to, more in self._next(node[0], length - s if node == start else length, goal, goal_s):
                reached = (to, False)
                if cost + more < best.get(reached, float("inf")):
                    best[reached], before[reached] = cost + more, node
                    heapq.heappush(queue, (cost + more, reached))
        raise ValueError(f"no way leads from lane {lane} to {goal}")

    def _along(self, lane: int, share: np.ndarray) -> np.ndarray:
        """Points of a centre line, at shares [0, 1] of its length."""
        corners = points(self._town.lanes[lane].centre)[:, :2]
        s = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(corners, axis=0).T))])
        return np.column_stack([np.interp(share * s[-1], s, corners[:, axis]) for axis in (0, 1)])

    def _draw(self, lanes: list[int], s: float, goal_s: float) -> None:
        parts, limits, self.stops = [], [], []
        # Lanes that lie beside each other are one street: from the first to the last by a gentle change.
        streets: list[list[int]] = []
        for lane in lanes:
            last = self._town.lanes[streets[-1][-1]] if streets else None
            if last is not None and lane in (last.left, last.right):
                streets[-1].append(lane)
            else:
                streets.append([lane])
        for number, street in enumerate(streets):
            length = self._town.lanes[street[0]].length
            begin = s / length if number == 0 else 0.0
            end = goal_s / self._town.lanes[street[-1]].length if number == len(streets) - 1 else 1.0
            share = np.linspace(begin, end, max(2, int((end - begin) * length)))
            changes = len(street) - 1
            inside = np.clip((share - begin) / (end - begin) * 1.4 - 0.2, 0, 1)  # calm at both ends
            aside = changes * inside * inside * (3 - 2 * inside)
            line = sum(
                np.maximum(0, 1 - np.abs(aside - i))[:, None] * self._along(lane, share)
                for i, lane in enumerate(street)
            )
            parts.append(line)
            limits.append(np.full(len(line), self._town.lanes[street[-1]].speed_limit))
            signal = self._signal(street[-1], streets[number + 1][0]) if number + 1 < len(streets) else NONE
            if signal != NONE:
                self.stops.append((sum(map(len, parts)) - 1, signal))
        self.points = np.concatenate(parts)
        self.limits = np.concatenate(limits)
        # The angle between the ways to points 3 m behind and 3 m ahead.
        step = np.diff(self.points, axis=0, append=2 * self.points[-1:] - self.points[-2:-1])
        heading = np.unwrap(np.arctan2(step[:, 1], step[:, 0]))
        wide = np.pad(heading, 3, mode="edge")
        self.bends = np.abs(wide[6:] - wide[:-6]) / 6

    def _signal(self, lane: int, to: int) -> int:
        """The signal of the link from a lane's end to the next lane of the way."""
        for link in self._town.lanes[lane].links:
            if to in (link["via"], link["to"]):
                return int(link["signal"])
        return NONE


_DRIVING = enum("LaneKind")["driving"]
_FOR_CARS = (_DRIVING, enum("LaneKind")["internal"])
