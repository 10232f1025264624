#!/bin/sh
# Makes README's pictures that have no script of their own: weathers.jpg, night.jpg, vehicles.jpg and pedestrians.jpg.
#     docs/pictures/readme.sh
# Needs a release build and ImageMagick.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../.."
reprise=${REPRISE:-build/release/bin/reprise}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

sheet() {  # sheet NAME TILES GEOMETRY QUALITY PICTURES...
    name=$1 tiles=$2 geometry=$3 quality=$4
    shift 4
    montage "$@" -tile "$tiles" -geometry "$geometry" -background white -strip -sampling-factor 4:2:0 -quality "$quality" "$here/$name.jpg"
}

# One instant: clear noon, hard rain at sunset, depth, classes.
$reprise run scenarios/free_drive.lua --town town1 --cars 100 --walkers 80 --seed 7 --for 8 -o "$work/a.mcap"
at='--preset chase --ticks 120t --size 800x500'
$reprise render "$work/a.mcap" -o "$work/noon" $at --weather clear_noon
$reprise render "$work/a.mcap" -o "$work/rain" $at --weather hard_rain_sunset
$reprise render "$work/a.mcap" -o "$work/labels" $at --sensor depth,semantic
sheet weathers 2x 800x500+3+3 80 "$work/noon/000120.png" "$work/rain/000120.png" \
    "$work/labels/depth/view/000120.png" "$work/labels/semantic/view/000120.png"

# A street by night, dry and wet, lamps in the rain, and dusk.
$reprise run scenarios/free_drive.lua --town town1 --cars 60 --walkers 60 --seed 3 --for 16 -o "$work/b.mcap"
$reprise render "$work/b.mcap" -o "$work/dry" --preset chase --ticks 300t --size 640x400 --weather clear_night
$reprise render "$work/b.mcap" -o "$work/wet" --ticks 300t --size 640x400 --weather wet_night
$reprise render "$work/b.mcap" -o "$work/drops" --ticks 190t --size 640x400 --weather mid_rain_night
$reprise render "$work/b.mcap" -o "$work/dusk" --preset chase --ticks 300t --size 640x400 --weather clear_noon,sun_altitude=-2
sheet night 2x 640x400+4+4 85 "$work"/dry/*.png "$work"/wet/*.png "$work"/drops/*.png "$work"/dusk/*.png

plaza() {  # plaza NAME OPTIONS...: what the script NAME.lua puts onto a wide road
    name=$1
    shift
    $reprise run "docs/pictures/$name.lua" --town docs/pictures/plaza.net.xml -o "$work/$name.mcap"
    $reprise render "$work/$name.mcap" -o "$work/$name" --actor 1 --yaw 180 --weather clear_noon "$@"
    convert "$work/$name"/*.png -strip -interlace Plane -sampling-factor 4:2:0 -quality 82 "$here/$name.jpg"
}
plaza vehicles --ticks 2 --mount=-27.5,1,4.2 --pitch -7 --size 1800x440 --fov 68
plaza pedestrians --ticks 40 --mount=-29,0,3.2 --pitch -11 --size 1800x620 --fov 58
