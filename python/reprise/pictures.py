"""What the sensors of the driven vehicle's rig see, as numpy arrays that look into memory shared with the renderer."""
from __future__ import annotations

import mmap
import os
from typing import Iterator

import numpy as np

from .nouns import Noun, enum

_KINDS = {number: name for name, number in enum("SensorKind").items()}
# Channels and their type, as world/external/sensor.h says them.
_PIXELS = {
    "rgb": (3, np.dtype("u1")),
    "depth": (1, np.dtype("<f4")),
    "semantic": (1, np.dtype("u1")),
    "instance": (1, np.dtype("<u2")),
    "flow": (2, np.dtype("<f4")),
    "normals": (3, np.dtype("<f4")),
    "dvs": (2, np.dtype("u1")),
}


_READINGS = ("gnss", "imu", "collision", "lane_invasion")


def _columns(kind: str) -> np.dtype:
    """As world/external/point_fields.h says them; those with a star are whole numbers."""
    names = {
        "lidar": "x y z intensity time *ring *return",
        "semantic_lidar": "x y z cosine *object *tag time *ring",
        "radar": "velocity azimuth altitude depth snr rcs",
        "obstacle": "*other distance",
        "gnss": "latitude longitude altitude",
        "imu": "accelerometer_x accelerometer_y accelerometer_z gyroscope_x gyroscope_y gyroscope_z compass",
        "collision": "other impulse x y z ended",
        "lane_invasion": "lane marking",
    }[kind].split()
    if kind in _READINGS:
        return np.dtype([(name, "<f8") for name in names])
    return np.dtype([(name.lstrip("*"), "<u4" if name[0] == "*" else "<f4") for name in names])


def xyz(points: np.ndarray) -> np.ndarray:
    """(n, 3) float32 [m] of the points of a LiDAR, in its own frame: x ahead, y to the left, z up. A view."""
    if points.dtype.names is None or points.dtype.names[:3] != ("x", "y", "z") or points.dtype["x"] != np.dtype("<f4"):
        raise TypeError("xyz: expected the points of a lidar or semantic_lidar")
    return points.view("<f4").reshape(len(points), -1)[:, :3]


class Sensors:
    """The rig, and where its pixels lie."""

    def __init__(self, rig: list[Noun], memory: np.ndarray | None) -> None:
        self.rig = rig
        self._memory = memory

    @classmethod
    def of(cls, hello: Noun, descriptor: int | None) -> Sensors:
        """From the run's first word, and the memory that came with it; takes the descriptor over."""
        rig = Noun(hello.spawn.data, "world.Command").rig if len(hello.spawn) else []
        memory = None
        if descriptor is not None:
            try:
                if hello.shared_bytes:
                    shared = mmap.mmap(descriptor, hello.shared_bytes, access=mmap.ACCESS_READ)
                    memory = np.frombuffer(shared, np.uint8)
            finally:
                os.close(descriptor)
        return cls(list(rig), memory)

    def index(self, name: str) -> int:
        """Of a sensor in the rig. Raises KeyError."""
        for index, sensor in enumerate(self.rig):
            if sensor.name == name:
                return index
        carried = ", ".join(sensor.name for sensor in self.rig) or "no sensors"
        raise KeyError(f"no sensor '{name}': the vehicle carries {carried}")

    def is_camera(self, index: int) -> bool:
        return _KINDS[self.rig[index].kind] in _PIXELS

    def image(self, picture: Noun) -> np.ndarray:
        """The pixels of a picture, or rows with named columns: a view, nothing is copied."""
        sensor = self.rig[picture.sensor]
        kind = _KINDS[sensor.kind]
        if kind not in _PIXELS:
            return self._rows(picture, _columns(kind))
        channels, dtype = _PIXELS[kind]
        shape = (sensor.height, sensor.width) + ((channels,) if channels > 1 else ())
        pixels = picture.data
        if not len(pixels):
            if self._memory is None:
                raise ValueError("the run showed a picture without its pixels")
            size = dtype.itemsize * int(np.prod(shape))
            pixels = self._memory[picture.offset : picture.offset + size]
        return pixels.view(dtype).reshape(shape)


    def _rows(self, picture: Noun, columns: np.dtype) -> np.ndarray:
        data = picture.data
        if not len(data):
            if not picture.size:
                return np.empty(0, columns)
            if self._memory is None:
                raise ValueError("the run showed points without their numbers")
            data = self._memory[picture.offset : picture.offset + picture.size]
        return data.view(columns)


class Frames:
    """What the sensors of one tick saw, by their names: `for name, frame in seen.sensors.items()`."""

    def __init__(self, sensors: Sensors, pictures: list[Noun]) -> None:
        self._sensors = sensors
        self._pictures = {picture.sensor: picture for picture in pictures}

    def __len__(self) -> int:
        return len(self._pictures)

    def __iter__(self) -> Iterator[str]:
        return (self._sensors.rig[sensor].name for sensor in self._pictures)

    def __contains__(self, name: str) -> bool:
        return name in iter(self)

    def __getitem__(self, name: str) -> np.ndarray:
        image = self.get(name)
        if image is None:
            raise KeyError(f"the sensor '{name}' made no frame in this tick")
        return image

    def get(self, name: str) -> np.ndarray | None:
        """The frame of a sensor, or None where it was not due in this tick."""
        picture = self._pictures.get(self._sensors.index(name))
        return None if picture is None else self._sensors.image(picture)

    def items(self) -> Iterator[tuple[str, np.ndarray]]:
        """Names and frames, in the order of the rig."""
        return ((name, self[name]) for name in self)


class Images(Frames):
    """Those of cameras: `for name, image in seen.images.items()`."""

    def __init__(self, sensors: Sensors, pictures: list[Noun]) -> None:
        super().__init__(sensors, [picture for picture in pictures if sensors.is_camera(picture.sensor)])

    def get(self, name: str) -> np.ndarray | None:
        """The image of a camera, or None where it was not due in this tick."""
        if not self._sensors.is_camera(self._sensors.index(name)):
            raise KeyError(f"'{name}' is no camera: seen.sensors['{name}'] is what it measured")
        return super().get(name)
