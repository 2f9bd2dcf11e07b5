#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the scripts, before they change the folder: what they have in common.
script=$(realpath "$0")

# The comment at the top of the script, which says what it does.
usage() {
  sed -n '2,/^[^#]/{/^# SPDX-/d; s/^#\( \|$\)//p}' "$script"
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

# Of a log: the first failures of a build or of the tests, and the last lines.
show_failure() {
  first_failures "$1"
  echo "... and the last lines of $1, which has it all:"
  tail -n 20 "$1"
}

# Of a build what ninja says from the first "FAILED:" on. Of ctest the first three tests that failed: of those of GoogleTest the
# assertions that failed, each with the lines that belong to it, and the names; of others the first and last lines that they print.
first_failures() {
  awk -v most_tests=3 -v most_lines=40 -v most_of_assertion=12 '
    function show(line) { if (shown++ < most_lines) print line }
    function end_of_test(i) {
      for (i = 1; in_test && !assertions && i <= printed; ++i)
        if (i <= most_lines / 2 || i > printed - most_lines / 2) print lines[i]
        else if (i == most_lines / 2 + 1) print "..."
      in_test = printed = assertions = within = shown = 0
    }
    !in_test && /^FAILED: / { in_build = 1 }
    in_build { show($0); next }
    /^ *[0-9]+\/[0-9]+ Test +#[0-9]+: / || /^[0-9.]+% tests passed/ {
      end_of_test()
      in_test = /\*\*\*(Failed|Timeout|Exception|Not Run)/
      if (in_test && ++tests > most_tests) exit
      if (in_test) print
      next
    }
    !in_test { next }
    { lines[++printed] = $0 }
    /: Failure$/ { within = most_of_assertion; ++assertions }
    /^\[ / || /^$/ { within = 0 }
    /^\[  FAILED  \] / { ++assertions; show($0) }
    within > 0 { --within; show($0) }
    END { if (tests <= most_tests) end_of_test() }' "$1"
}

# The widest of the levels of x86-64 that this machine runs, as -march= names it; elsewhere nothing. (glibc's loader knows.)
widest_level() {
  /lib64/ld-linux-x86-64.so.2 --help 2>/dev/null | sed -n 's/^ *\(x86-64-v[0-9]\) (supported.*/\1/p' | head -n 1 || true
}
