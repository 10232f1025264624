"""The plans of the proving ground: a straight, curves, junctions. What a test needs is found by its name."""
import math

from plan import Plan, Road, Roundabout, Street, rectangle

LOOP_SIDE, LOOP_RADIUS = 80, 60  # [m] of a motorway's turning loop: aside, around
COUNTRY_LOOP_SIDE, COUNTRY_LOOP_RADIUS = 30, 25
SAG = 0.02  # [m] between an arc and its chords, at most
LEAD = 20  # [m] straight before and behind a curve: netconvert wants 14
# radius [m], angle [degrees, left positive], speed [km/h]: at most 2.6 m/s^2 to the side
CURVES = ((500, 60, 130), (300, -60, 100), (200, 90, 80), (120, -90, 60), (80, 90, 50), (50, -90, 40), (30, 90, 30))


class Pen:
    """Draws a line ahead, piece by piece."""

    def __init__(self, x, y, heading_deg=0):
        self.points = [(x, y)]
        self.heading = math.radians(heading_deg)

    @property
    def place(self):
        return self.points[-1]

    def ahead(self, length):
        x, y = self.place
        self.points.append((x + length * math.cos(self.heading), y + length * math.sin(self.heading)))
        return self

    def arc(self, radius, angle_deg):
        """To the left with a positive angle."""
        side = math.copysign(1, angle_deg)
        x, y = self.place
        centre = x - side * radius * math.sin(self.heading), y + side * radius * math.cos(self.heading)
        turn = math.radians(angle_deg)
        count = max(2, math.ceil(abs(turn) * radius / math.sqrt(8 * radius * SAG)))
        for i in range(1, count + 1):
            heading = self.heading + turn * i / count
            self.points.append((centre[0] + side * radius * math.sin(heading),
                                centre[1] - side * radius * math.cos(heading)))
        self.heading += turn
        return self

    def piece(self):
        """The line until here; the next one begins here."""
        line, self.points = self.points, self.points[-1:]
        return line


def turning_loop(plan, end, name, kind, arriving, leaving, side, radius, heading_deg):
    """Where a two-way road ends: aside to the right, around to the left, and back. Nobody has to turn on the spot."""
    aside = math.degrees(math.acos(side / (side + radius)))
    pen = Pen(*plan.junctions[end][:2], heading_deg).arc(side, -aside).arc(radius, 90 + aside)
    out = pen.piece()
    plan.junctions[name] = (*pen.place, "yield")
    back = pen.arc(radius, 90 + aside).arc(side, -aside).piece()
    plan.roads += [Road(f"{name}_out", end, name, kind, "Turning Loop", out),
                   Road(f"{name}_back", name, end, kind, "Turning Loop", back)]
    plan.links += [(arriving, f"{name}_out"), (f"{name}_out", f"{name}_back"), (f"{name}_back", leaving)]


def there_and_back(plan, name, source, target, kind, street, line, back, speed=None):
    plan.roads += [Road(name, source, target, kind, street, line, speed),
                   Road(back, target, source, kind, street, line[::-1], speed)]


def straight():
    """4 km, three lanes each way, 130 km/h: the edges 'east' and 'west', a turning loop at each end."""
    plan = Plan(junctions=dict(west_end=(0, 0, "yield"), east_end=(4000, 0, "yield")),
                keep_clear=[rectangle(-300, -200, 4300, 200)])  # nobody lives at a motorway
    there_and_back(plan, "east", "west_end", "east_end", "motorway", "Proving Straight", [(0, 0), (4000, 0)], "west")
    turning_loop(plan, "east_end", "east_loop", "turning_loop", "east", "west", LOOP_SIDE, LOOP_RADIUS, 0)
    turning_loop(plan, "west_end", "west_loop", "turning_loop", "west", "east", LOOP_SIDE, LOOP_RADIUS, 180)
    return plan


