#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs the cases of docs/studies/foundation.md (about five minutes on two cores) and writes their table to
# validation/studies/foundation.md.
# usage: validation/studies/foundation.sh [APPS_DIR]      (default build/release/apps; results in out/validation)
set -euo pipefail
. "$(dirname "$0")/../../scripts/lib.sh"
cd "$(dirname "$0")/../.."
[[ ${1:-} != -* ]] || no_more_options "$1"
apps=${1:-build/release/apps}
out=out/validation

case_of() { # case_of NAME APP SCENE OPTION...
  echo "== $1"
  "$apps/$2" "scenes/$3.toml" --out "$out/$1" --set coupling.method=delta "${@:4}"
}
n32=(--set domain.cells=32 --set mesh.latitudes=16 --set time.step=1/192 --set membrane.sigma0=300)
case_of tank_treading shear_flow paper/tank_treading_64
case_of tank_treading_paper shear_flow paper/tank_treading_64 --set method.preset=paper
case_of sphere shear_flow paper/sphere_in_shear
case_of oblate_32 relaxation paper/relaxation_oblate "${n32[@]}"
case_of oblate_64 relaxation paper/relaxation_oblate

scripts/python.sh validation/studies/foundation_table.py "$out" >validation/studies/foundation.md
cat validation/studies/foundation.md
