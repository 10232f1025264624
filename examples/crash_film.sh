#!/bin/bash
# A minute of a crash and of the queue behind it, as two films: from straight above, and from behind who rams.
#
#   examples/crash_film.sh [FOLDER]      REPRISE: the program (default: build/release/bin/reprise)
#
# Half of the ticks at 480x360, about two minutes a film on two cores. SIZE and EVERY ask for other ones.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
reprise=$(realpath "${REPRISE:-$here/../build/release/bin/reprise}")
out=${1:-crash_film}
mkdir -p "$out"
"$reprise" run "$here/crash_and_queue.lua" -o "$out/crash.mcap"
film() { # NAME PRESET ACTOR MORE...
    local name=$1 preset=$2 actor=$3
    shift 3
    "$reprise" render "$out/crash.mcap" -o "$out/$name.mp4" --preset "$preset" --actor "$actor" --overlay \
        --size "${SIZE:-480x360}" --every "${EVERY:-2}" "$@"
}
film from_above top hit --distance 45
film from_behind chase rammer --distance 9
echo "$out/from_above.mp4, $out/from_behind.mp4"
