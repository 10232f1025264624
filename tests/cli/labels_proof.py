#!/usr/bin/env python3
"""labels_proof.py REPRISE [boxes|weathers]: of a real drive among cars, buses, bicycles and people
  - depths, classes and instances are byte for byte those of clear noon under the paper's 18 weathers and by night, with
    one thread and with two, alone and in sequence;
  - the box of every actor within 60 m, projected, encloses what the instance picture shows of it.

Three weathers and 40 frames; REPRISE_THOROUGH: all weathers of a drive of 20 s, and 500 frames.
"""
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import zlib

import numpy as np

THOROUGH = bool(os.environ.get("REPRISE_THOROUGH"))
SECONDS = 25 if THOROUGH else 6
FRAMES = 500 if THOROUGH else 40
LABELS = ("depth", "semantic", "instance")
# What reaches out of a car's box, such as mirrors; the boxes of people, riding or on foot, are around all of them. And the rounding of pixels. [m], [px]
BEYOND, OF_PEOPLE, ROUNDING, PEOPLE = 0.25, 0.01, 0.5, (12, 13, 18, 19)


def reprise(*words):
    result = subprocess.run([sys.argv[1], *map(str, words)], capture_output=True, text=True)
    assert result.returncode == 0, (words, result.stderr)
    return result.stdout


def png(path):
    """A grey picture of 8 or 16 bits."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8]
        body = data[at + 8 : at + 8 + size]
        if kind == b"IHDR":
            width, height, depth = int.from_bytes(body[:4], "big"), int.from_bytes(body[4:8], "big"), body[8] // 8
        packed += body if kind == b"IDAT" else b""
        at += 12 + size
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * depth)
    above = np.zeros(width * depth, np.uint8)
    out = []
    for row in rows:
        kind, here = row[0], row[1:].copy()
        if kind == 1:
            here = here.reshape(width, depth).cumsum(0, dtype=np.uint8).ravel()
        elif kind == 2:
            here = here + above
        elif kind:
            here, up = here.tolist(), above.tolist()
            for i in range(len(here)):
                left, corner = (here[i - depth], up[i - depth]) if i >= depth else (0, 0)
                near = [abs(up[i] - corner), abs(left - corner), abs(left + up[i] - 2 * corner)]
                paeth = left if near[0] <= near[1] and near[0] <= near[2] else up[i] if near[1] <= near[2] else corner
                here[i] = here[i] + (paeth if kind == 4 else (left + up[i]) // 2) & 255
            here = np.array(here, np.uint8)
        above = here
        out.append(here)
    return np.array(out).reshape(height, width, depth) @ (256 ** np.arange(depth)[::-1])


def hashes(folder):
    return {
        str(file.relative_to(folder)): hashlib.sha256(file.read_bytes()).hexdigest()
        for file in sorted(folder.rglob("*")) if file.is_file() and file.name != "manifest.json"
    }  # fmt: skip


def weathers(folder, trace):
    every = "1t" if THOROUGH else "20t"
    look = ["--sensor", ",".join(LABELS), "--size", "200x88", "--no-view", "--ticks", "0.05s..20s"]
    listed = [line.split() for line in reprise("list", "weathers").splitlines()]
    names = [words[0] for words in listed if "paper" in words[1:2] or words[0].endswith("_night")]
    assert len(names) >= 18 + 9, names
    names = names if THOROUGH else ["hard_rain_sunset", "clear_night", "snowfall_night"]
    reprise("render", trace, "-o", folder / "clear", "--weather", "clear_noon", "--every", every, *look)
    clear = hashes(folder / "clear")
    for number, name in enumerate(names):
        out = folder / name
        reprise("render", trace, "-o", out, "--weather", name, "--every", every, "--threads", 1 + number % 2, *look)
        assert hashes(out) == clear, f"{name}: other labels than at clear noon"
        tick = f"{41 + 20 * (number % 3)}"
        alone = folder / (name + "_alone")
        reprise("render", trace, "-o", alone, "--weather", name, *look[:-1], f"{tick}t..{tick}t", "--every", "1t")
        for file, digest in hashes(alone).items():
            assert clear[file] == digest, f"{name}: {file} alone is another one"
    print(f"{len(clear)} frames of labels are the same under {len(names)} weathers")


def boxes(folder, trace):
    width, height = 640, 480
    focal = width / 2  # 90 degrees
    reprise("render", trace, "-o", folder / "boxes", "--sensor", "instance", "--boxes", "--no-view", "--size",
            f"{width}x{height}", "--every", "1t", "--ticks", f"1t..{FRAMES}t")  # fmt: skip
    files = sorted((folder / "boxes/boxes").glob("*.json"))
    outside = []
    worst, excesses, classes, near = (0, None), [], {}, 0
    for file in files:
        picture = png(folder / "boxes" / (file.stem + ".png"))
        for box in json.loads(file.read_text())["boxes"]:
            pose = np.array(box["camera_from_box"])
            distance = np.linalg.norm(pose[:3, 3])
            if distance > 60:
                continue
            corner = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
            corner = (corner * box["size"]) @ pose[:3, :3].T + pose[:3, 3]
            if corner[:, 2].min() < 0.5:  # beside the camera, and behind it
                near += 1
                continue
            x = width / 2 + focal * corner[:, 0] / corner[:, 2]
            y = height / 2 + focal * corner[:, 1] / corner[:, 2]
            rows, columns = np.nonzero(picture == box["instance"])
            assert len(rows) == box["pixels"], (file, box["actor"])
            seen = (x.min() - columns.min() - 0.5, columns.max() + 0.5 - x.max(),
                    y.min() - rows.min() - 0.5, rows.max() + 0.5 - y.max())  # fmt: skip
            excess = max(seen)
            beyond = OF_PEOPLE if box["class"] in PEOPLE else BEYOND
            allowed = ROUNDING + beyond * focal / corner[:, 2].min()
            if excess > allowed:
                outside.append(f"tick {file.stem}: {excess:.2f} px ({excess * corner[:, 2].min() / focal:.2f} m) of actor "
                               f"{box['actor']} (class {box['class']}), {distance:.1f} m away")  # fmt: skip
            excesses.append(excess)
            classes[box["class"]] = classes.get(box["class"], 0) + 1
            if excess > worst[0]:
                worst = (excess, f"class {box['class']} {distance:.1f} m away in tick {file.stem}")
    assert not outside, "\n".join([f"{len(outside)} reach out of their boxes:", *outside[:40]])
    assert len(excesses) > 2 * len(files), "hardly anybody was seen: this shows nothing"
    print(f"{len(excesses)} boxes in {len(files)} frames by class {classes}, {near} too near; outside by more than half a pixel: "
          f"{sum(excess > 0.5 for excess in excesses)}; worst {worst[0]:.2f} px, {worst[1]}")  # fmt: skip


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    trace = folder / "drive.mcap"
    (folder / "drive.lua").write_text("""return scenario 'drive' { town = 'town1', cars = 100, walkers = 400, seed = 5,
        run = function()
            local ego = spawn{ name = 'ego', model = 'sedan', driver = 'autopilot', speed = 6 }
            for i, model in ipairs{ 'bicycle', 'motorcycle', 'lorry', 'bus' } do
                spawn{ name = 'other' .. i, model = model, driver = 'autopilot', ahead_of = ego, gap = 12 * i, speed = 6 }
            end
            wait(3600)
        end }""")
    reprise("run", folder / "drive.lua", "--for", SECONDS, "-o", trace)
    for part in (boxes, weathers):
        if sys.argv[2:] in ([], [part.__name__]):
            part(folder, trace)
