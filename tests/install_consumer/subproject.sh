#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Builds a program with the source tree as a part of its project: by add_subdirectory and by FetchContent, with shared and static
# libraries.
# usage: tests/install_consumer/subproject.sh
set -euo pipefail
. "$(dirname "$0")/../../scripts/lib.sh"
no_more_options "$@"
here=$(realpath "$(dirname "$0")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

for shared in ON OFF; do
  for how in add_subdirectory FetchContent; do
    name=$how-$shared
    logged "$scratch/$name.log" "Configuring a project with Vesiflow by $how, BUILD_SHARED_LIBS=$shared" \
      cmake -S "$here/subproject" -B "$scratch/$name" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DHOW="$how" -DBUILD_SHARED_LIBS="$shared" \
      -DVESIFLOW_SOURCE="$here/../.." -DFETCHCONTENT_SOURCE_DIR_VESIFLOW="$here/../.." -DVESIFLOW_LIBRARIES=vesicle -DVESIFLOW_BATCH=8
    logged "$scratch/$name.log" "Compiling it" cmake --build "$scratch/$name"
    logged "$scratch/$name.log" "Running it" "$scratch/$name/curvatures"
  done
done
