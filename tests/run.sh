#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds everything and runs all tests. Further arguments go to ctest (tests/run.sh -R field).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake/install_dependencies.sh build test

# Recorded data beside the checkout, where there is any; without it those tests skip and say so.
if [[ -z "${VANTAGE_DATA:-}" && -d ../shared/data ]]; then
  VANTAGE_DATA="$(cd ../shared/data && pwd)"
  export VANTAGE_DATA
fi
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER="${CMAKE_CXX_COMPILER_LAUNCHER:-ccache}"
fi

jobs="$(nproc)"
cmake -S . -B build/release -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
  -DVANTAGE_BUILD_TESTS=ON -DVANTAGE_BUILD_EXAMPLES=ON -DCMAKE_UNITY_BUILD=ON -DVANTAGE_WARNINGS_AS_ERRORS="${VANTAGE_WARNINGS_AS_ERRORS:-OFF}"
cmake --build build/release --parallel "$jobs"
ctest --test-dir build/release --output-on-failure --no-tests=error --parallel "$jobs" "$@"
