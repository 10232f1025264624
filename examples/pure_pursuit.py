"""Pure pursuit along the route that the scenario set, as fast as bends and red lights allow.

reprise run examples/pure_pursuit.lua --driver ego='python3 examples/pure_pursuit.py'
"""
import math

import numpy as np
import reprise

SET_ROUTE = reprise.enum("CommandKind")["set_route"]
RED = [reprise.enum("SignalColor")[name] for name in ("red", "red_yellow", "yellow")]
WHEELBASE, LARGEST_STEER = 2.9, 0.6  # [m], [rad] about those of a sedan
way = None


def decide(seen):
    global way
    ego = seen.ego
    if way is None and seen.run.route:  # we take over, and it was said before
        way = reprise.Way(seen.run.town, ego.lane, ego.lane_s, seen.run.route.lanes, seen.run.route.s)
    for command in seen.tick.commands:
        if command.kind == SET_ROUTE and command.actor == seen.run.actor:
            way = reprise.Way(seen.run.town, ego.lane, ego.lane_s, command.lanes, command.s)
    if way is None:
        return reprise.Control(brake=1.0)
    here = way.index(ego.position)
    # Steer onto the circle through the rear axle and a point ahead, in the car's frame.
    x, y = way.points[min(here + int(4 + 0.5 * ego.speed), len(way.points) - 1)] - ego.position[:2]
    ahead, left = x * math.cos(ego.yaw) + y * math.sin(ego.yaw), y * math.cos(ego.yaw) - x * math.sin(ego.yaw)
    steer = math.atan2(2 * WHEELBASE * left, ahead * ahead + left * left) / LARGEST_STEER
    # Sideways at most 2 m/s^2 in the bends of the next 40 m, braking with 1.5 m/s^2 for them and for red lights.
    fast = np.minimum(way.limits, np.sqrt(2 / np.maximum(way.bends, 1e-3)))[here : here + 40]
    wanted = np.sqrt(fast**2 + 2 * 1.5 * np.arange(len(fast))).min()
    for stop, signal in way.stops:
        if here <= stop and seen.signals[signal] in RED:
            wanted = min(wanted, math.sqrt(2 * 1.5 * max(0, stop - here - 6)))
    push = 0.4 * (wanted - ego.speed)
    return reprise.Control(max(0, min(push, 1)), max(0, min(-push, 1)), max(-1, min(steer, 1)))


if __name__ == "__main__":
    reprise.drive(decide)
