#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Searches two arenas for victims from several starts by every planner and prints the table of docs/results.md:
# evaluation/victims_table.sh [PLANNER[,KEY=VALUE]...]... Needs VANTAGE_DATA and the built program
# (VICTIMS=path/to/victims names another). STARTS (default: 2 3 4), VIEWS (240) and ARENAS may be set. Searches that
# lie in the folder RESULTS (default: build/victims) already are not made again.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
: "${VANTAGE_DATA:?must name the folder with the arenas}"
victims=${VICTIMS:-$here/build/release/bin/victims}
results=${RESULTS:-$here/build/victims}
starts=${STARTS:-2 3 4}
views=${VIEWS:-240}
arenas=${ARENAS:-maze_many_victims exploration_eval_arena_2}
planners=("$@")
if [[ $# -eq 0 ]]; then
  planners=(frontier-void,cost_per_m=3 frontier-void 'frontier-gain,cost_per_m=3' nearest-frontier harmonic)
fi
mkdir -p "$results"

median() {
  tr ' ' '\n' | sort -n |
    awk '{ at[NR] = $1 } END { printf "%.2f", (at[int((NR + 1) / 2)] + at[int(NR / 2) + 1]) / 2 }'
}

# shellcheck disable=SC2086 # the starts are words
echo "| arena | planner |$(printf ' start %s |' $starts) victims per 10 m | median |"
# shellcheck disable=SC2086
echo "|---|---|$(printf -- '---|%.0s' $starts)---|---|"
for arena in $arenas; do
  for planner in "${planners[@]}"; do
    found='' rates=''
    for start in $starts; do
      file=$results/$arena-$views-$start-$planner.txt
      if [[ ! -s $file ]]; then
        echo "$arena, start $start, $planner" >&2
        "$victims" "$VANTAGE_DATA/environments/nist_usar/$arena.ply" "$views" "$start" "$planner" > "$file.part"
        mv "$file.part" "$file"
      fi
      row=$(grep "^| $planner | $start |" "$file")
      found+=" $(cut -d'|' -f7 <<< "$row") |"
      rates+=" $(cut -d'|' -f8 <<< "$row")"
    done
    rates=$(xargs <<< "$rates")
    printf '| %s | %s |%s %s | %s |\n' "$arena" "$planner" "$(tr -s ' ' <<< "$found")" "${rates// /, }" \
      "$(median <<< "$rates")"
  done
done
