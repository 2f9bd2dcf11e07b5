#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Installs what building and running the programs and plotting their results need; silent when nothing is missing.
# usage: scripts/install-deps.sh [--python | --test | --dev | --viewer | --browser]
#   --python also what the Python package is compiled and installed with
#   --test   the same, and what the tests and benchmarks need, and SUNDIALS, whose Debian package brings PETSc, MPI and Fortran along
#   --dev    also the tools of the format, script and documentation checks, the fuzz targets and the sanitizers
#   --viewer also Node and npm, which scripts/viewer.sh makes the viewer of the reports with. Debian 12 has npm as 358 packages, more than all
#            the others here, so that they come only when they are asked for
#   --browser also these and Chromium, in which reports are tested
# Knows Debian 12 and later; elsewhere it only checks, and names what is missing.
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."

packages=(
  g++ cmake ninja-build
  libeigen3-dev libfftw3-dev libsuitesparse-dev libopenblas-dev libhdf5-dev libxxhash-dev
  libtomlplusplus-dev libcli11-dev libspdlog-dev libfmt-dev nlohmann-json3-dev libmuparser-dev
  python3 python3-numpy python3-matplotlib python3-h5py
)
commands=(g++ cmake ninja)
headers=(Eigen/Core fftw3.h cholmod.h hdf5.h xxhash.h toml++/toml.h CLI/CLI.hpp spdlog/spdlog.h fmt/core.h nlohmann/json.hpp muParser.h)
python_packages=(python3-dev pybind11-dev python3-pybind11 python3-setuptools python3-wheel python3-pip python3-venv)
test_packages=(pkgconf libgtest-dev libgmock-dev libbenchmark-dev libsundials-dev)
test_headers=(gtest/gtest.h benchmark/benchmark.h sundials/sundials_config.h)
# With the run-time libraries of clang's sanitizers, fuzzer and OpenMP; llvm names the lines in their reports.
dev_packages=(git clang-format clang-tidy shellcheck clang libclang-rt-dev libomp-dev llvm valgrind gcovr doxygen mypy)
dev_commands=(git clang-format clang-tidy shellcheck clang++ valgrind gcovr doxygen mypy)

# Whatever their packages are called: Node of its makers brings npm along.
add_unless_there() {
  local package
  for package in "$@"; do
    [[ $package == nodejs ]] && command -v node >/dev/null && continue
    command -v "$package" >/dev/null || packages+=("$package")
  done
  commands+=("${@/nodejs/node}")
}

case "${1:-}" in
  --python)
    packages+=("${python_packages[@]}")
    shift
    ;;
  --viewer)
    add_unless_there nodejs npm
    shift
    ;;
  --browser)
    add_unless_there nodejs npm chromium
    shift
    ;;
  --test | --dev)
    packages+=("${python_packages[@]}" "${test_packages[@]}")
    headers+=("${test_headers[@]}")
    if [[ $1 == --dev ]]; then
      packages+=("${dev_packages[@]}")
      commands+=("${dev_commands[@]}")
    fi
    shift
    ;;
esac
no_more_options "$@"

install_on_debian() {
  local installed missing=() name root=()
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${packages[@]}" 2>/dev/null || true)
  for name in "${packages[@]}"; do
    grep -qxF "$name installed" <<<"$installed" || missing+=("$name")
  done
  [[ ${#missing[@]} -gt 0 ]] || return 0

  local install=(apt-get install -y --no-install-recommends "${missing[@]}")
  if [[ $(id -u) -ne 0 ]]; then
    # Asks for a password only where someone can type one.
    if ! sudo -n true 2>/dev/null && ! { [[ -t 0 ]] && sudo -v; } 2>/dev/null; then
      echo "Packages are missing, and only root can install them; ask the administrator for: ${install[*]}" >&2
      return 1
    fi
    root=(sudo)
  fi
  # A fresh image has no package lists. A failing third-party source must not stop us; a failing install does.
  echo "Missing packages: ${missing[*]}"
  "${root[@]}" apt-get update -qq >/dev/null 2>&1 || true
  logged build/install-deps.log "Installing them" "${root[@]}" env DEBIAN_FRONTEND=noninteractive "${install[@]}"
}

# Elsewhere: does the preprocessor find the headers, the shell the commands, a python the modules?
check_elsewhere() {
  local missing=() name
  for name in "${commands[@]}"; do
    command -v "$name" >/dev/null || missing+=("$name")
  done
  for name in "${headers[@]}"; do
    g++ -E -x c++ -I/usr/include/eigen3 -I/usr/include/suitesparse - <<<"#include <$name>" >/dev/null 2>&1 ||
      missing+=("$name")
  done
  scripts/python.sh -c "" 2>/dev/null || missing+=("python3 with numpy, matplotlib, h5py")
  [[ ${#missing[@]} -gt 0 ]] || return 0
  {
    echo "This system has no dpkg, so nothing was installed. Not found: ${missing[*]}"
    echo "Vesiflow needs g++ 12 or later, CMake 3.25, Ninja, and the libraries behind these Debian packages:"
    echo "  ${packages[*]}"
  } >&2
  return 1
}

if command -v dpkg-query apt-get >/dev/null; then
  install_on_debian
else
  check_elsewhere
fi
