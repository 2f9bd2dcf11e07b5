#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Vesicles of reduced volume 0.7 with and without redistribution of their markers, and of 0.8 where nothing needs it (about
# fifteen minutes on one core); writes the table to validation/studies/redistribution.md.
# usage: validation/studies/redistribution.sh [APPS_DIR]      (default build/release/apps; results in out/redistribution)
set -euo pipefail
. "$(dirname "$0")/../../scripts/lib.sh"
cd "$(dirname "$0")/../.."
[[ ${1:-} != -* ]] || no_more_options "$1"
apps=${1:-build/release/apps}
out=out/redistribution

case_of() { # case_of NAME APP SCENE OPTION...; a run that blows up is a result
  echo "== $1"
  "$apps/$2" "scenes/$3.toml" --out "$out/$1" --threads 1 "${@:4}" || [ $? -eq 3 ]
}
never=(--set mesh.redistribute=never)
case_of shear_never shear_flow paper/deflated_tank_treading "${never[@]}"
case_of shear_never_half_step shear_flow paper/deflated_tank_treading "${never[@]}" --set time.step=1/384 --set time.end=12
case_of shear_never_48_latitudes shear_flow paper/deflated_tank_treading "${never[@]}" --set mesh.latitudes=48 --set time.end=12
case_of shear shear_flow paper/deflated_tank_treading
case_of relaxation_never relaxation paper/deflated_relaxation "${never[@]}"
case_of relaxation relaxation paper/deflated_relaxation --set mesh.max_aspect_ratio=1
v08=(--set vesicles.0.reduced_volume=0.8 --set time.end=16)
case_of shear_08_never shear_flow paper/deflated_tank_treading "${v08[@]}" "${never[@]}"
case_of shear_08 shear_flow paper/deflated_tank_treading "${v08[@]}" --set mesh.max_aspect_ratio=3.5

scripts/python.sh validation/studies/redistribution_table.py "$out" >validation/studies/redistribution.md
cat validation/studies/redistribution.md
