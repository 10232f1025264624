"""Drives of the built-in driver on many road networks, in traffic: does any of them end early?

drives.py REPRISE [NET ...] [--drives N] [--cars N] [--seconds S] [--jobs N] [--keep FOLDER] [--only WORD]

Each drive is a process of its own. Without NETs: those that `netgenerate` makes (see MADE), and SUMO's own examples
where they are installed. Prints a line a net (passed, collided, stood, aborted), then every drive that did not pass.
Exit status 1 when a drive aborted. Run by hand: 200 drives are ten minutes of two processors.
"""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import resource
import shlex
import subprocess
import sys
import tempfile

SUMO = pathlib.Path("/usr/share/sumo/tools")

# What netgenerate makes: wide and narrow, left-hand, with tiny edges, on one lane both ways, with lanes to turn.
MADE = {
    "grid": "--grid --grid.number 5 --grid.length 120 -L 2 -j traffic_light --turn-lanes 1 --turn-lanes.length 40",
    "grid_left": "--grid --grid.number 5 --grid.length 100 -L 2 --lefthand --turn-lanes 1 --turn-lanes.length 30",
    "grid_stop": "--grid --grid.number 4 --grid.length 90 -j priority_stop --grid.attach-length 60",
    "grid_all_way": "--grid --grid.number 4 --grid.length 70 -L 3 -j allway_stop",
    "grid_tiny": "--grid --grid.number 6 --grid.length 45 -j right_before_left",
    "spider": "--spider --spider.arm-number 6 --spider.circle-number 4 --spider.space-radius 60 -L 2",
    "spider_left": "--spider --spider.arm-number 7 --spider.circle-number 3 --spider.space-radius 70 --lefthand",
    "circle": "--spider --spider.arm-number 5 --spider.circle-number 2 --spider.space-radius 40 --spider.omit-center",
    "bidi": "--rand --rand.iterations 60 --bidi-probability 1 --seed 5",
    "bidi_wide": "--rand --rand.iterations 50 --bidi-probability 0.4 -L 2 --random-lanenumber --seed 9",
    "tiny": "--rand --rand.iterations 90 --rand.min-distance 6 --rand.max-distance 45 --seed 11",
    "tiny_left": "--rand --rand.iterations 90 --rand.min-distance 5 --rand.max-distance 40 --lefthand --seed 12",
    "tiny_lit": "--rand --rand.iterations 80 --rand.min-distance 8 --rand.max-distance 60 -L 2 -j traffic_light --seed 3",
    "random": "--rand --rand.iterations 70 -L 3 --random-lanenumber --random-priority --tls.guess --seed 21",
    "random_left": "--rand --rand.iterations 70 -L 3 --random-lanenumber --lefthand --tls.guess --seed 22",
    "random_turns": "--rand --rand.iterations 60 -L 2 --turn-lanes 2 --turn-lanes.length 25 --rand.grid --seed 23",
}

EXAMPLES = [
    "game/DRT/osm",
    "game/A10KW/osm",
    "game/bs3d/bs",
    "game/kuehne/kuehne",
    "game/highway/highway",
    "game/ramp/ramp",
    "game/square/square",
    "sumolib/scenario/scenarios/RealWorld/acosta/acosta_buslanes",
    "sumolib/scenario/scenarios/RealWorld/joined/joined_buslanes",
    "sumolib/scenario/scenarios/RealWorld/pasubio/pasubio_buslanes",
    "sumolib/scenario/scenarios/RealWorld/RiLSA_example3/net",
    "sumolib/scenario/scenarios/RealWorld/RiLSA_example4/net",
]

SCENARIO = """
return scenario 'drive' {{
    cars = {cars}, duration = {seconds},
    run = function() spawn{{ name = 'ego', model = 'sedan', driver = 'autopilot', may_overtake = true }} wait({seconds}) end,
}}
"""

