"""A town and who is on its roads, from above, as SVG. Metres, x east; SVG's y points down, so north is -y."""
from __future__ import annotations

import functools
import html
from typing import Any, Iterable, Iterator, Tuple

import numpy as np

from . import schema
from .nouns import Noun, enum, points

NONE = 0xFFFFFFFF
EGO, DRIVEN, CAR, WALKER = "#e8572a", "#2f7ed8", "#3b4148", "#8e44ad"  # who: ours, others with mass, background, on foot
SIGNALS = {
    "off": "#6b7077", "red": "#e03131", "red_yellow": "#f08c00", "yellow": "#f5c518", "green": "#2fb344",
    "green_minor": "#7bc96f", "stop": "#e03131",
}  # fmt: skip
SIGNAL_COLOURS = [SIGNALS[name] for name in enum("SignalColor")]
_LAND, _ROAD, _SIDEWALK, _CROSSING, _MARKING = "#eef0e6", "#858b93", "#d8d4ca", "#d3d6da", "#f4f5f6"
_BUILDING, _ROOF_EDGE, _TREE = "#cbb9a8", "#a8947f", "#7fb069"
_PLOTS = {
    "lawn": "#dfe9cc", "park": "#cfe3b6", "square": "#e5ded1", "gravel": "#e0d8c6", "water": "#a8d0ea",
    "car_park": "#c9ccd0", "playground": "#ecd9b0", "forest": "#bcd6a2",
}  # fmt: skip
_LANE = {name: number for name, number in enum("LaneKind").items()}
Box = Tuple[float, float, float, float]  # west, south, east, north [m]


def town_box(town: Noun) -> Box:
    """Around all lanes, and some of the land beside them."""
    (west, south, _), (east, north, _), beside = town.low.item(), town.high.item(), 25.0
    return west - beside, south - beside, east + beside, north + beside


def view_box(box: Box) -> str:
    """Of an SVG."""
    west, south, east, north = box
    return f"{west:.1f} {-north:.1f} {east - west:.1f} {north - south:.1f}"


def _path(line: np.ndarray, closed: bool = False) -> str:
    text = "L".join(f"{x:.1f} {-y:.1f}" for x, y in line[:, :2].tolist())
    return f"M{text}{'Z' if closed else ''}"


def _is_inside(line: np.ndarray, box: Box, beside: float = 5.0) -> bool:
    """Whether any of it may lie in the box."""
    west, south, east, north = box
    low, high = line[:, :2].min(axis=0) - beside, line[:, :2].max(axis=0) + beside
    return bool(low[0] < east and high[0] > west and low[1] < north and high[1] > south)


def _beside(line: np.ndarray, left: float) -> np.ndarray:
    """A line so many metres to the left of another."""
    along = np.gradient(line[:, :2], axis=0)
    along /= np.maximum(np.hypot(along[:, :1], along[:, 1:]), 1e-9)
    return line[:, :2] + left * np.column_stack([-along[:, 1], along[:, 0]])


def _rectangle(x: float, y: float, yaw: float, length: float, width: float) -> np.ndarray:
    ahead, left = np.array([np.cos(yaw), np.sin(yaw)]) * length / 2, np.array([-np.sin(yaw), np.cos(yaw)]) * width / 2
    return np.array([x, y]) + np.array([ahead + left, left - ahead, -ahead - left, ahead - left])


def _shapes(lines: Iterable[np.ndarray], style: str, closed: bool = True) -> Iterator[str]:
    """One path of many lines: an element less for each."""
    text = "".join(_path(line, closed) for line in lines)
    if text:
        yield f'<path d="{text}" {style}/>'


def town_layers(town: Noun, box: Box) -> str:
    """The ground, roads, markings, buildings and trees within a box: SVG elements, the lowest first."""
    west, south, east, north = box
    parts = [f'<rect x="{west:.1f}" y="{-north:.1f}" width="{east - west:.1f}" height="{north - south:.1f}" fill="{_LAND}"/>']
    plots = {number: name for name, number in enum("PlotKind").items()}
    for plot in town.plots:
        outline = points(plot.outline)
        if _is_inside(outline, box):
            parts += _shapes([outline], f'fill="{_PLOTS[plots[plot.kind]]}"')
    lanes = [(lane, points(lane.centre)) for lane in town.lanes]
    lanes = [(lane, centre) for lane, centre in lanes if _is_inside(centre, box)]
    outlines = [points(junction.outline) for junction in town.junctions if len(junction.outline)]
    parts += _roads(lanes, [outline for outline in outlines if _is_inside(outline, box)])
    parts += _buildings(town, box)
    crowns = [tree for tree in town.trees.tolist() if west < tree[0][0] < east and south < tree[0][1] < north]
    parts += [f'<circle cx="{x:.1f}" cy="{-y:.1f}" r="{radius:.1f}" fill="{_TREE}" fill-opacity=".55"/>'
              for (x, y, _), _, radius, *_ in crowns]  # fmt: skip
    return "".join(parts)


