#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Compiles every public header alone, and included twice, seeing only the libraries its own may use.
# usage: scripts/check_headers.sh
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."
no_more_options "$@"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

eigen=/usr/include/eigen3
if command -v pkg-config >/dev/null && pkg-config --exists eigen3; then
  eigen=$(pkg-config --variable=prefix eigen3)/include/eigen3
fi
vesicle=(-Ilibvesicle/include -isystem "$eigen")
fluid=(-Ilibfluid/include)
coupling=(-Ilibcoupling/include "${vesicle[@]}" "${fluid[@]}")

# check LIBRARY FLAG...: one source file per header, all compiled side by side.
check() {
  local library=$1 header count=0
  shift
  mkdir "$scratch/$library"
  while read -r header; do
    printf '#include <%s>\n#include <%s>\n' "$header" "$header" >"$scratch/$library/${header//\//_}.cpp"
    count=$((count + 1))
  done < <(cd "lib$library/include" && find . -name '*.h' -printf '%P\n')
  find "$scratch/$library" -name '*.cpp' -print0 |
    xargs -0 -r -n 1 -P "$(nproc)" "${CXX:-g++}" -std=c++20 -fsyntax-only -Wall -Wextra -Werror "$@"
  echo "lib$library: $count public headers compile alone"
}

check vesicle "${vesicle[@]}"
check fluid "${fluid[@]}"
check coupling "${coupling[@]}"
check run -Ilibrun/include "${coupling[@]}"
