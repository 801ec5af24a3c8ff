#!/bin/sh
# Builds Pluvia and renders the demo street on a rainy evening into out/lane.
set -eu
cd "$(dirname "$0")/.."
tools/build.sh
build/pluvia scenes lane -o out
build/pluvia render out/lane.glb --camera front --hour 17.75 --exposure 4.8 --view filmic --rain 10,100 --shutter 0.004 --wetness 1 --puddles 0.4 --spp 16 -o out/lane --overwrite
# The picture in the README: clean, rainy; light of the streaks, rain mask.
cd out/lane
oiiotool background.png rainy_100.png rain_layer_100.png rain_mask_100.png --ch 0,0,0 --mosaic 2x2 --resize 1200x600 -o overview.png
