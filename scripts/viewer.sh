#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Makes viewer/dist/viewer.js, the script of the reports; the next build puts it into librun. Needs Node 18 or later and npm.
# usage: scripts/viewer.sh
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."
no_more_options "$@"

if ! { command -v node && command -v npm; } >/dev/null; then
  echo "viewer.sh: node and npm are needed (scripts/install-deps.sh --viewer)" >&2
  exit 1
fi
cd viewer
logged ../build/viewer-packages.log "Fetching the packages of the viewer" npm ci --ignore-scripts
logged ../build/viewer.log "Making viewer/dist/viewer.js" npm run build
