#!/usr/bin/env bash
# tests/checks/layers.py must find each kind of breach, at any depth: layers_breach_test.sh SOURCE
set -euo pipefail
source=$1
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
rooms="world process ground walkers towns scripting traffic drivers replay exchange render kernel cli"
(cd "$source" && cp -r --parents $rooms "$copy")
check() { python3 -B "$source/tests/checks/layers.py" "$copy"; }
check >/dev/null

# breach FILE LINE: found when LINE is added to FILE?
breach() {
    local file=$copy/$1
    cp "$file" "$copy/kept"
    echo "$2" >>"$file"
    if check >"$copy/found"; then
        echo "not found: '$2' in $1"
        exit 1
    fi
    cp "$copy/kept" "$file"
}

breach render/sensors.h '#include "kernel/kernel.h"'
breach render/shapes/people/figure.cpp '#include "kernel/kernel.h"'
breach drivers/driver.cpp '#include "ground/mesh/ground.h"'
breach kernel/kernel.h '#include <btBulletDynamicsCommon.h>'
breach kernel/roster.cpp '#include <btBulletDynamicsCommon.h>'
breach towns/network/place.h '#include <pugixml.hpp>'
breach render/shapes/people/figure.cpp '#include "render/look/look.h"'
breach world/digest.h '#include "world/tick.h"'
rm "$copy/world/README.md"
if check >/dev/null; then
    echo "not found: a folder without a README.md"
    exit 1
fi
