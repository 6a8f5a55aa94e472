#!/bin/sh
# Builds the C++ oracles into the folder given: build.sh OUT_DIR
set -eu
here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd)
out=${1:?usage: build.sh OUT_DIR}
mkdir -p "$out"
cxx=${CXX:-g++}
# shellcheck disable=SC2046
"$cxx" -std=c++17 -O2 -Wall -Wextra -I"$here" "$here/sdf_oracle.cc" -o "$out/sdf_oracle" \
    $(pkg-config --cflags --libs sdformat12)
# shellcheck disable=SC2046
"$cxx" -std=c++17 -O2 -Wall -Wextra -I"$here" "$here/urdf_oracle.cc" -o "$out/urdf_oracle" \
    $(pkg-config --cflags --libs urdfdom)
