#!/usr/bin/env bash
# interrupt.sh SHEAR_FLOW SCENES: a run that is asked to stop leaves a checkpoint and says the command from which another goes on
# to the very bits of an uninterrupted run; a run that is killed outright leaves readable files.
set -eu
shear_flow=$1
scene=$2/tank_treading_coarse.toml
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
small=(--set domain.cells=32 --set mesh.latitudes=16 --set time.step=1/192 --set time.end=1
  --set output.checkpoint_every=0.04 --set output.vesicle_every=0.04 --quiet --threads 2)

fail() {
  echo "FAILED: $*"
  exit 1
}

# Waits until a run under way has written a file: it is then between its first and its last step.
wait_for() {
  for _ in $(seq 1 600); do
    [[ -e $1 ]] && return
    sleep 0.05
  done
  fail "$1 did not appear"
}

# status FOLDER TEXT
status() { grep -q "\"status\": \"$2\"" "$1/summary.json" || fail "$1 is not $2: $(grep '"status"' "$1/summary.json")"; }

# same FOLDER: its run has ended as the one that nobody disturbed.
same() {
  cmp <(tail -n 1 "$work/whole/diagnostics.csv") <(tail -n 1 "$1/diagnostics.csv") || fail "$1: the last row differs"
  cmp "$work/whole/checkpoint.h5" "$1/checkpoint.h5" || fail "$1: the checkpoint differs"
  [[ ! -e $1/run.lock ]] || fail "$1: the lock is left"
}

# go_on FOLDER LOG: by the command that the run has said.
go_on() {
  command=$(sed -n 's/^ *go on with: //p' "$2")
  [[ -n $command ]] || fail "no command to go on with: $(cat "$2")"
  eval "$command"
  status "$1" completed
}

"$shear_flow" "$scene" "${small[@]}" --out "$work/whole"

# stopped_by SIGNAL EXIT_CODE STATUS
stopped_by() {
  folder="$work/it's $1"
  "$shear_flow" "$scene" "${small[@]}" --out "$folder" 2>"$work/log" &
  run=$!
  wait_for "$folder/checkpoint.h5"
  kill -"$1" "$run"
  kill -"$1" "$run" # as timeout(1) does: to the process, and to its group
  code=0
  wait "$run" || code=$?
  [[ $code -eq $2 ]] || fail "SIG$1 gave exit code $code, expected $2"
  status "$folder" "$3"
  grep -q "at step [0-9]*, t = [0-9.]* of 1" "$work/log" || fail "SIG$1: $(cat "$work/log")"
}
stopped_by INT 130 interrupted
stopped_by TERM 143 terminated
stopped_by USR1 138 "user signal 1"
stopped_by USR2 140 "user signal 2"
stopped_by HUP 129 "hung up"
go_on "$folder" "$work/log"
same "$folder"

# What nohup has made deaf for SIGHUP stays so.
(
  trap '' HUP
  exec "$shear_flow" "$scene" "${small[@]}" --out "$work/nohup"
) &
run=$!
wait_for "$work/nohup/checkpoint.h5"
kill -HUP "$run"
wait "$run" || fail "SIGHUP ended a run under nohup"
same "$work/nohup"

code=0
"$shear_flow" "$scene" "${small[@]}" --set limits.wall_time=0.2 --out "$work/limit" 2>"$work/log" || code=$?
[[ $code -eq 6 ]] || fail "limits.wall_time gave exit code $code, expected 6"
status "$work/limit" "out of time"
command="$(sed -n 's/^ *go on with: //p' "$work/log") --set limits.wall_time=0"
eval "$command" || fail "going on after limits.wall_time"
cmp <(tail -n 1 "$work/whole/diagnostics.csv") <(tail -n 1 "$work/limit/diagnostics.csv") ||
  fail "the run continued after limits.wall_time differs"

"$shear_flow" "$scene" "${small[@]}" --out "$work/killed" &
run=$!
wait_for "$work/killed/checkpoint.h5"
again=("$shear_flow" "$scene" "${small[@]}" --out "$work/killed" --restart "$work/killed/checkpoint.h5")
# Another in the same folder is refused, and touches nothing; of the one that was killed nothing is left to do by hand.
code=0
"${again[@]}" 2>"$work/log" || code=$?
[[ $code -eq 4 ]] || fail "two runs in one folder: exit code $code, expected 4"
grep -q "in use by another run: process $run on " "$work/log" || fail "two runs in one folder: $(cat "$work/log")"
kill -KILL "$run"
wait "$run" 2>/dev/null || true
"${again[@]}"
same "$work/killed"
echo "interrupted, killed and continued: the same bits"
