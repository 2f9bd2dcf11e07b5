#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# restart.sh VESICLES: folders stand for their scene and their checkpoint, a restart goes on in the folder of its checkpoint, a run
# that is complete stays as it is, and the shell may take overrides apart.
set -u
vesicles=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

mkdir scene
cat >scene/scene.toml <<'TOML'
[domain]
cells = 16
[mesh]
latitudes = 12
[time]
step = "1/24"
end = 0.125
[output]
fluid_every = 0
[vesicles]
shape = "prolate"
reduced_volume = 0.95
TOML

# A folder given for a scene; its name is that of the results.
"$vesicles" scene/ --quiet 2>log || fail "a folder for a scene: $(cat log)"
[[ -e out/scene/summary.json ]] || fail "results are not in out/scene: $(ls . out)"
grep -qF '[[vesicles]]' out/scene/scene.toml || fail "the only vesicle is not written as [[vesicles]]"

# A complete run.
before=$(cd out/scene && md5sum ./*)
"$vesicles" --restart out/scene --quiet 2>log || fail "a complete run is refused"
grep -q 'this run is complete at t = 0.125, .*--set time.end=0.25' log || fail "a complete run: $(cat log)"
[[ $(cd out/scene && md5sum ./*) == "$before" && $(ls) == $'log\nout\nscene' ]] || fail "a complete run was changed"

# It goes on in its folder, with and without the scene, with a later end.
"$vesicles" --restart out/scene --quiet --set time.end = 0.25 2>log || fail "$(cat log)"
grep -q 'continuing from out/scene/checkpoint.h5 at step 3, .*results go on in out/scene$' log || fail "no folder: $(cat log)"
"$vesicles" scene --restart out/scene/checkpoint.h5 --quiet --set time.end= 0.375 2>log || fail "$(cat log)"
[[ $(ls) == $'log\nout\nscene' && $(ls out) == scene && ! -e out/scene/previous_1 ]] || fail "files elsewhere: $(ls . out)"
grep -q '"time": 0.375' out/scene/summary.json || fail "the run did not go on to 0.375"

# A copy of a checkpoint belongs to no folder.
mkdir archive && cp out/scene/checkpoint.h5 archive/long.h5
"$vesicles" --restart archive/long.h5 --quiet --set time.end=0.5 2>log || fail "$(cat log)"
[[ $(ls archive) == long.h5 && -e out/long/summary.json ]] || fail "files beside the copy: $(ls archive)"

# A run whose summary was lost to a kill ends once more.
sed -i 's/"completed"/"running"/' out/long/summary.json
"$vesicles" --restart out/long --quiet 2>log || fail "$(cat log)"
grep -q '"status": "completed"' out/long/summary.json || fail "the summary was not completed: $(cat log)"

# A plan ends with what all of it takes.
"$vesicles" scene --plan >plan || fail "plan"
tail -n 4 plan | grep -qE '^In all$' || fail "no totals: $(tail -n 4 plan)"
tail -n 3 plan | grep -qE '^  time +about .* by .*thread.*: 3 steps of .* ms by one$' || fail "no time: $(tail -n 3 plan)"
tail -n 2 plan | grep -qE '^  memory +about .* MB' || fail "no memory: $(tail -n 3 plan)"
tail -n 1 plan | grep -qE '^  disk +about .* MB; the file system of out/scene has [0-9]+ MB$' || fail "no disk: $(tail -n 1 plan)"

echo "$failures failures"
exit $((failures > 0))
