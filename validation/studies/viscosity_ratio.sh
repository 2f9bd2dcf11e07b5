#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# How the time step and the treatment of the viscous term move a vesicle more viscous than the fluid around it: tank-treading at
# ratio 5 to t = 4, and the time at which one of ratio 20 lies along the flow, in a small box (about ten minutes on one
# core). Prints the second table of validation/studies/viscosity_ratio.md.
# usage: validation/studies/viscosity_ratio.sh [APPS_DIR]      (default build/release/apps; results in out/viscosity_ratio)
set -euo pipefail
. "$(dirname "$0")/../../scripts/lib.sh"
cd "$(dirname "$0")/../.."
[[ ${1:-} != -* ]] || no_more_options "$1"
apps=${1:-build/release/apps}
out=${OUT:-out/viscosity_ratio}

case_of() { # case_of RATIO END TREATMENT STEPS_PER_UNIT; inertia = none is named "none"
  local name="ratio$1_$3_$4" treatment=(--set "fluid.viscous_treatment=$3")
  if [[ $3 == none ]]; then treatment=(--set fluid.inertia=none); fi
  "$apps/shear_flow" scenes/tumbling.toml --out "$out/$name" --threads 1 --quiet --set coupling.method=delta --set "fluid.viscosity_ratio=$1" \
    --set 'domain.lower=[-3,-3,-3]' --set 'domain.upper=[3,3,3]' --set domain.cells=32 --set membrane.sigma0=570 \
    --set "time.end=$2" --set "time.step=1/$4" --set output.vesicle_every=0 --set output.checkpoint_every=0 \
    --set output.diagnostics_every=0.02 "${treatment[@]}" || [ $? -eq 3 ] # a run that blows up is a result
}

for steps in 48 96 192; do
  for treatment in explicit extrapolated; do
    case_of 5 4 $treatment $steps
    case_of 20 7.4 $treatment $steps
  done
done
for steps in 48 96; do
  case_of 5 4 implicit $steps
  case_of 20 7.4 implicit $steps
done
case_of 20 7.4 extrapolated 384
case_of 5 4 none 96

scripts/python.sh validation/studies/viscosity_ratio_table.py "$out"
