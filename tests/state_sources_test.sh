#!/usr/bin/env bash
# The build fingerprint covers every source that a run's state comes out of, however deep it lies:
# state_sources_test.sh SOURCE BUILD
set -euo pipefail
source=$(realpath "$1")
list=$2/generated/state_sources.txt
rooms="world ground walkers towns scripting traffic drivers replay kernel"
(cd "$source" && find $rooms -name '*.cpp' -o -name '*.h' -o -name '*.fbs' -o -name '*.lua' -o -name '*.in') |
    sed "s|^|$source/|" | sort >"$list.wanted"
diff <(sort "$list") "$list.wanted" || {
    echo "cmake/Versions.cmake and the tree differ (>: a source that is not in the fingerprint)"
    exit 1
}
for room in $rooms; do
    grep -q "^$source/$room/.*/.*\.cpp$" "$list" || grep -q "^$source/$room/[^/]*\.cpp$" "$list" || {
        echo "nothing of $room/ is in the fingerprint"
        exit 1
    }
done
# A deep file that changes must change the digest.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
deep=$(grep -m 1 '/ground/mesh/.*\.cpp$' "$list")
digest() { cmake -DOUTPUT="$work/$1.h" -DNAME=D "-DSOURCES=$2" -P "$source/cmake/SourceDigest.cmake" && cat "$work/$1.h"; }
cp "$deep" "$work/changed.cpp"
before=$(digest before "$work/changed.cpp")
echo "// changed" >>"$work/changed.cpp"
after=$(digest after "$work/changed.cpp")
[[ $before != "$after" ]] || {
    echo "a change of $deep leaves the digest as it was"
    exit 1
}
