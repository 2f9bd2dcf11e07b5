#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Formats every C++ file of the tree, or with --check only says which ones differ.
# usage: scripts/format.sh [--check]
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."
arguments=(-i)
if [[ ${1:-} == --check ]]; then
  arguments=(--dry-run --Werror)
  shift
fi
no_more_options "$@"

# Releases of clang-format disagree in details; 14 is Debian 12's and the one that is checked.
format=$(command -v clang-format-14 || command -v clang-format || true)
if [[ -z $format ]] || ! "$format" --version | grep -q 'version 14\.'; then
  echo "clang-format 14 is needed (scripts/install-deps.sh --dev)" >&2
  exit 1
fi

git ls-files -z --cached --others --exclude-standard '*.h' '*.cpp' |
  while IFS= read -r -d '' file; do
    # A file that is deleted but still in the index has nothing to format.
    if [[ -f $file ]]; then printf '%s\0' "$file"; fi
  done | xargs -0 -r "$format" "${arguments[@]}"
