#!/bin/sh
# The maps in this folder are what make_maps.py writes: maps_test.sh
set -eu
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$here/make_maps.py" "$scratch" 2>/dev/null
for map in bridge.xodr quarter.net.xml lanes.net.xml; do
  cmp "$scratch/$map" "$here/$map"
done
