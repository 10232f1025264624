"""Reads traces: ticks, town, outcome, tables. Needs python3-zstandard (pip: zstandard) on top of numpy and flatbuffers."""
from __future__ import annotations

import collections
import functools
import pathlib
import struct
import subprocess
import tempfile
from typing import TYPE_CHECKING, Any, Iterator

import numpy as np

from . import schema, tables
from .nouns import Noun

try:
    import zstandard
except ImportError:  # told where it is needed: drivers do without
    zstandard = None  # type: ignore[assignment]

if TYPE_CHECKING:
    from .view import View

_MAGIC = b"\x89MCAP0\r\n"
_CHUNK, _MESSAGE, _ATTACHMENT, _METADATA = 6, 5, 9, 12
_UNITS = {
    "position": "m", "velocity": "m/s", "angular_velocity": "rad/s", "acceleration": "m/s2", "steering_angle": "rad",
    "odometer": "m", "speed": "m/s", "lane_s": "m", "lane_t": "m", "gap_ahead": "m", "goal_distance": "m", "speed_limit": "m/s", "yaw": "rad", "pitch": "rad",
    "impulse_vehicles": "Ns", "impulse_walkers": "Ns", "impulse_static": "Ns", "suspension_length": "m",
    "suspension_force": "N", "rotation": "rad", "engine_speed": "rad/s",
}  # fmt: skip


class TraceError(Exception):
    """The file is no trace, or damaged. `reprise info` says more."""


class Tick:
    """A recorded tick: `tick` and `traffic` are nouns with all of it; a trace's level may leave traffic out (None)."""

    def __init__(self, trace: Trace, tick: bytes, traffic: bytes | None) -> None:
        self._trace = trace
        self.tick = Noun(tick, "world.Tick")
        self.traffic = None if traffic is None else Noun(traffic, "world.Traffic")
        self.index: int = self.tick.index
        self.time: float = self.index * trace.step  #: [s]

    def __repr__(self) -> str:
        return f"<tick {self.index}, {self.time:.2f} s>"

    def show(self, radius: float | None = None) -> View:
        """From above, for a notebook or `.save('tick.html')`; so many metres [m] around the driven vehicle, or all."""
        from .view import view_of_tick

        return view_of_tick(self._trace.town, self.tick, self.traffic, self._trace.step, self._trace.egos, radius)

    def vehicle(self, actor: int) -> np.void:
        """The VehicleState (world/tick.fbs) of an actor. Raises KeyError."""
        vehicles = self.tick.vehicles
        at = int(np.searchsorted(vehicles["id"], actor))
        if at == len(vehicles) or vehicles["id"][at] != actor:
            raise KeyError(f"no vehicle {actor} in tick {self.index}: {vehicles['id'].tolist()}")
        return vehicles[at]


