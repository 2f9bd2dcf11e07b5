#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# From a fresh clone to pictures of a tank-treading vesicle, in a few minutes.
# usage: scripts/quickstart.sh [--threads N]      (default: all cores, but at most 2: the case is small)
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."

threads=$(nproc)
((threads <= 2)) || threads=2
if [[ ${1:-} == --threads ]]; then
  threads=${2:?--threads needs a number}
  shift 2
fi
no_more_options "$@"
out=out/tank_treading_coarse

scripts/install-deps.sh
# Without Node, reports have plots and outlines but nothing to turn, and say how to get it.
if { command -v node && command -v npm; } >/dev/null && [[ ! -e viewer/dist/viewer.js ]]; then
  scripts/viewer.sh || echo "The report will have no viewer; that takes nothing from the results."
fi
logged build/release/configure.log "Configuring build/release" cmake --preset release
logged build/release/build.log "Compiling shear_flow" cmake --build --preset release --target shear_flow
build/release/apps/shear_flow scenes/tank_treading_coarse.toml --out "$out" --threads "$threads"
scripts/python.sh -m vesiflow plot "$out"

scripts/python.sh - "$out" <<'REPORT'
import json, sys
vesicle = json.load(open(f"{sys.argv[1]}/summary.json"))["vesicles"][0]
print(f"\nMembranes and flow for ParaView: {sys.argv[1]}/vesicle.xdmf and fluid.xdmf; pictures: {sys.argv[1]}/pictures")
print(f"Steady tank-treading: inclination {vesicle['inclination_angle_deg']:.1f} degrees, "
      f"frequency {vesicle['tank_treading_frequency']:.3f}; expected: 27.7 degrees, 0.405. Keller & Skalak (1982), who take "
      "the vesicle for an ellipsoid of the same reduced volume: 27.0 degrees, 0.427.")
print(f"\nReport, for any browser: {sys.argv[1]}/report.html")
REPORT
