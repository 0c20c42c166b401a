#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Explores the worlds of docs/results.md and prints its table: examples/results.sh [WHAT...], where WHAT is among
# house-coarse house-fine collapsed-house collapsed-house-fine office office-fine plane (default: house-coarse house-fine
# collapsed-house office); plane is an office driven through instead of flown. Needs VANTAGE_DATA and a built program
# (VANTAGE=path/to/vantage names another). EXTRA holds further options of vantage explore, "--wear" for instance. Reports
# that lie in the folder RESULTS (default: build/results) already are not made again.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
: "${VANTAGE_DATA:?must name the folder with the worlds}"
vantage=${VANTAGE:-$here/build/release/bin/vantage}
results=${RESULTS:-$here/build/results}
seeds=${SEEDS:-1 2 3 4 5}
mkdir -p "$results"

value() { sed -n "s/^ *\"$2\": \"\{0,1\}\([^\",]*\).*/\1/p" "$1" | head -1; }

# explore TITLE RESOLUTION PLANNERS WORLD OPTION...: one row for every planner and start.
explore() {
  local title=$1 resolution=$2 planners=$3 world=$4 planner seed report
  shift 4
  for planner in $planners; do
    for seed in $seeds; do
      report=$results/${title// /-}-$resolution-$planner-$seed.json
      if [[ ! -s $report ]]; then
        echo "$title, $resolution m, $planner, start $seed" >&2
        "$vantage" explore --world "$world" --planner "$planner" --resolution "$resolution" --seed "$seed" "$@" ${EXTRA:-} \
          --json "$report" > /dev/null || { code=$?; [[ $code -eq 3 || $code -eq 4 ]]; }
      fi
      printf '| %s | %s | %s | %s | %s | %s | %.1f | %.4f | %s | %.0f | %.0f |\n' "$title" "$resolution" "$planner" \
        "$seed" "$(value "$report" outcome)" "$(value "$report" views)" "$(value "$report" path_length_m)" \
        "$(value "$report" coverage)" "$(value "$report" collisions)" \
        "$(sed -n '/"plan": {/,/}/s/.*"median": \([^,]*\).*/\1/p' "$report")" \
        "$(sed -n '/"plan": {/,/}/s/.*"max": \([^,]*\).*/\1/p' "$report")"
    done
  done
}

echo '| world | cells, m | planner | start | outcome | views | path, m | coverage | collisions | plan, ms | longest |'
echo '|---|---|---|---|---|---|---|---|---|---|---|'
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
