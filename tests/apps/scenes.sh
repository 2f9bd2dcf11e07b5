#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Every scene of the folder can be read and says what it would compute, without a warning; what is shown first takes the steps that
# the documents recommend.
# usage: scenes.sh APP FOLDER
set -euo pipefail
failures=0
failed() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}
for scene in "$2"/*.toml "$2"/*/*.toml; do
  plan=$("$1" "$scene" --plan) || { failed "$scene is refused"; continue; }
  if grep 'WARNING' <<<"$plan"; then failed "the plan of $scene warns"; fi
  if [[ ${scene%/*} == "$2" ]] && ! grep -q 'markers  *shape_following' <<<"$plan"; then failed "$scene is not one of shape following"; fi
done
exit $((failures > 0))
