"""Data sets that `reprise dataset` made, as numpy arrays: no other library reads their pictures."""
from __future__ import annotations

import json
import pathlib
import struct
import zlib
from typing import Any, Dict, Iterator, Optional, Union

import numpy as np


class Dataset:
    """One weather's view of a data set: `Dataset('set', weather='clear_night', split='train')`.

    An item is a dictionary: `id`, `trace`, `tick`, and by the name of each camera its picture (an array of rows), of
    rgb cameras also `NAME_boxes`, the list that docs/rendering.md describes; by the name of each LiDAR and radar its
    rows of numbers, as docs/datasets.md says them."""

    def __init__(self, folder: Union[str, pathlib.Path], weather: Optional[str] = None, split: Optional[str] = None):
        self.folder = pathlib.Path(folder)
        self.index = json.loads((self.folder / "dataset.json").read_text())
        if not self.index.get("complete"):
            raise ValueError(f"{folder}/dataset.json: is not complete; the command that makes it goes on where it was")
        folders = {one["said"]: one["folder"] for one in self.index["weathers"]}
        self.weather = next(iter(folders)) if weather is None else weather
        if self.weather not in folders:
            raise KeyError(f"{folder}: no weather '{weather}'; there are {', '.join(folders)}")
        if split is not None and split not in self.index["frames_of"]:
            raise KeyError(f"{folder}: no split '{split}'; there are {', '.join(self.index['frames_of'])}")
        self.frames = [one for one in self.index["frames"] if split in (None, one["split"])]
        weather_folder = folders[self.weather]
        where = lambda sensors: {one["name"]: one["files"].replace("{weather}", weather_folder) for one in sensors}
        self._pictures, self._points = where(self.index["cameras"]), where(self.index["rays"])

    def __len__(self) -> int:
        return len(self.frames)

    def __getitem__(self, at: int) -> Dict[str, Any]:
        frame = self.frames[at]
        item = {key: frame[key] for key in ("id", "trace", "tick")}
        number = f"{frame['id']:06}"
        for name, files in self._pictures.items():
            item[name] = read_png(self.folder / files.replace("{id}", number))
            boxes = self.folder / "labels" / f"boxes_{name}" / f"{number}.json"
            if boxes.exists():
                item[name + "_boxes"] = json.loads(boxes.read_text())["boxes"]
        for name, files in self._points.items():
            item[name] = read_points(self.folder / files.replace("{id}", number))
        return item

    def __iter__(self) -> Iterator[Dict[str, Any]]:
        return (self[at] for at in range(len(self)))


def read_points(path: pathlib.Path) -> np.ndarray:
    """A row for each point: of KITTI's .bin x, y, z, intensity, of nuScenes' .pcd.bin the ring as well, of its radars'
    .pcd records with named fields, of a .npy all columns of its sensor."""
    if path.suffix == ".npy":
        return np.load(path)
    if path.suffix == ".bin":
        return np.fromfile(path, np.float32).reshape(-1, 5 if path.name.endswith(".pcd.bin") else 4)
    head, data = path.read_bytes().split(b"DATA binary\n", 1)
    said = {line.split()[0]: line.split()[1:] for line in head.decode().splitlines()}
    kind = np.dtype([(name, f"<{type.lower()}{size}") for name, type, size in zip(said["FIELDS"], said["TYPE"], said["SIZE"])])
    points = np.frombuffer(data, kind, int(said["POINTS"][0]))
    return points[~np.isnan(points["x"])]


def read_png(path: Union[str, pathlib.Path]) -> np.ndarray:
    """A picture of `reprise render` as it is: (height, width) or (height, width, 3) of uint8 or uint16. 0.1 s at 800x600."""
    data = pathlib.Path(path).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{path}: this is no PNG")
    at, packed, head = 8, b"", b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        if kind == b"IHDR":
            head = data[at + 8 : at + 8 + size]
        elif kind == b"IDAT":
            packed += data[at + 8 : at + 8 + size]
        at += size + 12
    width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", head)
    if depth not in (8, 16) or colour not in (0, 2) or interlaced:
        raise ValueError(f"{path}: a PNG of another kind than reprise writes")
    channels = 3 if colour == 2 else 1
    unit = channels * depth // 8  # bytes of a pixel
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * unit)
    raw = _unfiltered(rows[:, 0], rows[:, 1:].reshape(height, width, unit))
    picture = raw.reshape(height, -1).view(">u2").astype(np.uint16) if depth == 16 else raw
    return picture.reshape((height, width, channels) if channels > 1 else (height, width))


def _unfiltered(filters: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """What PNG's filters made of a picture, taken back: pixels of a diagonal do not ask for each other."""
    height, width, unit = rows.shape
    out = np.zeros((height + 1, width + 1, unit), np.int16)  # around it zeros to the left and above
    for diagonal in range(height + width - 1):
        y = np.arange(max(0, diagonal - width + 1), min(height, diagonal + 1))
        x = diagonal - y
        left, up, corner = out[y + 1, x], out[y, x + 1], out[y, x]
        guess = left + up - corner
        far_left, far_up, far_corner = abs(guess - left), abs(guess - up), abs(guess - corner)
        nearest = np.where((far_left <= far_up) & (far_left <= far_corner), left, np.where(far_up <= far_corner, up, corner))
        kind = filters[y][:, None]
        added = np.select([kind == 1, kind == 2, kind == 3, kind == 4], [left, up, (left + up) // 2, nearest], 0)
        out[y + 1, x + 1] = (rows[y, x] + added) & 255
    return out[1:, 1:].astype(np.uint8)
