#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# streams.sh SHEAR_FLOW SCENES [DUCT_FLOW]: what is said to people may be lost, a run is not: standard streams that are full, closed,
# or that nobody reads. What was asked for and cannot be written is an error.
set -eu
shear_flow=$1
scene=$2/tank_treading_coarse.toml
duct_flow=${3-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
run=("$shear_flow" "$scene" --set domain.cells=16 --set mesh.latitudes=16 --set time.step=1/48
  --set time.end=0.25 --threads 1)

fail() {
  echo "FAILED: $*"
  exit 1
}

# expect CODE WHAT COMMAND...
expect() {
  local code=0
  "${@:3}" || code=$?
  [[ $code -eq $1 ]] || fail "$2: exit code $code, expected $1"
}

"${run[@]}" --out "$work/whole" >/dev/null 2>"$work/said"
grep -q '^step 12/12' "$work/said" || fail "no progress: $(cat "$work/said")"
whole() {
  for file in checkpoint.h5 diagnostics.csv vesicle.h5 fluid.h5 scene.toml; do
    cmp "$work/whole/$file" "$work/$1/$file" || fail "$1: $file differs"
  done
  grep -q '"status": "completed"' "$work/$1/summary.json" || fail "$1: not completed"
}

full() { "${run[@]}" --out "$work/full" >/dev/full 2>/dev/full; }
expect 0 "full standard streams" full
whole full

# A file of results that gets the number of a closed stream gets what is said there.
closed() { "${run[@]}" --out "$work/closed" <&- >&- 2>&-; }
expect 0 "closed standard streams" closed
whole closed

unread() {
  mkfifo "$work/pipe"
  true <"$work/pipe" & # opens it, reads nothing, goes
  "${run[@]}" --out "$work/unread" >"$work/pipe" 2>&1
}
expect 0 "a pipe that nobody reads" unread
whole unread

full_plan() { "${run[@]}" --plan >/dev/full 2>"$work/said"; }
expect 4 "--plan on a full disk" full_plan
grep -q "standard output: .*No space left on device" "$work/said" || fail "--plan: $(cat "$work/said")"
unread_plan() { "${run[@]}" --plan 2>"$work/said" | true; }
set -o pipefail
expect 0 "--plan that nobody reads" unread_plan

if [[ -n $duct_flow ]]; then
  duct=("$duct_flow" --cells 4 --end 0.1 --tolerance 1e3 --threads 1)
  "${duct[@]}" >"$work/table" 2>/dev/null
  silent() { "${duct[@]}" 2>/dev/full >"$work/table_2"; }
  expect 0 "a steady flow with a full standard error" silent
  cmp "$work/table" "$work/table_2"
  full_table() { "${duct[@]}" >/dev/full 2>"$work/said"; }
  expect 4 "a table on a full disk" full_table
  grep -q "No space left on device" "$work/said" || fail "a table on a full disk: $(cat "$work/said")"
fi
echo "nothing lost but words"
