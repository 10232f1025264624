#!/usr/bin/env bash
# What ./dev install leaves serves somebody else's project: its driver drives, its kernel steps.
# usage: package_test.sh SOURCE BUILD SCRATCH
set -euo pipefail
source=$1 build=$2 scratch=$3
fail() {
    echo "$*" >&2
    exit 1
}
rm -rf "$scratch"
mkdir -p "$scratch"
cmake --install "$build" --prefix "$scratch/prefix" >"$scratch/install.log"
cmake -S "$source/tests/package" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$scratch/prefix" -DEXAMPLES="$source/examples" >"$scratch/configure.log"
cmake --build "$scratch/build" >"$scratch/build.log" || fail "$(tail -40 "$scratch/build.log")"

cd "$source"
"$scratch/build/hello_tick" | tail -1
run=$scratch/prefix/bin/reprise
"$run" run examples/external.lua --for 20 --driver ego="$scratch/build/pid_driver" -o "$scratch/a.mcap" >"$scratch/run.log" ||
    [[ $? == 1 ]] || fail "$(cat "$scratch/run.log")"
"$run" verify "$scratch/a.mcap"
REPRISE=$run "$scratch/build/episodes" | tail -1
for library in sumo Bullet lua; do
    for client in pid_driver episodes; do
        ldd "$scratch/build/$client" | grep -qi "$library" && fail "the client library needs $library"
    done
done
rm -rf "$scratch"
