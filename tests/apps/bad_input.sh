#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# bad_input.sh SHEAR_FLOW SCENES: every kind of bad input gives one clear error and the documented exit code, and
# leaves what is in the results folder as it was.
set -u
shear_flow=$1
scenes=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# A small good run, whose results must survive everything below.
small=(--set domain.cells=24 --set mesh.latitudes=16 --set time.step=1/384 --set time.end=0.03)
"$shear_flow" "$scenes/tank_treading_coarse.toml" "${small[@]}" --out "$work/run" --quiet || exit 1
before=$(cd "$work/run" && md5sum ./*)

# refused EXIT_CODE PATTERN ARGUMENTS...
refused() {
  local code=$1 pattern=$2 message status
  shift 2
  message=$("$shear_flow" "$@" --out "$work/run" --quiet 2>&1)
  status=$?
  if [[ $status -ne $code || ! $message =~ ^"error: ".*$pattern || $message == *"internal error"* || $(wc -l <<<"$message") -gt 4 ]]; then
    echo "FAILED ($status, expected $code and '$pattern'): $* -> $message"
    failures=$((failures + 1))
  else
    echo "ok: $message"
  fi
  if [[ $(cd "$work/run" && md5sum ./*) != "$before" ]]; then
    echo "FAILED: results were changed by: $*"
    failures=$((failures + 1))
  fi
}

scene=$scenes/tank_treading_coarse.toml
write() { printf '%s\n' "$2" >"$work/$1.toml"; }
vesicle=$'[[vesicles]]\nshape = "prolate"\nreduced_volume = 0.9'
write wrong_type $'[domain]\ncells = "many"\n'"$vesicle"
write unknown_key $'[fluid]\nreynolds = 1.0\n'"$vesicle"
write negative_viscosity $'[fluid]\nviscosity_ratio = -1.0\n'"$vesicle"
write not_toml $'[domain\ncells = 64'
write no_vesicle $'[domain]\ncells = 64'
write several $'[fluid]\nreynolds_number = -1.0\n[time]\nend = -2\n[membran]\nsigma0 = 1\n'"$vesicle"
write misplaced $'[flow]\nend = 2.0\n'"$vesicle"
write no_value $'[flow]\ntype = shear\n'"$vesicle"
mkdir "$work/empty_folder"
: >"$work/empty.toml"
head -c 20000 "$work/run/checkpoint.h5" >"$work/truncated.h5"
echo "not a checkpoint" >"$work/text.h5"

refused 2 'no_such_file.toml.*cannot be read' "$work/no_such_file.toml"
refused 2 'wrong_type.toml:2: domain.cells = .*whole number' "$work/wrong_type.toml"
refused 2 'unknown_key.toml:2: fluid.reynolds.*did you mean fluid.reynolds_number' "$work/unknown_key.toml"
refused 2 'negative_viscosity.toml:2: fluid.viscosity_ratio = -1.*in \[0.05, 100\]' "$work/negative_viscosity.toml"
refused 2 'not_toml.toml:[0-9]+: not valid TOML' "$work/not_toml.toml"
refused 2 'no_vesicle.toml.*vesicles' "$work/no_vesicle.toml"
refused 2 'empty.toml: there is no \[\[vesicles\]\]' "$work/empty.toml"
refused 2 'empty_folder: is a folder without a scene.toml' "$work/empty_folder"
refused 2 'is an HDF5 file, no scene; .*--restart' "$work/run/checkpoint.h5"
refused 2 'no_value.toml:2: not valid TOML: .*words and fractions need quotes' "$work/no_value.toml"
refused 2 'misplaced.toml:2: flow.end: .*did you mean time.end, that is end under \[time\]' "$work/misplaced.toml"
refused 2 '--set tim.end=3: there is no key tim.end; did you mean time.end' "$scene" --set tim.end=3
refused 2 '--set: time.step = .1/0.: must be finite and > 0' "$scene" --set time.step=1/0
refused 2 '3 mistakes:.*several.toml:2: fluid.reynolds_number = -1.*several.toml:4: time.end = -2.*several.toml:5: \[membran\].*did you mean \[membrane\]' \
  "$work/several.toml"
refused 2 'vesicles.0.centre.*walls' "$scene" --set 'vesicles.0.centre=[5.5, 0, 0]'
refused 2 'time.step = 0.5.*time.step <=' "$scene" --set time.step=0.5
refused 2 'time.end.*must be a number' "$scene" --set time.end=soon
refused 2 'reduced_volume = 1.5.*in \[0.3, 1\]' "$scene" --set vesicles.0.reduced_volume=1.5
refused 2 'key=value' "$scene" --set nonsense
refused 2 '--threads 0: must be from 1 to 1024' "$scene" --threads 0
refused 2 '--threads many: must be a whole number' "$scene" --threads many
refused 2 '--plann: there is no such option; did you mean --plan' "$scene" --plann
refused 2 '--set: its value is missing, what follows is --plan' "$scene" --set --plan
refused 2 'extra.toml: is one argument more' "$scene" extra.toml
refused 2 'missing.h5.*cannot be read' "$scene" "${small[@]}" --restart "$work/missing.h5"
refused 2 'truncated.h5.*truncated' "$scene" "${small[@]}" --restart "$work/truncated.h5"
refused 2 'text.h5.*not HDF5' "$scene" "${small[@]}" --restart "$work/text.h5"
refused 2 'written with fluid.reynolds_number' "$scene" "${small[@]}" --set fluid.reynolds_number=0.01 \
  --restart "$work/run/checkpoint.h5"
refused 2 'flow.type = "custom".*own' "$scene" --set flow.type=custom
refused 2 'use the app vesicles' "$scenes/relaxation_oblate.toml"
refused 2 'domain.periodic = .*does not repeat along z' "$scene" --set 'domain.periodic=[false, false, true]'
refused 2 'repulsion.range = -1.*>= 0' "$scene" --set repulsion.range=-1

# A folder that cannot be written: below a file.
message=$("$shear_flow" "$scene" "${small[@]}" --out "$work/text.h5/run" --quiet 2>&1)
if [[ $? -eq 4 && $message == *"cannot be written there"* ]]; then
  echo "ok: $message"
else
  echo "FAILED: unwritable folder -> $message"
  failures=$((failures + 1))
fi

echo "$failures failures"
exit $((failures > 0))
