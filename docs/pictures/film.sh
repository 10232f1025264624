#!/bin/sh
# Makes a film of 20 s: a drive under four weathers side by side, which pass into night.
#     docs/pictures/film.sh [FILM.mp4]
# Needs a release build. 640x360: about ten minutes of one core; SIZE and EVERY ask for others.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
reprise=$(realpath "${REPRISE:-$here/../../build/release/bin/reprise}")
out=${1:-drive.mp4}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$reprise" run "$here/../../scenarios/free_drive.lua" --town town1 --cars 60 --walkers 60 --seed 3 --for 20 -o "$work/a.mcap"
"$reprise" render "$work/a.mcap" -o "$out" --preset chase --size "${SIZE:-640x360}" --every "${EVERY:-1}" \
    --compare 'clear_noon;hard_rain_sunset;0s:foggy_noon,20s:clear_night;cloudy_noon,snow=2,snow_cover=0.8'
