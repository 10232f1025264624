#!/usr/bin/env python3
"""pages_test.py REPRISE SOURCE PAGE ...: every command and every Python block of the pages runs as it stands.

A page is played in a fresh folder that has the project's examples, python and tests, and those scenarios that it names.
Commands are the lines of ```sh blocks, and of indented blocks that begin with `reprise` (with `$ reprise`: the lines
with a `$`; the others show what is said, and must be said so, in this order; `...` stands for any lines). What a page's reader has in mind stands in comments, which nobody sees:

    <!-- by hand: WHY -->             the next block is not run: it needs a person, another's file, minutes
    <!-- before: COMMAND -->          is done here
    <!-- where WORD: TEXT -->         from here on commands say TEXT in place of WORD; the shell may expand it
    <!-- python: STATEMENT -->        is done here, for the Python blocks of the page, which run together
    <!-- file NAME                    is here with this text; so is every block that begins with the comment
    TEXT                              `-- NAME` or `# NAME`
    -->

A command must succeed; with "(exit N)" in its comment that is its exit status, with "ends with Ctrl-C" it is ended so.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

SECONDS_TO_CTRL_C = 3
HEAD = """#!/bin/bash
failed=0
run() {  # LINE EXIT COMMAND [SHOWN]
    eval "$3" > .said 2>&1 < /dev/null
    local code=$?
    if [ $code != "$2" ]; then
        failed=1
        echo "$1: $3: exit status $code, expected $2"
        tail -n 20 .said
    fi
    [ -z "$4" ] || python3 .compare "$1" "$4" || failed=1
}
"""

COMPARE = """import sys
said, at = open(".said").read().splitlines(), 0
for line in sys.argv[2].splitlines():
    if line.strip() == "...":
        continue
    if line.rstrip() not in said[at:]:
        print(f"{sys.argv[1]}: shown, but not said (so, or there): {line}")
        sys.exit(1)
    at += said[at:].index(line.rstrip()) + 1
"""


class Page:
    """What there is to do, in its order, as a script."""

    def __init__(self, path, name, folder):
        self.path, self.name, self.folder = path, name, folder
        self.script, self.commands, self.skipped = [HEAD], 0, 0
        self.where = {}
        self.by_hand = False
        self.python = []
        lines = path.read_text().splitlines()
        self.at = 0
        while self.at < len(lines):
            self.take(lines)
        if self.python:
            self.write("blocks.py", "\n".join(self.python))
            self.run(0, "python3 blocks.py")

    def take(self, lines):
        first, line = self.at, lines[self.at]
        self.at += 1
        if line.startswith("<!--"):
            while "-->" not in lines[self.at - 1]:
                self.at += 1
            self.comment("\n".join(lines[first : self.at]))
        elif line.startswith("```"):
            while not lines[self.at].startswith("```"):
                self.at += 1
            self.fenced(first, line[3:], lines[first + 1 : self.at])
            self.at += 1
            self.by_hand = False
        elif line.startswith("    ") and (first == 0 or not lines[first - 1]):
            while self.at < len(lines) and (lines[self.at].startswith("    ") or self.goes_on(lines)):
                self.at += 1
            self.indented(first, [one[4:] for one in lines[first : self.at]])
            self.by_hand = False

    def goes_on(self, lines):
        return not lines[self.at] and self.at + 1 < len(lines) and lines[self.at + 1].startswith("    ")

    def comment(self, text):
        inside = text[4:].rsplit("-->", 1)[0].strip()
        key, _, rest = inside.partition(" ")
        if inside.startswith("by hand: "):
            self.by_hand = True
        elif key == "before:":
            self.run(self.at, rest)
        elif key == "where":
            word, _, replacement = rest.partition(": ")
            self.where[word] = replacement
        elif key == "python:":
            self.python.append(rest)
        elif key == "file":
            name, _, text = rest.partition("\n")
            self.write(name, text + "\n")

    def fenced(self, first, language, block):
        named = re.match(r"(?:--|#) (\w+\.(?:lua|py))$", block[0]) if block else None
        if named:
            self.write(named[1], "\n".join(block) + "\n")
        elif self.by_hand:
            self.skipped += 1
        elif language == "sh":
            self.run_all(first + 2, block)
        elif language == "python":
            self.python += block

    def indented(self, first, block):
        if not re.match(r"(\$ )?reprise ", block[0]):
            return
        if self.by_hand:
            self.skipped += 1
        elif block[0].startswith("$ "):
            starts = [at for at, line in enumerate(block) if line.startswith("$ ")]
            for at, end in zip(starts, [*starts[1:], len(block)]):
                self.run(first + 1 + at, block[at][2:], "\n".join(block[at + 1 : end]))
        else:
            self.run_all(first + 1, block)

    def run_all(self, first, block):
        for number, line in enumerate(block, first):
            if line.strip():
                self.run(number, line)

    def run(self, number, line, shown=""):
        self.commands += 1
        code = re.search(r"\(exit (\d)\)", line)
        expected = int(code[1]) if code else 0
        command = re.sub(r"\s+# .*", "", line)
        for word, replacement in self.where.items():
            command = command.replace(word, replacement)
        if "ends with Ctrl-C" in line:
            command = f"timeout --preserve-status -s INT {SECONDS_TO_CTRL_C} {command}"
            expected = 130
        self.script.append(f"run {self.name}:{number} {expected} {shlex.quote(command)} {shlex.quote(shown)}")

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def play(self, reprise, source):
        environment = dict(os.environ, PYTHONDONTWRITEBYTECODE="1", PYTHONPATH=f"{source}/python", HOME=str(self.folder))
        environment["PATH"] = f"{reprise.parent}:/usr/bin:{environment['PATH']}"  # Debian's python3 has what it needs
        self.write(".compare", COMPARE)
        self.write(".script", "\n".join(self.script) + "\nexit $failed\n")
        done = subprocess.run(["bash", ".script"], cwd=self.folder, env=environment, text=True, stdout=subprocess.PIPE, check=False)
        print(f"{self.name}: {self.commands} commands, {self.skipped} blocks by hand\n{done.stdout}", end="", flush=True)
        return done.returncode == 0


def furnish(folder, source, text):
    """Scenarios without their goldens, which commands may write; all else is only read."""
    for part in ("examples", "tests", "python"):
        (folder / part).symlink_to(source / part)
    (folder / "scenarios").mkdir()
    (folder / "scenarios/towns").symlink_to(source / "scenarios/towns")
    for name in set(re.findall(r"scenarios/\w+\.lua", text)):
        if (source / name).exists():
            shutil.copy(source / name, folder / name)


def main():
    reprise, source, *pages = map(pathlib.Path, sys.argv[1:])
    good, commands = True, 0
    for path in pages:
        with tempfile.TemporaryDirectory() as folder:
            furnish(pathlib.Path(folder), source.resolve(), path.read_text())
            page = Page(path, path.name, pathlib.Path(folder))
            good = page.play(reprise.resolve(), source.resolve()) and good
            commands += page.commands
    return 0 if good and commands else 1


if __name__ == "__main__":
    sys.exit(main())