STOOD = 20  # [m] in a whole drive: less is standing

Drive = collections.namedtuple("Drive", "net seed outcome said")


def make(folder, only):
    """The networks of MADE and EXAMPLES, by name."""
    nets = {}
    for name, words in MADE.items():
        nets[name] = folder / f"{name}.net.xml"
        if only in name:
            subprocess.run(
                ["netgenerate", *shlex.split(words), "-o", nets[name], "--no-warnings"],
                check=True,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,  # a word on SUMO_HOME
            )
    for path in EXAMPLES:
        if (net := SUMO / f"{path}.net.xml").exists():
            nets["/".join(path.split("/")[-2:])] = net
    return {name: net for name, net in nets.items() if only in name}


def why_it_ended(result):
    """The line that says why, a library's own words before ours."""
    lines = (result.stderr + result.stdout).splitlines()
    for mark in ("Assertion", "reprise: "):
        for line in lines:
            if mark in line:
                return line
    return f"exit status {result.returncode}: " + " / ".join(lines[-2:])


def infractions_of(reprise, trace):
    """What the driver touched, one line each, and how far it came. [m]"""
    score = subprocess.run([reprise, "score", trace, "--json"], capture_output=True, text=True)
    ego = json.loads(score.stdout)["vehicles"][0]
    return [one for one in ego["infractions"] if one["kind"].startswith("collision")], ego["driven"]


def drive(options, name, net, seed, folder):
    trace = folder / f"{name.replace('/', '_')}.{seed}.mcap"
    words = [options.reprise, "run", folder / "drive.lua", "--town", net, "--seed", str(seed), "-o", trace]
    result = subprocess.run(words, capture_output=True, text=True, timeout=options.timeout)
    if result.returncode != 0:
        return Drive(name, seed, "aborted", why_it_ended(result))
    touched, driven = infractions_of(options.reprise, trace)
    if not options.keep or not touched:
        trace.unlink(missing_ok=True)
    if touched:
        return Drive(name, seed, "collided", json.dumps(touched))
    if driven < STOOD:
        return Drive(name, seed, "stood", f"{driven:.0f} m driven")
    return Drive(name, seed, "passed", "")


def show(nets, drives):
    outcomes = ("passed", "collided", "stood", "aborted")
    print(f"{'net':32}" + "".join(f"{one:>10}" for one in outcomes))
    for name in [*nets, "all"]:
        of_net = collections.Counter(one.outcome for one in drives if name in (one.net, "all"))
        print(f"{name:32}" + "".join(f"{of_net[one]:>10}" for one in outcomes))
    for one in drives:
        if one.outcome != "passed":
            print(f"{one.net} seed {one.seed}: {one.outcome}: {one.said}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reprise")
    parser.add_argument("nets", nargs="*", type=pathlib.Path)
    parser.add_argument("--drives", type=int, default=8, help="of each net")
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--cars", default=80)
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--timeout", type=int, default=600, help="[s] of the clock, of one drive")
    parser.add_argument("--only", default="", help="nets whose name has this word")
    parser.add_argument("--keep", type=pathlib.Path, help="the networks, and traces of drives that collided")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "drive.lua").write_text(SCENARIO.format(cars=options.cars, seconds=options.seconds))
        nets = {net.name.split(".")[0]: net for net in options.nets} or make(folder, options.only)
        seeds = range(options.first_seed, options.first_seed + options.drives)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            waiting = [
                pool.submit(drive, options, name, net, seed, folder) for name, net in nets.items() for seed in seeds
            ]
            drives = []
            for one in waiting:
                drives.append(one.result())
                print(*drives[-1], file=sys.stderr, flush=True)
        show(nets, drives)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{len(drives)} drives, {used.ru_utime + used.ru_stime:.0f} s of CPU")
    return 1 if any(one.outcome == "aborted" for one in drives) else 0


if __name__ == "__main__":
    sys.exit(main())
