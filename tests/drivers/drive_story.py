"""What the built-in drivers of a trace lived through: collisions, waits, infractions, each with its story.

Used by long_drives.py. What is told is recorded; only `verdict` judges: from when on was the other one where the
driver then drove, and had it been enough to stop?
"""
import collections
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from reprise import schema  # noqa: E402
from reprise.nouns import enum  # noqa: E402

KINDS = {number: name for name, number in enum("EventKind").items()}
RED = {enum("SignalColor")[name] for name in ("red", "red_yellow")}
NONE = 0xFFFFFFFF

STANDS = 0.1  # [m/s] below
LONG = 60  # [s] of standing that is told
STUCK = 180  # [s] of standing, longer than any light is red
REACTION = 1.0  # [s] of an attentive driver
BRAKING = 6.0  # [m/s^2] of one who has to
LOOK_BACK = 5.0  # [s]


class Box:
    """A footprint: middle, heading, half of length and width."""

    def __init__(self, x, y, yaw, length, width, rear=None):
        self.c, self.s = math.cos(yaw), math.sin(yaw)
        ahead = 0 if rear is None else length / 2 - rear
        self.x, self.y = x + ahead * self.c, y + ahead * self.s
        self.yaw, self.length, self.width = yaw, length, width

    def local(self, x, y):
        """[m] ahead of the middle and left of it."""
        dx, dy = x - self.x, y - self.y
        return dx * self.c + dy * self.s, dy * self.c - dx * self.s

    def corners(self):
        for along, across in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
            u, v = along * self.length / 2, across * self.width / 2
            yield self.x + u * self.c - v * self.s, self.y + u * self.s + v * self.c

    def meets(self, other, margin=0.0):
        """Separating axes, of both."""
        for one, two in ((self, other), (other, self)):
            places = [one.local(x, y) for x, y in two.corners()]
            for axis, size in ((0, one.length / 2 + margin), (1, one.width / 2 + margin)):
                if min(p[axis] for p in places) > size or max(p[axis] for p in places) < -size:
                    return False
        return True


def yaw_of(q):
    return math.atan2(2 * (q["w"] * q["z"] + q["x"] * q["y"]), 1 - 2 * (q["y"] ** 2 + q["z"] ** 2))


def found(records, key, actor):
    at = records[key].searchsorted(actor)
    return records[at] if at < len(records) and records[key][at] == actor else None


def look(tick, actor):
    """(Box, speed, what it is, lane) of anybody in a tick; None: not there."""
    one = found(tick.tick.vehicles, "id", actor)
    if one is not None:
        name, length, width, rear = schema.VEHICLES[one["model"]]
        measured = found(tick.tick.measurements, "actor", actor)
        speed, lane = (float(measured["speed"]), int(measured["lane"])) if measured is not None else (0.0, NONE)
        place = one["position"]
        return Box(place["x"], place["y"], yaw_of(one["orientation"]), length, width, rear), speed, name, lane
    one = found(tick.traffic.cars, "id", actor)
    if one is not None:
        name, length, width, rear = schema.VEHICLES[one["model"]]
        place = one["position"]
        return Box(place["x"], place["y"], float(one["yaw"]), length, width, rear), float(one["speed"]), name, int(one["lane"])
    one = found(tick.traffic.walkers, "id", actor)
    if one is not None:
        place = one["position"]
        return Box(place["x"], place["y"], float(one["yaw"]), 0.5, 0.5), float(one["speed"]), "walker", NONE
    one = found(tick.tick.props, "id", actor)
    if one is not None:
        place = one["position"]
        return Box(place["x"], place["y"], 0, 0.5, 0.5), 0.0, "prop", NONE
    return None


def lane_name(trace, lane):
    return trace.town.lanes[lane].name if lane < len(trace.town.lanes) else "no lane"


