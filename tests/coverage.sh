#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How many lines of the libraries and the program the tests run, folder by folder and in all.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake/install_dependencies.sh build test check
cmake --preset coverage
cmake --build --preset coverage
ctest --preset coverage

# Each source file's report lies beside its object; what no test ran has none and counts as nothing run.
gcovr --root . --filter 'include/vantage/' --filter 'src/' --exclude-throw-branches build/coverage --txt /dev/stdout |
  awk '
    /^(include\/vantage|src)\// && NF >= 4 && $2 ~ /^[0-9]+$/ {
      folder = $1
      sub(/\/[^\/]*$/, "", folder)
      lines[folder] += $2
      run[folder] += $3
      all_lines += $2
      all_run += $3
    }
    END {
      for (folder in lines) {
        printf "%-28s %5d of %5d lines  %5.1f %%\n", folder, run[folder], lines[folder], 100 * run[folder] / lines[folder] | "sort"
      }
      close("sort")
      printf "%-28s %5d of %5d lines  %5.1f %%\n", "in all", all_run, all_lines, 100 * all_run / all_lines
    }'
