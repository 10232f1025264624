"""What a town is planned of: junctions, two-way streets, one-way roads, roundabouts. Lengths in metres."""
import math
import sys
from dataclasses import dataclass, field

# lanes in each direction, speed [m/s], priority, lane width, sidewalk width
STREET_TYPES = {
    "avenue": (2, 16.67, 9, 3.50, 2.50),
    "main": (1, 16.67, 9, 3.50, 2.50),
    "street": (1, 13.89, 7, 3.50, 2.50),
    "lane30": (1, 8.33, 5, 3.25, 2.00),
    "circle": (1, 8.33, 10, 4.50, 2.50),
    # the proving ground's
    "motorway": (3, 36.11, 10, 3.75, 0),
    "turning_loop": (3, 13.89, 10, 3.75, 0),
    "country": (1, 27.78, 8, 3.50, 0),
    "country_loop": (1, 8.33, 8, 3.50, 0),
}

# How a junction is ruled, in netconvert's words.
RULES = {"lit": "traffic_light", "yield": "priority", "stop": "priority_stop", "all_stop": "allway_stop",
         "right_first": "right_before_left"}


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
class Road:
    """One-way, on a line of its own; two of them on one line, there and back, are a road with two directions."""
    name: str  # of the edge: its lanes are name_0 (rightmost), name_1, ...
    source: str
    target: str
    kind: str
    street: str
    line: list  # (x, y); lanes lie to the right of it
    speed: float = None  # [m/s], None: its kind's


@dataclass
class Plan:
    junctions: dict  # name -> (x, y, rule)
    streets: list = field(default_factory=list)
    roundabouts: list = field(default_factory=list)
    plots: list = field(default_factory=list)  # (kind, outline); later ones lie over earlier ones
    districts: list = field(default_factory=list)  # (style, outline); an empty outline: everywhere else
    keep_clear: list = field(default_factory=list)  # outlines
    roads: list = field(default_factory=list)
    links: list = field(default_factory=list)  # (from, to) of roads whose way on netconvert would not guess


def rectangle(left, low, right, high):
    return [(left, low), (right, low), (right, high), (left, high)]


def circle(centre, radius, count):
    return [(centre[0] + radius * math.cos(math.tau * i / count),
             centre[1] + radius * math.sin(math.tau * i / count)) for i in range(count)]


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
    roads = {frozenset(road.line): road.line for road in plan.roads}.values()
    return (sum(length(centre_line(plan, street)) for street in plan.streets) +
            sum(length(line) for ring in plan.roundabouts for _, _, line in arcs_of(ring)) +
            sum(map(length, roads)))


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