def moment(trace, tick, driver, other):
    """One line of a collision's story: both of them, the other one as the driver sees it."""
    me = look(tick, driver)
    if me is None:
        return None
    box, speed, _, lane = me
    control = found(tick.tick.controls, "actor", driver)
    pedals = "" if control is None else f"throttle {control['throttle']:.2f} brake {control['brake']:.2f}"
    if control is not None and control["reverse"]:
        pedals += " reverse"
    text = f"{speed:5.1f} m/s, {pedals}, on {lane_name(trace, lane)}"
    seen = look(tick, other) if other else None
    if seen:
        ahead, left = box.local(seen[0].x, seen[0].y)
        turned = math.degrees(math.remainder(seen[0].yaw - box.yaw, 2 * math.pi))
        text += (
            f"; {seen[2]} {other} at {seen[1]:4.1f} m/s, {ahead:+6.1f} m ahead {left:+5.1f} m left (middles),"
            f" turned {turned:+4.0f}, on {lane_name(trace, seen[3])}"
        )
    return text


def in_the_way(trace, at, driver, other):
    """For how long before tick `at` the other one was where the driver drove until then [s], and how fast it was then."""
    swept, since = [], at
    for index in range(at, max(at - int(LOOK_BACK / trace.step), trace.first), -1):
        me, seen = look(trace[index], driver), look(trace[index], other)
        if me is None or seen is None:
            break
        swept.append(me[0])
        if not any(box.meets(seen[0], 0.3) for box in swept):
            break
        since = index
    me = look(trace[since], driver)
    return (at - since) * trace.step, me[1] if me else 0.0


def verdict(trace, at, driver, other):
    """Could the driver have avoided what happened in tick `at`? Judged by the tick before: then nobody was hit yet."""
    if other == 0:
        return "AVOIDABLE: something fixed"
    at = max(at - 1, trace.first)
    before = look(trace[max(at - int(0.5 / trace.step), trace.first)], driver)
    now, seen = look(trace[at], driver), look(trace[at], other)
    if not (before and now and seen):
        return "unknown"
    if abs(before[1]) < 0.3 and abs(now[1]) < 1:
        return "it stood"
    if now[1] > -0.1 and seen[1] > now[1] and now[0].local(seen[0].x, seen[0].y)[0] < -now[0].length / 4:
        return "hit from behind"
    since, speed = in_the_way(trace, at, driver, other)
    needed = REACTION + abs(speed) / BRAKING
    word = "AVOIDABLE" if since > needed else "no time"
    return f"{word}: in its way for {since:.2f} s at {speed:.1f} m/s, {needed:.2f} s to stop"


def nearest_ahead(tick, actor):
    """Who is in the lane's width within 15 m ahead; None: nobody."""
    me = look(tick, actor)
    if me is None:
        return None
    best, least = None, 15.0
    ids = [*tick.tick.vehicles["id"], *tick.traffic.cars["id"], *tick.traffic.walkers["id"]]
    for other in ids:
        if other == actor:
            continue
        seen = look(tick, int(other))
        if abs(seen[0].x - me[0].x) + abs(seen[0].y - me[0].y) > 50:
            continue
        for x, y in [*seen[0].corners(), (seen[0].x, seen[0].y)]:
            ahead, left = me[0].local(x, y)
            gap = ahead - me[0].length / 2
            if -0.3 < gap < least and abs(left) < me[0].width / 2 + 0.3:
                best, least = int(other), gap
    return best, least


def reason(trace, tick, actor, still):
    """Why somebody stands: who is ahead of whom, up to the first."""
    chain, seen = [], set()
    while actor not in seen and len(chain) < 8:
        seen.add(actor)
        _, speed, name, lane = look(tick, actor)
        text = f"{name} {actor} on {lane_name(trace, lane)}"
        if actor in still:
            text += f" still for {(tick.index - still[actor]) * trace.step:.0f} s"
        if lane < len(trace.town.lanes):
            signals = [link["signal"] for link in trace.town.lanes[lane].links]
            if any(one < len(tick.tick.signals) and tick.tick.signals[one] in RED for one in signals):
                text += " (red)"
        chain.append(text)
        ahead = nearest_ahead(tick, actor)
        if ahead is None or ahead[0] is None:
            return " <- ".join(chain)
        actor = ahead[0]
    return " <- ".join(chain) + (" <- again " + str(actor) if actor in seen else " <- ...")


