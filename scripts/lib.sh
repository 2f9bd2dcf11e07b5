#!/usr/bin/env bash
# Sourced by the scripts, before they change the folder: what they have in common.
script=$(realpath "$0")

# The comment at the top of the script, which says what it does.
usage() {
  sed -n '2,/^[^#]/s/^#\( \|$\)//p' "$script"
}

# no_more_options ARGUMENT...: --help helps, and anything else is refused. For what a script has not understood by then.
no_more_options() {
  [[ $# -gt 0 ]] || return 0
  if [[ $1 == --help || $1 == -h ]]; then
    usage
    exit 0
  fi
  echo "$(basename "$script"): not understood: $1" >&2
  usage >&2
  exit 2
}

# logged LOG WHAT COMMAND...: says what is done and how long it took. What the command prints goes to the file LOG; of it is shown, on a
# terminal, which step ninja or ctest has come to, and if the command fails where it failed and how it ended.
logged() {
  local log=$1 what=$2 status=0 start=$SECONDS
  shift 2
  mkdir -p "$(dirname "$log")"
  printf '%s ...' "$what"
  if [[ -t 1 ]]; then
    NINJA_STATUS='[%f/%t] ' "$@" </dev/null 2>&1 | tee "$log" | show_steps "$what" || status=$?
  else
    "$@" </dev/null >"$log" 2>&1 || status=$?
  fi
  if [[ $status -eq 0 ]]; then
    echo " $((SECONDS - start)) s"
  else
    echo " failed"
    show_failure "$log" >&2
    return "$status"
  fi
}

# The steps "[3/290]" of ninja and " 3/290 Test" of ctest, one over the other in the line that WHAT stands in.
show_steps() {
  local line
  while IFS= read -r line; do
    [[ ! $line =~ ^[[:space:]]*\[?([0-9]+/[0-9]+)[][:space:]] ]] || printf '\r%s ... %s ' "$1" "${BASH_REMATCH[1]}"
  done
}

# Of a log: the first failure of a build or of the tests, and the last lines.
show_failure() {
  sed -nE '/^FAILED: |\*\*\*(Failed|Timeout|Exception)/,$p' "$1" | head -n 40 || true
  echo "... and the last lines of $1, which has it all:"
  tail -n 20 "$1"
}

# The widest of the levels of x86-64 that this machine runs, as -march= names it; elsewhere nothing. (glibc's loader knows.)
widest_level() {
  /lib64/ld-linux-x86-64.so.2 --help 2>/dev/null | sed -n 's/^ *\(x86-64-v[0-9]\) (supported.*/\1/p' | head -n 1 || true
}
