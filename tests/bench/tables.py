#!/usr/bin/env python3
"""./dev bench --tables: measures every figure of README.md's section "Figures" and writes it there.

Benchmarks run --repetitions times each; whole programs several times; all figures are medians. Says
which figures could not be made, leaves README.md as it is and exits 1 then."""
import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import figures
import picture_memory

ROOT = Path(__file__).resolve().parents[2]
# Program and which of its benchmarks the tables need.
BENCHMARKS = {
    "tick_bench": "Tick",
    "driver_bench": ".",
    "serve_bench.py": "Resets|Vector",
    "trace_bench": "Encode|Write|Play|Verify",
    "recording_bench": "Recording",
    "render_bench": ".",
}
# As reprise-render is started; the bare rays beside it have it as well.
ENVIRONMENT = {"render_bench": picture_memory.environment()}
UNIT_MS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
DECORATION = re.compile(r"/(iterations:\d+|repeats:\d+|manual_time|process_time|real_time)")


def say(text):
    print(f"tables: {text}", file=sys.stderr, flush=True)


def values_of_benchmarks(output):
    """Google Benchmark's JSON as values: the medians of what each benchmark's repetitions say."""
    runs = {}
    for run in output["benchmarks"]:
        if run.get("run_type") != "iteration" or run.get("error_occurred"):
            continue
        name = DECORATION.sub("", run["run_name"])
        unit = UNIT_MS[run["time_unit"]]
        numbers = {key: value for key, value in run.items() if isinstance(value, (int, float))}
        numbers.update(real_ms=run["real_time"] * unit, cpu_ms=run["cpu_time"] * unit)
        for key, value in numbers.items():
            runs.setdefault(f"{name}.{key}", []).append(value)
    return {name: statistics.median(values) for name, values in runs.items()}


def benchmarks(build, work, repetitions, min_time):
    measured = {}
    for program, wanted in BENCHMARKS.items():
        say(f"{program}")
        out = work / f"{program}.json"
        in_python = ["/usr/bin/python3", "-B", ROOT / "tests/bench" / program]
        command = [*(in_python if program.endswith(".py") else [build / "bench" / program]), f"--benchmark_filter={wanted}",
                   f"--benchmark_repetitions={repetitions}", f"--benchmark_min_time={min_time}",
                   f"--benchmark_out={out}", "--benchmark_out_format=json"]
        result = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                text=True, env=dict(os.environ, TMPDIR=str(work), PYTHONPATH=str(ROOT / "python"),
                                                    REPRISE=str(build / "bin" / "reprise"), **ENVIRONMENT.get(program, {})))
        if result.returncode != 0:
            say(f"{program} failed ({result.returncode}):\n{result.stdout[-2000:]}")
            continue
        measured.update(values_of_benchmarks(json.loads(out.read_text())))
    return measured


def run(command):
    """Runs a program to its end. Returns seconds and the most memory it held [bytes]; None when it could
    not do its work. Exit status 1 says that traces differ or a check failed: the work is done."""
    begin = time.perf_counter()
    process = subprocess.Popen([str(word) for word in command], cwd=ROOT, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)
    problem = process.stderr.read().decode(errors="replace")
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - begin
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 1):
        say(f"{' '.join(str(word) for word in command)}: exit {process.returncode}\n{problem[-1000:]}")
        return None
    return seconds, usage.ru_maxrss * 1024


def medians(command, times):
    """Medians of seconds and bytes over several runs; None when one fails."""
    runs = []
    for _ in range(times):
        runs.append(run(command))
        if runs[-1] is None:
            return None
    return [statistics.median(column) for column in zip(*runs)]


def commands(reprise, work, quick):
    """Whole programs, as a user calls them."""
    say("whole programs")
    measured = {}
    trace, same = work / "minute.mcap", work / "same.mcap"
    if run([reprise, "run", "scenarios/free_drive.lua", "-o", trace, "--seed", 7, "--for", 60]):
        shutil.copy(trace, same)
    arguments = {"--version": ["--version"], "--help": ["--help"], "info": ["info", trace],
                 "diff": ["diff", trace, same]}
    for name in figures.COMMANDS:
        found = medians([reprise, *arguments[name]], 3 if quick else 31)
        if found:
            measured[f"reprise {name}.ms"] = found[0] * 1e3
    long = work / "ten_minutes.mcap"
    found = medians([reprise, "run", "scenarios/free_drive.lua", "-o", long, "--seed", 7, "--for", 600],
                    1 if quick else 5)
    if found:
        measured.update({"ten minutes.s": found[0], "ten minutes.memory_MB": found[1] * 1e-6,
                         "ten minutes.trace_MB": long.stat().st_size * 1e-6})
    return measured


def levels(reprise, work):
    """Bytes a tick of each level: what two more minutes add to a trace. Town and network, which a file
    holds once, are left out."""
    say("levels")
    sizes = {}
    for seconds in (60, 180):
        full = work / f"full_{seconds}.mcap"
        if run([reprise, "run", "tests/bench/crowd.lua", "-o", full, "--for", seconds]) is None:
            return {}
        sizes["full", seconds] = full.stat().st_size
        for level in figures.LEVELS:
            out = work / f"{level}_{seconds}.stripped.mcap"
            if level != "full" and run([reprise, "strip", full, "-o", out, "--level", level]):
                sizes[level, seconds] = out.stat().st_size
    more_ticks = (180 - 60) / figures.TICK
    return {f"level {level}.B": (sizes[level, 180] - sizes[level, 60]) / more_ticks
            for level in figures.LEVELS if (level, 180) in sizes and (level, 60) in sizes}


def machine():
    """Which commit, on what."""
    def git(*words):
        result = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True)
        return result.stdout.strip()
    commit = git("rev-parse", "--short", "HEAD") or "(unknown)"
    if git("status", "--porcelain", "--untracked-files=no"):
        commit += " with changes"
    found = re.search(r"^model name\s*:\s*(.*?)\s*$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    model = re.sub(r"\((R|TM)\)", "", found.group(1)) if found else "a CPU without a name"
    return f"commit {commit} on {len(os.sched_getaffinity(0))} cores ({model})"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build/release", help="the build folder")
    parser.add_argument("--quick", action="store_true",
                        help="one rough measurement, into figures.md of the build folder: are all figures made?")
    args = parser.parse_args()
    build = args.build.resolve()
    load = os.getloadavg()[0]
    if load > 0.5 and not args.quick:
        say(f"the machine is busy (load {load:.1f}): what it measures now is not worth much")
    with tempfile.TemporaryDirectory(dir=build, prefix="tables_") as folder:
        work = Path(folder)
        measured = benchmarks(build, work, 1 if args.quick else 5, 0.01 if args.quick else 0.5)
        reprise = build / "bin" / "reprise"
        measured |= commands(reprise, work, args.quick) | levels(reprise, work)
    measured["machine"] = machine()
    readme = ROOT / "README.md"
    text, missing = figures.rewritten(readme.read_text(), measured)
    aside = args.quick or missing  # README.md keeps the figures that it has, rather than gaps
    if aside:
        (build / "figures.md").write_text(figures.section(text).group(0))
    else:
        readme.write_text(text)
    for name in missing:
        say(f"not measured: {name}")
    say(f"wrote {'figures.md of the build folder' if aside else 'README.md'}")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
