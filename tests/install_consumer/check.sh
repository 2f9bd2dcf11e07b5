#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Installs a build to a scratch prefix and builds programs outside the tree against it, without -march=native.
# usage: tests/install_consumer/check.sh BUILD_DIR [OPTION...]      (options of CMake for these programs; CXX: their compiler)
set -euo pipefail
. "$(dirname "$0")/../../scripts/lib.sh"
[[ ${1:-} != -* ]] || no_more_options "$1"
build=$(realpath "${1:?usage: check.sh BUILD_DIR [OPTION...]}")
options=("${@:2}")
here=$(realpath "$(dirname "$0")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix=$scratch/prefix

# Says nothing unless the command fails.
quietly() {
  "$@" >"$scratch/log" 2>&1 || {
    cat "$scratch/log" >&2
    echo "failed: $*" >&2
    return 1
  }
}

# configure SOURCE NAME OPTION...: against what is installed in $prefix.
configure() {
  quietly cmake -S "$1" -B "$scratch/$2" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="-Wall -Wextra" \
    -DCMAKE_PREFIX_PATH="$prefix" "${options[@]}" "${@:3}"
}

# consume COMPONENT PROGRAM OPTION...: whoever asks for a disabled package fails.
consume() {
  configure "$here/$1" "$1" "${@:3}"
  quietly cmake --build "$scratch/$1"
  quietly "$scratch/$1/$2" "$scratch/$1/out"
  echo "install consumer: $1 built and ran"
}

# with_pkg_config COMPONENT PROGRAM: compiled by hand, with what pkg-config says alone.
with_pkg_config() {
  local flags static=(--static)
  [[ ! -e $libraries/libvesiflow_$1.so ]] || static=()
  read -ra flags < <(PKG_CONFIG_PATH=$libraries/pkgconfig pkg-config --cflags --libs "${static[@]}" "vesiflow-$1")
  quietly "${CXX:-g++}" -std=c++20 "$here/$1/main.cpp" -o "$scratch/$2" "${flags[@]}" "-Wl,-rpath,$libraries"
  quietly "$scratch/$2" "$scratch/$1/out_of_pkg_config"
  echo "install consumer: $1 built with pkg-config and ran"
}

# refused MESSAGE SOURCE OPTION...: does not configure, and says why.
refused() {
  rm -rf "$scratch/refused"
  if (configure "$2" refused "${@:3}") 2>/dev/null || ! tr -s '\n ' ' ' <"$scratch/log" | grep -q "$1"; then
    cat "$scratch/log" >&2
    echo "$2 was not refused with: $1" >&2
    return 1
  fi
}

quietly cmake --install "$build" --prefix "$prefix"
no_optional=()
for package in HDF5 HDF5C SUNDIALS XxHash spdlog fmt; do
  no_optional+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
consume vesicle curvatures "${no_optional[@]}"
consume fluid channel "${no_optional[@]}" -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON
consume coupling tank_treading -DCMAKE_DISABLE_FIND_PACKAGE_spdlog=ON -DCMAKE_DISABLE_FIND_PACKAGE_HDF5C=ON \
  -DCMAKE_DISABLE_FIND_PACKAGE_tomlplusplus=ON -DCMAKE_DISABLE_FIND_PACKAGE_XxHash=ON
if [[ $(wc -l <"$here/coupling/main.cpp") -ge 50 ]]; then
  echo "tests/install_consumer/coupling/main.cpp: a program without a configuration file takes less than 50 lines" >&2
  exit 1
fi
consume run extension

libraries=$(dirname "$(find "$prefix" -name pkgconfig)")
with_pkg_config vesicle curvatures
with_pkg_config fluid channel
with_pkg_config coupling tank_treading
with_pkg_config run extension

# The installed header and the libraries agree on what they are. Programs of one library alone have its functions only.
cat >"$scratch/version.cpp" <<'EOF'
#include <cstdio>
#include "coupling/version.h"
#include "fluid/version.h"
#include "run/version.h"
#include "vesicle/version.h"
#include "vesiflow/version.h"

int main() {
  using namespace vesiflow;
  for (const auto version : {vesicle::version(), fluid::version(), coupling::version(), run::version()})
    if (version != VESIFLOW_VERSION) return 1;
  std::puts(fluid::built_with().data());
  return (fluid::built_with().find("CHOLMOD") != std::string_view::npos) == VESIFLOW_HAVE_CHOLMOD &&
                 (coupling::built_with().find("SUNDIALS") != std::string_view::npos) == VESIFLOW_HAVE_SUNDIALS &&
                 (run::built_with().find("HDF5") != std::string_view::npos) == VESIFLOW_HAVE_HDF5
             ? 0
             : 2;
}
EOF
mkdir "$scratch/version"
cat >"$scratch/version/CMakeLists.txt" <<'EOF'
cmake_minimum_required(VERSION 3.25)
project(version LANGUAGES CXX)
find_package(Vesiflow REQUIRED)
add_executable(version ../version.cpp)
target_link_libraries(version PRIVATE Vesiflow::run)
EOF
configure "$scratch/version" version_build
quietly cmake --build "$scratch/version_build"
quietly "$scratch/version_build/version"
echo "install consumer: versions of headers and libraries agree"

# A shared library that hides what is not marked shows no private class.
if [[ -e $libraries/libvesiflow_fluid.so ]] && ! grep -qE 'VESIFLOW_BUILD_(TESTS|BENCH|FUZZ):[A-Z]*=(ON|AUTO)' "$build/CMakeCache.txt" &&
  nm -DC --defined-only "$libraries/libvesiflow_fluid.so" | grep 'vesiflow::fluid::FftSolver'; then
  echo "libvesiflow_fluid.so shows private symbols" >&2
  exit 1
fi

# A component that is not there is refused by name.
sed 's/COMPONENTS vesicle/COMPONENTS membrane/' "$here/vesicle/CMakeLists.txt" >"$scratch/CMakeLists.txt"
refused "no component 'membrane'" "$scratch"

# The consumer's module path is left as it was: where all is found, and where the first package is missing, or a later one.
configure "$here/module_path" module_path -DFOUND=ON
packages=(Eigen3)
[[ -e $libraries/libvesiflow_fluid.so ]] || packages+=(FFTW3 fmt)  # which shared libraries bring with them
for package in "${packages[@]}"; do
  configure "$here/module_path" "module_path_$package" -DFOUND=OFF "-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"
done
echo "install consumer: CMAKE_MODULE_PATH is left as it was"

# GoogleTest, Google Benchmark and SUNDIALS need not be there, unless what they are for is asked for.
absent=()
for package in GTest benchmark SUNDIALS; do
  absent+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
configure "$here/../.." partial "${absent[@]}" -DVESIFLOW_BUILD_BENCH=AUTO
refused "VESIFLOW_WITH_SUNDIALS=ON: SUNDIALS is not there" "$here/../.." "${absent[@]}" -DVESIFLOW_WITH_SUNDIALS=ON

# An install takes what is built: of a new build nothing, and then libfluid without the other libraries and without apps.
prefix=$scratch/partial_prefix
quietly cmake --install "$scratch/partial" --prefix "$prefix"
refused "no component 'fluid'" "$here/fluid"
cp -P "$build"/libfluid/libvesiflow_fluid.* "$scratch/partial/libfluid"
quietly cmake --install "$scratch/partial" --prefix "$prefix"
refused "no component 'coupling' in .*; installed are: fluid " "$here/coupling"
rm -r "$scratch/fluid"
consume fluid channel
echo "install consumer: an install takes what is built"

# The same program with the source tree as a part of it, and with one library alone, which does without OpenMP.
configure "$here/vesicle" subdirectory "${no_optional[@]}" -DVESIFLOW_SOURCE="$here/../.." \
  -DCMAKE_DISABLE_FIND_PACKAGE_OpenMP=ON \
  -DVESIFLOW_LIBRARIES=vesicle -DVESIFLOW_BATCH=8 -DCMAKE_BUILD_TYPE=Debug -DCMAKE_PROJECT_TOP_LEVEL_INCLUDES="$here/as_subdirectory.cmake"
quietly cmake --build "$scratch/subdirectory"
quietly "$scratch/subdirectory/curvatures"
echo "install consumer: vesicle built and ran as a subdirectory"
