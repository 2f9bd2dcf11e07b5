#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# memory.sh VESICLES SCENES: the memory that the plan speaks of is the peak resident size of the run to 10 %.
set -eu
vesicles=$1
scenes=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# check NAME ARGUMENTS...
check() {
  python3 - "$work" "$vesicles" "$@" <<'PYTHON'
import re
import resource
import subprocess
import sys

work, program, name, *arguments = sys.argv[1:]
common = [program, *arguments, "--threads", "1"]
plan = subprocess.run([*common, "--plan"], check=True, capture_output=True, text=True).stdout
planned = float(re.search(r"memory +about (\d+) MB", plan).group(1))
before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
subprocess.run([*common, "--quiet", "--out", f"{work}/{name}"], check=True, stderr=subprocess.DEVNULL)
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024 / 1e6
assert peak > before * 1024 / 1e6, f"{name}: the plan took more than the run"
print(f"{name}: planned {planned:.0f} MB, peak {peak:.0f} MB")
assert abs(planned / peak - 1) < 0.1, name
PYTHON
}

few=(--set output.checkpoint_every=1/48 --set output.fluid_every=1/48 --set output.vesicle_every=1/48)
check ratio_1 "$scenes/tank_treading_coarse.toml" "${few[@]}" --set time.end=4/24
check ratio_20 "$scenes/tumbling.toml" "${few[@]}" --set time.end=3/48
check adaptive "$scenes/tumbling.toml" "${few[@]}" --set time.end=3/48 --set time.adaptive=true
check without_output "$scenes/tank_treading_coarse.toml" --set time.end=2/24 --set output.checkpoint_every=0 \
  --set output.fluid_every=0 --set output.vesicle_every=0
check fine "$scenes/tank_treading.toml" --set time.end=2/48
check large "$scenes/tank_treading.toml" --set domain.cells=128 --set time.end=1/48 --set output.checkpoint_every=0 \
  --set output.fluid_every=0 --set output.vesicle_every=0
