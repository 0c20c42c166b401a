# SPDX-License-Identifier: MIT
# Completion of `vantage` for bash. It asks the program itself what there is, so it never falls behind.

_vantage_section() {  # the names that `vantage list` gives under a heading
  "${COMP_WORDS[0]}" list 2>/dev/null | awk -v heading="$1" '/^[^ ]/ { here = ($1 == heading) } /^ / && here { print $1 }'
}

_vantage() {
  local word="${COMP_WORDS[COMP_CWORD]}" before="" command="${COMP_WORDS[1]}" names=""
  COMPREPLY=()
  if ((COMP_CWORD > 0)); then
    before="${COMP_WORDS[COMP_CWORD - 1]}"
  fi
  if ((COMP_CWORD == 1)); then
    names="$("${COMP_WORDS[0]}" --help 2>/dev/null | awk '/^Commands/ { here = 1; next } /^ / && here { print $1 }') --help --version"
  elif [[ "$word" == -* ]]; then
    names="$("${COMP_WORDS[0]}" "$command" --help 2>/dev/null | grep -oE -- '--[a-z][a-z-]*' | sort -u)"
  else
    case "$before" in
      --world) names="$(_vantage_section worlds)" ;;
      --planner) names="$(_vantage_section planners)" ;;
      --sensor) names="$(_vantage_section sensors)" ;;
      --up) names="y z" ;;
      --method) names="default hierarchical uniform" ;;
    esac
    compopt -o default 2>/dev/null  # files, where no name fits
  fi
  mapfile -t COMPREPLY < <(compgen -W "$names" -- "$word")
}

complete -F _vantage vantage
