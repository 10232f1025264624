#!/usr/bin/env python3
"""Writes the plain SUMO sources (nodes, edges, connections, types) of Reprise's own towns.

    make_town.py town1|town2 FOLDER

A town is a plan of T-junctions joined by two-way streets: junctions with a place, streets with the
corners that they round on their way. All lengths are metres. build.sh turns the sources into a
network. The plans are our own; their lengths follow the two towns of Dosovitskiy et al., "CARLA: An
Open Urban Driving Simulator", CoRL 2017 (2.9 km and 1.4 km of drivable roads).

Rules that keep netconvert's junctions whole, each found by a sweep over one T-junction:
  * a curve starts at least 14 m from the junction, else a hole opens under the turning path;
  * a curve's radius is at least 1.5 times the street's half-width with its sidewalk (9.5 m for the
    avenue), else kerbs come closer than 0.2 m to the path;
  * turns inside of junctions are drawn with 12 points, else they have visible kinks.
"""
import math
import pathlib
import sys
from dataclasses import dataclass

CLASSES_NOT_ON_ROADS = "pedestrian tram rail rail_urban rail_electric rail_fast ship"
CORNER_RADIUS = 6  # of junctions

# lanes in each direction, speed [m/s], priority, lane width, sidewalk width
STREET_TYPES = {
    "avenue": (2, 16.67, 9, 3.50, 2.50),
    "main": (1, 16.67, 9, 3.50, 2.50),
    "street": (1, 13.89, 7, 3.50, 2.50),
    "lane30": (1, 8.33, 5, 3.25, 2.00),
}


@dataclass
class Plan:
    junctions: dict  # name -> (x, y)
    lit: set  # names of junctions with traffic lights
    streets: list  # (from, to, corners on the way, type)
    curve_radius: float


def town1():
    """A ring avenue around two blocks of streets: 16 T-junctions, 9 of them lit."""
    width, height = 432, 321
    west, middle, east = 120, 216, 312
    return Plan(
        junctions=dict(
            b1=(west, 0), b2=(middle, 0), b3=(east, 0),
            t1=(west, height), t2=(middle, height), t3=(east, height),
            l1=(0, 180), r1=(width, 150),
            a1=(west, 103), a2=(west, 180), a3=(west, 229),
            c1=(east, 103), c2=(east, 150), c3=(east, 229),
            m1=(middle, 103), m2=(middle, 229)),
        lit={"b1", "b3", "t1", "t3", "a1", "c3", "a3", "c1", "m1"},
        streets=[
            ("b1", "b2", [], "avenue"), ("b2", "b3", [], "avenue"),
            ("b3", "r1", [(376, 0), (width, 56)], "avenue"),
            ("r1", "t3", [(width, height)], "avenue"),
            ("t3", "t2", [], "avenue"), ("t2", "t1", [], "avenue"),
            ("t1", "l1", [(0, height)], "avenue"), ("l1", "b1", [(0, 0)], "avenue"),
            ("b1", "a1", [], "street"), ("a1", "a2", [], "street"),
            ("a2", "a3", [], "street"), ("a3", "t1", [], "street"),
            ("b3", "c1", [], "street"), ("c1", "c2", [], "street"),
            ("c2", "c3", [], "street"), ("c3", "t3", [], "street"),
            ("a1", "m1", [], "street"), ("m1", "c1", [], "street"),
            ("a3", "m2", [], "street"), ("m2", "c3", [], "street"),
            ("l1", "a2", [], "lane30"), ("c2", "r1", [], "lane30"),
            ("b2", "m1", [], "lane30"), ("m2", "t2", [], "lane30")],
        curve_radius=25)


def town2():
    """A small ring with a quarter inside: 8 T-junctions, 6 of them lit."""
    width, height = 220, 213
    return Plan(
        junctions=dict(b1=(78, 0), l1=(0, 116), r1=(width, 116), a1=(78, 116), a2=(152, 116),
                       t1=(152, height), r2=(width, 58), d1=(78, 58)),
        lit={"b1", "l1", "r1", "a1", "a2", "t1"},
        streets=[
            ("b1", "r2", [(width, 0)], "main"), ("r2", "r1", [], "main"),
            ("r1", "t1", [(width, height)], "main"), ("t1", "l1", [(0, height)], "main"),
            ("l1", "b1", [(0, 0)], "main"),
            ("b1", "d1", [], "street"), ("d1", "a1", [], "street"), ("l1", "a1", [], "street"),
            ("a1", "a2", [], "street"), ("a2", "r1", [], "street"), ("a2", "t1", [], "street"),
            ("d1", "r2", [], "lane30")],
        curve_radius=22)


