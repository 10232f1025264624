#!/usr/bin/env python3
"""snippets_test.py REPRISE DOCUMENT ...: every Lua block of the documents runs.

A block that returns a scenario runs as it stands. Another one is what a run function could say: it is given the
actors that it names, `ego` ahead of which `lead` drives, and the places that earlier blocks of its document made.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

HEAD = """return scenario 'snippet' { town = 'town1', duration = 40, cars = 5, run = function()
local lane = pick_lane{ length = 80 }
local ego = spawn{ name = 'ego', model = 'sedan', lane = lane, s = 8, speed_kmh = 20 }
local lead = spawn{ name = 'lead', model = 'hatchback', lane = lane, s = 40, speed_kmh = 20 }
wait_ticks(1)
start(function() wait(4) ego:set_speed(0) end)
do
"""
TAIL = "\nend wait(0.1) end }\n"


def main():
    reprise, *documents = sys.argv[1:]
    failed = blocks = 0
    with tempfile.TemporaryDirectory() as folder:
        for document in map(pathlib.Path, documents):
            text = document.read_text()
            for block in re.finditer(r"^```lua\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
                code, line = block[1], text[: block.start()].count("\n") + 2
                if re.search(r"\.\.\. end", code):  # only a header is meant: an empty function does
                    code = re.sub(r"\.\.\. end", "end", code)
                script = pathlib.Path(folder, "snippet.lua")
                script.write_text(code if "return scenario" in code else HEAD + code + TAIL)
                done = subprocess.run([reprise, "run", script, "-o", f"{folder}/snippet.mcap"],
                                      capture_output=True, text=True)
                blocks += 1
                if done.returncode not in (0, 1):
                    failed += 1
                    print(f"{document.name}:{line}: {done.stderr.strip()}")
    print(f"{blocks} snippets, {failed} do not run")
    return 1 if failed or not blocks else 0


if __name__ == "__main__":
    sys.exit(main())
