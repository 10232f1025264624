#!/usr/bin/env python3
"""Episodes from Python, state only: resets a second, steps beside the same run without a driver, and two environments in
two processes beside one. `./dev bench` calls it: serve_bench.py [--benchmark_filter=REGEX] [--benchmark_out=FILE]

The variable REPRISE names the program; PYTHONPATH holds python/. Other options of Google Benchmark are passed over; FILE
gets what it would write. No test; nothing depends on its figures.
"""
import argparse
import contextlib
import json
import multiprocessing
import os
import pathlib
import re
import resource
import subprocess
import tempfile
import time

import reprise
from reprise.wire import POLLING

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


def measure_resets():
    """[s] of each kind of reset in Town 1 with 100 cars."""
    with reprise.Simulation("town1", cars=100, seed=7) as sim:
        first = timed(sim.reset)
        same, other = resets(sim, 30, lambda i: 7), resets(sim, 10, lambda i: 8 + i)
    return {"first_ms": first * 1e3, "same_seed_ms": same * 1e3, "other_seed_ms": other * 1e3,
            "resets/s": 1 / same, "resets/s_other_seed": 1 / other}  # fmt: skip


def environment(pipe, seed, cores, polling):
    """A process that steps an episode of its own as often as it is asked to, with what it starts on these cores."""
    os.sched_setaffinity(0, cores)
    control = reprise.Control(brake=1.0)
    with reprise.Simulation("town1", cars=100, seed=seed, polling=polling) as sim:
        sim.reset()
        for steps in iter(pipe.recv, 0):
            pipe.send(timed(lambda: sim.run(lambda seen: control, steps)))


class Environments:
    """Such processes, which end with the block. Whoever of them is gone is told as an error, and not waited for."""

    def __init__(self, work, places):
        self.pipes, self.children = [], []
        for seed, place in enumerate(places):
            pipe, theirs = multiprocessing.Pipe()
            child = multiprocessing.Process(target=work, args=(theirs, seed % 2, *place))
            child.start()
            theirs.close()  # only the child has it: the pipe ends with it
            self.pipes.append(pipe)
            self.children.append(child)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for pipe, child in zip(self.pipes, self.children):
            with contextlib.suppress(BrokenPipeError):
                pipe.send(0)
            child.join()

    def rate(self, which, steps):
        """Ticks a second of all of these together."""
        for number in which:
            self.pipes[number].send(steps)
        return len(which) * steps / max(self._answer(number) for number in which)

    def _answer(self, number):
        try:
            return self.pipes[number].recv()
        except EOFError:
            self.children[number].join()
            ended = f"environment {number} ended with exit code {self.children[number].exitcode}"
            raise ChildProcessError(ended) from None


def plain(folder, count):
    """Ticks a second of all of so many runs at once in which nobody drives: what the machine has to give."""
    def ended(words):
        runs = [subprocess.Popen([os.environ["REPRISE"], "run", "alone.lua", *words, "-o", f"{i}.mcap"], cwd=folder,
                                 stdout=subprocess.DEVNULL) for i in range(count)]  # fmt: skip
        for run in runs:
            if run.wait() != 0:
                raise subprocess.CalledProcessError(run.returncode, run.args)

    return count * (TICKS - 1) / (timed(lambda: ended(())) - timed(lambda: ended(("--for", "0.05"))))


def measure_vector(steps=400, turns=9):
    """Ticks a second of two environments at once, of one, and of one that has a core only, in turns. One with two cores
    uses both: the next tick is begun while its driver thinks, and its driver stays awake for it. So the same of drivers
    that sleep between ticks. Beside them two plain runs at once over one: two environments can hardly be more than that."""
    cores = os.sched_getaffinity(0)
    places = ((cores, POLLING), (cores, POLLING), ({min(cores)}, POLLING), (cores, 0.0), (cores, 0.0))
    with Environments(environment, places) as environments, tempfile.TemporaryDirectory() as place:
        environments.rate(range(len(places)), steps)  # until queues have formed
        folder = pathlib.Path(place)
        (folder / "alone.lua").write_text(SCENARIO % (TICKS * 0.05, "manual"))
        turns = [(environments.rate((0, 1), steps), environments.rate((turn % 2,), steps),
                  environments.rate((2,), steps), plain(folder, 2), plain(folder, 1),
                  environments.rate((3, 4), steps), environments.rate((3 + turn % 2,), steps))
                 for turn in range(turns)]  # fmt: skip
    two, one, on_a_core, plain_two, plain_one, asleep_two, asleep_one = (median(column) for column in zip(*turns))
    ratios, of_core, of_plain, of_asleep = ([both[i] / both[i + j] for both in turns]
                                            for i, j in ((0, 1), (0, 2), (3, 1), (5, 1)))  # fmt: skip
    return {"ticks/s_two": two, "ticks/s_one": one, "ticks/s_one_on_a_core": on_a_core, "ticks/s_plain_two": plain_two,
            "ticks/s_plain_one": plain_one, "ticks/s_asleep_two": asleep_two, "ticks/s_asleep_one": asleep_one,
            "two_of_one_asleep": median(of_asleep), "two_of_one": median(ratios), "two_of_one_on_a_core": median(of_core),
            "plain_two_of_one": median(of_plain),
            "share_of_plain": median([ours / theirs for ours, theirs in zip(ratios, of_plain)])}  # fmt: skip


def measure_steps():
    """[us] of a tick with all of a run's work, its trace too; without a driver, and driven from here."""
    rows = {"alone_us": [], "python_us": [], "alone_cpu_us": [], "python_cpu_us": [], "python_own_cpu_us": []}
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        (folder / "driven.lua").write_text(SCENARIO % (TICKS * 0.05, "external"))
        (folder / "alone.lua").write_text(SCENARIO % (TICKS * 0.05, "manual"))
        for _ in range(3):  # interleaved
            alone, start = (without_driver(folder, words) for words in ((), ("--for", "0.05")))
            whole, here = from_python(folder)
            seconds = (alone[0] - start[0], whole[0], alone[1] - start[1], whole[1] - start[1], here[1])
            for row, value in zip(rows.values(), seconds):
                row.append(value / TICKS * 1e6)
    return {name: median(values) for name, values in rows.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--benchmark_filter", default=".")
    parser.add_argument("--benchmark_out", type=pathlib.Path)
    options, _ = parser.parse_known_args()
    found = []
    for name, measure in {"Resets": measure_resets, "Steps": measure_steps, "Vector": measure_vector}.items():
        if not re.search(options.benchmark_filter, name):
            continue
        begin = time.perf_counter()
        counters = measure()
        print(f"{name:10}", *(f"{counter}={value:.4g}" for counter, value in counters.items()), flush=True)
        found.append(dict(run_name=name, run_type="iteration", real_time=time.perf_counter() - begin, cpu_time=0.0,
                          time_unit="s", **counters))  # fmt: skip
    if options.benchmark_out:
        options.benchmark_out.write_text(json.dumps({"benchmarks": found}))


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
