"""Long drives of the built-in driver in traffic, on many towns and seeds: what befell it, and whose fault was it?

long_drives.py REPRISE [TOWN ...] [--seeds N] [--minutes M] [--cars N] [--walkers N] [--drivers N] [--jobs N] [--keep FOLDER]
long_drives.py --traces T.mcap ...

Runs N seeds on each town (a name, a folder or a network; default: town1). Prints every collision, wait of a minute or
more, overtaking and backing off with its story, then a table. Exit status 1 when a collision was avoidable, a run ended
early, or nobody moved any more. By hand: 10 seeds of 30 minutes on one town are half an hour of two processors.
"""
import argparse
import concurrent.futures
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from drive_story import Account  # noqa: E402
from reprise.trace import Trace  # noqa: E402

SCENARIO = """
return scenario 'long_drive' {{
    cars = {cars}, walkers = {walkers}, duration = {seconds},
    run = function()
        for i = 1, {drivers} do
            spawn{{ name = 'ego' .. i, model = 'sedan', driver = 'autopilot', may_overtake = true }}
        end
        wait({seconds})
    end,
}}
"""

GRIDLOCK = 0.5  # [m/s] a mean of all background cars over the last minute: nothing goes any more

COUNTED = ("collision", "blocked", "stood", "overtakes", "backed_off", "ran_red_light", "ran_stop_sign",
           "on_opposite_lane", "wrong_way", "on_sidewalk", "left_road", "speeding")  # fmt: skip


def account_of(path):
    """The stories as lines, and the row of the table."""
    account = Account(Trace(path))
    at_end = account.car_speeds[-60:] or [0.0]
    return account.stories, {
        "minutes": account.trace.last * account.trace.step / 60,
        "km": account.driven / 1000,
        "m/s": account.mean_speed,
        "cars m/s": sum(account.car_speeds) / max(len(account.car_speeds), 1),
        "at end": sum(at_end) / len(at_end),
        "stuck": account.stuck_cars,
        "longest": account.longest_wait,
        "avoidable": account.avoidable,
        **{name: account.counts[name] for name in COUNTED},
    }


def drive(options, town, seed, folder):
    """One run: its name, its stories and its row; a row of None: it ended early, and the stories say why."""
    name = f"{pathlib.Path(town).name.split('.')[0]} {seed}"
    trace = folder / f"{name.replace(' ', '.')}.mcap"
    words = [options.reprise, "run", folder / "long_drive.lua", "--town", town, "--seed", str(seed), "-o", trace]
    result = subprocess.run(words, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        return name, (result.stderr or result.stdout).splitlines()[-2:], None
    stories, row = account_of(trace)
    if not options.keep:
        trace.unlink()
    return name, stories, row


def played(options):
    """One after another as they end in the order of towns and seeds: name, stories, row."""
    if options.traces:
        for path in options.traces:
            yield path.name, *account_of(path)
        return
    with tempfile.TemporaryDirectory() as temporary, concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        said = dict(cars=options.cars, walkers=options.walkers, drivers=options.drivers, seconds=options.minutes * 60)
        (folder / "long_drive.lua").write_text(SCENARIO.format(**said))
        seeds = range(options.first_seed, options.first_seed + options.seeds)
        towns = options.towns or ["town1"]
        waiting = [pool.submit(drive, options, town, seed, folder) for town in towns for seed in seeds]
        for one in waiting:
            yield one.result()


def show(rows):
    """The table, a line a run and one of all."""
    names = list(rows[0][1])
    heads = [name.replace("ran_", "").replace("on_", "").replace("_", " ") for name in names]
    total = {name: sum(row[name] for _, row in rows) for name in names}
    for name in ("m/s", "cars m/s", "at end"):
        total[name] /= len(rows)
    total["longest"] = max(row["longest"] for _, row in rows)
    print(f"{'':22}" + " ".join(f"{head:>7}" for head in heads))
    for which, row in [*rows, ("all", total)]:
        cells = (f"{value:.1f}" if isinstance(value, float) else str(value) for value in row.values())
        print(f"{which:22}" + " ".join(f"{cell:>{max(len(head), 7)}}" for cell, head in zip(cells, heads)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reprise", nargs="?")
    parser.add_argument("towns", nargs="*")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--cars", type=int, default=100)
    parser.add_argument("--walkers", type=int, default=100)
    parser.add_argument("--drivers", type=int, default=1, help="more of them make more of a run, and meet each other")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep", type=pathlib.Path, help="the traces, in this folder")
    parser.add_argument("--traces", type=pathlib.Path, nargs="*", help="these, instead of runs")
    options = parser.parse_args()
    rows, bad = [], False
    for name, stories, row in played(options):
        print(f"{name}:", *stories, sep="\n", flush=True)
        if row is None:
            bad = True
            continue
        rows.append((name, row))
        bad = bad or row["avoidable"] > 0 or row["at end"] < GRIDLOCK
    if rows:
        show(rows)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
