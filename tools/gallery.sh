#!/bin/sh
# The sheets of streets in the README. Three streets by day, at dusk and at night, dry and in rain of 50 mm/h, as physics
# has it and as the paper's pictures have it, at 2048x1024; and the other five. Started again, it goes on where it ended.
set -eu
cd "$(dirname "$0")/.."
spp=${1:-8}  # samples; a pixel of the sheets has six times as many
size=2048x1024
out=out/gallery
mkdir -p $out
tools/build.sh
build/pluvia scenes lane citystreet japanesestreet avenue terrace brickyard backstreet stationstreet -o $out

render() {  # name scene camera hour, and what else the picture wants
    folder=$out/$1
    [ -f "$folder.png" ] && return
    scene=$2 camera=$3 hour=$4
    shift 4
    build/pluvia render "$out/$scene.glb" --camera "$camera" --hour "$hour" --city-glow city --view filmic --spp "$spp" \
        --size "$size" "$@" -o "$folder" --overwrite
    picture=background
    [ -f "$folder/rainy_050.png" ] && picture=rainy_050
    cp "$folder/$picture.png" "$folder.part.png"
    rm "$folder/frame.exr"
    mv "$folder.part.png" "$folder.png"
}

sheet() {  # name rows pictures...
    file=$out/gallery_$1.jpg rows=$2
    shift 2
    oiiotool "$@" --mosaic "3x$rows" --resize "2400x$((400 * rows))" --compression jpeg:85 -o "$file"
}

wet="--rain 50 --wetness 1 --puddles 0.4 --ripples 50"
for street in lane/front citystreet/front japanesestreet/camera1; do
    scene=${street%/*} camera=${street#*/}
    pictures=
    for hour in 12 17.6 20; do
        name=$scene-$hour
        render "$name-dry" "$scene" "$camera" $hour --weather fair
        # shellcheck disable=SC2086
        render "$name-physical" "$scene" "$camera" $hour $wet
        # shellcheck disable=SC2086
        render "$name-paper" "$scene" "$camera" $hour $wet --composition paper --streak-distance 1.78 --streak-share 0.024
        pictures="$pictures $out/$name-dry.png $out/$name-physical.png $out/$name-paper.png"
    done
    # shellcheck disable=SC2086
    sheet "$scene" 3 $pictures
done

size=1024x512 spp=$((3 * spp))
render avenue avenue front 12 --weather fair
render stationstreet stationstreet front 12 --weather fair
for street in terrace/12 brickyard/17.6 backstreet/20 stationstreet/20; do
    # shellcheck disable=SC2086
    render "${street%/*}-${street#*/}" "${street%/*}" front "${street#*/}" $wet
done
sheet others 2 $out/avenue.png $out/terrace-12.png $out/brickyard-17.6.png \
    $out/stationstreet.png $out/backstreet-20.png $out/stationstreet-20.png
