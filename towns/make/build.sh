#!/bin/sh
# Builds a town's network from its plain sources: build.sh town1|town2 [FOLDER]
# FOLDER (default: the town's own) gets NAME.net.xml. Same sources, same bytes: the comment in which
# netconvert notes date and call is taken out, and main roads lose the stops that it gives them.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
name=$1
town=$here/../../scenarios/towns/$name
source=$town/$name
target=${2:-$town}/$name.net.xml

SUMO_HOME=${SUMO_HOME:-/usr/share/sumo} netconvert \
  --node-files "$source.nod.xml" --edge-files "$source.edg.xml" \
  --connection-files "$source.con.xml" --type-files "$source.typ.xml" \
  --output-file "$target.part" --xml-validation never \
  --walkingareas --no-turnarounds --rectangular-lane-cut --opposites.guess \
  --junctions.corner-detail 8 --junctions.internal-link-detail 12 --junctions.limit-turn-speed 5.5 \
  --default.crossing-width 3 --offset.disable-normalization --precision 3 \
  --tls.default-type static --tls.cycle.time 40 --tls.yellow.time 3 --tls.allred.time 2 >&2
sed '/^<!-- generated on/,/^-->/d' "$target.part" >"$target.bare"
"$here/stop_signs.py" <"$target.bare" >"$target"
rm "$target.part" "$target.bare"
