#!/usr/bin/env python3
"""Every file of the project that a text or a comment names is there: paths.py [FOLDER]"""
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]).resolve()
tracked = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=root, text=True, capture_output=True, check=True).stdout.split()
tops = {name.split("/")[0] for name in tracked if "/" in name} | {"agents"}
made = re.compile(r"_generated\.h$|^world/.*Tick\.py$|fingerprint\.cpp$|_bfbs")
placeholder = re.compile(r"\b[A-Z]{4,}\b|NAME|FILE")
named = re.compile(r"(?<![\w./{$-])((?:" + "|".join(sorted(tops)) + r")/[\w./-]*\w\.(?:h|cpp|fbs|lua|py|sh|mjs|md|cmake|golden|json|xml|osm|xodr|txt|in))\b")
missing = []
for name in tracked:
    path = root / name
    if path.name == "CMakeLists.txt" or path.suffix not in (".h", ".cpp", ".fbs", ".lua", ".py", ".sh", ".mjs", ".md", ".cmake", ".txt", ".in", "") or not path.exists():
        continue
    for line, text in enumerate(path.read_text(errors="replace").splitlines(), 1):
        for match in named.finditer(text):
            places = (root, path.parent, root / "tests")
            if placeholder.search(match[1]) or made.search(match[1]):
                continue
            if not any((place / match[1]).exists() for place in places):
                missing.append(f"{name}:{line}: {match[1]} is not there")
print("\n".join(missing) or "every path that is named is there")
sys.exit(1 if missing else 0)
