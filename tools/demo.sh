#!/bin/sh
# Builds Pluvia and renders the demo street on a rainy evening into out/lane.
set -eu
cd "$(dirname "$0")/.."
tools/build.sh
build/pluvia scenes lane -o out
build/pluvia render out/lane.glb --camera front --hour 17.75 --exposure 4.8 --view filmic --rain 10,100 --shutter 0.004 -o out/lane --overwrite
oiiotool out/lane/background.png out/lane/rain_layer_100.png out/lane/depth.png --autocc --ch 0,0,0 out/lane/rainy_100.png --mosaic 2x2 -o out/lane/overview.png
