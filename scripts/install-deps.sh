#!/usr/bin/env bash
# Installs what building, testing and plotting need; silent when nothing is missing.
# usage: scripts/install-deps.sh [--dev]      --dev adds the tools of the format and script checks, the fuzz targets and the sanitizers
# Knows Debian 12 and later; elsewhere it only checks, and names what is missing.
set -euo pipefail

packages=(
  g++ cmake ninja-build git pkg-config
  libeigen3-dev libfftw3-dev libsuitesparse-dev libopenblas-dev libsundials-dev libhdf5-dev
  libtomlplusplus-dev libcli11-dev libspdlog-dev libfmt-dev nlohmann-json3-dev libmuparser-dev
  libgtest-dev libgmock-dev libbenchmark-dev
  python3 python3-numpy python3-matplotlib python3-h5py
)
commands=(g++ cmake ninja git)
dev_commands=(clang-format clang-tidy shellcheck clang++ valgrind)
# With the run-time libraries of clang's sanitizers, fuzzer and OpenMP; llvm names the lines in their reports.
dev_packages=(clang-format clang-tidy shellcheck clang libclang-rt-dev libomp-dev llvm valgrind)

case "${1:-}" in
  "") ;;
  --dev)
    packages+=("${dev_packages[@]}")
    commands+=("${dev_commands[@]}")
    ;;
  *)
    sed -n '2,4s/^# //p' "$0"
    [[ $1 == --help ]] && exit 0
    echo "unknown option: $1" >&2
    exit 2
    ;;
esac

install_on_debian() {
  local installed missing=() name
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${packages[@]}" 2>/dev/null || true)
  for name in "${packages[@]}"; do
    grep -qxF "$name installed" <<<"$installed" || missing+=("$name")
  done
  [[ ${#missing[@]} -gt 0 ]] || return 0

  local root=()
  [[ $(id -u) -eq 0 ]] || root=(sudo)
  echo "Installing: ${missing[*]}"
  # A fresh image has no package lists. A failing third-party source must not stop us; a failing install does.
  "${root[@]}" apt-get update -qq || true
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null
}

# Elsewhere: does the preprocessor find the headers, the shell the commands, a python the modules?
check_elsewhere() {
  local missing=() name
  for name in "${commands[@]}"; do
    command -v "$name" >/dev/null || missing+=("$name")
  done
  for name in Eigen/Core fftw3.h cholmod.h sundials/sundials_config.h hdf5.h toml++/toml.h CLI/CLI.hpp \
    spdlog/spdlog.h fmt/core.h nlohmann/json.hpp muParser.h gtest/gtest.h benchmark/benchmark.h; do
    g++ -E -x c++ -I/usr/include/eigen3 -I/usr/include/suitesparse - <<<"#include <$name>" >/dev/null 2>&1 ||
      missing+=("$name")
  done
  "$(dirname "$0")/python.sh" -c "" 2>/dev/null || missing+=("python3 with numpy, matplotlib, h5py")
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