def _roads(lanes: list[tuple[Any, np.ndarray]], junctions: list[np.ndarray]) -> Iterator[str]:
    def of(*kinds: str) -> list[tuple[Any, np.ndarray]]:
        return [(lane, centre) for lane, centre in lanes if lane.kind in [_LANE[kind] for kind in kinds]]

    def strips(kind: str, colour: str, wider: float = 0.0) -> Iterator[str]:
        for width in sorted({lane.width for lane, _ in of(kind)}):
            same = [centre for lane, centre in of(kind) if lane.width == width]
            yield from _shapes(same, f'fill="none" stroke="{colour}" stroke-width="{width + wider:.2f}"', closed=False)

    yield from strips("sidewalk", _SIDEWALK)
    yield from _shapes([points(lane.outline) for lane, _ in of("walking_area") if len(lane.outline)], f'fill="{_SIDEWALK}"')
    yield from strips("driving", _ROAD, 0.3)  # no seam between neighbours
    yield from _shapes(junctions, f'fill="{_ROAD}"')
    yield from strips("internal", _ROAD)
    for lane, centre in of("crossing"):
        # Stripes across the way of those who walk.
        yield from _shapes([centre], f'fill="none" stroke="{_CROSSING}" stroke-width="{lane.width:.1f}" '
                           'stroke-dasharray=".5 .6"', closed=False)  # fmt: skip
    inner = [_beside(centre, lane.width / 2) for lane, centre in of("driving") if lane.left != NONE]
    middle = [_beside(centre, lane.width / 2) for lane, centre in of("driving") if lane.left == NONE and lane.opposite != NONE]
    line = f'fill="none" stroke="{_MARKING}" stroke-width=".18"'
    yield from _shapes(inner, line + ' stroke-dasharray="3 6"', closed=False)
    yield from _shapes(middle, line, closed=False)


def _buildings(town: Noun, box: Box) -> Iterator[str]:
    roofs = [_rectangle(x, y, yaw, length, width) for (x, y, _), yaw, length, width, *_ in town.buildings.tolist()]
    roofs += [points(drawn.outline)[:, :2] for drawn in town.drawn_buildings]
    roofs = [roof for roof in roofs if _is_inside(roof, box)]
    shadow = np.array([1.2, -1.2])
    yield from _shapes([roof + shadow for roof in roofs], 'fill="#000" fill-opacity=".13"')
    yield from _shapes(roofs, f'fill="{_BUILDING}" stroke="{_ROOF_EDGE}" stroke-width=".4"')


@functools.lru_cache(maxsize=None)
def car_symbol(model: int) -> str:
    """A vehicle from above, in its own frame (x ahead; SVG's y: right), to be turned and moved to its place. Colour: as of
    what is around it."""
    _, length, width, overhang = schema.VEHICLES[model] if model < len(schema.VEHICLES) else schema.VEHICLES[0]
    glass = f'fill="#fff" fill-opacity=".45" x="{length * 0.55 - overhang:.2f}" y="{-width * 0.38:.2f}"'
    return (
        f'<rect x="{-overhang:.2f}" y="{-width / 2:.2f}" width="{length:.2f}" height="{width:.2f}" rx="{width * 0.25:.2f}"/>'
        f'<rect {glass} width="{length * 0.13:.2f}" height="{width * 0.76:.2f}" rx=".2"/>'
    )


def placed(x: float, y: float, yaw_deg: float) -> str:
    """The transform of what stands there."""
    return f"translate({x:.2f} {-y:.2f}) rotate({-yaw_deg:.1f})"


def signal_bars(town: Noun) -> list[str]:
    """For each signal an element without colour: beside each other at the end of the lane that they face."""
    lanes: dict[int, list[int]] = {}
    for index, signal in enumerate(town.signals):
        lanes.setdefault(signal.lane, []).append(index)
    bars = []
    for index, signal in enumerate(town.signals):
        x, y, _ = signal.position.item()
        if signal.for_walkers or signal.lane == NONE:
            bars.append(f'<circle r=".7" transform="{placed(x, y, 0)}"')
            continue
        here, width = lanes[signal.lane], town.lanes[signal.lane].width * 0.9
        each = width / len(here)
        top = -width / 2 + each * here.index(index)
        bars.append(f'<rect x="-1" y="{top:.2f}" width="1" height="{each:.2f}" transform="{placed(x, y, np.degrees(signal.yaw))}"')
    return bars


def page_title(town: Noun, text: str) -> str:
    return html.escape(f"{town.name} · {text}")
