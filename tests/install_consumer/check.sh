#!/usr/bin/env bash
# Installs a build to a scratch prefix and builds programs outside the tree against it, without -march=native.
# usage: tests/install_consumer/check.sh BUILD_DIR
set -euo pipefail
build=$(realpath "${1:?usage: check.sh BUILD_DIR}")
here=$(realpath "$(dirname "$0")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# Says nothing unless the command fails.
quietly() {
  "$@" >"$scratch/log" 2>&1 || {
    cat "$scratch/log" >&2
    echo "failed: $*" >&2
    return 1
  }
}

# configure SOURCE NAME OPTION...
configure() {
  quietly cmake -S "$1" -B "$scratch/$2" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="-Wall -Wextra" \
    -DCMAKE_PREFIX_PATH="$scratch/prefix" "${@:3}"
}

# consume COMPONENT PROGRAM OPTION...: whoever asks for a disabled package fails.
consume() {
  configure "$here/$1" "$1" "${@:3}"
  quietly cmake --build "$scratch/$1"
  quietly "$scratch/$1/$2" "$scratch/$1/out"
  echo "install consumer: $1 built and ran"
}

quietly cmake --install "$build" --prefix "$scratch/prefix"
no_optional=()
for package in HDF5 HDF5C SUNDIALS spdlog fmt; do
  no_optional+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
consume vesicle curvatures "${no_optional[@]}"
consume fluid channel "${no_optional[@]}" -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON
consume coupling extension

# A component that is not there is refused by name.
sed 's/COMPONENTS vesicle/COMPONENTS membrane/' "$here/vesicle/CMakeLists.txt" >"$scratch/CMakeLists.txt"
if cmake -S "$scratch" -B "$scratch/unknown" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/prefix" >"$scratch/log" 2>&1 ||
  ! grep -q "no component 'membrane'" "$scratch/log"; then
  cat "$scratch/log" >&2
  echo "an unknown component was not refused with a clear message" >&2
  exit 1
fi

# The same program with the source tree as a part of it, and with one library alone, which does without OpenMP.
configure "$here/vesicle" subdirectory "${no_optional[@]}" -DVESIFLOW_SOURCE="$here/../.." \
  -DCMAKE_DISABLE_FIND_PACKAGE_OpenMP=ON \
  -DVESIFLOW_LIBRARIES=vesicle -DCMAKE_BUILD_TYPE=Debug -DCMAKE_PROJECT_TOP_LEVEL_INCLUDES="$here/as_subdirectory.cmake"
quietly cmake --build "$scratch/subdirectory"
quietly "$scratch/subdirectory/curvatures"
echo "install consumer: vesicle built and ran as a subdirectory"
