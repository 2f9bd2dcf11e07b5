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
logged build/test/configure.log "Configuring build/test" cmake -S . -B build/test -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DVESIFLOW_ARCH="$level" -DVESIFLOW_WERROR=ON -DVESIFLOW_BATCH=8 -DVESIFLOW_WITH_SUNDIALS=ON -DVESIFLOW_BUILD_TESTS=ON -DVESIFLOW_BUILD_PYTHON=ON \
  -DVESIFLOW_BUILD_BENCH=OFF
logged build/test/build.log "Compiling libraries, apps and tests for ${level:-any processor}" cmake --build build/test

# Tests that run side by side share the cores: threads that wait must not spin.
export OMP_WAIT_POLICY=passive
logged build/test/ctest.log "Testing" \
  ctest --test-dir build/test --parallel "$(nproc)" --output-on-failure --no-tests=error
grep 'tests passed' build/test/ctest.log

scripts/check_dependencies.sh
scripts/check_headers.sh
scripts/check_links.sh
tests/install_consumer/check.sh build/test
