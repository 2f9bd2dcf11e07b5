#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Compiles everything with warnings as errors, runs every test, then the checks that are not tests. In build/test; what takes longer is
# in scripts/nightly.sh.
# usage: scripts/test.sh
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."
no_more_options "$@"
scripts/install-deps.sh --test

# Which warnings there are depends on the processor that is compiled for, so it is one of those that scripts/nightly.sh compiles for
# and not exactly this one.
level=$(widest_level)
options=(-G Ninja -DCMAKE_BUILD_TYPE=Release -DVESIFLOW_WERROR=ON)
logged build/test/configure.log "Configuring build/test" cmake -S . -B build/test "${options[@]}" \
  -DVESIFLOW_ARCH="$level" -DVESIFLOW_BUILD_TESTS=ON -DVESIFLOW_TEST_BATCH=6 -DVESIFLOW_BUILD_BENCH=OFF \
  -DVESIFLOW_WITH_SUNDIALS=ON
logged build/test/build.log "Compiling libraries, apps and tests for ${level:-any processor}" cmake --build build/test

# Tests that run side by side share the cores: threads that wait must not spin.
export OMP_WAIT_POLICY=passive
logged build/test/ctest.log "Testing" \
  ctest --test-dir build/test --parallel "$(nproc)" --output-on-failure --no-tests=error
grep 'tests passed' build/test/ctest.log

# Warnings that only code for AVX-512 raises are in libvesicle, where Eigen's loops are: looked for on other machines too. Sources are compiled
# six at once, in 90 s instead of 117; GCC then warns of types of one file that are members in the same file.
if [[ $level == x86-64-v[23] ]]; then
  logged build/wide/configure.log "Configuring build/wide" cmake -S . -B build/wide "${options[@]}" \
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=6 -DCMAKE_CXX_FLAGS=-Wno-subobject-linkage \
    -DVESIFLOW_ARCH=x86-64-v4 -DVESIFLOW_LIBRARIES=vesicle -DVESIFLOW_BUILD_APPS=OFF -DVESIFLOW_BUILD_TESTS=OFF
  logged build/wide/build.log "Compiling libvesicle for x86-64-v4" cmake --build build/wide
fi

scripts/check_dependencies.sh
scripts/check_headers.sh
scripts/check_links.sh
tests/install_consumer/check.sh build/test
