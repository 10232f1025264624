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

    def image(self, picture: Noun) -> np.ndarray:
        """The pixels of a picture: a view, nothing is copied."""
        sensor = self.rig[picture.sensor]
        kind = _KINDS[sensor.kind]
        channels, dtype = _PIXELS[kind]
        shape = (sensor.height, sensor.width) + ((channels,) if channels > 1 else ())
        pixels = picture.data
        if not len(pixels):
            if self._memory is None:
                raise ValueError("the run showed a picture without its pixels")
            size = dtype.itemsize * int(np.prod(shape))
            pixels = self._memory[picture.offset : picture.offset + size]
        return pixels.view(dtype).reshape(shape)


class Images:
    """The images of one tick by the names of their sensors: `for name, image in seen.images.items()`."""

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
        """The image of a sensor, or None where it was not due in this tick."""
        picture = self._pictures.get(self._sensors.index(name))
        return None if picture is None else self._sensors.image(picture)

    def items(self) -> Iterator[tuple[str, np.ndarray]]:
        """Names and images, in the order of the rig."""
        return ((name, self[name]) for name in self)
