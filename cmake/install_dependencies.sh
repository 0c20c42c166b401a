#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Usage: cmake/install_dependencies.sh <group>...
# Installs the missing packages of these groups (build, test, check, peer) in cmake/debian-packages.txt. Prints what it
# will install first; uses sudo only if needed.
set -euo pipefail
list="$(dirname "${BASH_SOURCE[0]}")/debian-packages.txt"

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "This is no Debian: nothing is installed here; cmake/debian-packages.txt names what must be there." >&2
  exit 0
fi

missing=()
while read -r package _ group; do
  for wanted in "$@"; do
    if [[ "$group" == "$wanted" && "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]]; then
      missing+=("$package")
    fi
  done
done < <(grep -v '^#' "$list")

if [[ ${#missing[@]} -eq 0 ]]; then
  exit 0
fi
as_root=()
if [[ $EUID -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "Packages are missing, and there is no sudo to install them with. As root:" >&2
    echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing what is missing from cmake/debian-packages.txt: ${missing[*]}"
# Hides the output unless the command fails.
log="$(mktemp)"
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update && "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
       apt-get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  tail -n 30 "$log" >&2
  echo "Installing ${missing[*]} failed." >&2
  exit 1
fi
