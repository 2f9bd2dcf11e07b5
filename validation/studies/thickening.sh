#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# How much the width of the delta function, which acts as a thickness of the membrane, moves the inclination and the frequency
# of a tank-treading vesicle (reduced volume 0.9, Ca 2.5, [-6,6]^3), for each delta function and spacing of the grid: about
# four minutes on one core. Runs that are there are not repeated. Only the half y > 0 of the box is computed, and vesicles
# start near their final inclination. Prints the tables of validation/studies/thickening.md and writes thickening.json beside the runs.
# usage: validation/studies/thickening.sh [APPS_DIR]      (default build/release/apps; results in out/thickening)
set -euo pipefail
. "$(dirname "$0")/../../scripts/lib.sh"
cd "$(dirname "$0")/../.."
[[ ${1:-} != -* ]] || no_more_options "$1"
apps=${1:-build/release/apps}
out=${OUT:-out/thickening}
mkdir -p "$out"

case_of() { # case_of NAME KERNEL CELLS LATITUDES [more options]
  local name="$1" kernel=$2 cells=$3 latitudes=$4 degrees=12
  shift 4
  if [[ $kernel == bspline32 ]]; then degrees=8; fi
  if grep -qs '"status": "completed"' "$out/$name/summary.json"; then return; fi
  timeout 900 "$apps/shear_flow" scenes/paper/tank_treading_128.toml --out "$out/$name" --threads 1 --quiet \
    --set "coupling.kernel=$kernel" --set "domain.cells=[$cells,$((cells / 2)),$cells]" --set "mesh.latitudes=$latitudes" \
    --set "mesh.normal_degrees=$degrees" \
    --set 'domain.lower=[-6,0,-6]' --set 'domain.mirror=[false,true,false]' --set vesicles.0.rotation_deg=61.5 \
    --set time.markers=shape_following --set membrane.sigma0=9000 --set time.step=1/24 --set time.end=5 \
    --set output.diagnostics_every=0.5 --set output.vesicle_every=0 --set output.fluid_every=0 \
    --set output.checkpoint_every=0 "$@" || [ $? -eq 3 ] # a run that blows up is a result
}

for kernel in smoothed4 bspline32 bspline43 bspline54 roma3 peskin4 bao6; do
  for cells in 64 96 128; do
    case_of "${kernel}_$cells" $kernel $cells $((cells / 2))
  done
done

scripts/python.sh validation/studies/thickening_table.py "$out"
