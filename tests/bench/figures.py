"""The section "Figures" of README.md: its blocks, each a table or a sentence made from measured values.

A value has the name "BENCHMARK.counter", such as "Tick/100.of_bare", or one that tables.py gives. A
block stands in README.md between the lines <!-- figures: NAME --> and <!-- /figures -->; what stands
between blocks is written by hand and holds no figure."""
import re

NOT_MEASURED = "not measured"
CARS = (0, 10, 50, 100, 200, 400)
LEVELS = {
    "full": "full",
    "keyed": "keyed: traffic once a second",
    "core": "core: no traffic",
    "inputs": "inputs: what was driven by hand, and digests",
}
PICTURES = {
    "depth": "depth, 800x600",
    "semantic": "semantic classes, 800x600",
    "rgb_clear_noon": "colour, 800x600, clear noon",
    "rgb_hard_rain_sunset": "colour, 800x600, hard rain at sunset",
    "rgb_clear_night": "colour, 800x600, clear night",
    "rgb_200x88": "colour, 200x88",
    "rgb_84x84": "colour, 84x84",
    "semantic_84x84": "semantic classes, 84x84",
}
SWEEPS = {
    "semantic_64x2048": "a turn of a LiDAR, 64 x 2048, with labels",
    "lidar_64x2048": "a turn of a LiDAR, 64 x 2048, clear noon",
    "lidar_rain_64x2048": "a turn of a LiDAR, 64 x 2048, hard rain",
}
COMMANDS = ("--version", "--help", "info", "diff")
TICKS_AN_HOUR = 72_000
TICK = 0.05  # [s]


class Values:
    """What was measured. Remembers which values were asked for and are not there."""

    def __init__(self, measured):
        self.measured = measured
        self.missing = []

    def text(self, name, scale=1.0, decimals=None, digits=3):
        """Rounded to decimals, or to digits that say something: 22,200, 413, 19.1, 0.9."""
        value = self.measured.get(name)
        if value is None:
            self.missing.append(name)
            return NOT_MEASURED
        value = float(value) * scale
        if decimals is None:
            value = float(f"{value:.{digits}g}")
            decimals = 1 if abs(value) < 10 ** (digits - 1) else 0
        return f"{value:,.{decimals}f}"


