#!/usr/bin/env bash
# read_trace_test.sh PATH_OF_REPRISE GENERATED_PYTHON PACKAGES_FOLDER WORK: the readers in Python, Lua
# and Node, which share no code, print the same of a real drive.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
reprise=$1 generated=$2 packages=$3 work=$4
mkdir -p "$work"
"$reprise" run "$here/../scenarios/free_drive.lua" -o "$work/a.mcap" --seed 7 --for 5 >/dev/null

PYTHONPATH=$generated /usr/bin/python3 "$here/read_trace.py" "$work/a.mcap" | tee "$work/python.txt"
(($(wc -l <"$work/python.txt") == 5))
lua5.4 "$here/read_trace.lua" "$work/a.mcap" "$reprise" >"$work/lua.txt"
diff "$work/python.txt" "$work/lua.txt"

"$here/../tests/node/packages.sh" "$packages" # may end with 77: skipped
cp "$here/read_trace.mjs" "$packages/"
node "$packages/read_trace.mjs" "$work/a.mcap" >"$work/node.txt"
diff "$work/python.txt" "$work/node.txt"
