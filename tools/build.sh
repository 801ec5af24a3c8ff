#!/bin/sh
# Installs the Debian packages that are missing (as root or through sudo) and builds Pluvia into build/.
set -eu
cd "$(dirname "$0")/.."
packages="g++ cmake ninja-build pkg-config libembree-dev libopenimageio-dev openimageio-tools libopencolorio-dev
libopenexr-dev libwebp-dev libpng-dev libtinygltf-dev libdraco-dev libmeshoptimizer-dev libtbb-dev libfmt-dev nlohmann-json3-dev
libcli11-dev doctest-dev libyaml-cpp-dev libarchive-dev libxxhash-dev libjemalloc-dev"
missing=
for package in $packages; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
done
if [ -n "$missing" ]; then
    as_root=
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "build.sh: missing packages, and neither root nor sudo:$missing" >&2; exit 2; }
        as_root=sudo
    fi
    $as_root apt-get update -q
    # shellcheck disable=SC2086
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing
fi
[ -f build/build.ninja ] || cmake -S . -B build -G Ninja
cmake --build build
