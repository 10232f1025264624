#!/bin/sh
# Makes all_weathers.jpg again: one instant under the paper's 2 lightings x 9 weathers, and under fog, snow and dust.
#     docs/pictures/weathers.sh
# Needs a release build and ImageMagick.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../.."
reprise=${REPRISE:-build/release/bin/reprise}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

$reprise run scenarios/free_drive.lua --town town1 --cars 60 --walkers 60 --seed 3 --for 8 -o "$work/a.mcap"
sheet=
for light in noon sunset; do
    for weather in clear cloudy overcast wet wet_cloudy wet_overcast soft_rain mid_rain hard_rain; do
        sheet="$sheet ${weather}_$light"
    done
done
pictures=
for weather in $sheet foggy_noon foggy_morning snowy_noon snowfall_noon dust_storm clear_noon,clouds=0.4,fog=800; do
    $reprise render "$work/a.mcap" -o "$work/$weather" --weather "$weather" --ticks 120t --size 640x480
    pictures="$pictures $work/$weather/000120.png"
done
# The names hold no blanks.
montage $pictures -tile 3x -geometry 400x300+2+2 -background white -strip -sampling-factor 4:2:0 -quality 78 \
    "$here/all_weathers.jpg"
