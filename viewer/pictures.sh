#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Makes the pictures of docs/images/report, one of which is at the top of the README, from the reports of the quickstart
# (scripts/quickstart.sh) and of eight vesicles (viewer/test/browser.sh).
# usage: viewer/pictures.sh [QUICKSTART EIGHT]      (folders of the runs; default: out/tank_treading_coarse out/browser/eight)
set -euo pipefail
. "$(dirname "$0")/../scripts/lib.sh"
cd "$(dirname "$0")/.."
quickstart=${1:-out/tank_treading_coarse}
eight=${2:-out/browser/eight}
[[ $# -le 2 && $quickstart != -* ]] || no_more_options "$@"
images=docs/images/report
mkdir -p "$images"

picture() {
  node viewer/picture.mjs "$1/report.html" "$images/$2" "${@:3}"
}
picture "$quickstart" tank_treading.jpg --view --width 1400 --height 640 --fluid speed --streamlines --zoom 1.25
picture "$quickstart" desktop.png --width 1280 --height 1180
picture "$quickstart" phone.png --width 390 --height 844 --field mean_curvature --lines
picture "$eight" eight.jpg --width 1280 --height 860 --dark --fluid pressure --streamlines --frame 16
ls -l "$images"
