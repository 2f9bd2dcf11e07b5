#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# equilibrium_shape.sh EQUILIBRIUM_SHAPE: what the program prints, writes and refuses.
set -u
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# refused EXIT_CODE PATTERN ARGUMENTS...: the message is short and matches; nothing is printed as a result.
refused() {
  local code=$1 pattern=$2 message status
  shift 2
  message=$("$program" "$@" 2>&1 >"$work/stdout")
  status=$?
  if [[ $status -ne $code || ! $message =~ ^"error: ".*$pattern || $message == *"internal error"* || $(wc -l <<<"$message") -gt 3 ]]; then
    fail "($status, expected $code and '$pattern'): $* -> $message"
  elif [[ $code -eq 2 && -s $work/stdout ]]; then
    fail "printed a result: $*"
  else
    echo "ok: $message"
  fi
}

coarse=(--latitudes 16 --branch)
refused 2 '--branch pear: must be one of prolate, oblate' --branch pear --reduced-volume 0.9
refused 2 '--branch is required' --reduced-volume 0.9
refused 2 '--output: there is no such option; did you mean --out' --output here
refused 2 '--reduced-volume is required' --branch prolate
refused 2 '--reduced-volume 1.2: .*in \(0, 1\]' --branch prolate --reduced-volume 1.2
refused 2 '--reduced-volume 0: .*in \(0, 1\]' --branch prolate --reduced-volume 0
refused 2 '--reduced-volume nan: .*in \(0, 1\]' --branch prolate --reduced-volume nan
refused 2 '--reduced-volume 0.9x: must be a number or FROM:TO:STEP' --branch prolate --reduced-volume 0.9x
refused 2 '--reduced-volume 0.7:0.9: must be a number or FROM:TO:STEP' --branch prolate --reduced-volume 0.7:0.9
refused 2 'STEP must be > 0' --branch prolate --reduced-volume 0.7:0.9:0
refused 2 '--latitudes 8: must be from 12 to 256' --branch prolate --reduced-volume 0.9 --latitudes 8
refused 2 '--latitudes' --branch prolate --reduced-volume 0.9 --latitudes many
refused 2 '--tolerance 0: must be in \(0, 1\)' --branch prolate --reduced-volume 0.9 --tolerance 0
refused 2 '--max-iterations 0: must be >= 1' --branch prolate --reduced-volume 0.9 --max-iterations 0
refused 2 '--method bisection: must be one of newton, gradient_flow, kinsol, cvode' \
  --branch prolate --reduced-volume 0.9 --method bisection
refused 3 'prolate 0.9: not converged: the limit of iterations was reached; after 1 iterations the residual is .*above' \
  "${coarse[@]}" prolate --reduced-volume 0.9 --max-iterations 1 --method gradient_flow
refused 3 'oblate 0.45: not converged: the two caps pass through each other at' \
  "${coarse[@]}" oblate --reduced-volume 0.45
echo "not a folder" >"$work/file"
refused 4 "--out $work/file/shapes" "${coarse[@]}" prolate --reduced-volume 0.9 --out "$work/file/shapes"

# Results: only JSON on standard output, failures beside shapes, and the files.
"$program" "${coarse[@]}" oblate --reduced-volume 0.45 0.9:1:0.05 --json --out "$work/shapes" \
  >"$work/result.json" 2>"$work/progress"
[[ $? -eq 3 ]] || fail "one shape in four not found: expected exit code 3"
cmp -s "$work/result.json" "$work/shapes/oblate.json" || fail "the summary differs from what was printed"
python3 - "$work" <<'PYTHON' || fail "the results are not as documented"
import csv, json, math, sys
from pathlib import Path

work = Path(sys.argv[1])
shapes = json.loads((work / "result.json").read_text())["shapes"]
assert [s["reduced_volume"] for s in shapes] == [0.45, 0.9, 0.95, 1.0], shapes
assert [s["converged"] for s in shapes] == [False, True, True, True]
sphere = shapes[3]
assert abs(sphere["bending_energy"] / (2 * math.pi) - 1) < 1e-12 and sphere["tension"] is None

# The meridian encloses the volume and has the area that belong to it (trapezoidal rule).
with open(work / "shapes/oblate_0.9_meridian.csv") as file:
    rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
assert rows[0]["rho"] == 0 and rows[-1]["rho"] == 0 and rows[0]["z"] == shapes[1]["polar_semi_axis"]
pairs = list(zip(rows, rows[1:]))
area = sum(math.pi * (a["rho"] + b["rho"]) * (b["arclength"] - a["arclength"]) for a, b in pairs)
volume = sum(math.pi * (a["rho"] ** 2 + b["rho"] ** 2) / 2 * (a["z"] - b["z"]) for a, b in pairs)
assert abs(area / (4 * math.pi * 0.9 ** (-2 / 3)) - 1) < 0.02, area
assert abs(volume / (4 * math.pi / 3) - 1) < 0.02, volume

# The coefficients give the height of the north pole: z = sum_n z_n0 sqrt((2n + 1) / (4 pi)).
lines = (work / "shapes/oblate_0.9_coefficients.txt").read_text().splitlines()
numbers = [line.split() for line in lines if not line.startswith("#")]
assert len(numbers) == 16 * 17 // 2 and all(len(row) == 8 for row in numbers)
pole = sum(float(row[6]) * math.sqrt((2 * int(row[0]) + 1) / (4 * math.pi)) for row in numbers if row[1] == "0")
assert abs(pole - shapes[1]["polar_semi_axis"]) < 1e-6, pole
PYTHON

echo "$failures failures"
exit $((failures > 0))
