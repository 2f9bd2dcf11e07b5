#!/usr/bin/env bash
# Builds everything with warnings as errors, runs every test, then the checks that are not tests.
# usage: scripts/test.sh      (in build/test)
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install-deps.sh

cmake -S . -B build/test -G Ninja -DCMAKE_BUILD_TYPE=Release -DVESIFLOW_WERROR=ON -DVESIFLOW_BUILD_BENCH=ON
cmake --build build/test

# Tests that run side by side share the cores: threads that wait must not spin.
export OMP_WAIT_POLICY=passive
ctest --test-dir build/test --parallel "$(nproc)" --output-on-failure --no-tests=error

scripts/check_dependencies.sh
scripts/check_headers.sh
tests/install_consumer/check.sh build/test
