#!/usr/bin/env python3
"""Writes the plain SUMO sources (nodes, edges, connections, types) and the places of Reprise's own towns.

    make_town.py town1|town2 FOLDER

A town is a plan of junctions joined by two-way streets and of roundabouts: junctions with a place and a
rule, streets with the corners that they round on their way. All lengths are metres. build.sh turns the
sources into a network. The plans are our own; their lengths follow the two towns of Dosovitskiy et al.,
"CARLA: An Open Urban Driving Simulator", CoRL 2017 (2.9 km and 1.4 km of drivable roads).

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
    "circle": (1, 8.33, 10, 4.50, 2.50),
}

# How a junction is ruled, in netconvert's words.
RULES = {"lit": "traffic_light", "yield": "priority", "stop": "priority_stop"}


@dataclass
class Street:
    """Two-way, from junction to junction."""
    source: str
    target: str
    kind: str
    name: str
    corners: list  # (x, y) on the way
    curve_radius: float


@dataclass
class Roundabout:
    """One-way around an island; its junctions are name + arm for each arm, such as m2w."""
    name: str
    centre: tuple
    radius: float  # of the island
    arms: dict  # name -> angle, degrees from east; ascending


@dataclass
class Plan:
    junctions: dict  # name -> (x, y, rule)
    streets: list
    roundabouts: list
    plots: list  # (kind, outline); later ones lie over earlier ones
    districts: list  # (style, outline); an empty outline: everywhere else
    keep_clear: list  # outlines


def rectangle(left, low, right, high):
    return [(left, low), (right, low), (right, high), (left, high)]


def circle(centre, radius, count):
    return [(centre[0] + radius * math.cos(math.tau * i / count),
             centre[1] + radius * math.sin(math.tau * i / count)) for i in range(count)]


def town1():
    """An old town: a ring avenue, a roundabout and a crossing in the middle, a winding lane."""
    west, middle, east = 112, 206, 300
    width, height = 421, 294
    ring = Roundabout("m2", (middle, 206), 15, dict(e=0, n=90, w=180, s=270))
    square = rectangle(214, 105, 262, 152)
    return Plan(
        junctions=dict(
            b1=(west, 0, "lit"), b2=(middle, 0, "stop"), b3=(east, 0, "lit"),
            t1=(west, height, "lit"), t2=(middle, height, "yield"), t3=(east, height, "lit"),
            l1=(0, 106, "lit"), r1=(width, 130, "yield"),
            a1=(west, 96, "lit"), a2=(west, 156, "stop"), a3=(west, 206, "yield"),
            c1=(east, 96, "lit"), c2=(east, 152, "stop"), c3=(east, 206, "lit"),
            m1=(middle, 96, "lit")),
        streets=[
            Street("b1", "b2", "avenue", "South Avenue", [], 25),
            Street("b2", "b3", "avenue", "South Avenue", [], 25),
            Street("b3", "r1", "avenue", "East Avenue", [(356, 0), (width, 52)], 25),
            Street("r1", "t3", "avenue", "East Avenue", [(width, height)], 25),
            Street("t3", "t2", "avenue", "North Avenue", [], 25),
            Street("t2", "t1", "avenue", "North Avenue", [], 25),
            Street("t1", "l1", "avenue", "West Avenue", [(62, height), (0, 220)], 25),
            Street("l1", "b1", "avenue", "West Avenue", [(0, 0)], 25),
            Street("b1", "a1", "street", "Mill Street", [], 25),
            Street("a1", "a2", "street", "Mill Street", [], 25),
            Street("a2", "a3", "street", "Mill Street", [], 25),
            Street("a3", "t1", "street", "Mill Street", [], 25),
            Street("b3", "c1", "street", "Church Street", [], 25),
            Street("c1", "c2", "street", "Church Street", [], 25),
            Street("c2", "c3", "street", "Church Street", [], 25),
            Street("c3", "t3", "street", "Church Street", [], 25),
            Street("a1", "m1", "street", "Bridge Street", [], 25),
            Street("m1", "c1", "street", "Bridge Street", [], 25),
            Street("m1", "m2s", "street", "Market Street", [], 25),
            Street("a3", "m2w", "street", "Park Street", [], 25),
            Street("m2e", "c3", "street", "Park Street", [], 25),
            # Two sharp bends between houses: nobody sees around them.
            Street("l1", "a2", "lane30", "Weaver Lane", [(56, 106), (56, 156)], 12),
            Street("c2", "r1", "lane30", "Orchard Lane", [], 25),
            Street("b2", "m1", "lane30", "Smith Lane", [], 25),
            Street("m2n", "t2", "lane30", "Rope Lane", [], 25)],
        roundabouts=[ring],
        plots=[
            ("park", rectangle(126, 108, 196, 180)),
            ("water", circle((170, 132), 11, 16)),
            ("playground", rectangle(132, 152, 152, 172)),
            ("square", square),
            ("car_park", rectangle(314, 168, 344, 192)),
            ("gravel", rectangle(18, 18, 40, 40)),
            ("forest", rectangle(362, 236, 396, 276))],
        districts=[("village", []), ("old", rectangle(west, 0, east, height)),
                   ("brick", rectangle(east, 0, width + 60, height))],
        keep_clear=[square, rectangle(126, 108, 196, 180), rectangle(314, 168, 344, 192)])


def town2():
    """A young town: a small ring road and a centre with one crossing and a hidden corner."""
    width, height = 210, 210
    west, east = 74, 142
    square = rectangle(84, 62, 128, 104)
    return Plan(
        junctions=dict(
            b1=(west, 0, "lit"), l1=(0, 114, "lit"), l2=(0, 54, "stop"), r1=(width, 114, "lit"),
            r2=(width, 52, "yield"), a1=(west, 114, "lit"), a2=(east, 114, "stop"),
            d1=(west, 54, "yield"), t1=(west, height, "lit")),
        streets=[
            Street("b1", "r2", "main", "Harbour Road", [(width, 0)], 22),
            Street("r2", "r1", "main", "Harbour Road", [], 22),
            Street("r1", "t1", "main", "Ring Road", [(width, 155), (162, height)], 22),
            Street("t1", "l1", "main", "Ring Road", [(0, height)], 22),
            Street("l1", "l2", "main", "Station Road", [], 22),
            Street("l2", "b1", "main", "Station Road", [(0, 0)], 22),
            Street("b1", "d1", "street", "Central Street", [], 22),
            Street("d1", "a1", "street", "Central Street", [], 22),
            Street("a1", "t1", "street", "Central Street", [], 22),
            Street("l1", "a1", "street", "Museum Street", [], 22),
            Street("a1", "a2", "street", "Museum Street", [], 22),
            Street("a2", "r1", "street", "Museum Street", [], 22),
            Street("l2", "d1", "lane30", "Garden Way", [], 22),
            # A corner between high houses: nobody sees around it.
            Street("a2", "r2", "lane30", "Gallery Way", [(east, 52)], 12)],
        roundabouts=[],
        plots=[
            ("square", square),
            ("park", rectangle(88, 126, 150, 180)),
            ("water", circle((132, 150), 10, 16)),
            ("playground", rectangle(96, 134, 112, 150)),
            ("car_park", rectangle(14, 70, 50, 98)),
            ("lawn", rectangle(20, 136, 58, 176))],
        districts=[("modern", []), ("centre", rectangle(west, 0, width, 114))],
        keep_clear=[square, rectangle(88, 126, 150, 180), rectangle(14, 70, 50, 98)])


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
    source, target = plan.junctions[street.source][:2], plan.junctions[street.target][:2]
    points = [source, *street.corners, target]
    line = [points[0]]
    for before, corner, after in zip(points, points[1:], points[2:]):
        line += rounded_corner(before, corner, after, street.curve_radius)
    return line + [points[-1]]


def junctions_of(roundabout):
    """name -> (x, y, rule)."""
    (x, y), radius = roundabout.centre, roundabout.radius
    return {roundabout.name + arm: (x + radius * math.cos(math.radians(angle)),
                                    y + radius * math.sin(math.radians(angle)), "yield")
            for arm, angle in roundabout.arms.items()}


def arcs_of(roundabout, pieces=8):
    """(from, to, line) of every piece of the circle, counter-clockwise."""
    arms = list(roundabout.arms.items())
    for (arm, first), (following, last) in zip(arms, arms[1:] + arms[:1]):
        turn = (last - first) % 360
        line = [(roundabout.centre[0] + roundabout.radius * math.cos(math.radians(angle)),
                 roundabout.centre[1] + roundabout.radius * math.sin(math.radians(angle)))
                for angle in (first + turn * i / pieces for i in range(pieces + 1))]
        yield roundabout.name + arm, roundabout.name + following, line


def length(line):
    return sum(math.dist(p, q) for p, q in zip(line, line[1:]))


def street_length(plan):
    """[m] from junction to junction along the middles; the two directions of a street count once."""
    return (sum(length(centre_line(plan, street)) for street in plan.streets) +
            sum(length(line) for ring in plan.roundabouts for _, _, line in arcs_of(ring)))


def half_width(kind):
    lanes, _, _, width, sidewalk = STREET_TYPES[kind]
    return lanes * width + sidewalk


def distance_to_segment(point, source, target):
    ahead = target[0] - source[0], target[1] - source[1]
    along = ((point[0] - source[0]) * ahead[0] + (point[1] - source[1]) * ahead[1])
    along = min(1, max(0, along / (ahead[0] ** 2 + ahead[1] ** 2)))
    return math.dist(point, (source[0] + along * ahead[0], source[1] + along * ahead[1]))


def points_along(outline, step=1):
    for source, target in zip(outline, outline[1:] + outline[:1]):
        count = max(1, math.ceil(math.dist(source, target) / step))
        for i in range(count):
            yield (source[0] + (target[0] - source[0]) * i / count,
                   source[1] + (target[1] - source[1]) * i / count)


def check_plots(plan):
    """Plots lie inside of blocks: no street and no sidewalk reaches into one."""
    for kind, outline in plan.plots:
        for street in plan.streets:
            line = centre_line(plan, street)
            room = min(distance_to_segment(point, p, q) for point in points_along(outline)
                       for p, q in zip(line, line[1:])) - half_width(street.kind)
            if room < 1:
                sys.exit(f"the {kind} is {room:.1f} m from {street.name}, at least 1 m is needed")


def nodes_xml(plan):
    for name, (x, y, rule) in plan.junctions.items():
        yield (f'<node id="{name}" x="{x:.2f}" y="{y:.2f}" type="{RULES[rule]}" '
               f'radius="{CORNER_RADIUS}"/>')


def shape_text(line):
    return " ".join(f"{x:.2f},{y:.2f}" for x, y in line)


def edges_xml(plan):
    for street in plan.streets:
        line = centre_line(plan, street)
        for start, end, points in ((street.source, street.target, line),
                                   (street.target, street.source, line[::-1])):
            yield (f'<edge id="{start}_{end}" from="{start}" to="{end}" type="{street.kind}" '
                   f'name="{street.name}" shape="{shape_text(points)}"/>')
    for ring in plan.roundabouts:
        for start, end, line in arcs_of(ring):
            yield (f'<edge id="{start}_{end}" from="{start}" to="{end}" type="circle" '
                   f'name="Circus" shape="{shape_text(line)}"/>')


def connections_xml(plan):
    """netconvert finds the turns by itself; the zebra crossings are ours, one across every arm."""
    arms = {}
    for street in plan.streets:
        arms.setdefault(street.source, []).append(street.target)
        arms.setdefault(street.target, []).append(street.source)
    for junction, others in arms.items():
        priority = "" if plan.junctions[junction][2] == "lit" else ' priority="true"'
        for other in others:
            yield (f'<crossing node="{junction}" edges="{other}_{junction} {junction}_{other}" '
                   f'width="3.00"{priority}/>')


def types_xml(plan):
    used = {street.kind for street in plan.streets} | ({"circle"} if plan.roundabouts else set())
    for name, (lanes, speed, priority, width, sidewalk) in STREET_TYPES.items():
        if name in used:
            yield (f'<type id="{name}" numLanes="{lanes}" speed="{speed:.2f}" '
                   f'priority="{priority}" width="{width:.2f}" sidewalkWidth="{sidewalk:.2f}" '
                   f'disallow="{CLASSES_NOT_ON_ROADS}"/>')


def place_xml(plan):
    """What a network does not hold: towns/network/place.h."""
    islands = [circle(ring.centre, ring.radius - 0.5, 24) for ring in plan.roundabouts]
    for kind, outline in plan.plots + [("lawn", island) for island in islands]:
        yield f'<plot kind="{kind}" shape="{shape_text(outline)}"/>'
    for style, outline in plan.districts:
        shape = f' shape="{shape_text(outline)}"' if outline else ""
        yield f'<district style="{style}"{shape}/>'
    for outline in plan.keep_clear + islands:
        yield f'<keep_clear shape="{shape_text(outline)}"/>'


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("town1", "town2"):
        sys.exit(__doc__.split("\n\n")[1].strip())
    name, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    plan = globals()[name]()
    for ring in plan.roundabouts:
        plan.junctions |= junctions_of(ring)
    check_plots(plan)
    for ending, root, lines in (("nod", "nodes", nodes_xml(plan)), ("edg", "edges", edges_xml(plan)),
                                ("con", "connections", connections_xml(plan)),
                                ("typ", "types", types_xml(plan)),
                                ("place", "place", place_xml(plan))):
        body = "".join(f"  {line}\n" for line in lines)
        (folder / f"{name}.{ending}.xml").write_text(f"<{root}>\n{body}</{root}>\n")
    print(f"{name}: {len(plan.junctions)} junctions, {len(plan.streets)} streets, "
          f"{street_length(plan):.1f} m")


if __name__ == "__main__":
    main()
