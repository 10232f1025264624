#!/usr/bin/env bash
# read_traces_test.sh PATH_OF_REPRISE WRITE_TRACES PACKAGES_FOLDER WORK: an independent reader
# understands what we write.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
reprise=$1 write_traces=$2 packages=$3 work=$4
"$here/packages.sh" "$packages"
rm -rf "$work"
mkdir -p "$work"
"$write_traces" "$work"
"$reprise" run "$here/../../scenarios/cut_in.lua" -o "$work/cut_in.mcap" --for 8 >/dev/null
"$reprise" run "$here/../../scenarios/free_drive.lua" -o "$work/free_drive.mcap" --for 3 >/dev/null
cp "$here/read_traces.mjs" "$packages/" # modules are looked for from where the file lies
node "$packages/read_traces.mjs" "$reprise" "$work"
