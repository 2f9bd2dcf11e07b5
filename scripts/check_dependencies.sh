#!/usr/bin/env bash
# Checks who includes whom: see "The libraries" in CONTRIBUTING.md.
# usage: scripts/check_dependencies.sh
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."
no_more_options "$@"
failed=0

# forbid RULE PATTERN FOLDER...: no #include in the folders names what matches the pattern.
forbid() {
  local rule=$1 pattern=$2 folder found
  shift 2
  for folder in "$@"; do
    [[ -d $folder ]] || continue
    if found=$(grep -rnE --include='*.h' --include='*.cpp' "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($pattern)" "$folder"); then
      printf '%s:\n%s\n' "$rule" "$found" >&2
      failed=1
    fi
  done
}

forbid "libvesicle knows no fluid" '(fluid|coupling)/' libvesicle tests/vesicle
forbid "libfluid knows no vesicle" '(vesicle|coupling)/' libfluid tests/fluid
forbid "common knows no library" '(vesicle|fluid|coupling)/' common
forbid "public headers show no third-party library but Eigen" \
  'fftw3|cholmod|suitesparse|sundials|kinsol|cvode|arkode|hdf5|H5|omp\.h|toml|nlohmann' \
  lib{vesicle,fluid,coupling}/include
forbid "apps include public headers only" '(\.\./)*lib[a-z]+/|.*(src|detail)/' apps

# What an app includes in quotes is a file of the apps, a public header, or the version that the build writes.
while IFS=: read -r file included; do
  [[ $included == build_info.h ]] && continue
  if [[ -z $(find apps -path "*/$included") ]] && ! compgen -G "lib*/include/$included" >/dev/null &&
    [[ ! -e common/$included ]]; then
    echo "apps include public headers and common/ only: $file includes \"$included\"" >&2
    failed=1
  fi
done < <(grep -rE --include='*.h' --include='*.cpp' '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' apps |
  sed -E 's/:[^"]*"([^"]*)".*/:\1/')

[[ $failed -eq 0 ]] && echo "dependencies: as they should be"
exit $failed
