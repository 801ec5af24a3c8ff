#!/bin/sh
# Builds Pluvia and runs its tests, as many at a time as there are processors.
set -eu
cd "$(dirname "$0")/.."
tools/build.sh
ctest --test-dir build --output-on-failure --parallel "$(nproc)"
