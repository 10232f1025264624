#!/usr/bin/env python3
"""Holds every include of the tree against ARCHITECTURE.md's picture: layers.py [FOLDER]

Prints each breach and exits with 1 when there is one:
  * a room includes another one that it may not know, or an inner room one above it;
  * a third-party header stands outside of its room, or in a header that other rooms include;
  * files include each other in a circle (x.h and x.cpp count as one);
  * a folder of code has no README.md, or is larger than a folder may be.
"""
import collections
import pathlib
import re
import sys

# Who may include whom.
ROOMS = {
    "world": "",
    "files": "world",
    "process": "world",
    "ground": "world",
    "walkers": "world ground",
    "towns": "world files process ground walkers",
    "scripting": "world",
    "traffic": "world",
    "drivers": "world",
    "remote": "world process",
    "replay": "world files",
    "exchange": "world files replay",
    "render": "world files ground",
    "kernel": "world process ground walkers scripting traffic drivers replay",
    "wheel": "world remote",
    "cli": "world files process ground walkers towns scripting traffic drivers remote replay exchange render kernel wheel",
}
# Inner rooms from the lowest to the highest: each may include those before it. "." is the room's own folder.
INNER = {
    "world": ". weather models lanes story external",
    "ground": "mesh paint .",
    "walkers": "map .",
    "towns": "check network maps furnish buildings . bridges import make",
    "traffic": "roads cars sight .",
    "drivers": "way control .",
    "kernel": "drill physics/bullet physics .",
    "render": "codecs shapes shapes/cars shapes/people shapes/buildings shapes/street trace scene look labels shade optics ranging readings map views overlay film .",
    "scripting": "lua run words .",
    "replay": "mcap . table compare golden score",
    "exchange": ". carla page",
    "cli": "options process fingerprint town trace golden external pictures measured dataset discover .",
}
# Where a header may stand: in the .cpp files and private headers of a room, or, with "+", in all its headers.
LIBRARIES = {
    r"lua\.hpp": "scripting",
    r"libsumo/": "traffic",
    r"pugixml\.hpp": "towns cli traffic",
    r"(bt|Bullet|LinearMath/)": "kernel/physics",
    r"(embree3|tbb)/": "render",
    r"opencv2/": "render",
    r"(png\.h|Imf)": "render/codecs",
    r"zstd\.h": "replay",
    r"xxhash\.h": "world",
    r"boost/polygon": "ground",
    r"boost/interprocess": "scripting",
    r"boost/graph": "traffic towns",
    r"boost/": "ground scripting traffic towns",
    r"CGAL/": "ground",
    r"recastnavigation/": "walkers",
    r"(osmium/|expat\.h)": "towns/maps",
    r"CLI/": "cli",
    r"SDL2/": "wheel",
    r"nlohmann/": "replay exchange cli towns/make",
    r"sqlite3\.h": "exchange",
    r"proj\.h": "exchange",
}
LARGEST = 40  # sources in one folder

root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]).resolve()
files = sorted(
    path.relative_to(root).as_posix()
    for room in ROOMS
    for path in (root / room).rglob("*")
    if path.suffix in (".h", ".cpp")
)
texts = {file: (root / file).read_text() for file in files}
breaches = []


def room_of(file):
    return file.split("/")[0]


def folder_of(file):
    return file.rsplit("/", 1)[0]


def inner_of(file):
    room, _, inside = folder_of(file).partition("/")
    return inside or "."


def module_of(file):
    return re.sub(r"\.(h|cpp)$", "", file)


def check_rooms(file, line, included):
    room, other = room_of(file), room_of(included)
    if other not in ROOMS:
        return
    where = f"{file}:{line}: includes {included}"
    if other != room:
        if other not in ROOMS[room].split():
            breaches.append(f"{where}: {room}/ may not know {other}/")
        return
    order = INNER.get(room, ".").split()
    own, its = inner_of(file), inner_of(included)
    for inner in (own, its):
        if inner not in order:
            breaches.append(f"{where}: {room}/{inner} is in no order of inner rooms")
            return
    if order.index(its) > order.index(own):
        breaches.append(f"{where}: {its} lies above {own} in {room}/")


def check_libraries(file, line, header):
    for pattern, rooms in LIBRARIES.items():
        if not re.match(pattern, header):
            continue
        allowed = any(file.startswith(room + "/") for room in rooms.split())
        private = file.endswith(".cpp") or "// Private to the room" in texts[file]
        if not (allowed and private):
            breaches.append(f"{file}:{line}: <{header}> stands outside of its room, or in a public header")
        return


def check_circles(graph):
    """Tarjan's strongly connected components."""
    index, low, stack, found = {}, {}, [], []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in sorted(graph[node]):
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            circle = stack[stack.index(node):]
            del stack[stack.index(node):]
            if len(circle) > 1:
                found.append(sorted(circle))

    sys.setrecursionlimit(10000)
    for node in sorted(graph):
        if node not in index:
            visit(node)
    for circle in found:
        breaches.append("files include each other in a circle: " + ", ".join(circle))


def check_folders():
    count = collections.Counter(folder_of(file) for file in files)
    for folder, sources in sorted(count.items()):
        if not (root / folder / "README.md").exists():
            breaches.append(f"{folder}/: no README.md that says what belongs here, and what never")
        if sources > LARGEST:
            breaches.append(f"{folder}/: {sources} sources; a folder holds at most {LARGEST}")


graph = collections.defaultdict(set)
for file in files:
    graph[module_of(file)]
    for line, text in enumerate(texts[file].splitlines(), 1):
        if match := re.match(r'#include "([^"]+)"', text):
            check_rooms(file, line, match[1])
            if match[1] in texts and module_of(match[1]) != module_of(file):
                graph[module_of(file)].add(module_of(match[1]))
        elif match := re.match(r"#include <([^>]+)>", text):
            check_libraries(file, line, match[1])
check_circles(graph)
check_folders()
print("\n".join(breaches) or f"{len(files)} files, no breach")
sys.exit(1 if breaches else 0)
