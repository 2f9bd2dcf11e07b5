#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# What coupling.thickness_correction changes, by spacing of the grid in [-6,6]^3: relaxation rates of a sphere's shape modes at ratio 1
# and 5, tank-treading (reduced volume 0.9) at Re = 1e-3, at Re = 1 and at ratio 5, tumbling at ratio 20 (about 25 minutes on
# one core). Runs that are there are not repeated. Only the half y > 0 of the box is computed. Prints the second part of
# validation/studies/thickening.md and writes thickness_correction.json beside the runs.
# usage: validation/studies/thickness_correction.sh [BUILD_DIR] [GROUP...]   (default build/release, all groups: modes tank ratio5 re1 tumbling)
set -euo pipefail
. "$(dirname "$0")/../../scripts/lib.sh"
cd "$(dirname "$0")/../.."
[[ ${1:-} != -* ]] || no_more_options "$1"
build=${1:-build/release}
out=${OUT:-out/thickness_correction}
groups=("${@:2}")
if [[ ${#groups[@]} == 0 ]]; then groups=(modes tank ratio5 re1 tumbling); fi
mkdir -p "$out"

case_of() { # case_of GROUP CELLS CORRECTED SCENE [more options]
  local name="$1_$3_$2" cells=$2 corrected=$3 scene=$4
  shift 4
  if grep -qs '"status": "completed"' "$out/$name/summary.json"; then return; fi
  timeout 900 "$build/apps/shear_flow" "scenes/$scene.toml" --out "$out/$name" --threads 1 --quiet --set coupling.method=delta \
    --set "coupling.thickness_correction=$corrected" --set "domain.cells=[$cells,$((cells / 2)),$cells]" \
    --set "mesh.latitudes=$((cells / 2))" --set mesh.normal_degrees=12 --set 'domain.lower=[-6,0,-6]' \
    --set 'domain.mirror=[false,true,false]' --set time.markers=shape_following --set output.vesicle_every=0 \
    --set output.fluid_every=0 --set output.checkpoint_every=0 "$@" || [ $? -eq 3 ] # a run that blows up is a result
}

modes_of() { # modes_of RATIO CELLS CORRECTED
  local name="$out/modes_ratio$1_$3_$2.txt" options=()
  if [[ -s $name ]]; then return; fi
  if [[ $3 == true ]]; then options=(--correction); fi
  "$build/bench/shape_modes" --half 6 --ratio "$1" --cells "$2" "${options[@]}" >"$name.part"
  mv "$name.part" "$name"
}

for group in "${groups[@]}"; do
  for corrected in true false; do
    case $group in
      modes)
        for cells in 64 96 128; do
          for ratio in 1 5; do modes_of $ratio $cells $corrected; done
        done ;;
      tank)
        for cells in 48 64 96 128; do
          case_of tank $cells $corrected paper/tank_treading_128 --set membrane.sigma0=9000 --set time.step=1/24 --set time.end=8 \
            --set vesicles.0.rotation_deg=61.5 --set output.diagnostics_every=0.5
        done ;;
      re1) # scenes with the correction are refused at this Reynolds number since they were seen to blow up
        if [[ $corrected == true ]]; then continue; fi
        for cells in 48 64 96; do
          case_of re1 $cells $corrected paper/tank_treading_128 --set membrane.sigma0=9000 --set time.step=1/48 --set time.end=8 \
            --set vesicles.0.rotation_deg=57 --set output.diagnostics_every=0.5 --set fluid.reynolds_number=1
        done ;;
      ratio5)
        for cells in 48 64 96; do
          case_of ratio5 $cells $corrected tumbling --set fluid.viscosity_ratio=5 --set time.step=1/48 --set time.end=6 \
            --set vesicles.0.rotation_deg=70 --set output.diagnostics_every=0.5
        done ;;
      tumbling)
        for cells in 48 64 96; do
          case_of tumbling $cells $corrected tumbling --set time.step=1/48 --set time.end=11 --set output.diagnostics_every=1/48
        done ;;
      *) echo "group $group: must be one of modes tank ratio5 re1 tumbling" >&2; exit 2 ;;
    esac
  done
done

scripts/python.sh validation/studies/thickness_correction_table.py "$out"
