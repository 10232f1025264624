"""Environments in which a run must give the same bytes: each is words that go before a command.

Because they are only words, environments can be joined, and a failing one can be typed in a shell.
"""

import contextlib
import os
import shlex
import subprocess
import threading
from dataclasses import dataclass
from typing import Callable


class Impossible(Exception):
    """This machine cannot make the environment."""


@dataclass(frozen=True)
class Environment:
    name: str
    words: tuple = ()  # before the command
    why: str = ""
    proof: tuple = ()  # a command that, in this environment, ...
    shows: str = ""  # ... prints this: the environment has the effect that it is here for
    machine: bool = False  # is about the machine around the process, not about the process
    busy: int = 0  # processes that keep the machine busy meanwhile
    memory_disk: bool = False  # the output goes to a file system in memory
    prepare: Callable = lambda: None  # makes what the words name

    def prove(self):
        """Throws Impossible when it is not what it says: a row would pass that shows nothing."""
        self.prepare()
        if self.proof:
            command = [*self.words, *self.proof]
            shown = output_of(command).strip()
            if shown != self.shows:
                raise Impossible(f"no effect: {shlex.join(command)} says {shown}, expected {self.shows}")


def output_of(command):
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    except OSError as error:
        raise Impossible(f"{error}; is a package of packages.txt missing?") from error
    if done.returncode != 0:
        raise Impossible(f"{shlex.join(command)[:200]}\n{done.stdout}{done.stderr}")
    return done.stdout


def shell(setup):
    """Runs the command in a shell that did `setup` first."""
    return ("bash", "-c", setup + '; exec "$@"', "bash")


def variables(**values):
    return ("env", *(f"{key}={value}" for key, value in values.items()))


def mask(*features):
    """glibc as it would be on a CPU without these features. Wrong names are silently ignored."""
    return variables(GLIBC_TUNABLES="glibc.cpu.hwcaps=" + ",".join("-" + each for each in features))


def make_german_locale(folder):
    """A locale with a decimal comma, made below `folder`; the system need not have it."""
    made = folder / "de_DE.UTF-8"
    if (made / "LC_NUMERIC").exists():
        return
    folder.mkdir(parents=True, exist_ok=True)
    scratch = folder / f"new.{os.getpid()}.{threading.get_ident()}"
    command = ["localedef", "-i", "de_DE", "-f", "UTF-8", str(scratch)]
    done = subprocess.run(command, capture_output=True, text=True)
    # localedef says 1 for warnings as well; what counts is what it wrote.
    if not (scratch / "LC_NUMERIC").exists():
        raise Impossible(f"{shlex.join(command)}: {done.stderr.strip()}; is the package locales installed?")
    with contextlib.suppress(OSError):  # somebody else was faster
        scratch.rename(made)


def german_locale(folder):
    return Environment(
        "de_locale",
        variables(LOCPATH=folder, LC_ALL="de_DE.UTF-8", LANG="de_DE.UTF-8", LANGUAGE="de"),
        "decimal commas",
        ("printf", "%.2f", "1,5"),
        "1,50",
        prepare=lambda: make_german_locale(folder),
    )


TERMINAL = ("bash", "-c", 'exec script -qec "exec $(printf "%q " "$@")" /dev/null', "bash")

MASKS = {
    "no_fma": ("FMA", "FMA4"),
    "no_avx2": ("AVX2", "FMA", "FMA4", "AVX512F"),
    "no_avx": ("AVX", "AVX2", "FMA", "FMA4", "AVX512F"),
    "no_sse4": ("SSE4_1", "SSE4_2", "AVX", "AVX2", "FMA", "FMA4"),
}

# qemu's models: without FMA, with and without SSE4, and with everything.
CPUS = {"Nehalem": "sse2", "qemu64": "sse2", "Haswell": "fma", "max": "fma"}


def masked_cpus(canary):
    return [
        Environment(f"mask_{name}", mask(*features), "glibc without " + ", ".join(features), (canary,), "sse2")
        for name, features in MASKS.items()
    ]


