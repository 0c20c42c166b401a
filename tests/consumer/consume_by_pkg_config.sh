#!/bin/sh
# SPDX-License-Identifier: MIT
# consume_by_pkg_config.sh <pkg-config> <folder of vantage.pc> <compiler> <source> <program>
# One compiler call, as a project without CMake would write it, and what it made.
set -eu
PKG_CONFIG_PATH="$2"
export PKG_CONFIG_PATH
# shellcheck disable=SC2046  # flags are words to be split
"$3" -std=c++20 "$4" $("$1" --cflags --libs 'vantage >= 0.1') -o "$5"
"$5"
