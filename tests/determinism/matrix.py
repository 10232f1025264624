#!/usr/bin/env python3
"""The matrix: the same run in every environment that we know of must write the same bytes.

  matrix.py --bin build/release/bin --tools build/release/tests/determinism            everything
  matrix.py --bin ... --tools ... '*.no_aslr' 'long.*'                                 only these

A row, RECIPE.ENVIRONMENT, makes something in an environment and compares it, byte by byte, with what the same
recipe makes in the plain one. Exit status: 0 all rows ok, 1 a row is not.
"""

import argparse
import contextlib
import filecmp
import fnmatch
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Callable

import environments
from environments import MASKS, Environment, Impossible

HERE = Path(__file__).resolve().parent
SCENARIOS = HERE.parents[1] / "scenarios"
NETS = Path("/usr/share/sumo/tools/game")  # of Debian's sumo-tools
PLAIN = Environment("plain")


@dataclass(frozen=True)
class Recipe:
    """A command that makes something: a file, a folder, or nothing (then it must succeed)."""

    name: str
    words: tuple  # {out}: what it makes; {NAME}: what the recipe NAME made
    program: str = "reprise-run"
    makes: str = ".mcap"  # ending of a file, "/" or ""
    needs: tuple = ()  # recipes whose results it reads
    ends: tuple = (0,)  # exit statuses that are good

    def path(self, folder, label):
        return folder / f"{self.name}.{label}{self.makes.rstrip('/')}"

    def but(self, *more_words, program=""):
        """The same another way: has to make the same as the recipe itself."""
        return replace(self, words=self.words + more_words, program=program or self.program)


def run_recipe(name, *words, **more):
    return Recipe(name, ("run", *map(str, words), "-o", "{out}"), **more)


# Ten seconds with everything in them; and five minutes, because shorter runs pass falsely: with the C library's
# maths instead of ours the ten seconds are equal on all emulated CPUs; the long runs part ways, this one in tick 164.
SHORT = run_recipe("short", HERE / "collision.lua")
# A hundred people on foot for five minutes: Detour, its avoidance, lights and cars.
ON_FOOT = run_recipe("on_foot", SCENARIOS / "free_drive.lua", "--seed", 7, "--walkers", 100, "--for", 300)
LONG = run_recipe("long", SCENARIOS / "free_drive.lua", "--seed", 7, "--for", 300)
CURVED = [  # real ones; that our car keeps its lane there is another question, so a failed check (1) is good enough
    run_recipe(name, SCENARIOS / "free_drive.lua", "--town", NETS / path, "--seed", 7, "--for", 300, ends=(0, 1))
    for name, path in {"city": "DRT/osm.net.xml", "ring_road": "bs3d/bs.net.xml"}.items()
]
# Cars of traffic's and parked ones that become bodies in the middle of a tick, and one who falls.
CRASHES = run_recipe("crashes", HERE / "crashes.lua")
# The same among a hundred cars and a hundred people on foot, for 6,000 ticks: the wrecks lie there, and queues form.
LONG_CRASHES = run_recipe("long_crashes", HERE / "crashes.lua", "--for", 300, "--cars", 100, "--walkers", 100)
CRASHES_VERIFIED = Recipe("crashes_verified", ("verify", "{crashes}"), makes="", needs=(CRASHES,))
# Every scenario that we ship, as it stands; a failed check (1) is an answer, too.
STORIES = [run_recipe(f"scenario_{path.stem}", path, ends=(0, 1)) for path in sorted(SCENARIOS.glob("*.lua"))]
# Commands that read a trace and make another thing of it are rows like all others: a recipe with `needs`.
VERIFIED = Recipe("verified", ("verify", "{short}"), makes="", needs=(SHORT,))
# Another program drives, here only: everywhere else its controls come from the trace, and make the same bytes again.
DRIVEN = run_recipe("driven", HERE / "driven.lua", "--driver", "ego={tools}/odd_driver steady")
DRIVEN_AGAIN = Recipe("driven_again", ("run", "{driven}", "-o", "{out}"), needs=(DRIVEN,))
DRIVEN_VERIFIED = Recipe("driven_verified", ("verify", "{driven}"), makes="", needs=(DRIVEN,))
RENDER = ("render", "{short}", "-o", "{out}", "--camera", "rgb,depth,semantic", "--size", "160x120", "--every", "60")
PICTURES = Recipe("pictures", RENDER, program="reprise-render", makes="/", needs=(SHORT,))
PORTABLE = Recipe("portable_pictures", (*RENDER, "--portable"), program="reprise-render", makes="/", needs=(SHORT,))
RECIPES = {recipe.name: recipe for recipe in (SHORT, ON_FOOT, LONG, CRASHES, LONG_CRASHES, CRASHES_VERIFIED, *CURVED, *STORIES, VERIFIED, DRIVEN, DRIVEN_AGAIN, DRIVEN_VERIFIED, PICTURES, PORTABLE)}


