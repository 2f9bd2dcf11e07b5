#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs the fuzz targets one after the other and says how many inputs each tried and what it found.
# usage: fuzz/run.sh [SECONDS] [TARGET...]     each target for so long, 60 s unless told; all targets unless named
#        fuzz/run.sh --short [TARGET...]       the same few thousand inputs every time, in less than a minute
# Builds preset fuzz. Findings and what was learnt (new inputs) go to out/fuzz/TARGET; fuzz/corpus is only read.
set -euo pipefail
. "$(dirname "$0")/../scripts/lib.sh"
cd "$(dirname "$0")/.."

seconds=60
short=
if [[ ${1:-} == --short ]]; then
  short=yes
  shift
elif [[ ${1:-} =~ ^[0-9]+$ ]]; then
  seconds=$1
  shift
elif [[ ${1:-} == -* ]]; then
  no_more_options "$1"
fi
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || targets=(coefficients mesh scene state checkpoint_bytes checkpoint_contents)

# Executions of a short run: some seconds each.
declare -A executions=([coefficients]=10000 [mesh]=20000 [scene]=2000 [state]=100 [checkpoint_bytes]=150 [checkpoint_contents]=200)

logged build/fuzz/configure.log "Configuring" cmake --preset fuzz
logged build/fuzz/build.log "Compiling fuzz targets" cmake --build build/fuzz --target "${targets[@]/#/fuzz_}"

export OMP_NUM_THREADS=1 LSAN_OPTIONS=suppressions=fuzz/lsan.supp:print_suppressions=0
export ASAN_SYMBOLIZER_PATH="${ASAN_SYMBOLIZER_PATH:-$(command -v llvm-symbolizer || true)}"
failed=()
for target in "${targets[@]}"; do
  out=out/fuzz/$target
  mkdir -p "$out/corpus"
  # An input must not ask for more memory than this, at once or in all (MB), nor take longer than that (seconds).
  options=(-artifact_prefix="$out/" -malloc_limit_mb=256 -rss_limit_mb=2048 -timeout=60 -print_final_stats=1)
  [[ ! -e fuzz/$target.dict ]] || options+=("-dict=fuzz/$target.dict")
  if [[ $short ]]; then
    options+=(-seed=1 "-runs=${executions[$target]}" "fuzz/corpus/$target")
  else
    options+=("-max_total_time=$seconds" "$out/corpus" "fuzz/corpus/$target")
  fi
  result=passed
  "build/fuzz/fuzz/fuzz_$target" "${options[@]}" >"$out/log" 2>&1 || result="FOUND SOMETHING, see $out/log"
  [[ $result == passed ]] || failed+=("$target")
  count=$(sed -n 's/^stat::number_of_executed_units: *//p' "$out/log" | tail -1)
  [[ $count ]] || count=$(sed -n 's/^#\([0-9]*\).*/\1/p' "$out/log" | tail -1)
  printf '%-22s %9s executions: %s\n' "$target" "${count:-0}" "$result"
done
[[ ${#failed[@]} -eq 0 ]]