class Trace:
    """A recorded run: `len(trace)`, `trace[100]` (the tick of that index), `for tick in trace`.

    Attributes: `town` and `episode` nouns, `scenario` its Lua source, `facts` and `outcome` as `reprise info` says them,
    `step` [s]. One chunk of 64 ticks is unpacked at a time and the last few are kept. It does not check the run:
    `reprise verify` does.
    """

    def __init__(self, path: str | pathlib.Path) -> None:
        if zstandard is None:
            raise TraceError("reading traces needs zstandard: apt install python3-zstandard, or pip install zstandard")
        self.path = pathlib.Path(path)
        self._data = memoryview(self.path.read_bytes())
        if bytes(self._data[:8]) != _MAGIC:
            raise TraceError(f"{path}: no trace (an MCAP file was expected)")
        self._chunks: list[tuple[int, int]] = []  # begin and length of each
        self._kept: collections.OrderedDict[int, dict[int, Tick]] = collections.OrderedDict()
        metadata, attachments = self._scan()
        self.facts: dict[str, str] = metadata.get("reprise.run", {})
        self.outcome: dict[str, str] = metadata.get("reprise.outcome", {})
        for name in ("episode.bin", "town.bin.zst"):
            if name not in attachments:
                raise TraceError(f"{path}: no trace of Reprise: it lacks {name}")
        self.episode = Noun(attachments["episode.bin"], "world.Episode")
        self.town = Noun(_unpacked(attachments["town.bin.zst"]), "world.Town")
        self.scenario: str = attachments.get("scenario/main.lua", b"").decode()
        self.step: float = self.episode.step_ns * 1e-9
        self._starts = [self._first_tick(begin, length) for begin, length in self._chunks]
        last = self._chunk(len(self._chunks) - 1) if self._chunks else {}
        self.first: int = self._starts[0] if self._starts else 1
        self.last: int = max(last, default=0)

    def _scan(self) -> tuple[dict[str, dict[str, str]], dict[str, bytes]]:
        metadata, attachments, at = {}, {}, 8
        while at + 9 <= len(self._data):
            kind, length = struct.unpack_from("<BQ", self._data, at)
            content = self._data[at + 9 : at + 9 + length]
            if kind == 0 or kind > 0x7F or len(content) < length:
                break  # the magic at the end, or where the file was cut
            if kind == _CHUNK:
                self._chunks.append((at + 9, length))
            elif kind == _METADATA:
                name, rest = _text(content, 0)
                metadata[name] = _pairs(content, rest)
            elif kind == _ATTACHMENT:
                name, rest = _text(content, 16)
                _, rest = _text(content, rest)
                (size,) = struct.unpack_from("<Q", content, rest)
                attachments[name] = bytes(content[rest + 8 : rest + 8 + size])
            at += 9 + length
        return metadata, attachments

    def _first_tick(self, begin: int, length: int) -> int:
        (start,) = struct.unpack_from("<Q", self._data, begin)
        return round(start / self.episode.step_ns)

    def _chunk(self, number: int) -> dict[int, Tick]:
        if number in self._kept:
            self._kept.move_to_end(number)
            return self._kept[number]
        begin, length = self._chunks[number]
        content = self._data[begin : begin + length]
        (size,) = struct.unpack_from("<Q", content, 16)
        name, rest = _text(content, 28)
        packed = bytes(content[rest + 8 :])
        data = memoryview(_unpacked(packed) if name == "zstd" else packed)
        if len(data) != size:
            raise TraceError(f"{self.path}: damaged: see `reprise info`")
        found: dict[int, dict[int, bytes]] = {}
        at = 0
        while at < len(data):
            kind, length = struct.unpack_from("<BQ", data, at)
            if kind == _MESSAGE:
                channel, index = struct.unpack_from("<HI", data, at + 9)
                # A copy, so that its doubles lie as numpy wants them.
                found.setdefault(index, {})[channel] = bytes(data[at + 31 : at + 9 + length])
            at += 9 + length
        ticks = {index: Tick(self, parts[1], parts.get(2)) for index, parts in found.items() if 1 in parts}
        self._kept[number] = ticks
        while len(self._kept) > 4:
            self._kept.popitem(last=False)
        return ticks

    def __len__(self) -> int:
        return self.last - self.first + 1 if self._chunks else 0

    def __getitem__(self, index: int) -> Tick:
        """By the tick's own index: the first is 1, of a slice `first`."""
        if not self.first <= index <= self.last:
            raise IndexError(f"{self.path} holds ticks {self.first} to {self.last}, not {index}")
        number = int(np.searchsorted(self._starts, index, side="right")) - 1
        try:
            return self._chunk(number)[index]
        except KeyError:
            raise IndexError(f"{self.path}: tick {index} is lost: see `reprise info`") from None

    def __iter__(self) -> Iterator[Tick]:
        return (self[index] for index in range(self.first, self.last + 1))

    def table(self, noun: str = "vehicles") -> np.ndarray:
        """All ticks' records of one kind below each other, with a field `tick` in front.

        `noun`: vehicles, wheels, measurements, controls, cars, walkers (world/tick.fbs, world/traffic.fbs).
        """
        parts = []
        for tick in self:
            source = tick.traffic if noun in schema.TABLES["world.Traffic"] else tick.tick
            if source is None:
                raise TraceError(f"{self.path} holds no traffic in tick {tick.index}: `reprise expand` makes it again")
            records = getattr(source, noun)
            rows = np.zeros(len(records), [("tick", "<u8")] + [(name, records.dtype[name]) for name in records.dtype.names])
            rows["tick"] = tick.index
            for name in records.dtype.names:
                rows[name] = records[name]
            parts.append(rows)
        return np.concatenate(parts) if parts else np.zeros(0)

    def to_pandas(self, noun: str = "vehicles") -> Any:
        """The table as a pandas.DataFrame with flat columns that name their unit, such as `position.x [m]`.

        The place of a vehicle, car or walker is its reference point: on the ground below the middle of the rear axle of
        vehicles with mass and of cars, below the middle of walkers. How far along its lane something is, is told of both
        `rear_axle_s [m]` and `front_s [m]`, the front bumper, in `measurements` as in `cars`. `time [s]` stands behind
        `tick`, names of actors, models and lanes and lengths at the end. `lanes` and `actors` are tables of the whole
        trace: what stands behind the numbers.
        """
        import pandas

        if noun in ("lanes", "actors"):
            return pandas.DataFrame(tables.lanes(self) if noun == "lanes" else tables.actors(self))
        columns: dict[str, np.ndarray] = {}
        table = self.table(noun)
        for name in table.dtype.names or ():
            _flatten(columns, name, _UNITS.get(name, ""), table[name])
            if name == "tick":
                columns["time [s]"] = table["tick"] * self.step
        tables.add_names(self, noun, table, columns)
        return pandas.DataFrame(columns)

    @functools.cached_property
    def spawned_before(self) -> dict[int, Noun]:
        """Of a slice: by actor, how those were spawned who were there before its first tick (Command of world/tick.fbs)."""
        key = "slice.spawn."
        return {int(name[len(key):]): Noun(bytes.fromhex(text.partition(" ")[2]), "world.Command")
                for name, text in self.facts.items() if name.startswith(key)}  # fmt: skip

    @functools.cached_property
    def names(self) -> dict[int, str]:
        """What the scenario called its actors, by id."""
        return tables.names(self)

    @functools.cached_property
    def egos(self) -> set[int]:
        """Ids of the vehicles that another program drove; without any, of the first vehicle that has mass."""
        from .view import egos_of

        return egos_of(self)

    def show(self, first: int | None = None, last: int | None = None, every: int | None = None, radius: float = 60.0) -> View:
        """From above, for a notebook or `.save('replay.html')`: town, cars, signals, with a slider over the ticks.

        `first` to `last`, each `every`th (default: all of up to 600, else so many). `radius` [m] is seen around the
        driven vehicle, in red, where it is followed. `trace[100].show()` shows one tick, without a script.
        """
        from .view import view_of_trace

        return view_of_trace(self, first, last, every, radius)

    def page(self, first: int | None = None, last: int | None = None, every: int | None = None, reprise: str = "reprise") -> View:
        """The page of `reprise show`, which makes it: the run from above with a time slider, events, checks and plots.

        For a notebook or `.save('replay.html')`. `first` to `last`, each `every`th (default: all, fewer of long runs).
        """
        from .view import View

        with tempfile.TemporaryDirectory() as folder:
            command = [reprise, "show", str(self.path), "-o", f"{folder}/replay.html"]
            if first is not None or last is not None:
                command += ["--ticks", f"{'' if first is None else first}..{'' if last is None else last}"]
            command += [] if every is None else ["--every", str(every)]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise TraceError(done.stderr.strip())
            page = pathlib.Path(folder, "replay.html").read_text(encoding="utf-8")
        return View(self[self.first].show().svg, page, f"{self.path.name}, made by reprise show", True)

    def render(self, tick: int, camera: str = "rgb", weather: str = "", reprise: str = "reprise", **options: Any) -> bytes:
        """A PNG of one tick, made by `reprise render`; options as its own: size='400x300', mount='1,0,1.4', actor=2."""
        with tempfile.TemporaryDirectory() as folder:
            command = [reprise, "render", str(self.path), "-o", f"{folder}/out", "--camera", camera]
            command += ["--ticks", str(tick)] + (["--weather", weather] if weather else [])
            for name, value in options.items():
                command += [f"--{name}", str(value)]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise TraceError(done.stderr.strip())
            return next(pathlib.Path(folder).glob("out/*.png")).read_bytes()


def _flatten(columns: dict[str, np.ndarray], name: str, unit: str, values: np.ndarray) -> None:
    if values.dtype.names:
        for part in values.dtype.names:
            _flatten(columns, f"{name}.{part}", unit, values[part])
    elif not name.startswith("reserved"):
        columns[f"{name} [{unit}]" if unit else name] = values


def _text(data: memoryview, at: int) -> tuple[str, int]:
    (length,) = struct.unpack_from("<I", data, at)
    return bytes(data[at + 4 : at + 4 + length]).decode(), at + 4 + length


def _pairs(data: memoryview, at: int) -> dict[str, str]:
    (length,) = struct.unpack_from("<I", data, at)
    pairs, end = {}, at + 4 + length
    at += 4
    while at < end:
        key, at = _text(data, at)
        pairs[key], at = _text(data, at)
    return pairs


def _unpacked(data: bytes) -> bytes:
    try:
        return zstandard.ZstdDecompressor().decompress(data)
    except zstandard.ZstdError as error:
        raise TraceError(f"damaged: {error}") from error
