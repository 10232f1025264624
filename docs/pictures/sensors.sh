#!/bin/sh
# Makes sensors.jpg: one moment as every sensor sees it.
#     docs/pictures/sensors.sh
# Needs a release build, ImageMagick and numpy.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
reprise=$(realpath "${REPRISE:-$here/../../build/release/bin/reprise}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$reprise" run "$here/../../scenarios/free_drive.lua" --town town1 --cars 160 --walkers 160 --seed "${SEED:-5}" --for 14 -o "$work/a.mcap"
tick=${TICK:-220}
"$reprise" render "$work/a.mcap" -o "$work/s" --sensor rgb,depth,semantic,instance,normals,flow --boxes --ticks "${tick}t" --size 640x480
"$reprise" render "$work/a.mcap" -o "$work/s" --sensor lidar,radar --mount 0,0,1.9 --attribute channels=64,range=100,points_per_second=1200000,upper_fov=10,lower_fov=-25 --points npy --ticks "${tick}t"
/usr/bin/python3 "$here/sensors.py" "$work/s" "$(printf %06d "$tick")" "$work"
montage -font DejaVu-Sans $(for one in rgb depth semantic instance normals flow lidar radar boxes; do echo -label $one "$work/$one.ppm"; done) \
    -tile 3x -geometry 400x300+2+2 -background white -strip -sampling-factor 4:2:0 -quality 78 "$here/sensors.jpg"
