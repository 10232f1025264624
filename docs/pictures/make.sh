#!/bin/sh
# Makes the gallery of docs/towns.md again: maps of the towns and what stands at eight spots of each, at clear noon;
# and the presets of docs/rendering.md.
#     docs/pictures/make.sh [FOLDER WITH Town07.xodr]
# And show.jpg, a page of `reprise show`. Needs a release build, ImageMagick and chromium. The maps of CARLA are not ours to ship: without the folder theirs is left as it is.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../.."
reprise=${REPRISE:-build/release/bin/reprise}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

jpeg() {  # jpeg FROM TO WIDTH QUALITY
    convert "$1" -resize "$3" -strip -interlace Plane -sampling-factor 4:2:0 -quality "$4" "$2"
}

map() {  # map TOWN NAME WIDTH
    $reprise town show "$1" -o "$work/map.png" --size 2400
    jpeg "$work/map.png" "$here/map_$2.jpg" "$3" 74
}

# Town, actor that carries the camera, name, tick, place on the actor, yaw, pitch, field of view.
spots='
town1 1 roundabout 820 13,2.4,3.6 2 -4 76
town1 2 square 560 0,-1,3.6 -38 -3 78
town1 3 park 520 -4,-2,3 -95 -3 84
town1 4 old_street 600 3,3.2,3 0 -1 70
town1 5 crossing 640 0,2.6,3.4 -8 -4 75
town1 6 shops 640 2,3,3 0 -1 72
town1 7 bend 620 2,3,3 10 -3 75
town1 8 village 600 0,4,3.2 -2 -2 72
town2 1 crossing 620 0,2.8,3.4 0 -3 75
town2 2 square 540 0,-1,3.2 -50 -2 80
town2 3 park 500 0,0,2.8 -100 -2 80
town2 4 quiet_street 490 3,3,3 0 -1 70
town2 5 side_street 540 0,4.5,3.2 22 -2 75
town2 6 avenue 560 6,3,3 18 2 75
town2 7 bend 560 2,3,3 -2 -2 75
town2 8 shops 560 0,3,3.2 14 -1 72
'

picture() {  # one line of spots
    $reprise render "$work/$1.mcap" -o "$work/frames" --weather clear_noon --actor "$2" --ticks "$4" \
        --mount="$5" --yaw="$6" --pitch="$7" --fov "$8" --size 1600x900
    jpeg "$work/frames/$(printf %06d "$4").png" "$here/$1_$3.jpg" 1200 82
    rm -r "$work/frames"
}

for town in town1 town2; do
    map $town $town 1200
    $reprise run "$here/$town.lua" -o "$work/$town.mcap"
done
echo "$spots" | while read -r town actor name tick mount yaw pitch fov; do
    [ -z "$town" ] || picture "$town" "$actor" "$name" "$tick" "$mount" "$yaw" "$pitch" "$fov"
done
cd "$here"
montage town1_roundabout.jpg town1_bend.jpg town1_old_street.jpg town1_crossing.jpg \
    town2_park.jpg town2_side_street.jpg town2_bend.jpg town2_square.jpg \
    -tile 4x -geometry 300x169+2+2 -background white -strip -quality 85 towns.jpg
cd "$here/../.."

$reprise run scenarios/child_runs_out.lua -o "$work/child.mcap"
for preset in chase top driver orbit; do
    $reprise render "$work/child.mcap" -o "$work/$preset" --preset $preset --overlay --size 480x360 --ticks 106t
done
montage "$work"/chase/*.png "$work"/top/*.png "$work"/driver/*.png "$work"/orbit/*.png \
    -tile 2x -geometry 480x360 -strip -quality 80 "$here/presets.jpg"

map tests/towns/village.osm village 600

$reprise run scenarios/cut_in.lua -o "$work/cut_in.mcap"
$reprise show "$work/cut_in.mcap"
chromium --headless --no-sandbox --window-size=1280,800 --virtual-time-budget=5000 --screenshot="$work/show.png" \
    "file://$work/cut_in.html#t=4.2&actor=ego"
jpeg "$work/show.png" "$here/show.jpg" 1280 80
[ $# -eq 0 ] || map "$1/Town07.xodr" Town07 900

# The ten scenarios of docs/scenarios.md, each at its instant.
instants='
cut_in_timed 4s ego
ccrs 24s ego
ccrb 4.5s ego
occluded_child 7.4s ego
red_light_runner 8.6s ego
unprotected_left 7s ego
overtake_cyclist 10.9s ego
jam 26s ego
lane_change_in_rain 8.8s ego
platoon 20s second
'
echo "$instants" | while read -r name at actor; do
    [ -n "$name" ] || continue
    $reprise run "scenarios/$name.lua" -o "$work/$name.mcap" >/dev/null
    $reprise render "$work/$name.mcap" --preset chase --actor "$actor" --overlay --ticks "$at" \
        -o "$work/$name" --size 480x270
done
montage $(echo "$instants" | while read -r name _; do [ -z "$name" ] || echo "$work/$name"/*.png; done) \
    -tile 2x -geometry +0+0 -strip -sampling-factor 4:2:0 -quality 80 "$here/scenarios.jpg"
