#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# browser.sh APPS [FOLDER]: reports in headless Chromium: runs the quickstart's scene, eight vesicles and a run that blows up with the apps in
# APPS, opens their pages, and leaves pictures in FOLDER (default: out/browser). Needs Chromium, and the packages of viewer/.
set -euo pipefail
apps=$(realpath "${1:?the folder of the apps}")
folder=$(realpath -m "${2:-$(dirname "$0")/../../out/browser}")
cd "$(dirname "$0")/.."
rm -rf "$folder"
mkdir -p "$folder"

"$apps/shear_flow" ../scenes/tank_treading_coarse.toml --out "$folder/tank_treading" --quiet
"$apps/vesicles" ../scenes/eight_vesicles.toml --out "$folder/eight" --quiet --set "domain.cells=[40, 36, 40]" --set mesh.latitudes=24 \
  --set time.step=1/24 --set time.end=4 --set output.vesicle_every=0.125 --set output.fluid_every=1 2>"$folder/eight.log"
status=0
"$apps/shear_flow" test/blow_up.toml --out "$folder/blow_up" --quiet 2>"$folder/blow_up.log" || status=$?
[[ $status -eq 3 ]] || {
  echo "the run that should blow up ended with $status" >&2
  exit 1
}
REPORTS=$folder APPS=$apps node --test --test-reporter=spec test/*.test.mjs test/*.browser.mjs
