#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Builds the reference of the public headers, build/docs/html/index.html. Fails where a public symbol is not documented, or a comment says
# what Doxygen does not understand.
# usage: scripts/docs.sh
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."
no_more_options "$@"

if ! command -v doxygen >/dev/null; then
  echo "doxygen is needed (scripts/install-deps.sh --dev)" >&2
  exit 1
fi
rm -rf build/docs
mkdir -p build/docs
doxygen docs/doxygen/Doxyfile

# Doxygen 1.9 looks for the documentation of everything but enumerators.
undocumented=$(awk '
  /<enumvalue / { documented = 0 }
  /<name>/ { name = $0; gsub(/<[^>]*>| /, "", name) }
  /<para>/ { documented = 1 }
  /<\/enumvalue>/ && !documented { print FILENAME ": enumerator " name " is not documented" }' build/docs/xml/*.xml)
if [[ -n $undocumented ]]; then
  echo "$undocumented" >&2
  exit 1
fi
echo "documented: $(find lib*/include -name '*.h' | wc -l) public headers, build/docs/html/index.html"
