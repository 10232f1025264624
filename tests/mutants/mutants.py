#!/usr/bin/env python3
"""Do the tests bite? Makes a copy of the sources with every fault of mutants.toml in it, switched off, and runs
the tests that should notice each one, switched on.

    mutants.py copy TREE                 the copy; only what has changed is written
    mutants.py fit                       is what they replace still there?
    mutants.py targets                   the test programs that are needed, and what they call
    mutants.py run BUILD [NAME ...]      kills them (default: all); exit 1: one survived
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
SOURCES = HERE.parent.parent
TIME_LIMIT = 200  # [s] of one test program for one mutant; an endless loop is killed by it
WIDE_TIME_LIMIT = 400  # [s] where whole programs run
SLOW = ("cli_test", "towns_test", "render_test")  # asked last


class Fault(Exception):
    """The list does not fit the sources, or the tests fail without any mutant."""


def read_mutants():
    mutants = tomllib.loads((HERE / "mutants.toml").read_text())["mutant"]
    for mutant in mutants:
        mutant.setdefault("edits", [{"was": mutant.get("was"), "now": mutant.get("now")}])
    names = [mutant["name"] for mutant in mutants]
    if len(set(names)) != len(names):
        raise Fault("a name is there twice")
    return mutants


def mutated(path, text, mutants):
    """The file with all its mutants in it. Each replaces a text that stands there exactly once."""
    places = []
    for mutant in mutants:
        for edit in mutant["edits"]:
            if text.count(edit["was"]) != 1:
                raise Fault(f"{mutant['name']}: {path} has {text.count(edit['was'])} places like: {edit['was'].strip()}")
            begin = text.index(edit["was"])
            switch = f'::reprise::mutants::is_on("{mutant["name"]}")'
            places.append((begin, begin + len(edit["was"]), edit["now"].replace("MUTANT", switch), mutant["name"]))
    places.sort()
    out, at = '#include "tests/mutants/mutant.h"\n', 0
    for begin, end, now, name in places:
        if begin < at:
            raise Fault(f"{name}: its place in {path} is that of another mutant")
        out += text[at:begin] + now
        at = end
    return out + text[at:]


def fit():
    """Throws where the sources have moved on from the list."""
    by_file = {}
    for mutant in read_mutants():
        by_file.setdefault(mutant["file"], []).append(mutant)
    for name, mutants in by_file.items():
        if not (SOURCES / name).is_file():
            raise Fault(f"{mutants[0]['name']}: no such file: {name}")
        mutated(name, (SOURCES / name).read_text(), mutants)
    print(f"each of {sum(map(len, by_file.values()))} mutants has its place")


def copy(tree):
    """Everything git knows or would take, with the mutants in it."""
    by_file = {}
    for mutant in read_mutants():
        by_file.setdefault(mutant["file"], []).append(mutant)
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=SOURCES, check=True, capture_output=True, text=True,
    ).stdout.split("\0")
    wanted = {name for name in listed if name and (SOURCES / name).is_file()}
    if missing := set(by_file) - wanted:
        raise Fault(f"no such file: {', '.join(sorted(missing))}")
    for name in wanted:
        source, target = SOURCES / name, tree / name
        content = source.read_bytes()
        if name in by_file:
            content = mutated(name, content.decode(), by_file[name]).encode()
        if target.is_file() and target.read_bytes() == content:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
        target.chmod(source.stat().st_mode)
    for target in list(tree.rglob("*")):
        name = str(target.relative_to(tree))
        if target.is_file() and name not in wanted and not name.startswith("build/"):
            target.unlink()


def split(test):
    program, _, names = test.partition(":")
    return program, names or "*"


def run_tests(build, test, mutant, limit):
    """Which tests fail: [] none, None when there is nothing of that name."""
    program, names = split(test)
    with tempfile.TemporaryDirectory(prefix="reprise_mutant_") as scratch:
        report = pathlib.Path(scratch) / "report.json"
        environment = dict(os.environ, TMPDIR=scratch, GTEST_OUTPUT=f"json:{report}")
        environment.pop("REPRISE_MUTANT", None)
        if mutant:
            environment["REPRISE_MUTANT"] = mutant
        child = subprocess.Popen(
            [build / "tests" / program, f"--gtest_filter={names}"],
            cwd=scratch, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
        )
        try:
            code = child.wait(limit)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, 9)  # and whatever it started
            child.wait()
            return [f"{program}: time limit"]
        if not report.exists():
            return [f"{program}: ended by {code}"]
        suites = json.loads(report.read_text())["testsuites"]
    tests = [(f"{suite['name']}.{test['name']}", "failures" in test) for suite in suites for test in suite["testsuite"]]
    if not tests:
        return None
    failed = [name for name, is_failure in tests if is_failure]
    return failed or ([f"{program}: ended by {code}"] if code != 0 else [])


def check_without_mutants(build, tests, pool):
    """Tests that fail anyhow, or that are not there, would prove nothing."""
    tests = sorted(tests)
    for test, failed in zip(tests, pool.map(lambda test: run_tests(build, test, None, WIDE_TIME_LIMIT), tests)):
        if failed is None:
            raise Fault(f"{test}: no such test")
        if failed:
            raise Fault(f"{test}: fails without any mutant: {', '.join(failed)}")


def kill(build, mutant, programs):
    """How it died: (by which of its own tests, by which of all tests of these programs)."""
    killers = []
    for test in mutant["tests"]:
        killers += run_tests(build, test, mutant["name"], mutant.get("seconds", TIME_LIMIT)) or []
        if killers:
            return killers, []
    others = []
    for program in sorted(programs, key=lambda program: (program in SLOW, program)):
        others += run_tests(build, program, mutant["name"], WIDE_TIME_LIMIT) or []
        if others:
            break
    return killers, others


def told(names):
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def take_signals_again():
    """In the background, and under nohup, some are ignored; the tests of processes send them to themselves."""
    for number in (signal.SIGHUP, signal.SIGINT, signal.SIGQUIT):
        if signal.getsignal(number) == signal.SIG_IGN:
            signal.signal(number, signal.SIG_DFL)


def run(build, names, jobs, own_only):
    take_signals_again()
    mutants = read_mutants()
    if unknown := set(names) - {mutant["name"] for mutant in mutants}:
        raise Fault(f"no mutant {', '.join(sorted(unknown))}")
    mutants = [mutant for mutant in mutants if not names or mutant["name"] in names]
    programs = [] if own_only else sorted({split(test)[0] for mutant in read_mutants() for test in mutant["tests"]})
    begin = time.monotonic()
    survivors, strangers = [], []
    table = ["| mutant | what it breaks | killed by |", "| --- | --- | --- |"]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        check_without_mutants(build, {test for mutant in mutants for test in mutant["tests"]}, pool)
        deaths = pool.map(lambda mutant: kill(build, mutant, programs), mutants)
        for mutant, (own, others) in zip(mutants, deaths):
            verdict = told(own) if own else f"not by its own tests, but by {told(others)}" if others else "SURVIVED"
            print(f"{mutant['name']:38} {verdict}", flush=True)
            table.append(f"| {mutant['name']} | {mutant['breaks']} | {verdict} |")
            if not own:
                (strangers if others else survivors).append(mutant["name"])
    (build / "mutants.md").write_text("\n".join(table) + "\n")
    print(f"{len(mutants)} mutants, {len(survivors)} survived, {time.monotonic() - begin:.0f} s; table: {build}/mutants.md")
    if strangers:
        print(f"name better tests for: {', '.join(strangers)}")
    return 1 if survivors else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("copy").add_argument("tree", type=pathlib.Path)
    commands.add_parser("targets")
    commands.add_parser("fit", help="does each of them still have its place in the sources?")
    runner = commands.add_parser("run")
    runner.add_argument("build", type=lambda text: pathlib.Path(text).resolve())
    runner.add_argument("names", nargs="*")
    runner.add_argument("--jobs", type=int, default=os.cpu_count())
    runner.add_argument("--own", action="store_true", help="a mutant's own tests only; else a survivor meets all tests")
    options = parser.parse_args()
    try:
        if options.command == "copy":
            copy(options.tree)
        elif options.command == "fit":
            fit()
        elif options.command == "targets":
            print(" ".join(sorted({split(test)[0] for mutant in read_mutants() for test in mutant["tests"]})))
        else:
            return run(options.build, options.names, options.jobs, options.own)
    except Fault as fault:
        print(f"mutants: {fault}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
