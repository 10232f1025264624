#!/usr/bin/env python3
"""Writes the maps that tests import and drive on: make_maps.py FOLDER

bridge.xodr: OpenDRIVE as an editor would write it. A crossing with traffic lights; a road that leaves it,
  loops over itself on a bridge and comes back; a T-junction whose side road has a stop sign and ends in a
  curve of spiral and arc. Limits of whole roads, a limit sign, a crosswalk, sidewalks.
quarter.net.xml: a SUMO network by netconvert from plain nodes and edges. Nine junctions with and without
  lights, a road of two lanes each way, streets on a slope, and a road that crosses another on a bridge.
lanes.net.xml: likewise. `main`, a straight road of 1500 m with three lanes each way for 130 km/h, at whose ends
  one can only turn around, and `hill`, one of two lanes each way that climbs 8 % over 600 m.

The maps are our own. Metres, radians, east and north. Same script and netconvert, same bytes.
"""
import math
import pathlib
import subprocess
import sys
import tempfile

LANE = 3.5  # [m]
WALK = 2.0  # [m]
MOUTH = 15  # [m] from a junction's middle to where its roads begin


# ---- OpenDRIVE ------------------------------------------------------------------------------------


class Path:
    """A reference line, piece by piece."""

    def __init__(self, x, y, heading):
        self.x, self.y, self.heading, self.length = x, y, heading, 0.0
        self.pieces = []

    def _add(self, length, curvature, slope, shape):
        """Curvature is linear in the way: `curvature` at its start, with `slope` [1/m2]."""
        self.pieces.append(
            f'<geometry s="{self.length:.6f}" x="{self.x:.6f}" y="{self.y:.6f}" '
            f'hdg="{self.heading:.9f}" length="{length:.6f}">{shape}</geometry>')
        steps = 2000
        step = length / steps
        for i in range(steps):  # midpoint rule
            s = (i + 0.5) * step
            heading = self.heading + curvature * s + slope * s * s / 2
            self.x += math.cos(heading) * step
            self.y += math.sin(heading) * step
        self.heading += curvature * length + slope * length * length / 2
        self.length += length
        return self

    def line(self, length):
        return self._add(length, 0, 0, "<line/>")

    def arc(self, radius, angle):
        """To the left where the angle is positive."""
        curvature = math.copysign(1 / radius, angle)
        return self._add(radius * abs(angle), curvature, 0, f'<arc curvature="{curvature:.9f}"/>')

    def spiral(self, length, start, end):
        return self._add(length, start, (end - start) / length,
                         f'<spiral curvStart="{start:.9f}" curvEnd="{end:.9f}"/>')


def lane(number, kind, width, link=""):
    return (f'<lane id="{number}" type="{kind}" level="false">{link}'
            f'<width sOffset="0" a="{width}" b="0" c="0" d="0"/></lane>')


def rise(s, length, start, end):
    """Cubic from one height to another, level at both ends."""
    d = end - start
    return (f'<elevation s="{s:.3f}" a="{start}" b="0" c="{3 * d / length ** 2:.9f}" '
            f'd="{-2 * d / length ** 3:.12f}"/>')


def road(number, path, limit_kmh, ends, elevation="", objects="", signals=""):
    """Two-way, between the junctions `ends` (None: a dead end)."""
    links = "".join(f'<{name} elementType="junction" elementId="{junction}"/>'
                    for name, junction in zip(("predecessor", "successor"), ends)
                    if junction is not None)
    return (f'<road name="Road {number}" length="{path.length:.6f}" id="{number}" junction="-1">'
            f'<link>{links}</link>'
            f'<type s="0" type="town"><speed max="{limit_kmh}" unit="km/h"/></type>'
            f'<planView>{"".join(path.pieces)}</planView>'
            f'<elevationProfile>{elevation or rise(0, 1, 0, 0)}</elevationProfile>'
            f'<lanes><laneSection s="0"><left>{lane(2, "sidewalk", WALK)}{lane(1, "driving", LANE)}</left>'
            f'<center><lane id="0" type="none" level="false"/></center>'
            f'<right>{lane(-1, "driving", LANE)}{lane(-2, "sidewalk", WALK)}</right></laneSection></lanes>'
            f'<objects>{objects}</objects><signals>{signals}</signals></road>\n')


