#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Repeats the table of Shade & Newman 2011 (docs/results.md): explores `rooms` at 0.2 m and prints one row per planner and
# setting, medians with quartiles over the starts.
# Usage: harmonic_table.sh [PART...], PART among paper baselines ablation kinect stereo (default: paper baselines ablation).
# Needs a built program (VANTAGE=path/to/vantage names another). Variables:
#   SEEDS="1 2"           the starts (default: 1 to 20)
#   MAX_VIEWS=N           budget of a run (default: 1000)
#   SHARES="0.95 0.99"    coverages at which the path is printed
#   JOBS=N                runs at a time (default: 2)
#   RESULTS=DIR           folder of the reports (default: build/harmonic-table); reports in it are not made again
#   EVERY=N               kinect and stereo: only every N-th pixel both ways, to save time
#   PLANNERS="..."        kinect and stereo: the rows (default: harmonic frontier-gain nearest-frontier)
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
vantage=${VANTAGE:-$here/build/release/bin/vantage}
results=${RESULTS:-$here/build/harmonic-table}
seeds=${SEEDS:-$(seq 1 20)}
jobs=${JOBS:-2}
max_views=${MAX_VIEWS:-1000}
every=${EVERY:-1}
planners=${PLANNERS:-harmonic frontier-gain nearest-frontier}
read -r share_1 share_2 <<< "${SHARES:-0.95 0.99}"
mkdir -p "$results"

# field REPORT KEY: the value of a key that stands once in a report.
field() { sed -n "s/.*\"$2\": \"\{0,1\}\([^\",}]*\).*/\1/p" "$1" | head -1; }

# path_at REPORT SHARE: metres travelled when coverage first was SHARE; "-" if it never was.
path_at() {
  awk -v share="$2" '
    function number(key) { return match($0, "\"" key "\": ?[0-9]") ? substr($0, RSTART + RLENGTH - 1) + 0 : -1 }
    /"view":/ && number("coverage") >= share { print number("path_length_m"); found = 1; exit }
    END { if (!found) print "-" }' "$1"
}

# quartiles DIGITS: median [lower, upper quartile] of the numbers on stdin; "-" if a number is missing.
quartiles() {
  sort -g | awk -v digits="$1" '
    /^-$/ { missing = 1 }
    { v[NR] = $1 }
    function at(share,  place, below) {
      place = 1 + share * (NR - 1); below = int(place)
      return v[below] + (place - below) * (v[below < NR ? below + 1 : NR] - v[below])
    }
    END {
      if (missing || NR == 0) { print "-"; exit }
      f = "%." digits "f"
      printf f " [" f ", " f "]", at(0.5), at(0.25), at(0.75)
    }'
}

column() { # column DIGITS COMMAND...: quartiles of a figure over all reports of the row
  local digits=$1 report
  shift
  for report in "${reports[@]}"; do "$@" "$report"; done | quartiles "$digits"
}
value_of() { field "$2" "$1"; }
millions_of() { field "$2" "$1" | awk '{ print $1 / 1e6 }'; }
path_at_share() { path_at "$2" "$1"; }

# row TITLE NAME OPTION...: explores from every start, in parallel, and prints a row.
row() {
  local title=$1 name=$2 seed
  shift 2
  reports=()
  for seed in $seeds; do
    reports+=("$results/$name-$seed.json")
    [[ -s $results/$name-$seed.json ]] || echo "$seed"
  done > "$results/$name.todo"
  [[ -s $results/$name.todo ]] && echo "$title" >&2
  xargs -r -P "$jobs" -I{} sh -c '
    "$0" explore --world rooms --resolution 0.2 --seed {} "$@" > /dev/null || { code=$?; test $code -eq 3 || test $code -eq 4; }' \
    "$vantage" --max-views "$max_views" --json "$results/$name-{}.json" "$@" < "$results/$name.todo"
  rm "$results/$name.todo"
  local explored
  explored=$({ grep -l '"outcome": "explored",$' "${reports[@]}" || true; } | wc -l)
  printf '| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s of %s |\n' "$title" \
    "$(column 1 value_of path_length_m)" "$(column 0 value_of views)" "$(column 1 path_at_share "$share_1")" \
    "$(column 1 path_at_share "$share_2")" "$(column 4 value_of coverage)" "$(column 2 millions_of integration)" \
    "$(column 1 millions_of planning)" "$(column 0 plan_median)" "$explored" "${#reports[@]}"
}
plan_median() { sed -n '/"plan": {/,/}/s/.*"median": \([^,]*\).*/\1/p' "$1" | head -1; }

