"""A driver in another program on every route of a town's tasks.

external_routes.py REPRISE SCENARIO.lua DRIVER.py TASKS.json [EVERY]: what was said on each route that
goes wrong, exit status 1 when any did. Only one in EVERY routes, unless REPRISE_THOROUGH is set.
"""
import concurrent.futures
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile


def drive(reprise, scenario, driver, route, trace):
    """What is said of a route; empty when the driver arrived, in time, and touched nothing."""
    words = [reprise, "run", scenario, "-o", trace, "--level", "inputs", "--driver-timeout", "120"]
    words += ["--driver", f"ego=exec '{sys.executable}' -B '{driver}'"]
    for key, value in route.items():
        words += ["--set", f"{key}={value}"]
    result = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    pathlib.Path(trace).unlink(missing_ok=True)
    arrived = result.returncode == 0 and "passed: arrived" in result.stdout
    return "" if arrived else f"{' '.join(words)}\n{result.stdout}"


def main(reprise, scenario, driver, tasks, every="1"):
    routes = [
        {"start": way["start"]["lane"], "s": way["start"]["s"], "goal": way["goal"]["lane"], "goal_s": way["goal"]["s"]}
        for ways in json.loads(pathlib.Path(tasks).read_text())["tasks"].values()
        for way in ways
    ][:: 1 if os.environ.get("REPRISE_THOROUGH") else int(every)]
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        waiting = [
            pool.submit(drive, reprise, scenario, driver, route, f"{folder}/{number}.mcap")
            for number, route in enumerate(routes)
        ]
        wrong = [text for text in (one.result() for one in waiting) if text]
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print("\n".join(wrong))
    print(f"{len(routes) - len(wrong)} of {len(routes)} routes, {used.ru_utime + used.ru_stime:.0f} s of CPU")
    return 1 if wrong or not routes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