@dataclass(frozen=True)
class Row:
    name: str  # GROUP.REST
    work: Callable  # Lab -> "" when it is ok, or what is wrong
    short: bool = False  # part of ./dev test as well


class Lab:
    """Runs recipes and keeps what they make in one folder."""

    def __init__(self, arguments):
        self.bin = arguments.bin.resolve()
        self.tools = arguments.tools.resolve()
        self.work = arguments.work.resolve()
        self.locks = {name: threading.Lock() for name in RECIPES}

    def reference(self, recipe):
        return recipe.path(self.work, "plain")

    def command(self, recipe, environment, out):
        # Not by way of the thin `reprise`: an emulated program that becomes another one leaves the emulator.
        places = {"out": out, "tools": self.tools, **{need.name: self.reference(need) for need in recipe.needs}}
        words = [word.format(**places) for word in recipe.words]
        return [*environment.words, str(self.bin / recipe.program), *words]

    def make(self, recipe, environment, out):
        """Returns what is wrong, or ""."""
        command = self.command(recipe, environment, out)
        busy = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(environment.busy)]
        try:
            done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
        finally:
            for each in busy:
                each.kill()
                each.wait()
        if out.exists() == bool(recipe.makes) and done.returncode in recipe.ends:
            return ""
        tail = "\n".join((done.stdout + done.stderr).strip().splitlines()[-8:])
        return f"{shlex.join(command)}\nexit status {done.returncode}\n{tail}"

    def make_reference(self, name):
        recipe = RECIPES[name]
        for need in recipe.needs:
            if wrong := self.make_reference(need.name):
                return wrong
        with self.locks[name]:
            if not recipe.makes or self.reference(recipe).exists():
                return ""
            with tempfile.TemporaryDirectory(dir=self.work) as folder:  # another process may make it as well
                out = recipe.path(Path(folder), "plain")
                wrong = self.make(recipe, PLAIN, out)
                if not wrong:
                    with contextlib.suppress(OSError):
                        out.rename(self.reference(recipe))
                return wrong

    def compare(self, recipe, environment, label):
        """Makes it here and compares. What is equal is not kept."""
        environment.prove()
        if wrong := self.make_reference(recipe.name):
            return "in the plain environment: " + wrong
        with tempfile.TemporaryDirectory(dir="/dev/shm" if environment.memory_disk else self.work) as folder:
            out = recipe.path(Path(folder), label)
            wrong = self.make(recipe, environment, out)
            if not wrong and recipe.makes and not same(self.reference(recipe), out):
                kept = recipe.path(self.work, label)
                remove(kept)
                shutil.move(out, kept)
                wrong = self.difference(recipe, environment, kept)
        return wrong

    def difference(self, recipe, environment, found):
        command = shlex.join(self.command(recipe, environment, found))
        if found.is_dir():
            return f"{command}\ndiff -r {self.reference(recipe)} {found}"
        diff = [str(self.bin / "reprise"), "diff", str(self.reference(recipe)), str(found)]
        told = subprocess.run(diff, capture_output=True, text=True)
        return f"{command}\n{shlex.join(diff)}\n{told.stdout}{told.stderr}".rstrip()


def remove(path):
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


