#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Looks for data races with the thread sanitizer: short runs of the coupled method, and the suites of libfluid that set the
# number of threads.
# usage: scripts/check_threads.sh [--runs-only]      (builds preset tsan)
# clang, because its OpenMP tells the sanitizer who waits for whom (the tool Archer); with gcc's every parallel loop looks
# like a race. Libraries without instrumentation (FFTW, BLAS, HDF5) are not looked at.
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."
targets=(vesicles fluid_tests)
if [[ ${1:-} == --runs-only ]]; then
  targets=(vesicles)
  shift
fi
no_more_options "$@"
logged build/tsan/configure.log "Configuring" cmake --preset tsan
logged build/tsan/build.log "Compiling ${targets[*]}" cmake --build build/tsan --target "${targets[@]}"

archer=$(clang++ -print-resource-dir)/../../libarcher.so
[[ -e $archer ]] || { echo "libarcher.so is missing: install clang's OpenMP (Debian: libomp-dev)" >&2; exit 1; }
export OMP_NUM_THREADS=2 OMP_TOOL_LIBRARIES="$archer"
export TSAN_OPTIONS="ignore_noninstrumented_modules=1 halt_on_error=0 exitcode=66"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# run NAME KEY=VALUE...: the scene with these overrides.
run() {
  local name=$1 settings=() key
  shift
  for key in "$@"; do settings+=(--set "$key"); done
  if build/tsan/apps/vesicles tests/sanitizers/two_vesicles.toml --quiet --threads 2 --out "$scratch/$name" \
    "${settings[@]}" >"$scratch/log" 2>&1; then
    echo "$name: no races"
  else
    cat "$scratch/log"
    echo "$name: FAILED"
    exit 1
  fi
}
run shape_following
run implicit time.markers=implicit
run ab2_in_stokes_flow time.markers=ab2 fluid.inertia=none
run adaptive_implicit_viscosity time.adaptive=true time.step=0.002 time.end=0.006 fluid.viscous_treatment=implicit
run paper method.preset=paper coupling.kernel=peskin4

for target in "${targets[@]}"; do
  [[ $target == *_tests ]] || continue
  build/tsan/tests/fluid/fluid_tests --gtest_brief=1 --gtest_filter='*Thread*:*thread*'
done