class Account:
    """Of one trace: what its drivers did, summed up and told."""

    def __init__(self, trace):
        self.trace = trace
        self.counts = collections.Counter()
        self.stories = []
        self.wrecks = set()
        self.avoidable = 0
        self.driven = self.seconds = 0.0  # [m], [s] of all drivers
        self.car_speeds = []  # [m/s] mean of the background, each second
        self.still = {}  # since which tick somebody stands
        self.longest_wait = 0.0
        self.stuck_cars = 0  # at the end, for over STUCK
        for tick in trace:
            self._take(tick)
        last = trace[trace.last]
        limit = STUCK / trace.step
        for actor, since in self.still.items():
            if trace.last - since > limit and actor not in self.wrecks:
                self.stuck_cars += 1
        for one in last.tick.vehicles:
            if int(one["id"]) in self.wrecks:
                continue
            self.driven += float(one["odometer"])
            self._waited(last, int(one["id"]))

    @property
    def mean_speed(self):
        return self.driven / self.seconds if self.seconds else 0.0

    def _take(self, tick):
        # Who is a wreck from this tick on had no driver of ours.
        self.wrecks.update(event.actor for event in tick.tick.events if KINDS[event.kind] == "wrecked")
        drivers = set(map(int, tick.tick.vehicles["id"])) - self.wrecks
        self.seconds += len(drivers) * self.trace.step
        self._note_still(tick, tick.tick.measurements["actor"], tick.tick.measurements["speed"])
        if tick.index % 20 == 0:
            cars = tick.traffic.cars
            self._note_still(tick, cars["id"], cars["speed"])
            self._forget_gone(cars["id"], tick.tick.vehicles["id"])
            if len(cars):
                self.car_speeds.append(float(cars["speed"].mean()))
        for event in tick.tick.events:
            kind = KINDS[event.kind]
            if event.actor not in drivers and event.other not in drivers:
                continue
            if kind in ("spawned", "printed", "finished", "despawned"):
                continue
            if kind == "collision":
                for driver, other in ((event.actor, event.other), (event.other, event.actor)):
                    if driver in drivers:
                        self._collided(tick, driver, other, event)
                self.counts[kind] += 1
            elif kind not in ("collision_ended",):
                self.counts[kind] += 1
            if kind in ("wrecked", "backed_off", "overtakes", "wrong_way", "left_road", "on_sidewalk"):
                self._tell(tick, f"{kind}: {event.actor} {event.text} {event.other or ''}")
            if kind == "blocked":
                self._tell(tick, f"blocked: {reason(self.trace, tick, event.actor, self.still)}")

    def _note_still(self, tick, ids, speeds):
        for actor, speed in zip(ids.tolist(), speeds.tolist()):
            if abs(speed) < STANDS:
                self.still.setdefault(actor, tick.index)
            elif actor in self.still:
                self._waited(tick, actor)
                del self.still[actor]

    def _forget_gone(self, *here):
        """Who was taken out while it stood stands no more."""
        ids = {int(actor) for some in here for actor in some}
        for actor in [actor for actor in self.still if actor not in ids]:
            del self.still[actor]

    def _waited(self, tick, actor):
        since = self.still.get(actor)
        if since is None or actor in self.wrecks or found(tick.tick.vehicles, "id", actor) is None:
            return
        stood = (tick.index - since) * self.trace.step
        self.longest_wait = max(self.longest_wait, stood)
        if stood > LONG:
            self.counts["stood"] += 1
            self._tell(tick, f"stood: {actor} for {stood:.0f} s")

    def _collided(self, tick, driver, other, event):
        judged = verdict(self.trace, tick.index, driver, other)
        self.avoidable += judged.startswith("AVOIDABLE")
        self._tell(tick, f"collision: {driver} with {other or 'the town'}, {event.value:.0f} N s: {judged}")
        for before in (5, 4, 3, 2, 1.5, 1, 0.5, 0):
            index = tick.index - round(before / self.trace.step)
            if index >= self.trace.first:
                self.stories.append(f"      -{before:3} s {moment(self.trace, self.trace[index], driver, other)}")

    def _tell(self, tick, text):
        self.stories.append(f"  {tick.time:7.2f} s {text}")
