#!/usr/bin/env python3
"""bad_rigs_test.py REPRISE: broken rig files and numbers that are none end in one line, exit status 2 and no folder."""
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

RIG = {"sensors": [
    {"name": "front", "type": "rgb", "position": [1.5, 0, 1.4], "fov_deg": 90, "size": [32, 24], "every": 2},
    {"name": "far", "type": "depth", "roll_deg": 3, "pitch_deg": -5, "yaw_deg": 30, "size": [16, 16], "rate_hz": 10,
     "attributes": {"own_car": 1}}]}  # fmt: skip
ODD = ["NaN", "-1", "1e999", "null", "true", '""', '"\\u0000"', "[]", "{}", "[1]", "1e308", "-0.5", '"../x"', '"rgb"', "100000"]
WORDS = [["--mount", "nan,0,1"], ["--mount", "1,0"], ["--fov", "nan"], ["--fov", "0"], ["--pitch", "nan"], ["--yaw", "inf"],
         ["--size", "0x0"], ["--size", "100000x100000"], ["--size", "-3x4"], ["--weather", "rain=nan"], ["--weather", "rainy_night"],
         ["--weather", "fog=-1"], ["--sensor", "lidr"], ["--sensor", "lidar", "--attribute", "range=nan"],
         ["--sensor", "lidar", "--attribute", "channels=1e9"], ["--sensor", "semantic_lidar", "--attribute", "upper_fov=-40"],
         ["--sensor", "lidar", "--mount", "nan,0,0"],
         ["--sensor", "radar", "--weather", "rain=nan"], ["--sensor", "lidar", "--weather", "no_such"]]  # fmt: skip


def mutations(draw):
    text = json.dumps(RIG, indent=1)
    for _ in range(25):  # bytes that are lost, doubled, or others
        at = draw.randrange(len(text))
        yield draw.choice([text[:at], text[:at] + text[at + 1 :], text[:at] + draw.choice('{}[],:"\\x7f') + text[at + 1 :]])
    places = [(i, key) for i, sensor in enumerate(RIG["sensors"]) for key in sensor]
    for number in range(60):  # values that are others
        rig = json.loads(text)
        sensor, key = places[number % len(places)]
        rig["sensors"][sensor][key] = "@"
        yield json.dumps(rig).replace('"@"', draw.choice(ODD))


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "a.lua").write_text("return scenario 'a' { town = 'straight', run = function() spawn{ name = 'ego', model = 'sedan' } wait(1) end }")
    run = lambda *words: subprocess.run([sys.argv[1], *words], cwd=folder, capture_output=True, timeout=120)
    assert run("run", "a.lua", "--for", "0.2", "-o", "a.mcap").returncode == 0
    failed, good = [], 0

    def hold(said, *words):
        global good
        result = run("render", "a.mcap", "-o", "out", "--every", "2t", *words)
        lines = result.stderr.decode(errors="replace").splitlines()
        if result.returncode == 0 and (folder / "out").exists():
            good += 1
            run_away = subprocess.run(["rm", "-r", folder / "out"])
            assert run_away.returncode == 0
        elif result.returncode != 2 or len(lines) != 1 or not lines[0].startswith("reprise: ") or (folder / "out").exists():
            failed.append((said, result.returncode, lines[:3]))

    for text in mutations(random.Random(17)):
        (folder / "rig.json").write_text(text)
        hold(text, "--rig", "rig.json")
    os.mkfifo(folder / "pipe")
    (folder / "large.json").write_text(" " * (1 << 20) + json.dumps(RIG))
    NO_FILES = [["--rig", each] for each in (".", "no_such.json", "pipe", "/dev/zero", "large.json", "/proc/self/mem")]
    for words in WORDS + NO_FILES:
        before = good
        hold(words, *words)
        if good > before:
            failed.append((words, "was taken", []))
            good = before
    for one in failed:
        print(*one)
    assert 0 < good < 60, f"{good} of the mutations were rigs: this shows little"
    sys.exit(1 if failed else 0)
