# Sourced by the scripts: what they have in common.

# The comment at the top of the script, which says what it does.
usage() {
  sed -n '2,/^[^#]/s/^#\( \|$\)//p' "$0"
}

# no_more_options ARGUMENT...: --help helps, and anything else is refused. For what a script has not understood by then.
no_more_options() {
  case "${1:-}" in
    "") ;;
    -h | --help)
      usage
      exit 0
      ;;
    *)
      echo "$(basename "$0"): unknown option: $1" >&2
      usage >&2
      exit 2
      ;;
  esac
}

# logged LOG WHAT COMMAND...: says what is done, and of the command's output only the end if it fails; the whole is in the file LOG.
# On a terminal, where ninja has got to is shown in the same line.
logged() {
  local log=$1 what=$2 status=0 line
  shift 2
  mkdir -p "$(dirname "$log")"
  if [[ -t 1 ]]; then
    NINJA_STATUS='[%f/%t] ' "$@" 2>&1 </dev/null | while IFS= read -r line; do
      printf '%s\n' "$line" >&3
      [[ ! $line =~ ^\[[0-9]+/[0-9]+\] ]] || printf '\r%s %s' "$what" "${BASH_REMATCH[0]}"
    done 3>"$log" || status=$?
    printf '\r'
  else
    "$@" >"$log" 2>&1 </dev/null || status=$?
  fi
  if [[ $status -ne 0 ]]; then
    echo "$what: FAILED" >&2
    # The first failure of a build tells more than the last lines, which belong to what ran beside it.
    { sed -n '/^FAILED: /,$p' "$log" | head -n 30 | grep . || tail -n 30 "$log"; } >&2
    echo "The whole output is in $log" >&2
    return "$status"
  fi
  printf '%s: done\n' "$what"
}
