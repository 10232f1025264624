#!/usr/bin/env python3
"""Writes the plain SUMO sources (nodes, edges, connections, types) and the places of Reprise's own towns.

    make_town.py town1|town2|straight|curves|junctions FOLDER

A town is a plan of junctions joined by two-way streets and of roundabouts: junctions with a place and a
rule, streets with the corners that they round on their way. All lengths are metres. build.sh turns the
sources into a network. The plans are in own_towns.py and proving_ground.py.

Rules that keep netconvert's junctions whole, each found by a sweep over one T-junction:
  * a curve starts at least 14 m from the junction, else a hole opens under the turning path;
  * a curve's radius is at least 1.5 times the street's half-width with its sidewalk (9.5 m for the
    avenue), else kerbs come closer than 0.2 m to the path;
  * turns inside of junctions are drawn with 12 points, else they have visible kinks.
"""
import pathlib
import sys

sys.dont_write_bytecode = True  # of the plans, in a source folder
from own_towns import town1, town2
from plan import RULES, STREET_TYPES, arcs_of, centre_line, check_plots, circle, junctions_of, street_length
from proving_ground import curves, junctions, straight

PLANS = {plan.__name__: plan for plan in (town1, town2, straight, curves, junctions)}
CLASSES_NOT_ON_ROADS = "pedestrian tram rail rail_urban rail_electric rail_fast ship"
CORNER_RADIUS = 6  # of junctions


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
    for road in plan.roads:
        speed = f' speed="{road.speed:.2f}"' if road.speed else ""
        yield (f'<edge id="{road.name}" from="{road.source}" to="{road.target}" type="{road.kind}" '
               f'name="{road.street}"{speed} shape="{shape_text(road.line)}"/>')


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
    for source, target in plan.links:
        yield f'<connection from="{source}" to="{target}"/>'


def types_xml(plan):
    used = {road.kind for road in plan.streets + plan.roads} | ({"circle"} if plan.roundabouts else set())
    for name, (lanes, speed, priority, width, sidewalk) in STREET_TYPES.items():
        if name in used:
            walk = f'sidewalkWidth="{sidewalk:.2f}" ' if sidewalk else ""
            yield (f'<type id="{name}" numLanes="{lanes}" speed="{speed:.2f}" '
                   f'priority="{priority}" width="{width:.2f}" {walk}'
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
    if len(sys.argv) != 3 or sys.argv[1] not in PLANS:
        sys.exit(__doc__.split("\n\n")[1].strip())
    name, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    plan = PLANS[name]()
    for ring in plan.roundabouts:
        plan.junctions |= junctions_of(ring)
    check_plots(plan)
    for ending, root, lines in (("nod", "nodes", nodes_xml(plan)), ("edg", "edges", edges_xml(plan)),
                                ("con", "connections", connections_xml(plan)),
                                ("typ", "types", types_xml(plan)),
                                ("place", "place", place_xml(plan))):
        body = "".join(f"  {line}\n" for line in lines)
        (folder / f"{name}.{ending}.xml").write_text(f"<{root}>\n{body}</{root}>\n")
    print(f"{name}: {len(plan.junctions)} junctions, {len(plan.streets) + len(plan.roads)} streets, "
          f"{street_length(plan):.1f} m")


if __name__ == "__main__":
    main()
