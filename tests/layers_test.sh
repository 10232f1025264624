#!/usr/bin/env bash
# Shows every include that leaves a room for one it may not know, and every third-party header that
# is used outside its room or crosses a room's header. The table is ARCHITECTURE.md's.
set -euo pipefail
cd "${1:-$(dirname "$0")/..}"

declare -A may_include=(
    [world]=""
    [process]="world"
    [scripting]="world" [traffic]="world process" [replay]="world" [render]="world"
    [exchange]="world replay"
    [kernel]="world scripting traffic replay"
    [cli]="world process scripting traffic replay exchange render kernel"
)
# Where a library may be named: "room" in its .cpp files only, "room.h" in its headers too.
declare -A owner=(
    [lua.hpp]="scripting" [libsumo/]="traffic" [pugixml.hpp]="traffic cli"
    [bt]="kernel" [BulletDynamics/]="kernel" [BulletCollision/]="kernel" [LinearMath/]="kernel"
    [embree3/]="render" [tbb/]="render" [opencv2/]="render"
    [zstd.h]="replay" [xxhash.h]="world" [boost/]="world scripting" [CGAL/]="world" [recastnavigation/]="traffic"
    [osmium/]="traffic"
    [CLI/]="cli" [nlohmann/]="replay exchange cli" [sqlite3.h]="exchange" [proj.h]="exchange"
    [Eigen/]="world.h exchange.h traffic.h render.h kernel.h replay.h scripting.h cli.h"
)

found=0
show() {
    echo "$1"
    found=1
}

for room in "${!may_include[@]}"; do
    for other in "${!may_include[@]}"; do
        [[ $other == "$room" || " ${may_include[$room]} " == *" $other "* ]] && continue
        while read -r hit; do
            show "$hit   <- $room may not know $other"
        done < <(grep -rnE "#include \"$other/" "$room" --include='*.h' --include='*.cpp' || true)
    done
    for library in "${!owner[@]}"; do
        while IFS=: read -r file line text; do
            allowed=0
            for place in ${owner[$library]}; do
                [[ ${place%.h} == "$room" ]] || continue
                # A private header (x_internal kind) shares the room's library; public ones may not.
                [[ $file == *.cpp || $place == *.h ]] && allowed=1
                grep -q '^// Private to the room' "$file" && allowed=1
            done
            ((allowed)) || show "$file:$line:$text   <- third party outside its room, or in a public header"
        done < <(grep -rnE "#include <$library" "$room" --include='*.h' --include='*.cpp' || true)
    done
done
exit $found
