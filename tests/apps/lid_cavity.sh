#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# lid_cavity.sh LID_CAVITY: what the program prints, writes and refuses.
set -u
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# refused EXIT_CODE PATTERN ARGUMENTS...: one clear message; nothing is printed as a result of bad input.
refused() {
  local code=$1 pattern=$2 message status
  shift 2
  message=$("$program" --quiet "$@" 2>&1 >"$work/stdout")
  status=$?
  if [[ $status -ne $code || ! $message =~ ^"error: ".*$pattern || $(wc -l <<<"$message") -gt 2 ]]; then
    fail "($status, expected $code and '$pattern'): $* -> $message"
  elif [[ $code -ne 3 && -s $work/stdout ]]; then
    fail "printed a result: $*"
  else
    echo "ok: $message"
  fi
}

refused 2 '--cells 4: must be from 8 to 512' --cells 16 4
refused 2 '--cells.*many' --cells many
refused 2 '--reynolds-number -5: must be finite and > 0' --reynolds-number -5
refused 2 '--threads 0: must be from 1' --threads 0
refused 3 '8\^3 cells: not steady at time .*: it changes by' --cells 8 --end 1
refused 3 'the velocity has passed 100 at time .* smaller --time-step' --cells 12 --time-step 1
echo "not a folder" >"$work/file"
refused 4 "--out $work/file/flow" --cells 8 --out "$work/file/flow"

quick=(--quiet --tolerance 1e-2)
for threads in 1 3; do
  "$program" "${quick[@]}" --cells 8 12 --threads $threads --json --out "$work/$threads" >"$work/$threads.json" ||
    fail "$threads threads"
done
cmp "$work"/{1,3}/mid_plane_12.csv || fail "the number of threads changes the flow"
cmp -s "$work/1.json" "$work/1/lid_cavity.json" || fail "what is written differs from what is printed"
"$program" "${quick[@]}" --cells 8 12 >"$work/table.txt" || fail "table"
grep -q 'Albensoeder & Kuhlmann (2005), doi:10.1016/j.jcp.2004.12.024' "$work/table.txt" || fail "no source is named"
"$program" "${quick[@]}" --cells 8 --reynolds-number 100 >"$work/other.txt" || fail "Reynolds number 100"
grep -q 'Albensoeder' "$work/other.txt" && fail "compares Reynolds number 100 with 1000"
python3 - "$work" <<'PYTHON' || fail "the results are not as documented"
import csv, json, sys
from pathlib import Path

work = Path(sys.argv[1])
result = json.loads((work / "1.json").read_text())
assert [g["cells"] for g in result["grids"]] == [8, 12] and all(g["steady"] for g in result["grids"])
for row in result["published"]["u_along_y"] + result["published"]["v_along_x"]:
    coarse, fine = row["grids"]
    assert abs(row["extrapolated"] - (fine + (fine - coarse) / (1.5**2 - 1))) < 1e-12
line = result["grids"][1]["u_along_y"]
assert line["positions"][0] == 0 and line["positions"][-1] == 1 and abs(line["values"][-1] - 1) < 1e-12
assert min(line["values"]) >= result["grids"][1]["u_minimum"]["value"]
with open(work / "1/mid_plane_12.csv") as file:
    assert sum(1 for _ in csv.DictReader(file)) == 144
PYTHON

echo "$failures failures"
exit $((failures > 0))
