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
# What else becomes of a trace: stripped, cut, joined, recovered, branched.
cd "$work"
for level in inputs core keyed; do
    "$reprise" strip cut_in.mcap --level $level -o cut_in_$level.mcap >/dev/null
done
"$reprise" slice cut_in.mcap --ticks ..70 -o slice_head.mcap >/dev/null
"$reprise" slice cut_in.mcap --ticks 71.. -o slice_tail.mcap >/dev/null
"$reprise" slice cut_in_keyed.mcap --ticks 30..99 -o slice_keyed.mcap >/dev/null
"$reprise" merge slice_tail.mcap slice_head.mcap -o merged.mcap >/dev/null
head -c "$(($(stat -c %s cut_in.mcap) * 3 / 4))" cut_in.mcap >cut_off.partial
"$reprise" recover cut_off.partial -o recovered.mcap >/dev/null || (($? == 3))
printf "return scenario 'brake' { run = function() actor('ego'):set_speed(0) wait(3) end }" >brake.lua
"$reprise" branch cut_in.mcap --at 4.0s --script brake.lua -o branched.mcap >/dev/null || (($? == 1))
cp "$here/read_traces.mjs" "$packages/" # modules are looked for from where the file lies
node "$packages/read_traces.mjs" "$reprise" "$work"