def towards(source, target):
    """Unit vector."""
    length = math.dist(source, target)
    return (target[0] - source[0]) / length, (target[1] - source[1]) / length


def rounded_corner(before, corner, after, radius, pieces=7):
    """The corner of a polyline as points on a circle of this radius that touches both sides."""
    back, ahead = towards(corner, before), towards(corner, after)
    half_angle = math.acos(back[0] * ahead[0] + back[1] * ahead[1]) / 2
    reach = radius / math.tan(half_angle)
    start = corner[0] + back[0] * reach, corner[1] + back[1] * reach
    end = corner[0] + ahead[0] * reach, corner[1] + ahead[1] * reach
    bisector = back[0] + ahead[0], back[1] + ahead[1]
    scale = radius / math.sin(half_angle) / math.hypot(*bisector)
    centre = corner[0] + bisector[0] * scale, corner[1] + bisector[1] * scale
    first = math.atan2(start[1] - centre[1], start[0] - centre[0])
    last = math.atan2(end[1] - centre[1], end[0] - centre[0])
    turn = (last - first + math.pi) % (2 * math.pi) - math.pi
    arc = [(centre[0] + radius * math.cos(first + turn * i / pieces),
            centre[1] + radius * math.sin(first + turn * i / pieces)) for i in range(1, pieces)]
    return [start, *arc, end]


def centre_line(plan, street):
    source, target, corners, _ = street
    points = [plan.junctions[source], *corners, plan.junctions[target]]
    line = [points[0]]
    for before, corner, after in zip(points, points[1:], points[2:]):
        line += rounded_corner(before, corner, after, plan.curve_radius)
    return line + [points[-1]]


def length(line):
    return sum(math.dist(p, q) for p, q in zip(line, line[1:]))


def nodes_xml(plan):
    for name, (x, y) in plan.junctions.items():
        kind = "traffic_light" if name in plan.lit else "priority"
        yield f'<node id="{name}" x="{x:.2f}" y="{y:.2f}" type="{kind}" radius="{CORNER_RADIUS}"/>'


def edges_xml(plan):
    for street in plan.streets:
        source, target, _, kind = street
        line = centre_line(plan, street)
        for start, end, points in ((source, target, line), (target, source, line[::-1])):
            shape = " ".join(f"{x:.2f},{y:.2f}" for x, y in points)
            yield (f'<edge id="{start}_{end}" from="{start}" to="{end}" type="{kind}" '
                   f'shape="{shape}"/>')


def connections_xml(plan):
    """netconvert finds the turns by itself; the zebra crossings are ours, one across every arm."""
    arms = {}
    for source, target, _, _ in plan.streets:
        arms.setdefault(source, []).append(target)
        arms.setdefault(target, []).append(source)
    for junction, others in arms.items():
        priority = "" if junction in plan.lit else ' priority="true"'
        for other in others:
            yield (f'<crossing node="{junction}" edges="{other}_{junction} {junction}_{other}" '
                   f'width="3.00"{priority}/>')


def types_xml(plan):
    used = {street[3] for street in plan.streets}
    for name, (lanes, speed, priority, width, sidewalk) in STREET_TYPES.items():
        if name in used:
            yield (f'<type id="{name}" numLanes="{lanes}" speed="{speed:.2f}" '
                   f'priority="{priority}" width="{width:.2f}" sidewalkWidth="{sidewalk:.2f}" '
                   f'disallow="{CLASSES_NOT_ON_ROADS}"/>')


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("town1", "town2"):
        sys.exit(__doc__.split("\n\n")[1].strip())
    name, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    plan = globals()[name]()
    for ending, root, lines in (("nod", "nodes", nodes_xml(plan)), ("edg", "edges", edges_xml(plan)),
                                ("con", "connections", connections_xml(plan)),
                                ("typ", "types", types_xml(plan))):
        body = "".join(f"  {line}\n" for line in lines)
        (folder / f"{name}.{ending}.xml").write_text(f"<{root}>\n{body}</{root}>\n")
    total = sum(length(centre_line(plan, street)) for street in plan.streets)
    print(f"{name}: {len(plan.junctions)} junctions, {len(plan.lit)} lit, {len(plan.streets)} streets, "
          f"{total:.1f} m")


if __name__ == "__main__":
    main()
