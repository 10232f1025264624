#!/usr/bin/env python3
"""Fuzz: a seed decides town, demand, weather and all deeds of swarm.lua; each episode runs twice, the second
time in another environment, and must write the same bytes.

  episodes.py --bin build/release/bin --tools build/release/tests [COUNT [FIRST_SEED]]

Exit status: 0 no difference, 1 a difference, or an end that is a fault of ours.
"""

import argparse
import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path

import environments
from matrix import HERE, NETS, same

# Ours, and those of Debian's sumo-tools. Ours come up as often as all others together.
FOREIGN = ["DRT/osm", "A10KW/osm", "bs3d/bs", "corridor/corridor", "cross/cross", "grid6/grid6", "highway/highway",
           "kuehne/kuehne", "ramp/ramp", "square/square"]
TOWNS = ["town1", "town2"] * (len(FOREIGN) // 2) + [str(NETS / f"{name}.net.xml") for name in FOREIGN]
DEMANDS = [0, 5, 30, 80, 150]
WEATHERS = ["clear_noon", "hard_rain_sunset"]

COMPLETE = "ran to its end"
ENOUGH = 0.7  # of all episodes must run to their end: the others ask for what a town does not have
SOME = 8
MANY = 50  # episodes in which every deed must happen

# Of each of these an episode gets one at most: they set the same thing, or speak against each other.
ONE_OF = [("mask_", "malloc_tunables"), ("stack_", "large_environment")]


def draw(seed, what, count):
    """A number below count that depends on seed and `what` alone, in every version of Python."""
    return int.from_bytes(hashlib.sha256(f"{seed} {what}".encode()).digest()[:8], "big") % count


def draw_of(seed, what, choices):
    return choices[draw(seed, what, len(choices))]


@dataclass
class Plan:
    """What a seed stands for."""

    seed: int
    town: str
    cars: int
    weather: str
    seconds: int
    mistakes: int
    environments: list

    def town_name(self):
        folder = Path(self.town).parent.name
        return folder or self.town

    def text(self):
        where = "+".join(each.name for each in self.environments) or "plain again"
        return f"{self.town_name()}, {self.cars} cars, {self.seconds} s, {where}"


@dataclass
class Result:
    plan: Plan
    end: str = ""  # how the two runs ended
    wrong: str = ""  # a difference, or a fault of ours
    events: Counter = field(default_factory=Counter)
    seconds: float = 0


def plan(seed, known, emulated):
    chosen = []
    for i in range(1 + draw(seed, "environments", 3)):
        each = draw_of(seed, f"environment {i}", known)
        taken = [group for group in ONE_OF if any(other.name.startswith(group) for other in chosen)]
        if each not in chosen and not any(each.name.startswith(group) for group in taken):
            chosen.append(each)
    # First what would undo the others; last what takes all words behind it as one, which may not be as long as a
    # large environment.
    chosen.sort(key=lambda each: (each.name != "empty_environment", each.name == "terminal"))
    if draw(seed, "emulated", 12) == 0:
        chosen = [draw_of(seed, "cpu", emulated)]  # slow, so not often; and nothing else
    return Plan(
        seed=seed,
        town=draw_of(seed, "town", TOWNS),
        cars=draw_of(seed, "cars", DEMANDS),
        weather=draw_of(seed, "weather", WEATHERS),
        seconds=10 + draw(seed, "seconds", 11),
        mistakes=int(draw(seed, "mistakes", 12) == 0),
        environments=chosen,
    )


def write_scenario(plan, folder):
    """Demand and weather are not for the command line to choose, so the header is."""
    text = (HERE / "swarm.lua").read_text()
    for key, value in {"cars": plan.cars, "weather": f"'{plan.weather}'"}.items():
        text, count = re.subn(rf"(?m)^(    {key} = ).*,$", rf"\g<1>{value},", text)
        assert count == 1, key
    scenario = folder / "swarm.lua"
    scenario.write_text(text)
    return scenario


@dataclass
class Run:
    command: list
    code: int
    text: str

    def end(self):
        """The verdict's word or the reason; equal runs end equally."""
        if self.code in (0, 1):
            return COMPLETE
        reasons = re.findall(r"(?:reprise: |Assertion)[^\r\n]*", self.text)
        return f"exit {self.code}: " + (" / ".join(reasons) or self.text[-300:])


def is_possible(environment):
    """What this machine cannot do is left out here; the matrix has it as a row that is not ok."""
    try:
        environment.prove()
    except environments.Impossible:
        return False
    return True


def run_once(arguments, plan, scenario, out, words):
    command = [*words, str(arguments.bin / "reprise-run"), "run", str(scenario), "--town", plan.town, "-o", str(out)]
    command += ["--seed", str(plan.seed)]
    parameters = {"seconds": plan.seconds, "connected": int("/" not in plan.town), "mistakes": plan.mistakes}
    for key, value in parameters.items():
        command += ["--set", f"{key}={value}"]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
    # Messages name the trace; two runs write two.
    return Run(command, done.returncode, (done.stdout + done.stderr).replace(str(out), "TRACE"))


def run_twice(arguments, plan):
    begin = time.monotonic()
    folder = arguments.work / f"seed_{plan.seed}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    scenario = write_scenario(plan, folder)
    plan.environments = [each for each in plan.environments if is_possible(each)]
    words = [word for each in plan.environments for word in each.words]
    traces = [folder / "plain.mcap", folder / "elsewhere.mcap"]
    runs = [run_once(arguments, plan, scenario, traces[0], []), run_once(arguments, plan, scenario, traces[1], words)]
    result = Result(plan, end=runs[0].end(), events=events_in(runs[0].text))
    if runs[0].code != runs[1].code or runs[0].end() != runs[1].end():
        result.wrong = f"ended as: {runs[0].end()}\nand as:   {runs[1].end()}"
    elif traces[0].exists() != traces[1].exists():
        result.wrong = "only one of the two left a trace"
    elif traces[0].exists() and not same(*traces):
        diff = [str(arguments.bin / "reprise"), "diff", *map(str, traces)]
        result.wrong = shlex.join(diff) + "\n" + subprocess.run(diff, capture_output=True, text=True).stdout.rstrip()
    elif runs[0].code not in (0, 1, 2) and "a library stopped itself" not in runs[0].end():
        result.wrong = "equal in both runs, but our fault: " + runs[0].end()
    if result.wrong:
        commands = [shlex.join(run.command) for run in runs]
        result.wrong = "\n".join([f"./dev swarm 1 {plan.seed}", *commands, result.wrong])
    else:
        shutil.rmtree(folder)
    result.seconds = time.monotonic() - begin
    return result


def events_in(text):
    events = Counter()
    for deeds in re.findall(r"deeds: ([^\r\n]*)", text):
        events.update({name: int(count) for name, count in re.findall(r"(\w+)=(\d+)", deeds)})
    events["mistake"] += text.count("(local 'nobody')")  # that was its end, so it could not say so
    events["collisions"] = len(re.findall(r" hits ", text))
    events["ticks"] = sum(map(int, re.findall(r"\.mcap: (\d+) ticks", text)))
    return events


def coverage(results):
    """Prints what the episodes really did. Returns what is wrong when the swarm has gone to sleep, or ""."""
    def line(title, counts):
        print(f"  {title:<14}" + ", ".join(f"{name} {count}" for name, count in counts.most_common()))

    plans = [result.plan for result in results]
    print("Coverage: number of episodes, for deeds the number of deeds in episodes")
    line("town", Counter(plan.town_name() for plan in plans))
    line("cars", Counter(plan.cars for plan in plans))
    line("environment", Counter(each.name for plan in plans for each in plan.environments))
    total, present = Counter(), Counter()
    for result in results:
        total.update(result.events)
        present.update(name for name, count in result.events.items() if count)
    ticks = total.pop("ticks", 0)
    line("deeds", Counter({f"{name} {count} in": present[name] for name, count in total.items()}))
    print(f"  {'ticks':<14}{ticks}")
    complete = sum(result.end == COMPLETE for result in results)
    never = sorted(name for name in total if not present[name])
    if len(results) >= SOME and complete < len(results) * ENOUGH:
        return f"the swarm sleeps: only {complete} of {len(results)} episodes ran to their end"
    if len(results) >= MANY and never:
        return "the swarm sleeps: nobody ever did: " + ", ".join(never)
    return ""


def run_all(arguments, plans):
    results = []
    with ThreadPoolExecutor(arguments.jobs) as pool:
        running = [pool.submit(run_twice, arguments, each) for each in plans]
        for count, future in enumerate(as_completed(running), 1):
            result = future.result()
            results.append(result)
            word = "FAIL" if result.wrong else "ok"
            title = f"seed {result.plan.seed}: {result.plan.text()}"
            print(f"{word:<5}{result.seconds:6.1f} s  {title}  {count}/{len(running)}", flush=True)
            if result.wrong:
                print("      " + result.wrong.replace("\n", "\n      "), flush=True)
    return sorted(results, key=lambda result: result.plan.seed)


def summary(results, seconds):
    sleeps = coverage(results)
    cut_off = [result for result in results if result.end != COMPLETE]
    for result in cut_off:
        print(f"seed {result.plan.seed} ({result.plan.text()}): both runs ended early, with {result.end}")
    failed = [result for result in results if result.wrong]
    aborted = sum("exit 70" in result.end for result in cut_off)
    print(f"{len(results)} episodes in {seconds:.0f} s: {len(failed)} failed; {len(cut_off)} ended early, "
          f"{aborted} of them by an assertion of SUMO's")
    for result in failed:
        print(f"  ./dev swarm 1 {result.plan.seed}")
    if sleeps:
        print(sleeps)
    return 1 if failed or sleeps else 0


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", nargs="?", type=int, default=100)
    parser.add_argument("first_seed", nargs="?", type=int, default=1)
    parser.add_argument("--bin", type=Path, required=True, help="the folder of reprise and its kin")
    parser.add_argument("--tools", type=Path, required=True, help="the folder of wrong_maths")
    parser.add_argument("--work", type=Path, default=Path("fuzz"), help="failing episodes are kept here")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    arguments = parser.parse_args()
    if arguments.count < 1 or arguments.first_seed < 0:
        parser.error("expected a count of at least 1 and a seed of at least 0")
    for key in ("bin", "tools", "work"):
        setattr(arguments, key, getattr(arguments, key).resolve())
    return arguments


def main():
    arguments = read_arguments()
    canary = str(arguments.tools / "libm_canary")
    around = environments.surroundings(arguments.work, canary, arguments.tools / "libwrong_maths.so")
    known = environments.masked_cpus(canary) * 3 + [each for each in around if not each.machine]
    emulated = environments.emulated_cpus(canary)
    begin = time.monotonic()
    seeds = range(arguments.first_seed, arguments.first_seed + arguments.count)
    results = run_all(arguments, [plan(seed, known, emulated) for seed in seeds])
    return summary(results, time.monotonic() - begin)


if __name__ == "__main__":
    sys.exit(main())