class Junction:
    """Arms: (road, does the road end here?, angle from east of the arm)."""

    def __init__(self, number, x, y, arms):
        self.number, self.x, self.y, self.arms = number, x, y, arms

    def mouth(self, angle):
        return self.x + MOUTH * math.cos(angle), self.y + MOUTH * math.sin(angle)

    def write(self, first):
        """Its turns, as roads numbered from `first`, and itself."""
        roads, connections = "", ""
        for source, source_ends, source_angle in self.arms:
            for target, target_ends, target_angle in self.arms:
                if target == source:
                    continue
                number = first + connections.count("<connection")
                path = Path(*self.mouth(source_angle), source_angle + math.pi)
                turn = math.remainder(target_angle - source_angle - math.pi, 2 * math.pi)
                if abs(turn) < 0.1:
                    path.line(2 * MOUTH)
                else:
                    path.arc(MOUTH, turn)
                lane_in, lane_out = (-1 if source_ends else 1), (1 if target_ends else -1)
                link = f'<link><predecessor id="{lane_in}"/><successor id="{lane_out}"/></link>'
                roads += (
                    f'<road name="" length="{path.length:.6f}" id="{number}" junction="{self.number}"><link>'
                    f'<predecessor elementType="road" elementId="{source}" '
                    f'contactPoint="{"end" if source_ends else "start"}"/>'
                    f'<successor elementType="road" elementId="{target}" '
                    f'contactPoint="{"end" if target_ends else "start"}"/></link>'
                    f'<planView>{"".join(path.pieces)}</planView>'
                    f'<lanes><laneSection s="0"><center><lane id="0" type="none" level="false"/></center>'
                    f'<right>{lane(-1, "driving", LANE, link)}</right></laneSection></lanes></road>\n')
                connections += (
                    f'<connection id="{connections.count("<connection")}" incomingRoad="{source}" '
                    f'connectingRoad="{number}" contactPoint="start">'
                    f'<laneLink from="{lane_in}" to="-1"/></connection>')
        return roads, f'<junction id="{self.number}" name="">{connections}</junction>\n'


def signal(number, s, t, along, kind, more=""):
    """For those who drive along s, or against it. Poles stand beside the sidewalk's outer edge."""
    return (f'<signal id="{number}" s="{s:.3f}" t="{t}" orientation="{"+" if along else "-"}" '
            f'country="DE" {kind} hOffset="0" {more}/>')


def bridge_map():
    light = 'name="Signal_3Light" dynamic="yes" type="1000001" subtype="-1" value="-1" zOffset="3.5" height="1"'
    stop = 'name="Sign_Stop" dynamic="no" type="206" subtype="-1" value="-1" zOffset="2" height="0.7"'
    limit = 'name="Sign_30" dynamic="no" type="274" subtype="30" value="30" unit="km/h" zOffset="2" height="0.6"'
    side = LANE + WALK + 0.3
    quarter = math.pi / 2
    # From the crossing eastwards, around to the left and over itself, and back from the south.
    loop = (Path(MOUTH, 0, 0).line(120).arc(40, 3 * quarter).line(110).arc(40, -quarter).line(25)
            .arc(30, -quarter).line(65))
    height = 7  # [m] of the bridge, which lies 348 m on
    heights = (rise(0, 100, 0, 0) + rise(100, 230, 0, height) + rise(330, 37, height, height) +
               rise(367, 230, height, 0) + rise(597, 50, 0, 0))
    west = Path(-MOUTH, 0, math.pi).line(85)
    north = (Path(-115, MOUTH, quarter).line(45).arc(30, -quarter).line(55).arc(30, -quarter).line(45))
    end = Path(-115, -MOUTH, -quarter).spiral(40, 0, 0.02)
    end.arc(50, 0.6).line(40)
    roads = (
        road(1, loop, 50, (100, 100), heights, signals=signal(1, 1, side, False, light) +
             signal(2, loop.length - 1, -side, True, light)) +
        road(2, west, 30, (100, 101), signals=signal(3, 1, side, False, light) +
             signal(4, 20, -side, True, limit),
             objects='<object id="1" name="Crosswalk" type="crosswalk" s="1.5" t="0" zOffset="0"/>') +
        road(3, north, 50, (101, 100), signals=signal(5, north.length - 1, -side, True, light)) +
        road(4, end, 30, (101, None), signals=signal(6, 1, side, False, stop)))
    turns, junctions = "", ""
    for number, junction in enumerate((
            Junction(100, 0, 0, ((1, False, 0), (3, True, quarter), (2, False, math.pi), (1, True, -quarter))),
            Junction(101, -115, 0, ((2, True, 0), (3, False, quarter), (4, False, -quarter))))):
        more_turns, itself = junction.write(200 + 100 * number)
        turns += more_turns
        junctions += itself
    return ('<?xml version="1.0" encoding="UTF-8"?>\n<OpenDRIVE><header revMajor="1" revMinor="4" '
            f'name="bridge" version="1"/>\n{roads}{turns}{junctions}</OpenDRIVE>\n')


