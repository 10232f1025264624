#!/usr/bin/env python3
"""Resets and steps a second from Python, state only, beside the same run without a driver: serve_bench.py

The variable REPRISE names the program; PYTHONPATH holds python/. No test; nothing depends on its figures.
"""
import os
import pathlib
import resource
import subprocess
import tempfile
import time

import reprise

TICKS = 1200
# The run without a driver has the same vehicle, whose brakes are on.
SCENARIO = """return scenario 'bench' {
    town = 'town1', cars = 100, seed = 7, duration = %g,
    run = function()
        spawn{ name = 'ego', model = 'sedan', driver = '%s' }
        wait(3600)
    end,
}
"""


def median(values):
    return sorted(values)[len(values) // 2]


def timed(work):
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def resets(sim, count, seeds):
    return median([timed(lambda: sim.reset(seed=seeds(i))) for i in range(count)])


def main():
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        (folder / "driven.lua").write_text(SCENARIO % (TICKS * 0.05, "external"))
        (folder / "alone.lua").write_text(SCENARIO % (TICKS * 0.05, "manual"))
        rows = []
        with reprise.Simulation("town1", cars=100, seed=7) as sim:
            rows.append(("reset, the first", timed(sim.reset)))
            rows.append(("reset, the same seed", resets(sim, 30, lambda i: 7)))
            rows.append(("reset, another seed", resets(sim, 10, lambda i: 8 + i)))
        for name, seconds in rows:
            print(f"{name:34} {seconds * 1e3:9.1f} ms {1 / seconds:9.0f} /s")
        print(f"{'':34} {'wall':>9} us {'processor':>9} us of a tick")
        for _ in range(3):  # interleaved
            alone, start = (without_driver(folder, words) for words in ((), ("--for", "0.05")))
            show("without a driver", *((whole - begin) / TICKS for whole, begin in zip(alone, start)))
            whole, here = from_python(folder)
            show("from Python, all processes", whole[0] / TICKS, (whole[1] - start[1]) / TICKS)
            show("from Python, its own", here[0] / TICKS, here[1] / TICKS)


def show(name, wall, processor):
    print(f"{name:34} {wall * 1e6:9.0f}    {processor * 1e6:9.0f}")


def children():
    """[s] of processor time of the children that have ended, and of theirs."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def without_driver(folder, words):
    """[s] of wall and processor time."""
    before = children()
    wall = timed(lambda: subprocess.run([os.environ["REPRISE"], "run", "alone.lua", *words], cwd=folder, check=True,
                                        stdout=subprocess.DEVNULL))  # fmt: skip
    return wall, children() - before


def from_python(folder):
    """[s] of wall and processor time of all, then of this program alone."""
    before, control = children(), reprise.Control(brake=1.0)
    with reprise.Simulation(scenario="driven.lua", folder=folder, trace="driven.mcap") as sim:
        sim.reset()
        processor = time.process_time()
        wall = timed(lambda: sim.run(lambda seen: control))
        processor = time.process_time() - processor
    return (wall, children() - before + processor), (wall, processor)


if __name__ == "__main__":
    main()
