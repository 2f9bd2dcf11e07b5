#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# duct_flow.sh DUCT_FLOW: what the program prints, writes and refuses.
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
  if [[ $status -ne $code || ! $message =~ $pattern || $message == *"internal error:"* || $message != "error: "* || $(wc -l <<<"$message") -gt 2 ]]; then
    fail "($status, expected $code and '$pattern'): $* -> $message"
  elif [[ $code -eq 2 && -s $work/stdout ]]; then
    fail "printed a result: $*"
  else
    echo "ok: $message"
  fi
}

refused 2 '--ends open: must be one of periodic, walls' --ends open
refused 2 '--half-widths -1: must be finite and > 0' --half-widths 3 -1
refused 2 '--length 0: must be finite and > 0' --length 0
# Boxes that are empty in floating point, or longer than any number.
refused 2 '--length 5e-324: must be from 1e-100 to 1e\+100' --ends walls --length 5e-324
refused 2 '--half-widths 1e\+308: must be from 1e-100 to 1e\+100' --half-widths 1e308 3
refused 2 '--half-widths 1000000: must be short enough for at most 65536 cells' --half-widths 3 1e6
refused 2 '--length 10000: must be short enough for at most 16384 cells' --ends walls --length 1e4 --cells 16 --refine 2
refused 2 '--cells 3: must be from 4 to 1024' --cells 3
refused 2 '--cells: must be one number or three' --cells 8 8
refused 2 '--refine 9: must be from 0 to 6' --refine 9
refused 2 '--refine 3: must be small enough for at most 1024 cells' --cells 200 --refine 3
refused 2 '--reynolds-number 0: must be finite and > 0' --reynolds-number 0
refused 2 '--time-step nan: must be finite and > 0' --time-step nan
refused 2 '--courant-number 2: must be in \(0, 1\]' --courant-number 2
refused 2 '--tolerance -1: must be' --tolerance -1
refused 2 '--end 0: must be' --end 0
refused 2 '--threads 0: must be from 1' --threads 0
refused 2 '--color' --color
refused 3 '4x8x8 cells: not steady at time' --cells 8 --end 0.1 --time-step 0.05
echo "not a folder" >"$work/file"
refused 4 "--out $work/file/flow" --cells 8 --out "$work/file/flow"

"$program" --quiet --cells 8 --refine 2 --json --out "$work/flow" >"$work/flow.json" || fail "periodic"
"$program" --quiet --ends walls --half-widths 3 2.25 --cells 8 --json >"$work/walls.json" || fail "walls"
for threads in 1 3; do
  "$program" --quiet --ends walls --cells 8 12 6 --length 4 --stokes --threads $threads --out "$work/threads_$threads" \
    >/dev/null || fail "Stokes flow with $threads threads"
done
cmp "$work"/threads_{1,3}/cross_section_8x12x6.csv || fail "the number of threads changes the flow"
cmp -s "$work/flow.json" "$work/flow/duct_flow.json" || fail "what is written differs from what is printed"
python3 - "$work" <<'PYTHON' || fail "the results are not as documented"
import csv, json, math, sys
from pathlib import Path

work = Path(sys.argv[1])
flow = json.loads((work / "flow.json").read_text())
assert [g["cells"] for g in flow["grids"]] == [[4, 8, 8], [4, 16, 16], [4, 32, 32]]
assert all(g["steady"] for g in flow["grids"])
walls = json.loads((work / "walls.json").read_text())
assert walls["grids"][0]["cells"] == [8, 8, 6] and walls["ends"] == "walls" and walls["length"] == 6

# The error is that of the flow in the file.
with open(work / "flow/cross_section_4x32x32.csv") as file:
    rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
assert len(rows) == 32 * 32
error = math.sqrt(sum((r["u"] - r["series"]) ** 2 for r in rows) / len(rows))
assert abs(error - flow["grids"][2]["error_l2"]) < 1e-8, error
PYTHON

echo "$failures failures"
exit $((failures > 0))
