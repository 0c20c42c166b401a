#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds the command line and lets a robot explore the built-in world `rooms`.
# Usage: examples/demo.sh [output folder]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out="${1:-out/rooms}"

cmake/install_dependencies.sh build

if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER="${CMAKE_CXX_COMPILER_LAUNCHER:-ccache}"
fi
# The folder of tests/run.sh is used as it is; a new one is made without the tests.
if [[ ! -f build/release/build.ninja ]]; then
  cmake -S . -B build/release -G Ninja -DCMAKE_BUILD_TYPE=Release -DVANTAGE_BUILD_TESTS=OFF \
    -DVANTAGE_BUILD_EXAMPLES=OFF -DCMAKE_UNITY_BUILD=ON
fi
cmake --build build/release --parallel "$(nproc)" --target vantage

build/release/bin/vantage explore --world rooms --planner harmonic --sensor panoramic --out "$out"

echo
echo "The run, to be opened in a browser, its pictures and its report:"
for file in "$out/report.html" "$out"/*.png "$out/report.json"; do
  echo "  $file"
done
