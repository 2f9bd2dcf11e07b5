#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs duct_flow and lid_cavity on the grids of docs/studies/foundation.md and writes their tables to validation/studies/duct_flow.md and
# validation/studies/lid_cavity.md, the numbers of the cavity to validation/results/lid_cavity.json, and the pictures in docs/images/fluid.
# The ducts take a minute; the cavity takes most of an hour on one core, nearly all of it the grid of 96^3.
# usage: validation/studies/steady_flows.sh [APPS_DIR]      (default build/release/apps; results in out/validation)
set -euo pipefail
. "$(dirname "$0")/../../scripts/lib.sh"
cd "$(dirname "$0")/../.."
[[ ${1:-} != -* ]] || no_more_options "$1"
apps=${1:-build/release/apps}
out=out/validation
threads=(--threads 1 --quiet)
revision() { git rev-parse --short=12 HEAD; }

duct() { # duct NAME OPTION...
  echo "\`duct_flow ${*:2}\`"
  echo '```'
  "$apps/duct_flow" "${threads[@]}" "${@:2}" --out "$out/duct/$1"
  echo '```'
  echo
}
{
  echo "# Flow in rectangular ducts against the exact series"
  echo
  echo "Revision $(revision), made by \`validation/studies/steady_flows.sh\`. The conclusions are in"
  echo "[the study of the foundation](../../docs/studies/foundation.md#the-fluid-alone)."
  echo
  for widths in "3 3" "3 2.25"; do
    read -ra half_widths <<<"$widths"
    duct "periodic_${half_widths[1]}" --half-widths "${half_widths[@]}" --cells 8 --refine 4
    duct "stokes_${half_widths[1]}" --half-widths "${half_widths[@]}" --ends walls --stokes --cells 8 --refine 3
    for re in 1e-3 1 10; do
      duct "walls_${half_widths[1]}_$re" \
        --half-widths "${half_widths[@]}" --ends walls --reynolds-number $re --cells 8 --refine 3
    done
  done
} >validation/studies/duct_flow.md
scripts/python.sh tools/plot_duct_flow.py "$out"/duct/{periodic_2.25,periodic_3,stokes_3,walls_3_1,walls_3_10,walls_2.25_1e-3} \
  --out docs/images/fluid/duct_flow.png

cavity=(--cells 32 48 64 96 --tolerance 2e-6)
"$apps/lid_cavity" "${threads[@]}" "${cavity[@]}" --out "$out/lid_cavity"
{
  echo "# The lid-driven cube beside published profiles"
  echo
  echo "Made by \`lid_cavity ${cavity[*]}\` (\`validation/studies/steady_flows.sh\`). The conclusions are in"
  echo "[the study of the foundation](../../docs/studies/foundation.md#the-fluid-alone)."
  echo
  scripts/python.sh validation/studies/lid_cavity_table.py "$out/lid_cavity/lid_cavity.json"
} >validation/studies/lid_cavity.md
cp "$out/lid_cavity/lid_cavity.json" validation/results/lid_cavity.json
scripts/python.sh tools/plot_lid_cavity.py "$out/lid_cavity" --out docs/images/fluid/lid_cavity.png
