#!/bin/sh
# Builds Pluvia and renders the demo street on a rainy evening into out/lane.
set -eu
cd "$(dirname "$0")/.."
tools/build.sh
build/pluvia scenes lane -o out
build/pluvia render out/lane.glb --camera front --hour 18.2 --rain 10,50 --view filmic -o out/lane --overwrite
