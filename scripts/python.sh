#!/usr/bin/env bash
# Runs a python that has numpy, matplotlib and h5py: the distribution's, which another python3 in PATH may hide.
set -euo pipefail
for python in /usr/bin/python3 python3; do
  if "$python" -c 'import numpy, matplotlib, h5py' 2>/dev/null; then
    exec "$python" "$@"
  fi
done
echo "No python3 with numpy, matplotlib and h5py found. Run scripts/install-deps.sh" >&2
exit 1