def emulated_cpus(canary):
    return [
        Environment(f"qemu_{cpu}", ("qemu-x86_64", "-cpu", cpu), "an emulated CPU", (canary,), maths)
        for cpu, maths in CPUS.items()
    ]


def in_bash(code):
    return ("bash", "-c", code)


def surroundings(work, canary, wrong_maths):
    """What users meet on one CPU. `work`: a folder to make things in."""
    first_cpu = str(min(os.sched_getaffinity(0)))
    heap = dict(GLIBC_TUNABLES="glibc.malloc.arena_max=1:glibc.malloc.mmap_threshold=4096:glibc.malloc.tcache_count=0",
                MALLOC_CONF="narenas:1,tcache:false,dirty_decay_ms:0")  # fmt: skip
    junk = dict(MALLOC_PERTURB_=165, MALLOC_CONF="junk:true")
    large = variables(**{f"REPRISE_FILLER_{i}": "x" * 100_000 for i in range(12)})
    nowhere = "/nonexistent"
    home, input_is_closed = in_bash("echo ${HOME-none}"), in_bash("test -e /proc/$$/fd/0 || echo closed")
    return [
        Environment("no_aslr", ("setarch", "-R"), "addresses without randomness",
                    ("cat", "/proc/self/personality"), "00040000"),
        Environment("empty_environment", ("env", "-i"), "not one variable", ("env",), ""),
        Environment("large_environment", large, "1.2 MB of variables shift the stack",
                    in_bash("env | wc -c | cut -c 1-2"), "12"),
        german_locale(work / "locales"),
        Environment("time_zone", variables(TZ="Asia/Kathmandu"), "another time zone",
                    ("date", "-d@0", "+%H:%M"), "05:30"),
        Environment("malloc_perturb", variables(**junk), "memory is full of 0x5a or 0xa5, also when freed"),
        Environment("malloc_tunables", variables(**heap), "another heap layout"),
        Environment("malloc_of_glibc", variables(LD_PRELOAD="libstdc++.so.6:libc.so.6"), "no jemalloc",
                    in_bash("echo $LD_PRELOAD"), "libstdc++.so.6:libc.so.6"),
        Environment("one_cpu", ("taskset", "-c", first_cpu), "threads take turns", ("nproc",), "1"),
        Environment("nice", ("nice", "-n", "19"), "everybody else comes first", ("nice",), "19", machine=True),
        Environment("loaded", (), "four busy processes beside it", machine=True, busy=4),
        Environment("bind_now", variables(LD_BIND_NOW=1), "all symbols bound at the start"),
        Environment("preload", variables(LD_PRELOAD=wrong_maths), "a library with a sin of its own comes first",
                    (canary,), "neither"),
        Environment("other_folder", ("env", "-C", "/"), "another working directory", ("pwd",), "/"),
        Environment("no_home", ("env", "-u", "HOME", "-u", "USER", "-u", "PATH"), "no home, user or path",
                    home, "none"),
        Environment("other_home", variables(HOME=nowhere), "a home that is not there", home, nowhere),
        Environment("sumo_home", variables(SUMO_HOME=nowhere), "SUMO's own variable, wrong"),
        Environment("stack_64MB", shell("ulimit -s 65536"), "a large stack: maps memory elsewhere",
                    in_bash("ulimit -s"), "65536"),
        Environment("stack_1MB", shell("ulimit -s 1024"), "a small stack", in_bash("ulimit -s"), "1024"),
        Environment("few_files", shell("ulimit -n 32"), "32 open files at most", in_bash("ulimit -n"), "32"),
        Environment("umask", shell("umask 077"), "files for the owner alone", in_bash("umask"), "0077"),
        Environment("closed_input", shell("exec <&-"), "file 0 is free for the first that opens one",
                    input_is_closed, "closed"),
        Environment("terminal", TERMINAL, "a terminal: the progress line is on",
                    in_bash("test -t 2 && echo yes"), "yes"),
        Environment("memory_disk", (), "the trace goes to a file system in memory", machine=True, memory_disk=True),
    ]