def table(columns, rows):
    lines = ["| " + " | ".join(columns) + " |", "| " + " | ".join("---" for _ in columns) + " |"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def machine(v):
    """Commit, number of cores and model are words, not values."""
    words = v.measured.get("machine", "commit (unknown) on an unknown machine")
    return f"Measured at {words}."


def ticks(v):
    rows = []
    for cars in CARS:
        at = f"Tick/{cars}."
        rows.append([
            str(cars),
            v.text(at + "ticks/s"),
            v.text(at + "ticks/s", TICK),
            v.text(at + "of_bare", decimals=2),
            v.text(at + "sumo_us", digits=3) + " us",
            v.text(at + "bullet_us", digits=3) + " us",
            v.text(at + "record_us", decimals=1) + " us",
            v.text(at + "raw_B", 1e-3, decimals=1) + " kB",
            v.text(at + "file_B", 1e-3, decimals=1) + " kB",
        ])
    columns = ["cars", "ticks/s", "times real time", "a tick, of its bare parts", "bare SUMO step",
               "bare Bullet, 10 substeps", "recording", "a tick, raw", "in the file"]
    return table(columns, rows) + (
        f"\n\nAt 100 cars a tick takes {v.text('Tick/100.of_bare_medians', decimals=2)} of its bare parts by medians, "
        f"recording {v.text('Tick/100.record_%', decimals=1)} % of it; SUMO stepped in a\n"
        f"loop of its own takes {v.text('Tick/100.sumo_alone_us', digits=3)} us.")


def drivers(v):
    """Who drives among 100 cars: ticks/s, and what that adds to a tick in which nobody is asked."""
    rows = [["nobody is asked: the same controls from inside", v.text("Driver.ticks/s_alone"), ""],
            ["the built-in driver", v.text("Driver.ticks/s_built_in"), ""]]
    for name, words in (("cpp", "another program, in C++"), ("cpp_asleep", "in C++, asleep between ticks"), ("python", "in Python"),
                        ("python_asleep", "in Python, asleep between ticks")):  # fmt: skip
        rows.append([words, v.text(f"Driver.ticks/s_{name}"), v.text(f"Driver.{name}_us", digits=2) + " us"])
    for name, words in (("rgb84", "84x84"), ("rgb200x88", "200x88"),
                        ("three800x600", "800x600, with depth and semantic classes")):
        rows.append([f"in Python, with colour {words}", v.text(f"Cameras.ticks/s_{name}", digits=2), ""])
    return table(["who drives, among 100 cars", "ticks/s", "adds to a tick"], rows) + (
        f"\n\nA bare round trip of the same bytes in each tick adds {v.text('Driver.bare_us', digits=2)} us; one after the other they take "
        f"{v.text('RoundTrip/7300.real_ms', 1e3, digits=2)} us, 1 kB {v.text('RoundTrip/1000.real_ms', 1e3, digits=2)} us.\n"
        f"From Python {v.text('Resets.resets/s', digits=2)} episodes a second begin with the seed of the last one, "
        f"{v.text('Resets.resets/s_other_seed', digits=2)} with another; two environments in\n"
        f"two processes make {v.text('Vector.two_of_one', decimals=2)} times the ticks of one, which has a core for its driver then, and "
        f"{v.text('Vector.two_of_one_on_a_core', decimals=2)} times those of one on one core; "
        f"asleep between ticks {v.text('Vector.two_of_one_asleep', decimals=2)} times those of one. Two runs in which nobody drives make "
        f"{v.text('Vector.plain_two_of_one', decimals=2)} times those of one.")


def pictures(v):
    rows = []
    for name, words in PICTURES.items():
        at = f"look/{name}."
        rows.append([words, v.text(at + "real_ms", digits=3) + " ms", v.text(at + "of_bare", decimals=1),
                     v.text(at + "portable_ms", digits=3) + " ms"])
    for name, words in SWEEPS.items():
        at = f"sweep/{name}."
        rows.append([words, v.text(at + "real_ms", digits=3) + " ms (no file)", v.text(at + "of_bare", decimals=1), ""])
    columns = ["a picture, one core", "with its file", "of bare Embree over all its rays", "`--portable`, without the file"]
    return table(columns, rows) + (
        f"\n\nBy night, among lamps, a picture takes {v.text('Night.of_noon', decimals=2)} times what it takes at noon, measured in turns.\n"
        f"Until the first picture {v.text('StartUp.real_ms', digits=3)} ms pass. Two threads make "
        f"{v.text('Threads.times_one', decimals=2)} times the pictures of one; of the bare rays they\n"
        f"trace {v.text('Threads.bare_times_one', decimals=2)} times as many.")


def traces(v):
    rows = []
    for name, words, bare in (("Encode", "encode", "compression"),
                              ("Write", "write, all threads", "compression"),
                              ("Play", "play", "decompression")):
        rows.append([words, v.text(name + ".cpu_us"), v.text(name + ".bare_cpu_us") + f" ({bare})",
                     v.text(name + ".of_bare", decimals=2)])
    rows.append(["verify: simulates it again", v.text("Verify.cpu_us"), "", ""])
    return table(["us of CPU a tick, 100 cars and 100 walkers", "ours",
                  "bare zstd over the same bytes", "ratio"], rows)


def recording(v):
    return (f"Recording takes {v.text('Recording.thread_%', decimals=1)} % of the simulation's thread and "
            f"{v.text('Recording.wall_%', decimals=1)} % by the clock there; with compression on its own\n"
            f"thread {v.text('Recording.cpu_%', decimals=1)} % of all CPU time. "
            f"Playing is {v.text('Recording.play_faster', digits=2)} times as fast as simulating.")


def commands(v):
    rows = [[f"`reprise {name}`", v.text(f"reprise {name}.ms", digits=2) + " ms", ""] for name in COMMANDS]
    rows.append(["ten minutes among 100 cars, recorded", v.text("ten minutes.s", digits=2) + " s",
                 f"{v.text('ten minutes.memory_MB', digits=2)} MB of memory, "
                 f"{v.text('ten minutes.trace_MB', digits=3)} MB of trace"])
    return table(["a whole program", "time", ""], rows)


def levels(v):
    rows = [[words, v.text(f"level {level}.B", decimals=0) + " B",
             v.text(f"level {level}.B", TICKS_AN_HOUR * 1e-6, decimals=0) + " MB"]
            for level, words in LEVELS.items()]
    return table(["level of a trace, 100 cars and 100 walkers", "a tick in the file", "a simulated hour"],
                 rows)


BLOCKS = {"machine": machine, "ticks": ticks, "drivers": drivers, "pictures": pictures, "traces": traces,
          "recording": recording, "levels": levels, "commands": commands}
END = "<!-- /figures -->"
A_BLOCK = re.compile(r"<!-- figures: (\w+) -->\n(.*?)\n" + re.escape(END), re.DOTALL)


def section(readme):
    """The text under "## Figures", up to the next heading."""
    found = re.search(r"^## Figures\n(.*?)(?=^## |\Z)", readme, re.DOTALL | re.MULTILINE)
    if found is None:
        raise SystemExit("README.md: there is no heading '## Figures'")
    return found


def blocks_of(readme):
    """The blocks that stand there: name and text, in order."""
    return A_BLOCK.findall(section(readme).group(1))


def rewritten(readme, measured):
    """The text with every block made again, and the names of values that were not measured."""
    values = Values(measured)
    there = [name for name, _ in blocks_of(readme)]
    if there != list(BLOCKS):
        raise SystemExit(f"README.md: the blocks of 'Figures' are {', '.join(there) or 'none'}; "
                         f"expected {', '.join(BLOCKS)}")

    def made(block):
        name = block.group(1)
        return f"<!-- figures: {name} -->\n{BLOCKS[name](values)}\n{END}"

    found = section(readme)
    text = A_BLOCK.sub(made, found.group(1))
    return readme[:found.start(1)] + text + readme[found.end(1):], values.missing
