#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Kills runs at random moments, restarts them, and compares what comes out with runs that nobody disturbed.

usage: scripts/python.sh validation/robustness/kills.py [--count N] [--apps FOLDER] [--seed N] [--store]

Runs of tiny scenes write every file in every step. Each is sent SIGKILL at a random moment, restarted from its last checkpoint (or
from its scene, if there is none yet), killed again, and so on, until it is through. After each kill: every file that is there opens and is
complete as far as it says, and what a checkpoint counts on is there. At the end: checkpoint, table and snapshots are the same bits as those
of a run without kills. Exit code 1 if anything was lost. --store writes validation/results/kills.json.
"""

import collections
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line, runs, store, written  # noqa: E402
from harness.runs import ROOT  # noqa: E402

RESULT = ROOT / "validation" / "results" / "kills.json"

SCENE = """
[domain]
lower = [-3, -3, -3]
upper = [3, 3, 3]
cells = 16
[membrane]
g = 1
[mesh]
latitudes = 8
tangential_degrees = 6
[time]
step = "1/32"
end = 0.75
[output]
diagnostics_every = 1e-3
vesicle_every = 1e-3
fluid_every = 1e-3
checkpoint_every = 1e-3
[[vesicles]]
shape = "prolate"
reduced_volume = 0.95
rotation_deg = 60
"""

# What a checkpoint has to carry differs between these.
VARIANTS = {
    "equal steps": [],
    "adaptive steps": ["time.adaptive=true", "time.tolerance=1e-2", "membrane.integral_rate=2", "time.markers=strain_relaxation"],
    "two viscosities": ["fluid.viscosity_ratio=5", "mesh.max_aspect_ratio=1"],
}


# Seconds between the moment that a kill is meant for and the kill: so it also meets runs that wait for the disk.
LONGEST_WAIT = 0.01


def processor_seconds(pid):
    """Of a process, also of another one; Linux numbers these clocks like that."""
    return time.clock_gettime(~pid << 3 | 2)


def kill_after(process, seconds, wait):
    """When it has taken that many processor seconds, and some time later: on a busy machine too, it has then come as far as on another. A
    process that ends before is left alone."""
    while process.poll() is None:
        if processor_seconds(process.pid) >= seconds:
            time.sleep(wait)
            process.kill()
            return
        time.sleep(0.002)


class Chain:
    """One run from its start to its end, with as many kills as it takes."""

    def __init__(self, program, work, variant, reference_seconds, chance):
        self.program, self.variant, self.chance = program, variant, chance
        self.folder = work / "run"
        shutil.rmtree(self.folder, ignore_errors=True)
        self.scene = work / "scene.toml"
        self.longest = 1.1 * reference_seconds  # of the processor
        self.problems, self.moments = [], collections.Counter()
        self.kills = self.restarts = 0

    def command(self):
        checkpoint = self.folder / "checkpoint.h5"
        if checkpoint.exists():
            return [self.program, "--restart", checkpoint, "--quiet", "--threads", "1"]
        return start_command(self.program, self.scene, self.variant, self.folder)

    def carry_out(self, wanted):
        """Kills until `wanted` are done or the run is through; what is left then runs undisturbed."""
        while True:
            restarted = (self.folder / "checkpoint.h5").exists()
            before = written.steps_of_table(self.folder)
            process = subprocess.Popen(list(map(str, self.command())), stderr=subprocess.PIPE, text=True)
            self.restarts += restarted
            if self.kills < wanted:
                # Often soon after the start, where a restarted run sets its files right.
                limit = self.longest * (0.1 if self.chance.random() < 0.3 else 0.6)
                kill_after(process, self.chance.uniform(0, limit), self.chance.uniform(0, LONGEST_WAIT))
            _, message = process.communicate()
            if process.returncode == -9:
                self.look(restarted, before)
                continue
            if process.returncode != 0:
                self.problems.append(f"{self.variant}: exit code {process.returncode}: {message.strip()}")
            return

    def look(self, restarted, before):
        """Straight after a kill."""
        self.kills += 1
        kind = "a restarted run" if restarted else "a run from its start"
        self.moments[f"{kind}, {'before its first row' if written.steps_of_table(self.folder) <= before else 'under way'}"] += 1
        for part in sorted(self.folder.rglob("*.part")):
            name = "a snapshot" if part.parent.name == "snapshots" else part.stem
            name = name.rpartition(".")[0] if name.startswith("run.lock.") else name  # of a name that is not used yet
            self.moments[f"within the writing of {name}"] += 1
        self.problems += [f"{self.variant}, kill {self.kills}: {p}" for p in written.problems(self.folder)]


def start_command(program, scene, variant, folder):
    settings = [word for setting in VARIANTS[variant] for word in ("--set", setting)]
    return [program, scene, *settings, "--out", folder, "--quiet", "--threads", "1"]


def references(program, work):
    """Folder and processor seconds of a run without kills, by variant."""
    result = {}
    for number, variant in enumerate(VARIANTS):
        folder = work / f"reference_{number}"
        before = runs.children_seconds()
        subprocess.run(list(map(str, start_command(program, work / "scene.toml", variant, folder))), check=True)
        result[variant] = folder, runs.children_seconds() - before
        problems = written.problems(folder)
        if problems:
            sys.exit(f"a run without kills is not whole: {problems}")
    return result


def study(program, count, seed, report):
    chance = random.Random(seed)
    kills = restarts = finished = 0
    moments, problems, growth = collections.Counter(), [], []
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        (work / "scene.toml").write_text(SCENE)
        undisturbed = references(program, work)
        while kills < count:
            variant = list(VARIANTS)[finished % len(VARIANTS)]
            folder, seconds = undisturbed[variant]
            chain = Chain(program, work, variant, seconds, chance)
            chain.carry_out(count - kills)
            kills, restarts, finished = kills + chain.kills, restarts + chain.restarts, finished + 1
            moments += chain.moments
            found = chain.problems + [f"{variant}: {d}" for d in written.differences(folder, chain.folder)]
            for problem in found:
                report(problem)
            problems += found
            growth.append(written.size(chain.folder) / written.size(folder))
            report(f"{kills} kills, {finished} runs finished, {len(problems)} problems")
    return {"kills": kills, "runs": finished, "restarts_from_checkpoints": restarts, "killed": dict(sorted(moments.items())),
            "files_larger_by_at_most": round(max(growth), 3), "problems": problems}


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("--count", type=int, default=200, help="kills in all (default 200)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--store", action="store_true", help="write validation/results/kills.json")
    options = parser.parse_args()
    start = time.monotonic()
    found = study(command_line.program(options), options.count, options.seed, runs.say)
    for moment, number in found["killed"].items():
        print(f"  {number:4d} {moment}")
    print("\n".join(found["problems"]) or "nothing lost, the same bits")
    if options.store:
        result = {
            "case": "kills", "title": "SIGKILL at random moments, with output in every step",
            "command": f"scripts/python.sh validation/robustness/kills.py --count {options.count} --seed {options.seed} --store",
            "git_revision": store.revision(), "machine": store.machine(),
            "wall_seconds": round(time.monotonic() - start), "values": found,
        }
        store.write(RESULT, result)
    sys.exit(1 if found["problems"] else 0)


if __name__ == "__main__":
    main()
