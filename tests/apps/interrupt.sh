#!/usr/bin/env bash
# interrupt.sh SHEAR_FLOW SCENES: a run that is asked to stop leaves a checkpoint from which another goes on to the
# very bits of an uninterrupted run; a run that is killed outright leaves readable files.
set -eu
shear_flow=$1
scene=$2/tank_treading_coarse.toml
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
small=(--set domain.cells=32 --set mesh.latitudes=16 --set time.step=1/192 --set time.end=2 --quiet --threads 2)

# Waits until a run under way has written a file: it is then between its first and its last step.
wait_for() {
  for _ in $(seq 1 600); do
    [[ -e $1 ]] && return
    sleep 0.05
  done
  echo "FAILED: $1 did not appear"
  exit 1
}

"$shear_flow" "$scene" "${small[@]}" --out "$work/whole"

"$shear_flow" "$scene" "${small[@]}" --out "$work/stopped" &
run=$!
wait_for "$work/stopped/diagnostics.csv"
kill -TERM "$run"
status=0
wait "$run" || status=$?
[[ $status -eq 143 ]] || { echo "FAILED: SIGTERM gave exit code $status, expected 143"; exit 1; }
grep -q '"status": "terminated"' "$work/stopped/summary.json"
"$shear_flow" --restart "$work/stopped/checkpoint.h5" --quiet --threads 1
grep -q '"status": "completed"' "$work/stopped/summary.json"
tail -n 1 "$work/whole/diagnostics.csv" >"$work/a"
tail -n 1 "$work/stopped/diagnostics.csv" >"$work/b"
cmp "$work/a" "$work/b" || { echo "FAILED: the continued run differs from the uninterrupted one"; exit 1; }
cmp "$work/whole/checkpoint.h5" "$work/stopped/checkpoint.h5" ||
  { echo "FAILED: the checkpoint of the continued run differs"; exit 1; }

"$shear_flow" "$scene" "${small[@]}" --set output.checkpoint_every=0.02 --set output.vesicle_every=0.02 \
  --out "$work/killed" &
run=$!
wait_for "$work/killed/checkpoint.h5"
kill -KILL "$run"
wait "$run" 2>/dev/null || true
"$shear_flow" "$scene" "${small[@]}" --set output.checkpoint_every=0.02 --set output.vesicle_every=0.02 \
  --out "$work/killed" --restart "$work/killed/checkpoint.h5"
tail -n 1 "$work/killed/diagnostics.csv" >"$work/c"
cmp "$work/a" "$work/c" || { echo "FAILED: the run continued after a kill differs"; exit 1; }
echo "interrupted, killed and continued: the same bits"
