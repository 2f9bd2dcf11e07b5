#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs a few steps of the coupled method under valgrind: shapes read from files, every kind of output, and a restart.
# usage: scripts/check_memory.sh      (builds preset valgrind)
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."
no_more_options "$@"
logged build/valgrind/configure.log "Configuring" cmake --preset valgrind
logged build/valgrind/build.log "Compiling vesicles" cmake --build build/valgrind --target vesicles

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# With these set the program does not start itself again, which valgrind cannot follow.
export OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive OPENBLAS_NUM_THREADS=1
check() {
  valgrind --quiet --error-exitcode=1 --leak-check=full --show-leak-kinds=definite,indirect,possible \
    --errors-for-leak-kinds=definite,indirect,possible --suppressions=tests/sanitizers/valgrind.supp \
    build/valgrind/apps/vesicles "$@" --quiet --threads 1
}
check tests/sanitizers/two_vesicles.toml --out "$scratch/run"
check --restart "$scratch/run/checkpoint.h5" --set time.end=0.05 --out "$scratch/run"
echo "valgrind has nothing to say"
