"""A driver in Python: keeps its lane at 30 km/h, goes on where the lane does, stays behind others, stops at red.

reprise run examples/external.lua --driver ego='python3 examples/follow_lane.py'
"""
import math

import numpy as np
import reprise

RED = {reprise.enum("SignalColor")[name] for name in ("red", "red_yellow", "yellow")}
NONE = 0xFFFFFFFF
WHEELBASE, LARGEST_STEER = 2.9, 0.6  # [m], [rad] about those of a sedan
centres = {}


def centre(town, lane):
    """The lane's centre line, a point each metre, (n, 2) [m]; made once."""
    if lane not in centres:
        corners = reprise.points(town.lanes[lane].centre)[:, :2]
        s = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(corners, axis=0).T))])
        at = np.linspace(0, s[-1], max(2, int(s[-1]) + 1))
        centres[lane] = np.column_stack([np.interp(at, s, corners[:, 0]), np.interp(at, s, corners[:, 1])])
    return centres[lane]


def path_ahead(town, lane, wanted=60.0):
    """Points of the lane and of those that follow straight on, and the signal at its end."""
    parts, length, signal = [centre(town, lane)], town.lanes[lane].length, NONE
    while length < wanted and len(town.lanes[lane].links) > 0:
        link = min(town.lanes[lane].links, key=lambda link: link["turn"])
        if signal == NONE and link["signal"] != NONE:
            signal = int(link["signal"])
        lane = int(link["via"]) if link["via"] != NONE else int(link["to"])
        parts.append(centre(town, lane))
        length += town.lanes[lane].length
    return np.concatenate(parts), signal


def decide(seen):
    ego, town = seen.ego, seen.run.town
    if ego.lane == NONE:
        return reprise.Control(brake=1.0)
    points, signal = path_ahead(town, int(ego.lane))
    # Pure pursuit: the point ahead at the look-ahead distance, seen from the rear axle.
    look_ahead = max(5.0, 0.8 * ego.speed)
    away = points - ego.position[:2]
    cos, sin = math.cos(ego.yaw), math.sin(ego.yaw)
    forward, left = away @ [cos, sin], away @ [-sin, cos]
    far_enough = np.flatnonzero((forward > 0) & (np.hypot(forward, left) >= look_ahead))
    x, y = (forward[far_enough[0]], left[far_enough[0]]) if len(far_enough) else (look_ahead, 0.0)
    steer = math.atan2(2 * WHEELBASE * y, x * x + y * y) / LARGEST_STEER
    # As fast as the gap, or the way to a red light, allows.
    free = ego.gap_ahead - 4.0
    if signal != NONE and seen.signals[signal] in RED:
        free = min(free, town.lanes[int(ego.lane)].length - ego.lane_s - 5.0)
    wanted = min(30 / 3.6, math.sqrt(max(0.0, 2 * 2.0 * free)))
    push = (wanted - ego.speed) * 0.5
    return reprise.Control(
        throttle=min(max(push, 0.0), 1.0), brake=min(max(-push, 0.0), 1.0), steer=min(max(steer, -1.0), 1.0)
    )


if __name__ == "__main__":
    reprise.drive(decide)
