#!/bin/sh
# Makes optics.jpg again: what lenses, shutters and sensors do to one instant; docs/rendering.md says what each is.
#     docs/pictures/optics.sh
# Needs a release build and ImageMagick.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../.."
reprise=${REPRISE:-build/release/bin/reprise}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

$reprise run scenarios/free_drive.lua --town town1 --cars 60 --walkers 60 --seed 3 --for 8 -o "$work/a.mcap"

pictures=
take() {  # take NAME OPTIONS...
    name=$1
    shift
    $reprise render "$work/a.mcap" -o "$work/$name" --ticks 120t --size 640x480 "$@"
    found=$work/$name/000120.png
    [ -f "$found" ] || found=$work/$name/view/000120.png
    pictures="$pictures $found"
}
noon='--weather clear_noon'
take pinhole $noon
take Brown_and_Conrady $noon --attribute k1=-0.3,k2=0.08
take fisheye_of_200_degrees $noon --fov 200 --attribute lens=fisheye
take night_by_the_weather --weather clear_night
take noise_at_ISO_1600 --weather clear_night --attribute noise=1,iso=1600
take fixed_exposure_too_long $noon --attribute exposure_mode=manual,fstop=8,shutter_speed=100
take motion_blur_of_50_ms $noon --yaw 60 --attribute motion_blur=1,shutter_speed=20,samples=24
take rolling_shutter_of_50_ms $noon --yaw 60 --fov 30 --pitch=-2 --attribute readout_time=50
take events $noon --sensor dvs
# The names hold no blanks.
montage $pictures -tile 3x -geometry 400x300+2+2 -background white -strip -sampling-factor 4:2:0 -quality 78 "$here/optics.jpg"
