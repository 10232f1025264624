#!/usr/bin/env bash
# read_foxglove_test.sh PATH_OF_REPRISE PACKAGES_FOLDER WORK: an independent reader understands what we
# export.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
reprise=$1 packages=$2 work=$3
"$here/packages.sh" "$packages"
rm -rf "$work"
mkdir -p "$work"
"$reprise" run "$here/../../scenarios/child_runs_out.lua" -o "$work/a.mcap" >/dev/null
"$reprise" render "$work/a.mcap" -o "$work/pictures" --size 32x24 \
    --sensor rgb,lidar,radar --attribute range=60 --mount 1,0.2,1.6 --yaw 20 --pitch -5 >/dev/null
"$reprise" export "$work/a.mcap" --to foxglove -o "$work/a.foxglove.mcap" --images "$work/pictures"
cp "$here/read_foxglove.mjs" "$packages/" # modules are looked for from where the file lies
node "$packages/read_foxglove.mjs" "$reprise" "$work/a.mcap" "$work/a.foxglove.mcap" "$work/pictures"
