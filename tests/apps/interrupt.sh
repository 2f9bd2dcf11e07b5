#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# interrupt.sh SHEAR_FLOW SCENES: a run that is asked to stop leaves a checkpoint and says the command from which another goes on
# to the very bits of an uninterrupted run; a run that is killed outright leaves readable files.
set -eu
shear_flow=$1
scene=$2/tank_treading_coarse.toml
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Without an end of their own, so that none is over before it is stopped, however late that comes.
small=(--set domain.cells=32 --set mesh.latitudes=16 --set time.step=1/192 --set time.end=1000
  --set output.checkpoint_every=0.04 --set output.vesicle_every=0.04 --quiet --threads 2)

fail() {
  echo "FAILED: $*"
  exit 1
}

# Waits until a run has written a file: it is then beyond its start.
wait_for() {
  for _ in $(seq 1 1200); do
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

# go_on FOLDER [OPTIONS]: to the common end, by the command that the run has said.
go_on() {
  command=$(sed -n 's/^ *go on with: //p' "$1.log")
  [[ -n $command ]] || fail "no command to go on with: $(cat "$1.log")"
  eval "$command --set time.end=$end ${2-}" || fail "$1: going on"
  status "$1" completed
  same "$1"
}

# stop SIGNAL EXIT_CODE STATUS FOLDER: the run under way.
stop() {
  kill -"$1" "$run"
  kill -"$1" "$run" # as timeout(1) does: to the process, and to its group
  code=0
  wait "$run" || code=$?
  [[ $code -eq $2 ]] || fail "SIG$1 gave exit code $code, expected $2"
  status "$4" "$3"
  grep -q "at step [0-9]*, t = [0-9.]* of 1000" "$4.log" || fail "SIG$1: $(cat "$4.log")"
}

# stopped_by SIGNAL EXIT_CODE STATUS
stopped_by() {
  folder="$work/it's $1"
  "$shear_flow" "$scene" "${small[@]}" --out "$folder" 2>"$folder.log" &
  run=$!
  wait_for "$folder/checkpoint.h5"
  stop "$@" "$folder"
}
stopped_by INT 130 interrupted
stopped_by TERM 143 terminated
stopped_by USR1 138 "user signal 1"
stopped_by USR2 140 "user signal 2"
stopped_by HUP 129 "hung up"

# What nohup has made deaf for SIGHUP stays so.
(
  trap '' HUP
  exec "$shear_flow" "$scene" "${small[@]}" --out "$work/nohup" 2>"$work/nohup.log"
) &
run=$!
wait_for "$work/nohup/checkpoint.h5"
kill -HUP "$run"
stop TERM 143 terminated "$work/nohup"

code=0
"$shear_flow" "$scene" "${small[@]}" --set limits.wall_time=0.2 --out "$work/limit" 2>"$work/limit.log" || code=$?
[[ $code -eq 6 ]] || fail "limits.wall_time gave exit code $code, expected 6"
status "$work/limit" "out of time"

# Another in the same folder is refused, and touches nothing; of the one that was killed nothing is left to do by hand.
"$shear_flow" "$scene" "${small[@]}" --out "$work/killed" &
run=$!
wait_for "$work/killed/checkpoint.h5"
again=("$shear_flow" "$scene" "${small[@]}" --out "$work/killed" --restart "$work/killed/checkpoint.h5")
code=0
"${again[@]}" 2>"$work/log" || code=$?
[[ $code -eq 4 ]] || fail "two runs in one folder: exit code $code, expected 4"
grep -q "in use by another run: process $run on " "$work/log" || fail "two runs in one folder: $(cat "$work/log")"
kill -KILL "$run"
wait "$run" 2>/dev/null || true

# All go on to the same end, which none has come to. The summary of the run that was killed is of its last checkpoint.
end=$(sed -n 's/^ *"time": \([0-9.]*\).*/\1/p' "$work"/*/summary.json | sort -g | awk 'END { print int($1) + 1 }')
"$shear_flow" "$scene" "${small[@]}" --set "time.end=$end" --out "$work/whole"
go_on "$work/it's HUP"
go_on "$work/nohup"
go_on "$work/limit" "--set limits.wall_time=0"
"${again[@]}" --set "time.end=$end"
same "$work/killed"
echo "interrupted, killed and continued: the same bits"
