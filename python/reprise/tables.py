"""What a reader of a trace's tables wants to see and no tick records: names, models, lengths, reference points."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import schema

if TYPE_CHECKING:
    from .trace import Trace

_FIRST_OF_THE_DEMAND = 1_000_000  # ids from here on have no names: world/tick.h
_ACTOR = {"vehicles": "id", "cars": "id", "walkers": "id", "props": "id", "wheels": "vehicle", "measurements": "actor", "controls": "actor"}


def names(trace: Trace) -> dict[int, str]:
    """Of the scenario's actors, by id."""
    spawned = schema.ENUMS["world.EventKind"][1]["spawned"]
    found = {}
    for tick in trace:
        for event in tick.tick.events or ():
            if event.kind == spawned and event.actor < _FIRST_OF_THE_DEMAND:
                found[int(event.actor)] = event.text
    return found


def add_names(trace: Trace, noun: str, table: np.ndarray, columns: dict[str, Any]) -> None:
    """Behind the recorded columns: `name`, `model_name`, `length [m]`, `width [m]`, `lane_name`, both points along the lane."""
    if noun not in _ACTOR or not len(table):
        return
    ids = table[_ACTOR[noun]]
    columns["name"] = [trace.names.get(int(one)) for one in ids]
    models = _models(trace, noun, table)
    if models is not None:
        sizes = np.array([row[1:] for row in schema.VEHICLES])[models]
        columns["model_name"] = [schema.VEHICLES[model][0] for model in models]
        columns["length [m]"], columns["width [m]"] = sizes[:, 0], sizes[:, 1]
    if noun == "vehicles":
        measured = trace.table("measurements")  # one for each vehicle, in the same order
        if not np.array_equal(table["id"], measured["actor"]):
            return
        lanes = [lane.name for lane in trace.town.lanes]
        columns["lane_name"] = [lanes[lane] if lane < len(lanes) else None for lane in measured["lane"]]
        columns["rear_axle_s [m]"] = measured["lane_s"]
        columns["front_s [m]"] = measured["lane_s"] + sizes[:, 0] - sizes[:, 2]
    if noun in ("measurements", "cars"):
        lanes = [lane.name for lane in trace.town.lanes]
        columns["lane_name"] = [lanes[lane] if lane < len(lanes) else None for lane in table["lane"]]
        front = sizes[:, 0] - sizes[:, 2]  # from the rear axle
        recorded = columns.pop("lane_s [m]").astype(float)
        columns["rear_axle_s [m]"] = recorded - front if noun == "cars" else recorded
        columns["front_s [m]"] = recorded if noun == "cars" else recorded + front


def _models(trace: Trace, noun: str, table: np.ndarray) -> np.ndarray | None:
    if noun in ("vehicles", "cars"):
        return table["model"]
    if noun != "measurements":
        return None
    vehicles = trace.table("vehicles")  # one for each measurement, in the same order
    if not np.array_equal(vehicles["id"], table["actor"]):
        raise ValueError("measurements are not those of the vehicles")
    return vehicles["model"]


def lanes(trace: Trace) -> dict[str, list[Any]]:
    """Of the town: `number` is what other tables call `lane`. road...: of OpenDRIVE, where the town came from it."""
    town = trace.town
    every = list(town.lanes)
    kinds = {value: name for name, value in schema.ENUMS["world.LaneKind"][1].items()}

    def name_of(items: list[Any], index: int) -> str | None:
        return items[index].name if index < len(items) else None

    junctions = list(town.junctions or ())
    return {
        "number": list(range(len(every))),
        "name": [lane.name for lane in every],
        "edge": [lane.edge for lane in every],
        "index": [int(lane.index) for lane in every],
        "kind": [kinds.get(int(lane.kind)) for lane in every],
        "length [m]": [lane.length for lane in every],
        "width [m]": [lane.width for lane in every],
        "speed_limit [m/s]": [lane.speed_limit for lane in every],
        "left": [name_of(every, lane.left) for lane in every],
        "right": [name_of(every, lane.right) for lane in every],
        "opposite": [name_of(every, lane.opposite) for lane in every],
        "junction": [name_of(junctions, lane.junction) for lane in every],
        "street": [lane.street or None for lane in every],
        "road": [lane.road or None for lane in every],
        "road_lane": [lane.road_lane if lane.road else None for lane in every],
        "road_s [m]": [lane.road_s if lane.road else None for lane in every],
        "road_s_end [m]": [lane.road_s_end if lane.road else None for lane in every],
    }


def actors(trace: Trace) -> dict[str, list[Any]]:
    """All that was in the trace, by id. Times are None where the trace does not tell them."""
    kinds = schema.ENUMS["world.EventKind"][1]
    seen: dict[int, dict[str, Any]] = {}

    def actor(number: int) -> dict[str, Any]:
        return seen.setdefault(int(number), {})

    for tick in trace:
        for event in tick.tick.events or ():
            if event.kind == kinds["spawned"]:
                actor(event.actor)["spawned"] = tick.time
            elif event.kind == kinds["despawned"]:
                actor(event.actor)["despawned"] = tick.time
            elif event.kind == kinds["wrecked"]:
                actor(event.actor)["wrecked"] = tick.time
        for kind, records in (("vehicle", tick.tick.vehicles), ("car", tick.traffic and tick.traffic.cars),
                              ("walker", tick.traffic and tick.traffic.walkers)):  # fmt: skip
            if records is not None:
                for number, model in zip(records["id"].tolist(), records["model"].tolist()):
                    one = actor(number)
                    if "kind" not in one:
                        one["kind"], one["model"] = kind, model
    rows = [(number, seen[number]) for number in sorted(seen)]
    sizes = [schema.VEHICLES[one["model"]] if one.get("kind") in ("vehicle", "car") else None for _, one in rows]
    return {
        "id": [number for number, _ in rows],
        "name": [trace.names.get(number) for number, _ in rows],
        # A car that is hit goes on as a body.
        "kind": ["vehicle" if "wrecked" in one else one.get("kind") for _, one in rows],
        "model": [size[0] if size else None for size in sizes],
        "length [m]": [size[1] if size else None for size in sizes],
        "width [m]": [size[2] if size else None for size in sizes],
        "spawned [s]": [one.get("spawned") for _, one in rows],
        "despawned [s]": [one.get("despawned") for _, one in rows],
        "wrecked [s]": [one.get("wrecked") for _, one in rows],
    }
