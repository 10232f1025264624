# Reads a trace without Reprise: Python, FlatBuffers (python3-flatbuffers), zstd (python3-zstandard).
# The classes in reprise/ are what `flatc --python` makes of world/*.fbs; put them on PYTHONPATH.
#   python3 read_trace.py a.mcap
import struct
import sys

import zstandard
from reprise.world import Tick, Traffic


def records(data):
    at = 0
    while at < len(data):
        op, length = struct.unpack_from("<BQ", data, at)
        yield op, data[at + 9 : at + 9 + length]
        at += 9 + length


def messages(path):
    with open(path, "rb") as file:
        content = file.read()[8:-8]  # without the magic at both ends
    for op, chunk in records(content):
        if op != 6:
            continue
        (size,) = struct.unpack_from("<Q", chunk, 16)
        (name,) = struct.unpack_from("<I", chunk, 28)  # length of "zstd", or 0
        packed = chunk[40 + name :]
        data = zstandard.ZstdDecompressor().decompress(packed, size) if name else packed
        yield from ((struct.unpack_from("<H", m)[0], m[22:]) for op, m in records(data) if op == 5)


for channel, data in messages(sys.argv[1]):
    if channel == 1:
        tick = Tick.Tick.GetRootAs(data)
        speed = tick.Measurements(0).Speed() if tick.MeasurementsLength() else 0
    elif tick.Index() % 20 == 0:
        traffic = Traffic.Traffic.GetRootAs(data)
        fastest = max((traffic.Cars(i).Speed() for i in range(traffic.CarsLength())), default=0)
        print(f"tick {tick.Index()}: {speed:.3f} m/s; the fastest of {traffic.CarsLength()} cars: {fastest:.3f} m/s")
