#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# geometry_accuracy.sh GEOMETRY_ACCURACY: its JSON parses and has what it promises, files of expressions and of
# coefficients give the errors of the same built-in surface, bad input gives one clear error and exit code 2.
set -u
app=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

cat >ellipsoid.toml <<'TOML'
x = "sin(theta) * cos(phi)"
y = "b * sin(theta) * sin(phi)"
z = "c * cos(theta)"
[constants]
b = 2
c = 4.0
TOML
cat >y32.toml <<'TOML'
r = "1 + exp(-3 * 0.25 * sqrt(105 / (2 * pi)) * cos(2 * phi) * sin(theta)^2 * cos(theta))"
TOML
# x = sin(theta) cos(phi) is 2 Re f Y_1^1 with f = sqrt(2 pi / 3), z = 4 cos(theta) is f Y_1^0 with f = 4 sqrt(4 pi / 3).
cat >ellipsoid.txt <<'COEFFICIENTS'
# the ellipsoid 1:2:4
1 1  1.4472025091165353 0  0 -2.8944050182330706  0 0
1 0  0 0  0 0  8.1866534424453930 0
COEFFICIENTS

only=(--formula cartesian --upsampling 2 --truncated false)
"$app" --surface ellipsoid y32 ellipsoid.toml ellipsoid.txt y32.toml --latitudes 16 32 "${only[@]}" --json >files.json || exit 1
"$app" --surface ellipsoid --latitudes 32 --json >forms.json || exit 1
python3 - <<'PYTHON' || failures=$((failures + 1))
import json

forms = json.load(open("forms.json"))
combinations = {(r["formula"], r["upsampling"], r["truncated"]) for r in forms if r["sampling"] == 1}
assert combinations == {(f, u, t) for f in ("cartesian", "christoffel", "paper") for u in (1, 1.5, 2) for t in (True, False)}
for r in forms:
    assert (r["surface"], r["latitudes"]) == ("ellipsoid", 32), r
    assert r["sampling"] == 1 or (r["formula"], r["upsampling"], r["truncated"]) == ("cartesian", 2, False), r
    assert r["error_H"] <= r["paper_H"] / 10 and r["error_K"] <= r["paper_K"] / 10, r
    assert r["paper_lapH"] == {1: 32.7, 1.5: None, 2: 4.16}[r["upsampling"]], r

files = json.load(open("files.json"))
rows = {(r["surface"], r["latitudes"]): r for r in files if r["sampling"] == 1}
for n in (16, 32):
    for file, name in (("ellipsoid.toml", "ellipsoid"), ("ellipsoid.txt", "ellipsoid"), ("y32.toml", "y32")):
        a, b = rows[file, n], rows[name, n]
        # Errors of the ellipsoid's H and K are rounding, which depends on how the positions were rounded.
        for key in ("error_lapH",) if name == "ellipsoid" else ("error_H", "error_K", "error_lapH"):
            assert b[key] / 2 < a[key] < 2 * b[key], (file, n, key, a[key], b[key])
            assert a[key.replace("error", "reference_error")] < a[key] / 100, (file, n, key)
        assert a["error_H"] < max(2 * b["error_H"], 1e-12) and a["paper_H"] is None
for r in files:  # sampled on twice the latitudes every surface is resolved
    if r["sampling"] == 2 and r["paper_H"] is not None:
        assert r["error_H"] <= r["paper_H"] / 10 and r["error_K"] <= r["paper_K"] / 10, r
assert {r["sampling"] for r in files} == {1, 2}
PYTHON

# says PATTERN ARGUMENTS...: succeeds with a text that matches.
says() {
  local pattern=$1 text
  shift
  text=$("$app" "$@")
  if [[ $? -ne 0 || ! $text =~ $pattern ]]; then
    echo "FAILED (expected '$pattern'): $* -> $text"
    failures=$((failures + 1))
  fi
}
says 'target H +N = 16 .*missed: the surface cut to degrees n < 16' --surface y32 --latitudes 16 "${only[@]}"
says 'target H +N = 16 [^:]*: met' --surface y32 --latitudes 16 --sampling 2
says 'target Lap H N = 64 [^:]*: met' --surface ellipsoid --latitudes 64 "${only[@]}"
echo 'r = "1 + 0.2 * abs(cos(theta))"' >kink.toml
says 'N = 16: .*too near the errors of .*Lap H to measure' --surface kink.toml --latitudes 16 "${only[@]}"