def same(one, other):
    """Of two files or two folders: equal in every byte?"""
    if one.is_file():
        return filecmp.cmp(one, other, shallow=False)
    files = [sorted(p.relative_to(folder) for p in folder.rglob("*") if p.is_file()) for folder in (one, other)]
    return files[0] == files[1] and all(filecmp.cmp(one / p, other / p, shallow=False) for p in files[0])


# --- Rows.


def row_of(recipe, environment, short=False, label=""):
    label = label or environment.name
    return Row(f"{recipe.name}.{label}", lambda lab: lab.compare(recipe, environment, label), short)


def repeats(recipe, times, short=False):
    def work(lab):
        return next(filter(None, (lab.compare(recipe, PLAIN, f"repeat_{i}") for i in range(times))), "")

    return Row(f"{recipe.name}.{times}_repeats", work, short)


def names_in_masks(lab):
    """Each name in a mask switches something off, on a CPU that has all of them."""
    loader = "/lib64/ld-linux-x86-64.so.2"

    def active(*words):
        text = environments.output_of([*words, "qemu-x86_64", "-cpu", "max", loader, "--list-diagnostics"])
        return [line for line in text.splitlines() if ".active[" in line]

    plain = active()
    # qemu 7.2 emulates neither FMA4 nor AVX-512; both are spelt as in glibc's sysdeps/x86/cpu-tunables.c.
    names = sorted({name for names in MASKS.values() for name in names} - {"FMA4", "AVX512F"})
    unknown = [name for name in names if active(*environments.mask(name)) == plain]
    return f"without effect: {', '.join(unknown)}" if unknown else ""


def tests_pass(lab):
    done = subprocess.run([str(lab.tools / "warm_process_test")], capture_output=True, text=True)
    return "" if done.returncode == 0 else done.stdout + done.stderr


def rows(lab):
    canary = str(lab.tools / "libm_canary")
    around = environments.surroundings(lab.work, canary, lab.tools / "libwrong_maths.so")
    masks = environments.masked_cpus(canary)
    emulated = environments.emulated_cpus(canary)
    around_pictures = [each for each in around if each.name in ("no_aslr", "malloc_perturb", "one_cpu", "loaded")]

    table = [row_of(SHORT.but(program="reprise"), PLAIN, True, "thin_program")]
    table += [repeats(SHORT, 3, True), repeats(SHORT, 20)]
    table += [row_of(SHORT, each, True) for each in around]
    table += [row_of(SHORT, each) for each in emulated]
    table += [repeats(CRASHES, 3, True), row_of(CRASHES_VERIFIED, PLAIN, True)]
    table += [row_of(CRASHES, each, each.name in ("no_aslr", "malloc_perturb")) for each in around]
    table += [row_of(CRASHES, each, each.name == "mask_no_fma") for each in masks]
    table += [row_of(CRASHES, each) for each in emulated]
    table += [repeats(LONG_CRASHES, 1)]
    table += [row_of(LONG_CRASHES, each) for each in masks + around + emulated]
    table += [row_of(LONG, each, each.name in ("mask_no_fma", "mask_no_sse4")) for each in masks]
    table += [row_of(LONG, each) for each in around + emulated]
    table += [repeats(ON_FOOT, 3)]
    table += [row_of(ON_FOOT, each) for each in masks + around + emulated]
    table += [row_of(recipe, each) for recipe in CURVED for each in masks]
    table += [row_of(recipe, each, each.name == "mask_no_fma") for recipe in STORIES for each in masks]
    table += [row_of(recipe, each) for recipe in STORIES for each in around if each.name in ("no_aslr", "loaded")]
    table += [row_of(VERIFIED, each) for each in (PLAIN, *masks, *emulated)]
    table += [repeats(DRIVEN, 3, True)]
    table += [row_of(DRIVEN_AGAIN, each, each.name in ("no_aslr", "malloc_perturb", "one_cpu")) for each in around]
    table += [row_of(DRIVEN_VERIFIED, each, each.name in ("mask_no_fma", "mask_no_sse4")) for each in masks + emulated]
    for recipe in (PICTURES, PORTABLE):
        table += [row_of(recipe.but("--threads", str(count)), PLAIN, label=f"{count}_threads") for count in (1, 3, 7)]
        table += [row_of(recipe, each) for each in around_pictures]
    table += [row_of(PORTABLE, each) for each in masks + emulated]
    # ./dev test has these as tests of their own.
    table += [Row("one_process.warm_and_forked", tests_pass), Row("environments.names_in_masks", names_in_masks)]
    return table


