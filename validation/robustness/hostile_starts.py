#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Starts that no one should choose: each gives a right answer, a refusal or a warning. The table of
docs/studies/hostile_starts.md.

usage: scripts/python.sh validation/robustness/hostile_starts.py [--jobs N] [--apps build/release/apps] [--docs]

"Right" is measured against the same scene on a grid twice as fine (or the one the case names). Results are in out/hostile, the table in
validation/results/hostile_starts.json; --docs puts it into docs/studies/hostile_starts.md. What has been run is not run again.
tests/simulation/hostile_starts_test.cpp has the quick ones.
"""

import dataclasses
import json
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line, outputs, plans, runs, tables  # noqa: E402
from harness.runs import ROOT, Run  # noqa: E402

STORE = ROOT / "out" / "hostile"
RESULT = ROOT / "validation" / "results" / "hostile_starts.json"
PAGE = ROOT / "docs" / "studies" / "hostile_starts.md"
SINGLE, PAIR = "scenes/paper/half_box.toml", "validation/robustness/pair.toml"
QUIET = {"output.vesicle_every": 0, "output.checkpoint_every": 0}
SMALL = QUIET | {"domain.lower": [-3, 0, -3], "domain.upper": [3, 3, 3], "domain.cells": [32, 16, 32], "mesh.latitudes": 24, "membrane.sigma0": 2000,
                 "vesicles.0.rotation_deg": 0, "time.end": 2}
NEAR_WALL = SMALL | {"flow.type": "plane_poiseuille", "domain.lower": [-3, 0, -2], "domain.upper": [3, 2, 2], "domain.cells": [48, 16, 32],
                     "domain.periodic": [True, False, False], "vesicles.0.radius": 0.6, "vesicles.0.rotation_deg": 90, "time.end": 1}


@dataclasses.dataclass(frozen=True)
class Case:
    """finer: keys of the run to compare with, for one that should be right; says: words of the refusal, the stop or the warning."""

    name: str
    keys: dict
    scene: str = SINGLE
    finer: dict | None = None
    says: str | None = None


def pair(gap):
    half = 0.595 + gap / 2  # half the width of a prolate of this volume, radius 0.7, and half the gap
    return {"vesicles.0.centre": [-half, 0, 0.2], "vesicles.1.centre": [half, 0, -0.2]}


def cells(n):
    return {"domain.cells": [n, n // 2, n]}


def tight(half_width, n):
    return SMALL | {"domain.lower": [-half_width, 0, -half_width], "domain.upper": [half_width] * 3} | cells(n)


FINE_PAIR = cells(64) | {"mesh.latitudes": 40}
CASES = [
    Case("a vesicle one spacing off a wall", NEAR_WALL | {"vesicles.0.centre": [0, 0, 1.39]}, says="1.5 grid spacings off the walls"),
    Case("a vesicle 1.7 spacings off a wall", NEAR_WALL | {"vesicles.0.centre": [0, 0, 1.3]}, says="is not resolved below 2 h",
         finer={"domain.cells": [96, 32, 64], "mesh.latitudes": 40}),
    Case("a vesicle that gravity drives into a wall", NEAR_WALL | {"vesicles.0.centre": [0, 0, 1.1], "gravity.acceleration": [0, 0, 20],
                                                                   "vesicles.0.density_difference": 1, "time.end": 5},
         says="grid spacings to the wall"),
    Case("two vesicles that overlap", pair(-0.1), PAIR, says="overlap"),
    Case("two vesicles 0.3 h apart", pair(0.06), PAIR, says="is not resolved below 2 h", finer=FINE_PAIR),
    Case("two vesicles 1.5 h apart", pair(0.28), PAIR, says="is not resolved below 2 h", finer=FINE_PAIR),
    Case("a box too small for the vesicle", tight(1.7, 32), says="off the walls"),
    Case("a box 3.5 h wider than the vesicle at each end", tight(1.9, 32), finer=cells(64) | {"mesh.latitudes": 40}),
    Case("spacings of 2 : 1 : 1", SMALL | {"domain.cells": [16, 16, 32]}, says="below 8", finer=cells(32)),
    Case("spacings of 1 : 2 : 2", SMALL | {"domain.cells": [64, 16, 32]}, finer=cells(32)),
    Case("spacings of 1 : 4 : 4", SMALL | {"domain.cells": [64, 8, 16]}, says="below 8", finer=cells(32)),
    Case("the same, `euler`, g = 18 of the finest spacing", SMALL | {"domain.cells": [64, 8, 16], "time.markers": "euler", "time.step": "1/192",
                                                                   "membrane.sigma0": 1300}, says="far beyond"),
    Case("8 latitudes", SMALL | {"mesh.latitudes": 8}, says="bending force is not resolved", finer={"mesh.latitudes": 24}),
    Case("4 cells across the vesicle", SMALL | {"domain.lower": [-3, -3, -3], "domain.mirror": [False] * 3, "domain.cells": 12}, says="below 8",
         finer={"domain.lower": [-3, 0, -3], "domain.mirror": [False, True, False]} | cells(32)),
    Case("a vesicle smaller than a cell", SMALL | {"vesicles.0.radius": 0.08}, says="below 8"),
    Case("reduced volume 0.3", SMALL | {"vesicles.0.reduced_volume": 0.3}, says="grid spacings"),
    Case("time.step = 0.3", SMALL | {"time.step": 0.3}, says="must be <= 0.25"),
    Case("`euler` at g = 17", SMALL | {"time.markers": "euler", "time.step": "1/192", "membrane.sigma0": 2448}, says="far beyond"),
    Case("`ab2` at g = 4.2", SMALL | {"time.markers": "ab2", "time.step": "1/192", "membrane.sigma0": 600}, says="WARNING: beyond it"),
]
KEEPS = "a restart keeps everything"
RESTARTS = [("a restart with another Reynolds number", {"fluid.reynolds_number": 1.0}), ("a restart with the flow turned round", {"flow.rate": -1.0})]


def invoke(program, run, *more):
    command = [str(program), run.scene, "--threads", "1", "--quiet", *more]
    for setting in run.settings():
        command += ["--set", setting]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True)


def compare(coarse, fine):
    """Of the first vesicle at the end: inclination in degrees, frequency in per cent, centre."""
    a, b = (outputs.summary(folder)["vesicles"][0] for folder in (coarse, fine))
    return {"inclination_deg": outputs.turned(a["inclination_angle_deg"] - b["inclination_angle_deg"]),
            "frequency_percent": 100 * (a["tank_treading_frequency"] / b["tank_treading_frequency"] - 1),
            "centre": float(np.linalg.norm(np.subtract(a["centroid"], b["centroid"]))), "divergence": a["surface_divergence_max"]}


def carry_out(case, program, jobs):
    run = Run(case.name, case.scene, case.keys, store=STORE)
    plan = plans.plan(program, run.scene, run.settings())
    said = plan.text + plan.errors
    found = {"case": case.name, "command": run.command("build/release/apps/vesicles"), "says": case.says, "verdicts": []}
    if plan.refused:
        found["verdicts"].append("refused")
    else:
        wanted = [run] + ([Run(f"{case.name}, reference", case.scene, case.keys | case.finer, store=STORE)] if case.finer else [])
        runs.execute_all(wanted, program, jobs)
        said += (run.folder() / "log.txt").read_text()
        if plan.warnings or "warning" in (run.folder() / "log.txt").read_text():
            found["verdicts"].append("warned")
        summary = outputs.summary(run.folder())
        if summary["status"] != "completed":
            found["verdicts"].append(f"stopped at t = {summary['time']:.2g}")
        elif case.finer:
            found["against"] = compare(run.folder(), wanted[1].folder())
            found["verdicts"].append("runs")
        else:
            found["verdicts"].append("runs")
        found["cpu_seconds"] = sum(runs.provenance(each)["cpu_seconds"] for each in wanted)
    found["said"] = case.says is None or case.says in said
    return found


def restarts(program):
    base = Run("restart", SINGLE, SMALL | {"output.checkpoint_every": 1, "time.end": "1/24"}, keep_checkpoint=True, store=STORE)
    runs.execute_all([base], program, 1)
    for name, keys in RESTARTS:
        run = Run(name, SINGLE, base.keys | keys | {"time.end": 1}, store=STORE)
        result = invoke(program, run, "--restart", str(base.folder() / "checkpoint.h5"), "--out", str(run.folder()))
        yield {"case": name, "verdicts": ["refused" if result.returncode == plans.BAD_INPUT else f"exit code {result.returncode}"],
               "says": KEEPS, "said": KEEPS in result.stderr}


def table_of(results):
    rows = []
    for found in results:
        against = found.get("against")
        text = (f"{against['inclination_deg']:+.2f} degrees, {against['frequency_percent']:+.1f} %, {against['centre']:.1e}" if against else "")
        rows.append([found["case"], ", ".join(found["verdicts"]), found["says"] or "", text])
    return tables.table("", ["start", "what happens", "it says", "against the finer run: inclination, frequency, centre"], rows)


def main():
    parser = command_line.parser(__doc__, jobs=True)
    parser.add_argument("--docs", action="store_true", help="put the table into docs/studies/hostile_starts.md")
    options = parser.parse_args()
    program = command_line.program(options)
    results = [carry_out(case, program, options.jobs) for case in CASES] + list(restarts(program))
    RESULT.write_text(json.dumps(outputs.rounded(results, 4), indent=1) + "\n")
    stored = table_of(results)
    print(tables.text(stored))
    if options.docs:
        tables.write_into(PAGE, {"hostile": tables.block([stored])})
    silent = [found["case"] for found in results if not found["said"]]
    if silent:
        raise SystemExit(f"without the words that were expected: {', '.join(silent)}")


if __name__ == "__main__":
    main()