# refused PATTERN ARGUMENTS...
refused() {
  local pattern=$1 message status
  shift
  message=$("$app" "$@" 2>&1)
  status=$?
  if [[ $status -ne 2 || ! $message =~ ^"error: ".*$pattern || $message == *"internal error"* || $(wc -l <<<"$message") -gt 3 ]]; then
    echo "FAILED ($status, expected 2 and '$pattern'): $* -> $message"
    failures=$((failures + 1))
  else
    echo "ok: $message"
  fi
}
# refused_file PATTERN TEXT: a file of expressions.
refused_file() {
  printf '%s\n' "$2" >bad.toml
  refused "$1" --surface bad.toml
}

refused '--surface nosuch: must be one of sphere, ellipsoid, y32, .*or a file' --surface nosuch
refused '--surface /: must be one of' --surface /
refused '--latitudes 3: must be from 4 to 256' --latitudes 3
refused '--latitudes many: must be a whole number' --latitudes many
refused '--sampling 3: must be 1 or 2' --sampling 3
refused '--formula flux: must be one of cartesian, christoffel, paper' --formula flux
refused '--upsampling 4: must be one of 1, 1.5, 2' --upsampling 4
refused '--truncated maybe: must be one of' --truncated maybe
refused '--sampling 2: .*--formula cartesian' --sampling 2 --formula paper
printf '1 1 0.5\n' >short.txt
refused 'short.txt.*1' --surface short.txt
refused_file 'bad.toml:1: r = "1 \+ foo\(theta\)": .*foo.* position 4' 'r = "1 + foo(theta)"'
refused_file 'bad.toml:2: y = "1 \+ \(theta": Missing parenthesis.*position 11' $'x = "1"\ny = "1 + (theta"\nz = "2"'
refused_file 'bad.toml:1: r = "1, 2": must be one expression' 'r = "1, 2"'
refused_file 'r = "theta = 1": must not assign' 'r = "theta = 1"'
refused_file 'bad.toml:1: not valid TOML' 'r = 1 +'
refused_file 'bad.toml:1: r: must be an expression in quotes' 'r = 1'
refused_file 'either r or x, y and z, not both' $'r = "1"\nx = "2"'
refused_file 'z: missing' $'x = "1"\ny = "2"'
refused_file 'bad.toml:2: s: unknown key; allowed are r' $'r = "1"\ns = "2"'
refused_file 'bad.toml:3: constants.a: must be a finite number' $'r = "1"\n[constants]\na = "2"'
refused_file 'bad.toml:3: constants.theta: .*not theta' $'r = "1"\n[constants]\ntheta = 2'
refused_file 'r = "sqrt\(cos\(theta\)\)": is not a number at theta = .*must be finite' 'r = "sqrt(cos(theta))"'
refused_file 'r = "cos\(theta\)": is -.*must be > 0' 'r = "cos(theta)"'
refused_file 'the same point of the sphere: the surface is not closed' \
  $'x = "phi"\ny = "sin(theta) * sin(phi)"\nz = "cos(theta)"'
refused_file 'bad.toml: the volume is -4.19 .*must be > 0' \
  $'x = "-sin(theta) * cos(phi)"\ny = "sin(theta) * sin(phi)"\nz = "cos(theta)"'
refused_file 'the volume is .*reduced volume >= 0.001' \
  $'x = "sin(theta) * cos(phi)"\ny = "sin(theta) * sin(phi)"\nz = "abs(cos(theta))"'
refused_file 'bad.toml: degenerate surface' $'x = "sin(theta) * cos(phi)"\ny = "0"\nz = "cos(theta)"'

echo "$failures failures"
exit $((failures > 0))