# ---- SUMO -----------------------------------------------------------------------------------------


def quarter_sources():
    """Nodes and edges of three by three junctions 110 m apart, on a slope, and of an overpass."""
    block = 110
    nodes, edges = "", ""
    for column in range(3):
        for row in range(3):
            kind = "traffic_light" if column == 1 else "priority"
            nodes += (f'<node id="{"abc"[column]}{row}" x="{column * block}" y="{row * block}" '
                      f'z="{2 * row}" type="{kind}"/>\n')
    for node, x, y, z in (("west", -200, 165, 3), ("east", 420, 165, 3)):
        nodes += f'<node id="{node}" x="{x}" y="{y}" z="{z}" type="priority"/>\n'

    def street(source, target, lanes=1, shape=""):
        nonlocal edges
        for begin, goal, points in ((source, target, shape),
                                    (target, source, " ".join(reversed(shape.split())))):
            edges += (f'<edge id="{begin}_{goal}" from="{begin}" to="{goal}" numLanes="{lanes}" '
                      f'speed="{16.67 if lanes > 1 else 13.89}" priority="{9 if lanes > 1 else 5}" '
                      f'sidewalkWidth="2"' + (f' shape="{points}"' if points else "") + "/>\n")

    for i in range(2):
        for k in range(3):
            street(f'{"abc"[i]}{k}', f'{"abc"[i + 1]}{k}')
            street(f'{"abc"[k]}{i}', f'{"abc"[k]}{i + 1}', 2 if k == 1 else 1)
    # From the outer streets' corners to the ends of the overpass, which crosses three streets.
    street("a0", "west", 1, "0,0,0 -120,0,0 -190,60,1.5 -200,165,3")
    street("east", "c2", 1, "420,165,3 410,210,3.5 360,220,4 220,220,4")
    street("west", "east", 1, "-200,165,3 -20,165,10 240,165,10 420,165,3")
    return f"<nodes>\n{nodes}</nodes>\n", f"<edges>\n{edges}</edges>\n"


def lanes_sources():
    """Nodes and edges of two straight roads that meet nobody."""
    nodes, edges = "", ""
    for name, y, length, rise_to, lanes in (("main", 0, 1500, 0, 3), ("hill", -300, 600, 48, 2)):
        for end, x, z in (("west", 0, 0), ("east", length, rise_to)):
            nodes += f'<node id="{name}_{end}" x="{x}" y="{y}" z="{z}" type="priority"/>\n'
        for edge, source, target in ((name, "west", "east"), (f"{name}_back", "east", "west")):
            edges += (f'<edge id="{edge}" from="{name}_{source}" to="{name}_{target}" numLanes="{lanes}" '
                      'speed="36.11" priority="9"/>\n')
    return f"<nodes>\n{nodes}</nodes>\n", f"<edges>\n{edges}</edges>\n"


def sumo_map(nodes, edges):
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "in.nod.xml").write_text(nodes)
        (folder / "in.edg.xml").write_text(edges)
        subprocess.run(
            ["netconvert", "--node-files", "in.nod.xml", "--edge-files", "in.edg.xml", "--output-file",
             "out.net.xml", "--xml-validation", "never", "--crossings.guess", "--walkingareas",
             "--no-turnarounds.except-deadend", "--offset.disable-normalization", "--tls.default-type", "static",
             "--precision", "2"],
            cwd=folder, check=True, stdout=subprocess.DEVNULL)
        lines = (folder / "out.net.xml").read_text().splitlines(keepends=True)
    # The comment in which netconvert notes date and call.
    begin = next(i for i, text in enumerate(lines) if text.startswith("<!-- generated on"))
    end = next(i for i, text in enumerate(lines) if text.startswith("-->"))
    return "".join(lines[:begin] + lines[end + 1:])


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "bridge.xodr").write_text(bridge_map())
    (folder / "quarter.net.xml").write_text(sumo_map(*quarter_sources()))
    (folder / "lanes.net.xml").write_text(sumo_map(*lanes_sources()))


if __name__ == "__main__":
    main()
