#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# flow_fields.sh FLOW_FIELDS: its tables hold the flow that is known for ratio 1 and the symmetries of the others, bad input
# gives one clear error and the documented exit code.
set -u
app=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

# flow NAME ARGUMENTS...: tables in the folder NAME.
flow() {
  local name=$1
  shift
  "$app" --cells 12 "$@" --out "$name" >"$name.txt" 2>"$name.log" || { echo "FAILED: $*"; failures=$((failures + 1)); }
}
flow plain --ratio 1 --quiet
flow json --ratio 1 --json
cmp json.txt json/summary.json || { echo "FAILED: --json prints something else than the summary"; failures=$((failures + 1)); }
flow stokes
flow five --ratio 5
for treatment in explicit extrapolated implicit; do
  flow "$treatment" --ratio 5 --inertia unsteady --treatment "$treatment" --reynolds-number 0.1 --time-step 0.05 --end 5
done
flow swinging --inertia full --frequency 3 --time-step 0.25

python3 - <<'PYTHON' || failures=$((failures + 1))
import csv, json

def read(name):
    with open(f"{name}/plane.csv") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    assert list(rows[0]) == ["x", "z", "u", "v", "w", "pressure", "viscosity"] and len(rows) == 144, name
    with open(f"{name}/summary.json") as file:
        summary = json.load(file)
    assert summary["divergence"] < 1e-12, (name, summary)
    return rows, summary

# Undisturbed shear, whatever the solver.
plain, summary = read("plain")
assert summary["velocity_solver"] == "stokes" and summary["steps"] == 1
for row in plain:
    assert abs(row["u"] - row["z"]) < 1e-6 and abs(row["w"]) < 1e-6 and row["viscosity"] == 1, row

# A ball in shear: odd in (x, z), no flow across the plane; in the middle the rotation of the shear flow and less than half of its
# strain (without walls, and with a sharp surface, 5 / (3 + 2 ratio) of it, 0.12).
stokes, summary = read("stokes")
assert 20 < summary["iterations_of_first_step"] < 60, summary
for row, opposite in zip(stokes, reversed(stokes)):
    for name in "uw":
        assert abs(row[name] + opposite[name]) < 1e-6, (row, opposite)
    assert abs(row["v"]) < 1e-6 and abs(row["viscosity"] - opposite["viscosity"]) < 1e-12
    if row["x"] ** 2 + row["z"] ** 2 < 0.1:
        rates = row["u"] / row["z"], row["w"] / row["x"]
        assert abs(rates[0] - rates[1] - 1) < 1e-3 and 0.12 < rates[0] + rates[1] < 0.5, row

# Without the convection the steady flow is that without inertia, in every treatment of the viscosity.
five, summary = read("five")
for treatment in ("explicit", "extrapolated", "implicit"):
    rows, summary = read(treatment)
    assert summary["steps"] == 100
    worst = max(abs(a[name] - b[name]) for a, b in zip(rows, five) for name in "uw")
    assert worst < 1e-4, (treatment, worst)
assert read("swinging")[1]["time"] == 1
PYTHON

# refused EXIT_CODE PATTERN ARGUMENTS...
refused() {
  local code=$1 pattern=$2 message status
  shift 2
  message=$("$app" "$@" 2>&1)
  status=$?
  if [[ $status -ne $code || ! $message =~ ^"error: ".*$pattern || $(wc -l <<<"$message") -ne 1 ]]; then
    echo "FAILED ($status, expected $code and '$pattern'): $* -> $message"
    failures=$((failures + 1))
  else
    echo "ok: $message"
  fi
}

touch a_file
refused 2 '--cells 13: must be even' --cells 13
refused 2 '--cells 2: must be from 4 to 512' --cells 2
refused 2 '--nosuch: there is no such option' --nosuch
refused 2 '--treatment sideways: must be one of explicit, extrapolated, implicit' --treatment sideways
refused 2 '--inertia some: must be one of full, none, unsteady' --inertia some
refused 2 '--velocity-solver magic: must be one of auto, fft, pcg, cholmod' --velocity-solver magic
refused 2 '--ratio -20: must be finite and > 0' --ratio -20
refused 2 '--ratio nan: must be finite' --ratio nan
refused 2 '--reynolds-number -1: must be' --reynolds-number -1
refused 2 '--reynolds: there is no such option; did you mean --reynolds-number' --reynolds 1
for step in 0 -1 nan; do
  refused 2 "--time-step $step: must be finite and > 0" --time-step "$step"
done
refused 2 '--end 1: must be a positive multiple of the time step 0.3' --time-step 0.3
refused 2 "'fft' cannot solve the stress form" --cells 8 --inertia full --treatment implicit --velocity-solver fft
refused 4 'a_file.*cannot be made' --cells 8 --out a_file
mkdir -p full && ln -sf /dev/full full/plane.csv
refused 4 'plane.csv: cannot be written there' --cells 8 --out full

echo "$failures failures"
exit $((failures > 0))
