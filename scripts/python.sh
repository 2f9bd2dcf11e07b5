#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs a python that has numpy, matplotlib and h5py: the distribution's, which another python3 in PATH may hide. It finds the package
# vesiflow of the folder VESIFLOW_BUILD (build/release unless given, or another preset's that is built), and where none is built what the
# package has without compiled parts: results and their pictures.
# usage: scripts/python.sh SCRIPT [ARGUMENT...], or any other arguments of python
set -euo pipefail
. "$(dirname "$0")/lib.sh"
[[ $# -ne 1 || $1 != --help ]] || no_more_options --help
root=$(realpath "$(dirname "$0")/..")
package=$root/python
for build in ${VESIFLOW_BUILD:+"$(realpath -m "$VESIFLOW_BUILD")"} "$root"/build/{release,test,audit,dev}; do
  if compgen -G "$build/python/vesiflow/_run.*.so" >/dev/null; then
    package=$build/python
    break
  fi
done
export PYTHONPATH=$package${PYTHONPATH:+:$PYTHONPATH}
for python in /usr/bin/python3 python3; do
  if "$python" -c 'import numpy, matplotlib, h5py' 2>/dev/null; then
    exec "$python" "$@"
  fi
done
echo "No python3 with numpy, matplotlib and h5py found. Run scripts/install-deps.sh" >&2
exit 1
