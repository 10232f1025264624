#!/usr/bin/env python3
"""Beside MetaDrive (PyPI: metadrive-simulator), by hand: tests/peers/beside_metadrive.py [--cars 100] [--program build/release/bin/reprise]

Simulated seconds a second of processor time, all processes together, with a client in Python that looks at the state
and stands still among moving cars, both ten times a second (--every 1: ours twenty times); and whether an episode is the same again after reset() and in a fresh process.
Turns are taken, so that others on the machine slow both down. 0.3.0.1 is the last version whose assets are in the wheel.
It is installed into a Python of its own, build/peers/metadrive, from PyPI.
"""
import argparse
import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
VENV = ROOT / "build/peers/metadrive"
PACKAGES = ["metadrive-simulator==0.3.0.1", "panda3d-simplepbr<0.11", "numpy<2", "flatbuffers"]
SAME = 100  # steps in which episodes are compared


def processor_time():
    """[s] of this process and of its children that have ended."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


class MetaDrive:
    """Its blocks of roads, filled until so many cars drive; who arrives comes again elsewhere."""

    STEP = 0.1  # [s] five steps of its physics

    def __init__(self, cars, seed):
        from metadrive import MetaDriveEnv

        density = 0.2
        for tries_left in range(7, -1, -1):  # its traffic is asked for by density
            self.env = MetaDriveEnv(dict(environment_num=1, start_seed=seed, map=10, traffic_density=density,
                                         traffic_mode="respawn", crash_vehicle_done=False, horizon=10**9))  # fmt: skip
            self.env.reset()
            there = len(self.env.engine.traffic_manager.traffic_vehicles)
            if abs(there - cars) <= max(2, cars // 20) or tries_left == 0:
                break
            density *= cars / max(there, 1)
            self.env.close()
        self.cars = there

    def reset(self):
        self.env.reset()

    def step(self):
        seen, _, done, _ = self.env.step([0.0, -1.0])
        if done:
            self.env.reset()
        return float(seen[0])

    def state(self):
        cars = [*self.env.engine.traffic_manager.traffic_vehicles, self.env.vehicle]
        return sorted([*map(float, car.position), float(car.heading_theta)] for car in cars)

    def close(self):
        self.env.close()


class Reprise:
    TICK = 0.05  # [s]
    every = 2  # [ticks] that an action holds, so that it decides as often as MetaDrive's drivers do

    def __init__(self, cars, seed):
        import reprise

        self.STEP = self.TICK * self.every

        # Asleep between ticks: who looks whether there is one takes processor time.
        self.sim = reprise.Simulation("town1", cars=cars, seed=seed, polling=0, every=self.every)
        self.seen = self.sim.reset()
        self.cars = len(self.seen.cars)

    def reset(self):
        self.seen = self.sim.reset()

    def step(self):
        self.seen = self.sim.step(brake=1.0)
        return self.seen.ego.speed + len(self.seen.cars)

    def state(self):
        return self.seen.tick.digests["chain"].tobytes().hex()

    def close(self):
        self.sim.close()


KINDS = {"metadrive": MetaDrive, "reprise": Reprise}


def episode(sim):
    states = []
    for _ in range(SAME):
        sim.step()
        states.append(sim.state())
    return states


def work(kind, cars, seconds, seed):
    """In a process of its own: what one side does, as JSON."""
    if seconds == 0:
        sim = KINDS[kind](cars, seed)
        sim.reset()
        first = episode(sim)
        sim.reset()
        again = episode(sim)
        sim.close()
        return {"first": first, "again": again}
    sim = KINDS[kind](cars, seed)
    for _ in range(int(10 / sim.STEP)):  # until queues have formed
        sim.step()
    if kind == "metadrive":
        before = processor_time()
        for _ in range(int(seconds / sim.STEP)):
            sim.step()
        used = processor_time() - before
        sim.close()
        return {"cars": sim.cars, "seconds": used / seconds}
    # The server's time is known when it has ended: that of a start is measured, and taken off. It is so short that the
    # turn is longer.
    sim.close()
    seconds *= 20
    totals = []
    for steps in (200, 200 + int(seconds / sim.STEP)):
        before = processor_time()
        sim = KINDS[kind](cars, seed)
        for _ in range(steps):
            sim.step()
        there = sim.cars
        sim.close()
        totals.append(processor_time() - before)
    return {"cars": there, "seconds": (totals[1] - totals[0]) / seconds}


def first_difference(one, other):
    for step, (left, right) in enumerate(zip(one, other), 1):
        if left != right:
            return f"differs from step {step} on"
    return f"equal in all of {len(one)} steps"


def prepare():
    python = VENV / "bin/python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", VENV], check=True)
        subprocess.run([python, "-m", "pip", "install", "-q", *PACKAGES], check=True)
    return python


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cars", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=20.0, help="simulated, of a turn")
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--every", type=int, default=Reprise.every, help="[ticks of 0.05 s] that an action of ours holds (default 2)")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/bin/reprise")
    parser.add_argument("--work", choices=KINDS, help=argparse.SUPPRESS)
    options = parser.parse_args()
    Reprise.every = options.every
    if options.work:
        said, sys.stdout = sys.stdout, sys.stderr
        json.dump(work(options.work, options.cars, options.seconds, 7), said)
        return
    python = prepare()

    def ask(kind, seconds):
        words = [python, "-B", __file__, "--work", kind, "--cars", str(options.cars), "--seconds", str(seconds), "--every", str(options.every)]
        environment = dict(os.environ, PYTHONPATH=str(ROOT / "python"), REPRISE=str(options.program.resolve()))
        done = subprocess.run(words, env=environment, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{kind}: exit {done.returncode}\n{done.stderr[-2000:]}")
        return json.loads(done.stdout)

    begin = time.monotonic()
    turns = {kind: [] for kind in KINDS}
    for _ in range(options.turns):
        for kind, all_of_it in turns.items():
            all_of_it.append(ask(kind, options.seconds))
    for kind, all_of_it in turns.items():
        rates = [1 / turn["seconds"] for turn in all_of_it]
        print(f"{kind:10} {all_of_it[0]['cars']:4} cars {statistics.median(rates):8.1f} simulated seconds a second of "
              f"processor time ({', '.join(f'{rate:.1f}' for rate in rates)})")  # fmt: skip
    ratios = [left["seconds"] / right["seconds"] for left, right in zip(turns["metadrive"], turns["reprise"])]
    print(f"{'ratio':10} {'':9} {statistics.median(ratios):8.1f} ({', '.join(f'{ratio:.1f}' for ratio in ratios)})")
    for kind in KINDS:
        here, elsewhere = ask(kind, 0), ask(kind, 0)
        print(f"{kind:10} after reset(): {first_difference(here['first'], here['again'])}; "
              f"in a fresh process: {first_difference(here['first'], elsewhere['first'])}")  # fmt: skip
    print(f"in {time.monotonic() - begin:.0f} s, load {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
