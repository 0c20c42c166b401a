# SPDX-License-Identifier: MIT
# Completion of `vantage` for bash. It asks the program itself what there is, so it never falls behind.

_vantage_section() {  # the names that `vantage list` gives under a heading
  "${COMP_WORDS[0]}" list 2>/dev/null | awk -v heading="$1" '/^[^ ]/ { here = ($1 == heading) } /^ / && here { print $1 }'
}

_vantage_options() {  # of a command, as its help has them: at the beginning of a line
  "${COMP_WORDS[0]}" "$1" --help 2>/dev/null | awk '/^  -/ { count = split($1, names, ","); for (i = 1; i <= count; ++i) print names[i] }'
}

_vantage_choices() {  # what an option takes by name: the small words of "default|hierarchical|uniform"
  "${COMP_WORDS[0]}" "$1" --help 2>/dev/null | awk -v option="$2" '
    /^  -/ && $1 == option && index($2, "|") {
      count = split($2, words, "|")
      for (i = 1; i <= count; ++i) if (words[i] ~ /^[a-z0-9][a-z0-9-]*$/) print words[i]
    }'
}

_vantage() {
  local word="${COMP_WORDS[COMP_CWORD]}" before="" command="${COMP_WORDS[1]}" names="" first=""
  COMPREPLY=()
  if ((COMP_CWORD > 0)); then
    before="${COMP_WORDS[COMP_CWORD - 1]}"
  fi
  if ((COMP_CWORD == 1)); then
    names="$("${COMP_WORDS[0]}" --help 2>/dev/null | awk '/^Commands/ { here = 1; next } /^ / && here { print $1 }') --help --version"
  elif [[ "$word" == -* ]]; then
    names="$(_vantage_options "$command")"
  else
    case "$before" in
      --world) names="$(_vantage_section worlds)" ;;
      --planner)
        names="$(_vantage_section planners)"
        if [[ "$word" == *,* ]]; then  # one more behind those that stand there
          first="${word%,*},"
        fi
        ;;
      --sensor) names="$(_vantage_section sensors)" ;;
      -*) names="$(_vantage_choices "$command" "$before")" ;;
    esac
    compopt -o default 2>/dev/null  # files, where no name fits
  fi
  mapfile -t COMPREPLY < <(compgen -P "$first" -W "$names" -- "${word#"$first"}")
}

complete -F _vantage vantage
