#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# The checks that take too long for every change, one after the other; says at the end which of them failed.
# usage: scripts/nightly.sh [CHECK...]      (all checks unless named; a few hours on two cores)
#   x86-64-v2, x86-64-v3, x86-64-v4, native   everything, benchmarks too, compiled for these processors with warnings as errors; the
#                tests are run where this machine can
#   compilers    libraries and apps by g++ and clang++, as C++20 and C++23, shared and static, each pair of these at least once; programs
#                outside the tree by the same compiler against what is installed, and with the tree as a part of their project
#   bare         libraries and apps without SUNDIALS, CHOLMOD and HDF5
#   sanitizers   all tests with the address and undefined-behaviour sanitizers
#   threads      scripts/check_threads.sh
#   memory       scripts/check_memory.sh
#   fuzz         fuzz/run.sh, ten minutes each target
#   tidy         clang-tidy on every source
#   coverage     which share of the lines of the libraries and apps the tests reach, by file in build/coverage/coverage.txt; fails below 97 %
#   docs         scripts/docs.sh
#   kills        validation/robustness/kills.py: 200 runs killed at any moment go on to the same bits
#   faults       validation/robustness/faults.py: disks, permissions, descriptors and memory that run out
#   hostile      validation/robustness/hostile_starts.py: starts that no one should choose
#   browser      viewer/test/browser.sh: reports in headless Chromium, which this installs with Node where they are missing
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."

checks=(x86-64-v2 x86-64-v3 x86-64-v4 native compilers bare sanitizers threads memory fuzz tidy docs coverage kills faults hostile browser)
for check in "$@"; do
  [[ " ${checks[*]} " == *" $check "* ]] || no_more_options "$check"
done
export OMP_WAIT_POLICY=passive

# build NAME OPTION...: all targets, in build/NAME.
build() {
  logged "build/$1/configure.log" "Configuring build/$1" cmake -B "build/$1" "${@:2}"
  logged "build/$1/build.log" "Compiling build/$1" cmake --build "build/$1"
}

# run_tests NAME OPTION...: those in build/NAME, which the options tell ctest.
run_tests() {
  logged "build/$1/ctest.log" "Testing build/$1" ctest "${@:2}" --parallel "$(nproc)" --output-on-failure --no-tests=error
  grep 'tests passed' "build/$1/ctest.log"
}

# Sources in batches, but once one by one: then each has to include what it uses.
build_for() {
  local batch=8
  [[ $1 != native ]] || batch=1
  build "nightly-$1" -S . -G Ninja -DCMAKE_BUILD_TYPE=Release -DVESIFLOW_ARCH="$1" -DVESIFLOW_WERROR=ON \
    -DVESIFLOW_WITH_SUNDIALS=ON -DVESIFLOW_BUILD_TESTS=ON -DVESIFLOW_BATCH=$batch -DVESIFLOW_BUILD_BENCH=ON
}

# build_with COMPILER STANDARD SHARED: and consumes what is installed.
build_with() {
  local name=nightly-$1-$2-shared-$3
  build "$name" -S . -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$1" -DCMAKE_CXX_STANDARD="$2" -DBUILD_SHARED_LIBS="$3" \
    -DVESIFLOW_WERROR=ON -DVESIFLOW_BATCH=8 -DVESIFLOW_WITH_SUNDIALS=ON -DVESIFLOW_BUILD_TESTS=OFF
  CXX=$1 tests/install_consumer/check.sh "build/$name" -DCMAKE_CXX_STANDARD="$2" -DBUILD_SHARED_LIBS="$3"
}

# Nothing that is left out is looked for either.
build_bare() {
  local options=() package
  for package in SUNDIALS CHOLMOD HDF5; do options+=("-DVESIFLOW_WITH_$package=OFF"); done
  for package in SUNDIALS CHOLMOD HDF5C; do options+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"); done
  build nightly-bare -S . -G Ninja -DCMAKE_BUILD_TYPE=Release -DVESIFLOW_WERROR=ON -DVESIFLOW_BATCH=8 -DVESIFLOW_BUILD_TESTS=OFF "${options[@]}"
}

# validate SCRIPT OPTION...: one of validation/robustness/, with the apps for this machine.
validate() {
  build_for native
  scripts/python.sh "validation/robustness/$1.py" --apps build/nightly-native/apps "${@:2}"
}

# In per cent of the lines; there were 98.5 when it was set.
least_coverage=97

# All tests with counters, which threads share and tests that run side by side add to.
cover() {
  build coverage --preset coverage
  find build/coverage -name '*.gcda' -delete
  run_tests coverage --test-dir build/coverage
  logged build/coverage/gcovr.log "Counting lines" gcovr --root . --object-directory build/coverage \
    --filter 'lib[a-z]+/' --filter common/ --filter apps/ --print-summary --txt build/coverage/coverage.txt \
    --fail-under-line "$least_coverage"
  grep '^lines:' build/coverage/gcovr.log
}

# Reports in a real browser, with the viewer of this tree in them.
browse() {
  scripts/install-deps.sh --browser
  scripts/viewer.sh
  build_for native
  logged build/browser.log "Reports in Chromium" viewer/test/browser.sh build/nightly-native/apps out/browser
  grep -E '(tests|pass|fail) [0-9]+$|bytes; first frame' build/browser.log
}

perform() {
  case $1 in
    x86-64-v* | native)
      build_for "$1"
      if [[ $1 == x86-64-v* && $1 > $(widest_level) ]]; then
        echo "This machine cannot run what is compiled for $1."
      else
        run_tests "nightly-$1" --test-dir "build/nightly-$1"
      fi
      ;;
    compilers)
      build_with g++ 20 ON
      build_with g++ 23 OFF
      build_with clang++ 20 OFF
      build_with clang++ 23 ON
      tests/install_consumer/subproject.sh
      ;;
    bare) build_bare ;;
    sanitizers)
      build asan-ubsan --preset asan-ubsan
      run_tests asan-ubsan --preset asan-ubsan
      ;;
    threads) scripts/check_threads.sh ;;
    memory) scripts/check_memory.sh ;;
    fuzz) fuzz/run.sh 600 ;;
    tidy) build tidy --preset tidy ;;
    coverage) cover ;;
    docs) scripts/docs.sh ;;
    kills | faults) validate "$1" ;;
    browser) browse ;;
    hostile) validate hostile_starts --jobs "$(nproc)" ;;
  esac
}

if [[ $# -eq 1 ]]; then
  perform "$1"
  exit
fi
# Each in a process of its own, so that a failure ends this check and not the others.
scripts/install-deps.sh --dev
[[ $# -gt 0 ]] || set -- "${checks[@]}"
failed=()
for check in "$@"; do
  echo "== $check"
  scripts/nightly.sh "$check" || failed+=("$check")
done
if [[ ${#failed[@]} -gt 0 ]]; then
  echo "failed: ${failed[*]}" >&2
  exit 1
fi
