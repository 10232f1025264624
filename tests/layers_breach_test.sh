#!/usr/bin/env bash
# The layer check must fail when the renderer names the kernel, and when Bullet leaks into a header.
set -euo pipefail
source=$1
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
for room in world process scripting traffic replay exchange render kernel cli; do
    mkdir -p "$copy/$room"
    cp "$source/$room"/*.{h,cpp} "$copy/$room/" 2>/dev/null || true
done
"$source/tests/layers_test.sh" "$copy" >/dev/null

echo '#include "kernel/kernel.h"' >>"$copy/render/sensors.h"
if "$source/tests/layers_test.sh" "$copy" >/dev/null; then
    echo "not found: the renderer includes the kernel"
    exit 1
fi
cp "$source/render/sensors.h" "$copy/render/sensors.h"

echo '#include <btBulletDynamicsCommon.h>' >>"$copy/kernel/kernel.h"
if "$source/tests/layers_test.sh" "$copy" >/dev/null; then
    echo "not found: Bullet in a public header"
    exit 1
fi
