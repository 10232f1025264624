"""Pictures from above that notebooks show: of a tick, and of a trace with a slider. Self-contained HTML without a library."""
from __future__ import annotations

import html
import json
import pathlib
from typing import TYPE_CHECKING, Any, Iterable

import numpy as np

from . import top_view
from .nouns import Noun, enum
from .replay_page import REPLAY

if TYPE_CHECKING:
    from .trace import Tick, Trace

_DRIVER = enum("Driver")
_SPAWN = enum("CommandKind")["spawn"]
_STYLE = 'style="width:100%;max-height:80vh;background:#eef0e6;border-radius:6px" font-family="sans-serif"'


class View:
    """A picture. A notebook shows it when it is the last thing in a cell; elsewhere `save('view.html')` writes it for a
    browser. `svg` is the picture alone (of a trace, its first tick)."""

    def __init__(self, svg: str, page: str, text: str, is_alive: bool) -> None:
        self.svg, self._page, self._text, self._is_alive = svg, page, text, is_alive

    def save(self, path: str | pathlib.Path) -> pathlib.Path:
        """Writes it: a page of HTML, or SVG where the name ends so."""
        path = pathlib.Path(path)
        path.write_text(self.svg if path.suffix == ".svg" else self._page, encoding="utf-8")
        return path

    def _repr_html_(self) -> str:
        if not self._is_alive:
            return self.svg
        # A frame of its own: its script runs in every kind of notebook, and meets no other one.
        return f'<iframe srcdoc="{html.escape(self._page)}" style="width:100%;height:620px;border:0"></iframe>'

    def __repr__(self) -> str:
        return f"<reprise.View: {self._text}; a notebook shows it, .save('view.html') writes it for a browser>"


def _yaws_deg(vehicles: np.ndarray) -> np.ndarray:
    """[deg] of vehicles with mass, counter-clockwise from east."""
    turned = vehicles["orientation"]
    w, x, y, z = (turned[axis] for axis in ("w", "x", "y", "z"))
    return np.degrees(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))


def _actors(tick: Noun, traffic: Noun | None) -> Iterable[tuple[int, int, bool, float, float, float]]:
    """(id, model, has mass, x, y, yaw [deg]); model -1: on foot."""
    all_records = [(tick.vehicles, "vehicle")]
    if traffic is not None:
        all_records = [(traffic.cars, "car"), (traffic.walkers, "walker"), *all_records]
    for records, kind in all_records:
        if not len(records):
            continue
        yaws = _yaws_deg(records) if kind == "vehicle" else np.degrees(records["yaw"])
        models = np.full(len(records), -1) if kind == "walker" else records["model"]
        columns = (records["id"], models, records["position"]["x"], records["position"]["y"], yaws)
        for actor, model, x, y, yaw in zip(*(column.tolist() for column in columns)):
            yield actor, model, kind == "vehicle", x, y, yaw


def _figure(model: int, colour: str, more: str) -> str:
    """Of an actor; turned and moved by a transform in `more`."""
    shape = top_view.car_symbol(model) if model >= 0 else '<circle r=".45"/>'
    if colour == top_view.EGO:  # to be found in a whole town
        shape = f'<circle r="7" fill-opacity=".15" stroke="{colour}" stroke-opacity=".6" stroke-width=".6"/>{shape}'
    return f'<g fill="{colour}" {more}>{shape}</g>'


def _colour(actor: int, model: int, has_mass: bool, egos: set[int]) -> str:
    if actor in egos:
        return top_view.EGO
    return top_view.WALKER if model < 0 else top_view.DRIVEN if has_mass else top_view.CAR


def _signals(town: Noun, colours: np.ndarray) -> str:
    bars = [f'{bar} fill="{top_view.SIGNAL_COLOURS[colour]}"/>' for bar, colour in zip(top_view.signal_bars(town), colours)]
    return f'<g class="signals">{"".join(bars)}</g>'


def _around(centre: tuple[float, float], radius: float) -> top_view.Box:
    (x, y), wide = centre, 1.6  # as screens are
    return x - wide * radius, y - radius, x + wide * radius, y + radius


def _legend(box: top_view.Box, title: str) -> str:
    """The title, and a line of so many metres, in the picture's corners."""
    west, south, east, north = box
    size = (north - south) / 26
    length = next(metres for metres in (200, 100, 50, 20, 10, 5, 2) if metres < (east - west) / 4)
    x, y = west + size, -south - size
    texts = (f'<text class="title" x="{x:.2f}" y="{-north + 1.6 * size:.2f}">{title}</text>'
             f'<text x="{x + length + size / 2:.2f}" y="{y:.2f}">{length} m</text>')  # fmt: skip
    halo = f'stroke="#fff" stroke-opacity=".8" stroke-linejoin="round" stroke-width="{size / 4:.2f}"'
    return (
        f'<g font-size="{size:.2f}" fill="#2b2f33"><g {halo}>{texts}</g>{texts}</g>'
        f'<path d="M{x:.2f} {y - size / 2:.2f}v{size / 2:.2f}h{length}v{-size / 2:.2f}" fill="none" stroke="#2b2f33" '
        f'stroke-width="{size / 8:.2f}"/>'
    )


def _svg(box: top_view.Box, content: str) -> str:
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{top_view.view_box(box)}" {_STYLE}>{content}</svg>'


