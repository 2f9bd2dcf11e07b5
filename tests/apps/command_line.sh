#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# command_line.sh APP...: every app speaks with one voice: options that all have, help, version, one form of errors, exit codes, and
# the completion that it prints works in bash.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# refused APP PATTERN ARGUMENTS...: exit code 2, nothing on standard output, one line that starts with "error: ".
refused() {
  local app=$1 pattern=$2 message status
  shift 2
  message=$("$app" "$@" 2>&1 >stdout)
  status=$?
  [[ $status -eq 2 && $message =~ ^"error: ".*$pattern && $(wc -l <<<"$message") -eq 1 && ! -s stdout ]] ||
    fail "$app $* ($status, expected 2 and '$pattern') -> $message $(cat stdout)"
}

# completes NAME EXPECTED WORD...: the last word is completed to what holds EXPECTED, a line each.
completes() {
  local name=$1 expected=$2
  shift 2
  COMP_WORDS=("$name" "$@")
  COMP_CWORD=$#
  "_vesiflow_$name"
  grep -qxF -- "$expected" <(printf '%s\n' "${COMPREPLY[@]}") || fail "$* completes to '${COMPREPLY[*]}', not to $expected"
}

mkdir -p folder && : >file.toml
for app in "$@"; do
  name=$(basename "$app")
  help=$("$app" --help) || fail "$name --help"
  for option in --threads --quiet --completion --version --help; do
    grep -q -- " $option\|,$option" <<<"$help" || fail "$name has no $option"
  done
  # One name for one thing.
  grep -E -- '--(output|folder|reynolds|time|t-end|verbosity|silent|nthreads)( |$)' <<<"$help" && fail "$name has an old name"
  "$app" --version | grep -qE "^$name of Vesiflow [0-9.]+, revision [^ ]+$" || fail "$name --version"
  refused "$app" '--nosuch: there is no such option \(--help' --nosuch
  refused "$app" '--quite: there is no such option; did you mean --quiet' --quite
  refused "$app" '--completion zsh: must be bash' --completion zsh

  "$app" --completion bash >completion || fail "$name --completion bash"
  # shellcheck source=/dev/null
  source completion
  complete -p "$name" | grep -q "complete -F _vesiflow_$name $name" || fail "$name: nothing is completed"
  completes "$name" --quiet --qu
  completes "$name" --version --
  if grep -q -- --out <<<"$help"; then completes "$name" folder --out fo; fi
  case $name in
    vesicles)
      completes "$name" file.toml fil
      completes "$name" time.end= file.toml --set time.e
      completes "$name" vesicles.0.reduced_volume= --set vesicles.0.red
      refused "$app" 'a scene file is needed, or --restart' --quiet
      "$app" 2>&1 | grep -q '^Usage: vesicles' || fail "$name without arguments shows no help"
      ;;
    equilibrium_shape) completes "$name" oblate --branch ob ;;
    surface_fields) completes "$name" biconcave bi ;;
    flow_fields) completes "$name" extrapolated --treatment ext ;;
  esac
done

echo "$failures failures"
exit $((failures > 0))