def curves():
    """One country road: edge 'r120' is a curve of 120 m radius, 'r120_back' the other way; 's1' to 's8' are straight."""
    pen = Pen(0, 0)
    plan = Plan(junctions=dict(start=(0, 0, "yield")))
    before = "start"
    for number, (radius, angle, speed_kmh) in enumerate(CURVES + ((0, 0, 0),), 1):
        for name, line, speed in ((f"s{number}", pen.ahead(150).piece(), None),
                                  (f"r{radius}", radius and pen.ahead(LEAD).arc(radius, angle).ahead(LEAD).piece(),
                                   speed_kmh / 3.6)):
            if not line:
                continue
            after = f"behind_{name}"
            plan.junctions[after] = (*line[-1], "yield")
            there_and_back(plan, name, before, after, "country", "Winding Road", line, f"{name}_back", speed)
            before = after
    loop = "country_loop", COUNTRY_LOOP_SIDE, COUNTRY_LOOP_RADIUS
    last = f"s{len(CURVES) + 1}"
    turning_loop(plan, before, "far_loop", loop[0], last, f"{last}_back", *loop[1:], math.degrees(pen.heading))
    turning_loop(plan, "start", "near_loop", loop[0], "s1_back", "s1", *loop[1:], 180)
    return plan


def junctions():
    """A grid with a junction of every kind: x_ has four arms, t_ three, and then its rule."""
    places = dict(
        # rows from south to north, columns from west to east; corners are bends
        t_stop=(180, 0, "stop"), t_lit=(360, 0, "lit"), t_yield=(540, 0, "yield"),
        t_lit_wide=(0, 160, "lit"), x_yield=(180, 160, "yield"), x_lit=(360, 160, "lit"), x_stop=(540, 160, "stop"),
        t_yield_skew=(720, 90, "yield"),
        t_lit_skew=(0, 260, "lit"), x_all_stop=(180, 330, "all_stop"), x_right_first=(360, 330, "right_first"),
        t_stop_skew=(720, 400, "stop"),
        t_all_stop=(180, 500, "all_stop"), t_right_first=(360, 500, "right_first"))
    x_round = Roundabout("x_round_", (540, 330), 15, dict(e=0, n=90, w=180, s=270))
    t_round = Roundabout("t_round_", (540, 500), 15, dict(e=0, w=180, s=270))

    def street(source, target, kind, name, *corners):
        return Street(source, target, kind, name, list(corners), 25)
    return Plan(
        junctions=places, roundabouts=[x_round, t_round],
        streets=[
            street("t_lit_wide", "t_stop", "main", "Ring", (0, 0)), street("t_stop", "t_lit", "main", "Ring"),
            street("t_lit", "t_yield", "main", "Ring"), street("t_yield", "t_yield_skew", "main", "Ring", (720, 0)),
            street("t_yield_skew", "t_stop_skew", "main", "Ring"),
            street("t_stop_skew", "t_round_e", "main", "Ring", (720, 500)),
            street("t_round_w", "t_right_first", "main", "Ring"), street("t_right_first", "t_all_stop", "main", "Ring"),
            street("t_all_stop", "t_lit_skew", "main", "Ring", (0, 500)), street("t_lit_skew", "t_lit_wide", "main", "Ring"),
            street("t_lit_wide", "x_yield", "avenue", "Cross Avenue"), street("x_yield", "x_lit", "avenue", "Cross Avenue"),
            street("x_lit", "x_stop", "avenue", "Cross Avenue"), street("x_stop", "t_yield_skew", "avenue", "Cross Avenue"),
            street("t_lit_skew", "x_all_stop", "street", "North Street"),
            street("x_all_stop", "x_right_first", "street", "North Street"),
            street("x_right_first", "x_round_w", "street", "North Street"),
            street("x_round_e", "t_stop_skew", "street", "North Street"),
            street("t_stop", "x_yield", "street", "First Lane"), street("x_yield", "x_all_stop", "street", "First Lane"),
            street("x_all_stop", "t_all_stop", "lane30", "First Lane"),
            street("t_lit", "x_lit", "avenue", "Second Lane"), street("x_lit", "x_right_first", "street", "Second Lane"),
            street("x_right_first", "t_right_first", "street", "Second Lane"),
            street("t_yield", "x_stop", "lane30", "Third Lane"), street("x_stop", "x_round_s", "lane30", "Third Lane"),
            street("x_round_n", "t_round_s", "street", "Third Lane")],
        districts=[("modern", [])])
