#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Reconstructs the bunny and the dragon of Vasquez-Gomez et al. on their table by every method and prints the tables of
# docs/results.md: evaluation/reconstruction_table.sh [WHAT...], where WHAT is among aimed paper hierarchical
# uniform gains (default: aimed paper hierarchical). Needs VANTAGE_DATA and a built program (VANTAGE=path/to/vantage
# names another). SETTINGS="CELL_M/MIN_UNKNOWN_CELLS ..." and OBJECTS="bunny dragon" select rows. Runs in the folder
# RESULTS (default: build/reconstruction) are not made again.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
: "${VANTAGE_DATA:?must name the folder with the objects}"
vantage=${VANTAGE:-$here/build/release/bin/vantage}
results=${RESULTS:-$here/build/reconstruction}
settings=${SETTINGS:-0.02/15 0.01/12} # cells in metres / unknown cells below which it stops
objects=${OBJECTS:-bunny dragon}
mkdir -p "$results"

value() { sed -n "s/^ *\"$2\": \"\{0,1\}\([^\",]*\).*/\1/p" "$1" | head -1; }

declare -A place=(
  [bunny]="--object $VANTAGE_DATA/meshes/stanford/bun_zipper.ply --place 3,0,0,0.323245,0.5,-0.5,-0.5,0.5"
  [dragon]="--object $VANTAGE_DATA/meshes/stanford/dragon_vrip_res2.ply
    --place 2.5,0.02718675,-0.02051875,0.2896195,0.7071067812,0,0,0.7071067812")

# row NAME TITLE OPTION...: one row for every object and setting.
row() {
  local name=$1 title=$2 object setting folder
  shift 2
  for object in $objects; do
    for setting in $settings; do
      folder=$results/$object-${setting/\//-}-$name
      if [[ ! -s $folder/report.json ]]; then
        echo "$object, $setting, $title" >&2
        # shellcheck disable=SC2086 # the options of an object are words
        "$vantage" reconstruct --table ${place[$object]} --object-box -0.4,-0.4,0.43,0.4,0.4,0.95 \
          --radius 1.5 --start -1.5,0,0.69 \
          --reference "$VANTAGE_DATA/nbv_reference/vpl/${object}_ref_smalltable_nobase.dat" --resolution "${setting%/*}" \
          --set min_unknown_cells="${setting#*/}" "$@" --out "$folder" > "$folder.txt" || { code=$?; [[ $code -eq 3 || $code -eq 4 ]]; }
      fi
      printf '| %s | %s | %s | %s | %s | %s | %.1f %% | %.1f | %.2f |\n' "$object" "${setting%/*}" "${setting#*/}" \
        "$title" "$(value "$folder/report.json" outcome)" "$(value "$folder/report.json" views)" \
        "$(value "$folder/report.json" surface_coverage | awk '{ print 100 * $1 }')" \
        "$(value "$folder/report.json" path_length_m)" \
        "$(sed -n '/"plan": {/,/}/s/.*"median": \([^,]*\).*/\1/p' "$folder/report.json" | awk '{ print $1 / 1000 }')"
    done
  done
}

echo '| object | cells, m | stops below | method | outcome | views | coverage | path, m | time to plan, median, s |'
echo '|---|---|---|---|---|---|---|---|---|'
for what in "${@:-aimed paper hierarchical}"; do
  for part in $what; do
    case $part in
      aimed)
        row aimed '320 aimed'
        ;;
      paper)
        row paper '320 candidates' --aimed 0
        ;;
      hierarchical)
        row hierarchical hierarchical --aimed 0 --method hierarchical
        ;;
      uniform)
        row uniform uniform --aimed 0 --method uniform
        ;;
      gains)
        for gain in unknown-cells occlusion-aware unobserved-voxel rear-side-voxel rear-side-entropy proximity-count; do
          row "$gain" "$gain" --candidates 80 --aimed 0 --set gain="$gain"
        done
        ;;
      *)
        echo "reconstruction_table.sh: '$part' is none of aimed paper hierarchical uniform gains" >&2
        exit 2
        ;;
    esac
  done
done
