#!/bin/sh
# A recording of CARLA's recorder, seen again under other weathers: carla_again.jpg.
#     docs/pictures/carla_again.sh RECORDING.log TOWN[.xodr]
# Such a recording is not ours to ship; the picture's is scenario_runner's DistanceToLaneCenter.log (MIT), in Town01. Needs a release build and ImageMagick.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
reprise=$(realpath "${REPRISE:-$here/../../build/release/bin/reprise}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$reprise" import "$1" -o "$work/carla.mcap" --town "$2"
pictures=
for weather in clear_noon hard_rain_sunset clear_night snowfall_noon; do
    "$reprise" render "$work/carla.mcap" -o "$work/$weather" --preset chase --weather "$weather" --ticks "${TICK:-200t}" --size 800x450 --every 1
    pictures="$pictures $(ls "$work/$weather"/*.png)"
done
montage $pictures -tile 2x -geometry 560x315+2+2 -background white -strip -sampling-factor 4:2:0 -quality 80 "$here/carla_again.jpg"