def _page(body: str, title: str) -> str:
    return f'<!doctype html><html><head><meta charset="utf-8"><title>{title}</title></head><body style="margin:0">{body}</body></html>'


def _says(town: Noun, index: int, step: float, speed: float | None) -> str:
    return top_view.page_title(town, f"tick {index} · {index * step:.2f} s" + ("" if speed is None else f" · {abs(speed) * 3.6:.0f} km/h"))


def view_of_tick(town: Noun, tick: Noun, traffic: Noun | None, step: float, egos: set[int], radius: float | None) -> View:
    """One tick. `radius` [m] around the first of `egos`; None: the whole town."""
    actors = list(_actors(tick, traffic))
    ours = [(x, y) for actor, _, _, x, y, _ in actors if actor in egos]
    box = _around(ours[0], radius) if ours and radius else top_view.town_box(town)
    speeds = [float(one["speed"]) for one in tick.measurements if one["actor"] in egos]
    title = _says(town, tick.index, step, speeds[0] if len(speeds) == 1 else None)
    figures = [_figure(model, _colour(actor, model, has_mass, egos), f'transform="{top_view.placed(x, y, yaw)}"')
               for actor, model, has_mass, x, y, yaw in actors
               if box[0] - 15 < x < box[2] + 15 and box[1] - 15 < y < box[3] + 15]  # fmt: skip
    svg = _svg(box, top_view.town_layers(town, box) + _signals(town, tick.signals) + "".join(figures) + _legend(box, title))
    return View(svg, _page(svg, title), f"{town.name}, tick {tick.index}", False)


def egos_of(trace: Trace) -> set[int]:
    """Who is driven by another program in a trace; without one, the first that has mass. Reads all of it."""
    driven, first = {actor for actor, spawn in trace.spawned_before.items() if spawn.driver == _DRIVER["external"]}, None
    for tick in trace:
        for command in tick.tick.commands:
            if command.kind == _SPAWN and command.driver == _DRIVER["external"]:
                driven.add(int(command.actor))
        if first is None and len(tick.tick.vehicles):
            first = int(tick.tick.vehicles["id"][0])
    return driven or ({first} if first is not None else set())


def view_of_trace(trace: Trace, first: int | None, last: int | None, every: int | None, radius: float) -> View:
    """Ticks of a trace, with a slider."""
    first, last = max(first or 0, trace.first), min(last or trace.last, trace.last)
    if last < first:
        raise ValueError(f"show: expected ticks from {trace.first} to {trace.last}")
    if every is not None and every < 1:
        raise ValueError(f"show: every={every}: expected a number of ticks, at least 1")
    every = every or max(1, -(-(last - first) // 600))
    egos = trace.egos
    slots: dict[int, int] = {}
    figures: list[str] = []
    frames: list[dict[str, Any]] = []
    signals = ""
    for index in range(first, last + 1, every):
        tick = trace[index]
        there: list[float] = []
        for actor, model, has_mass, x, y, yaw in _actors(tick.tick, tick.traffic):
            if actor not in slots:
                slots[actor] = len(slots)
                figures.append(_figure(model, _colour(actor, model, has_mass, egos), 'visibility="hidden"'))
            there += [slots[actor], round(x, 2), round(-y, 2), round(-yaw, 1)]
        colours = "".join(map(str, tick.tick.signals.tolist()))
        ours = [one for one in tick.tick.vehicles if int(one["id"]) in egos][:1]
        speeds = [float(one["speed"]) for one in tick.tick.measurements if ours and one["actor"] == ours[0]["id"]]
        frames.append({
            "actors": there, "says": _says(trace.town, index, trace.step, speeds[0] if speeds else None),
            "at": [round(ours[0]["position"]["x"].item(), 2), round(-ours[0]["position"]["y"].item(), 2)] if ours else None,
            "signals": colours if colours != signals else None,
        })  # fmt: skip
        signals = colours
    return _replay(trace, figures, frames, trace[first], every, egos, radius)


def _replay(trace: Trace, figures: list[str], frames: list[dict[str, Any]], begin: Tick, every: int, egos: set[int],
            radius: float) -> View:  # fmt: skip
    town, box = trace.town, top_view.town_box(trace.town)
    way = [frame["at"] for frame in frames if frame["at"]]
    drawn = "L".join(f"{x:.1f} {y:.1f}" for x, y in way)
    trail = f'<path d="M{drawn}" fill="none" stroke="{top_view.EGO}" stroke-opacity=".45" stroke-width=".6"/>' if way else ""
    legend = f'<g class="corner">{_legend(box, frames[0]["says"])}</g>'
    svg = _svg(box, top_view.town_layers(town, box) + _signals(town, begin.tick.signals) + trail
               + f'<g class="actors">{"".join(figures)}</g>' + legend)  # fmt: skip
    data = json.dumps({"frames": frames, "colours": top_view.SIGNAL_COLOURS, "radius": radius,
                       "seconds": trace.step * every}, separators=(",", ":"))  # fmt: skip
    title = top_view.page_title(town, trace.path.name)
    page = _page(REPLAY.replace("{svg}", svg).replace("{data}", data.replace("</", "<\\/")), title)
    still = view_of_tick(town, begin.tick, begin.traffic, trace.step, egos, None).svg
    return View(still, page, f"{trace.path.name}, {len(frames)} ticks of {len(trace)}", True)
