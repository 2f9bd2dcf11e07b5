#!/usr/bin/env bash
# Every scene of the folder can be read, and says what it would compute.
# usage: scenes.sh APP FOLDER
set -euo pipefail
for scene in "$2"/*.toml "$2"/*/*.toml; do
  "$1" "$scene" --plan >/dev/null || { echo "$scene is refused"; exit 1; }
done
