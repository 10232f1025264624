#!/usr/bin/env python3
"""Writes reprise/schema.py from the FlatBuffers schemas and the vehicle catalogue: make_schema.py [--check]

--check writes nothing, and exits with 1 where the file is not what the schemas say.
"""
import hashlib
import pathlib
import pprint
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
# In the order of remote/CMakeLists.txt: the digest depends on it.
FILES = ["remote/wire.fbs"] + [f"world/{name}.fbs" for name in ("common", "tick", "traffic", "town", "episode")]
VEHICLES = ROOT / "world/models/vehicle_models.cpp"
TARGET = ROOT / "python/reprise/schema.py"


def digest():
    """As cmake/SourceDigest.cmake makes it."""
    each = [hashlib.sha256((ROOT / file).read_bytes()).hexdigest() for file in FILES]
    return hashlib.sha256("".join(each).encode()).hexdigest()[:16]


def blocks(text):
    """(kind, name, base, body) of each enum, struct and table; comments are gone."""
    text = re.sub(r"//.*", "", text)
    for match in re.finditer(r"\b(enum|struct|table)\s+(\w+)\s*(?::\s*(\w+))?\s*\{([^}]*)\}", text):
        yield match.groups()


def read():
    enums, structs, tables = {}, {}, {}
    for file in FILES:
        space = file.split("/")[0]
        for kind, name, base, body in blocks((ROOT / file).read_text()):
            name = f"{space}.{name}"
            if kind == "enum":
                value, values = 0, {}
                for item in filter(None, (part.strip() for part in body.split(","))):
                    word, _, number = (part.strip() for part in item.partition("="))
                    value = int(number, 0) if number else value
                    values[word] = value
                    value += 1
                enums[name] = (base, values)
                continue
            fields = re.findall(r"(\w+)\s*:\s*(\[?[\w.]+\]?)\s*(?:=[^;(]*)?(?:\(([^)]*)\))?\s*;", body)
            if kind == "struct":
                structs[name] = [(field, of) for field, of, _ in fields]
            else:
                tables[name] = {
                    field: (int(re.search(r"\bid:\s*(\d+)", notes).group(1)), of) for field, of, notes in fields
                }
    return enums, structs, tables


def vehicles():
    """(name, length, width, rear overhang) of each model of the catalogue, in its order."""
    rows = re.findall(r'^    \{"(\w+)",\s*\w+,\s*Livery::\w+,([^"]*)', VEHICLES.read_text(), re.MULTILINE)
    found = []
    for name, numbers in rows:
        length, width, _, _, rear_overhang = (float(number) for number in numbers.split(",")[:5])
        found.append((name, length, width, rear_overhang))
    return found


def text():
    enums, structs, tables = read()
    show = lambda noun: pprint.pformat(noun, width=116, sort_dicts=False)
    return (
        '"""Made by make_schema.py from world/*.fbs, remote/wire.fbs and world/models/vehicle_models.cpp: change those."""\n\n'
        f'DIGEST = "{digest()}"\n\n'
        f"# name: (type, values)\nENUMS = {show(enums)}\n\n"
        f"# name: fields in their order, without padding\nSTRUCTS = {show(structs)}\n\n"
        f"# name: field: (id, type)\nTABLES = {show(tables)}\n\n"
        "# Of the catalogue, which a tick's `model` is an index of: name, length, width, rear bumper to rear axle [m]\n"
        f"VEHICLES = {show(vehicles())}\n"
    )


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        if not TARGET.exists() or TARGET.read_text() != text():
            sys.exit(f"{TARGET.relative_to(ROOT)} is not what the schemas say: call python/make_schema.py")
    else:
        TARGET.write_text(text())
