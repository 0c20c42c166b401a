#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Explores the worlds of docs/results.md and prints their tables: examples/results.sh [NAME...], where NAME is among
# house-coarse house-fine collapsed-house collapsed-house-fine office office-fine plane (default: house-coarse house-fine
# collapsed-house office). One row per planner: median (least-greatest) over the starts SEEDS (default: 1 to 5).
# `plane` is an office that a robot drives through. Needs VANTAGE_DATA and a built program (VANTAGE=path/to/vantage names
# another). EACH=1 prints one row per start instead. EXTRA holds further options of vantage explore, for example
# "--wear"; give it a RESULTS folder of its own, because reports that are already in RESULTS (default: build/results) are
# not made again.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
: "${VANTAGE_DATA:?must name the folder with the worlds}"
vantage=${VANTAGE:-$here/build/release/bin/vantage}
results=${RESULTS:-$here/build/results}
seeds=${SEEDS:-1 2 3 4 5}
mkdir -p "$results"

value() { sed -n "s/^ *\"$2\": \"\{0,1\}\([^\",]*\).*/\1/p" "$1" | head -1; }

plan_ms() { sed -n "/\"plan\": {/,/}/s/.*\"$2\": \([^,]*\).*/\1/p" "$1"; }

# spread FORMAT: median (least-greatest) of the numbers on stdin; the number alone if there is one.
spread() {
  sort -g | awk -v f="$1" '
    { v[NR] = $1 }
    END {
      m = (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2
      if (NR == 1) printf f, m; else printf f " (" f "-" f ")", m, v[1], v[NR]
    }'
}

# explore TITLE RESOLUTION PLANNERS WORLD OPTION...: runs every planner from every start and prints the rows.
explore() {
  local title=$1 resolution=$2 planners=$3 world=$4 planner seed report reports
  shift 4
  for planner in $planners; do
    reports=()
    for seed in $seeds; do
      report=$results/${title// /-}-$resolution-$planner-$seed.json
      reports+=("$report")
      if [[ ! -s $report ]]; then
        echo "$title, $resolution m, $planner, start $seed" >&2
        "$vantage" explore --world "$world" --planner "$planner" --resolution "$resolution" --seed "$seed" "$@" ${EXTRA:-} \
          --json "$report" > /dev/null || { code=$?; [[ $code -eq 3 || $code -eq 4 ]]; }
      fi
      [[ -z ${EACH:-} ]] || row "$title" "$resolution" "$planner, start $seed" "$report"
    done
    [[ -n ${EACH:-} ]] || row "$title" "$resolution" "$planner" "${reports[@]}"
  done
}

# row TITLE RESOLUTION PLANNER REPORT...
row() {
  local title=$1 resolution=$2 planner=$3 explored
  shift 3
  explored=$({ grep -l '"outcome": "explored",$' "$@" || true; } | wc -l)
  printf '| %s | %s | %s | %s of %s | %s | %s | %s | %s | %s | %s |\n' "$title" "$resolution" "$planner" "$explored" $# \
    "$(for r in "$@"; do value "$r" views; done | spread %.0f)" \
    "$(for r in "$@"; do value "$r" path_length_m; done | spread %.1f)" \
    "$(for r in "$@"; do value "$r" coverage; done | spread %.4f)" \
    "$(for r in "$@"; do value "$r" collisions; done | awk '{ sum += $1 } END { print sum }')" \
    "$(for r in "$@"; do plan_ms "$r" median; done | spread %.0f)" \
    "$(for r in "$@"; do plan_ms "$r" max; done | sort -g | tail -1 | awk '{ printf "%.0f", $1 }')"
}

echo '| world | cells, m | planner | explored | views | path, m | coverage | collisions | plan, ms | longest, ms |'
echo '|---|---|---|---|---|---|---|---|---|---|'
environments=$VANTAGE_DATA/environments
house=$environments/aws_small_house/small_house_visual.ply
collapsed=$environments/gazebo/collapsed_house.ply
first_office=$environments/gazebo/osrf_first_office.ply
for what in "${@:-house-coarse house-fine collapsed-house office}"; do
  for part in $what; do
    case $part in
      house-coarse)
        explore 'small house' 0.2 'harmonic nearest-frontier frontier-gain' $house --region -9,-5,0.1,9,5,2.4
        ;;
      house-fine)
        explore 'small house' 0.1 'harmonic nearest-frontier frontier-gain' $house --region -9,-5,0.1,9,5,2.4 --max-views 2000
        ;;
      collapsed-house)
        explore 'collapsed house' 0.2 'harmonic nearest-frontier frontier-gain' $collapsed --max-views 2000
        ;;
      collapsed-house-fine)
        explore 'collapsed house' 0.1 'harmonic nearest-frontier frontier-gain' $collapsed --max-views 4000
        ;;
      office-fine)
        explore 'office' 0.1 'harmonic nearest-frontier frontier-gain' $first_office --max-views 8000
        ;;
      office)
        explore 'office' 0.2 'harmonic nearest-frontier frontier-gain' $first_office --max-views 8000
        ;;
      plane)
        for spacing in 0.5 0; do
          explore "plane, a scan every $spacing m" 0.1 'harmonic nearest-frontier frontier-gain' office --size 15,10 \
            --band 0.2,1.4 --look-around --sensor stereo --max-views 1500 --scan-spacing $spacing
        done
        ;;
      *)
        echo "results.sh: '$part' is none of house-coarse house-fine collapsed-house collapsed-house-fine office office-fine plane" >&2
        exit 2
        ;;
    esac
  done
done