head_of_table() {
  printf '\n| %s | path, m | scans | path at %s, m | path at %s, m | coverage | integration, 1e6 cells | planning, 1e6 cells | plan, ms | explored |\n' \
    "$1" "$share_1" "$share_2"
  echo '|---|---|---|---|---|---|---|---|---|---|'
}

# thinned SENSOR: the name of a narrow sensor, or a file with every N-th of its pixels.
thinned() {
  local width height across_deg down_deg near_m far_m
  case $1 in
    kinect) read -r width height across_deg down_deg near_m far_m <<< '640 480 57 43 0.4 4' ;;
    stereo) read -r width height across_deg down_deg near_m far_m <<< '512 384 65 51.0771935 0.5 5' ;;
  esac
  if [[ $every == 1 ]]; then
    echo "$1"
    return
  fi
  printf '{"width": %d, "height": %d, "horizontal_fov_deg": %s, "vertical_fov_deg": %s, ' \
    $((width / every)) $((height / every)) "$across_deg" "$down_deg" > "$results/$1.sensor"
  printf '"min_range_m": %s, "max_range_m": %s}\n' "$near_m" "$far_m" >> "$results/$1.sensor"
  mv "$results/$1.sensor" "$results/$1-every-$every.json"
  echo "$results/$1-every-$every.json"
}

# sensor_rows SENSOR: the planners beside each other with a narrow sensor.
sensor_rows() {
  local sensor planner
  sensor=$(thinned "$1")
  head_of_table "$1"
  for planner in $planners; do
    if [[ $planner == frontier-gain ]]; then
      row 'frontier-gain, 200 hypotheses' "$1-gain-200" --planner frontier-gain --set hypotheses=200 --sensor "$sensor"
    else
      row "$planner" "$1-$planner" --planner "$planner" --sensor "$sensor"
    fi
  done
}

for part in "${@:-paper baselines ablation}"; do
  for what in $part; do
    case $what in
      paper)
        head_of_table panoramic
        row 'harmonic' harmonic --planner harmonic
        row 'harmonic, faithful' faithful --planner harmonic --set mode=faithful
        row 'frontier-gain, 100 hypotheses' gain-100 --planner frontier-gain
        row 'nearest-frontier' nearest --planner nearest-frontier
        ;;
      baselines)
        head_of_table panoramic
        for hypotheses in 30 300; do
          row "frontier-gain, $hypotheses hypotheses" "gain-$hypotheses" --planner frontier-gain --set "hypotheses=$hypotheses"
        done
        row 'frontier-gain, 100, scans at goals only' gain-100-goals --planner frontier-gain --scan-spacing 0
        row 'nearest-frontier, scans at goals only' nearest-goals --planner nearest-frontier --scan-spacing 0
        ;;
      ablation)
        head_of_table panoramic
        row 'faithful' faithful --planner harmonic --set mode=faithful
        row '+ looks early, takes the shortest way there' early --planner harmonic --set mode=faithful \
          --set look_early=true --set shortest_way=true
        for detour in 2 0.5; do
          row "+ near frontiers first, detour $detour m" "detour-$detour" --planner harmonic --set mode=faithful \
            --set look_early=true --set shortest_way=true --set "detour_m=$detour"
        done
        row '+ detour 0.2 m: the default' harmonic --planner harmonic
        row 'default, looks from beside the boundary' late --planner harmonic --set look_early=false
        ;;
      kinect | stereo)
        sensor_rows "$what"
        ;;
      *)
        echo "harmonic_table.sh: '$what' is none of paper baselines ablation kinect stereo" >&2
        exit 2
        ;;
    esac
  done
done
