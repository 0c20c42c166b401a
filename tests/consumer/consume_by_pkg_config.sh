#!/bin/sh
# SPDX-License-Identifier: MIT
# Usage: consume_by_pkg_config.sh <pkg-config> <folder of vantage.pc> <compiler> <source> <program>
# Compiles a program with one compiler call, as in a project without CMake, and runs it.
set -eu
PKG_CONFIG_PATH="$2"
export PKG_CONFIG_PATH
# shellcheck disable=SC2046  # flags must be split into words
"$3" -std=c++20 "$4" $("$1" --cflags --libs 'vantage >= 0.1') -o "$5"
"$5"