def carry_out(lab, row):
    """Returns word, what is wrong, seconds."""
    begin = time.monotonic()
    try:
        wrong = row.work(lab)
        word = "FAIL" if wrong else "ok"
    except (Impossible, OSError, RuntimeError) as error:
        word, wrong = "CANNOT", str(error)
    return word, wrong, time.monotonic() - begin


def summary(results):
    """By groups: rows, those that are not ok, seconds."""
    print("\ngroup              rows  not ok  seconds")
    for group in dict.fromkeys(row.name.split(".")[0] for row in results):
        members = {row: result for row, result in results.items() if row.name.split(".")[0] == group}
        bad = sum(word != "ok" for word, _, _ in members.values())
        print(f"{group:<18}{len(members):5}{bad:8}{sum(seconds for _, _, seconds in members.values()):9.1f}")


def run_all(lab, chosen, jobs):
    """Returns the words of all rows."""
    results = {}
    begin = time.monotonic()
    with ThreadPoolExecutor(jobs) as pool:
        running = {pool.submit(carry_out, lab, row): row for row in chosen}
        for count, future in enumerate(as_completed(running), 1):
            row = running[future]
            word, wrong, seconds = results[row] = future.result()
            print(f"{word:<7}{seconds:6.1f} s  {row.name:<36}{count}/{len(chosen)}", flush=True)
            if wrong:
                print("       " + wrong.replace("\n", "\n       "), flush=True)
                print(f"       again: ./dev determinism {row.name}", flush=True)
    if len(chosen) > 1:
        summary(dict(sorted(results.items(), key=lambda item: chosen.index(item[0]))))
    bad = [row.name for row in chosen if results[row][0] != "ok"]
    print(f"{len(chosen) - len(bad)} of {len(chosen)} rows ok, {time.monotonic() - begin:.0f} s")
    if bad:
        print("not ok: " + " ".join(bad))
    return {word for word, _, _ in results.values()}


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("rows", nargs="*", help="names or patterns; default: all")
    parser.add_argument("--bin", type=Path, required=True, help="the folder of reprise and its kin")
    parser.add_argument("--tools", type=Path, required=True, help="the folder of libm_canary and its kin")
    parser.add_argument("--work", type=Path, default=Path("determinism"), help="what is made goes here")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--fresh", action="store_true", help="make anew what the rows compare with")
    parser.add_argument("--references", action="store_true", help="make that for the rows of ./dev test, and end")
    parser.add_argument("--may-skip", action="store_true", help="exit status 77 for what this machine cannot do")
    parser.add_argument("--list-short", action="store_true", help="print the rows that ./dev test has, and end")
    return parser.parse_args()


def main():
    arguments = read_arguments()
    lab = Lab(arguments)
    table = rows(lab)
    if arguments.list_short:
        print(";".join(row.name for row in table if row.short), end="")
        return 0
    lab.work.mkdir(parents=True, exist_ok=True)
    if arguments.fresh or arguments.references:
        for recipe in RECIPES.values():
            remove(lab.reference(recipe))
    if arguments.references:
        return lab.make_reference("short") or lab.make_reference("long") or 0
    wanted = arguments.rows or ["*"]
    unknown = [word for word in wanted if not any(fnmatch.fnmatch(row.name, word) for row in table)]
    if unknown:
        return f"matrix.py: no row '{unknown[0]}'; there are " + ", ".join(row.name for row in table)
    chosen = [row for row in table if any(fnmatch.fnmatch(row.name, word) for word in wanted)]
    words = run_all(lab, chosen, arguments.jobs)
    return 77 if arguments.may_skip and words == {"CANNOT"} else int(words != {"ok"})


if __name__ == "__main__":
    sys.exit(main())
