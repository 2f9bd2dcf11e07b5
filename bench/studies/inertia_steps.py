#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""How the error of the step falls with its length where two viscosities have inertia.

usage: scripts/python.sh bench/studies/inertia_steps.py [--apps FOLDER] [--docs]

A vesicle of reduced volume 0.92 turns to its angle of tank-treading at Re = 5 (shear flow, Ca = 2, sigma0 = 2000, h = R/5) from 65 degrees. Each number
is the largest difference between t = 0.25 and t = 2 from the run with the shortest step, over the largest value of that run. Writes
bench/results/inertia_steps.json; --docs puts the stored table into docs/jump_conditions.md.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "validation"))
from harness import command_line, outputs, runs, store, tables  # noqa: E402

RESULT = ROOT / "bench" / "results" / "inertia_steps.json"
PAGE = ROOT / "docs" / "jump_conditions.md"
COMMAND = "scripts/python.sh bench/studies/inertia_steps.py"
RATIOS, STEPS, SHORTEST, SINCE = (0.3, 0.5, 1, 1.7, 3, 5, 6, 20), (48, 96, 192), 384, 0.25
COLUMNS = {"angle": "inclination_angle_deg", "frequency": "tank_treading_frequency"}
KEYS = {"coupling.method": "sharp", "coupling.thickness_correction": "false", "domain.cells": "[40, 20, 40]", "domain.periodic": "[false, false, false]",
        "flow.type": "shear", "fluid.reynolds_number": 5, "membrane.capillary_number": 2, "membrane.sigma0": 2000, "mesh.latitudes": 32,
        "vesicles.0.centre": "[0, 0, 0]", "vesicles.0.reduced_volume": 0.92, "vesicles.0.rotation_deg": 25, "time.end": 2, "method.accuracy": "as_given",
        "output.diagnostics_every": 0.25, "output.vesicle_every": 0, "output.checkpoint_every": 0}


def run(program, ratio, steps):
    """The columns from SINCE on, or None if the run stopped."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "scenes/poiseuille_off_axis.toml", "--out", folder, "--quiet", "--threads", "1"]
        keys = KEYS | {"fluid.viscosity_ratio": ratio, "time.step": f"1/{steps}"}
        done = subprocess.run(command + [part for key, value in keys.items() for part in ("--set", f"{key}={value}")], cwd=ROOT, env=runs.environment(),
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if done.returncode != 0:
            return None
        course = outputs.course(pathlib.Path(folder))
        kept = course["time"] >= SINCE - 1e-9
        return {name: course[column][kept].tolist() for name, column in COLUMNS.items()}


def difference(found, reference):
    return {name: max(abs(a - b) for a, b in zip(found[name], exact)) / max(map(abs, exact)) for name, exact in reference.items()}


def measure(program):
    found = {}
    for ratio in RATIOS:
        reference = run(program, ratio, SHORTEST)
        for steps in STEPS:
            one = run(program, ratio, steps) if reference else None
            found[f"{ratio:g}, 1/{steps}"] = difference(one, reference) if one else None
        runs.say(f"ratio {ratio:g}: " + ", ".join(f"1/{s} {found[f'{ratio:g}, 1/{s}']}" for s in STEPS))
    return found


def table_of(differences):
    def shown(ratio, steps):
        one = differences[f"{ratio:g}, 1/{steps}"]
        return "stopped" if one is None else " / ".join(f"{100 * one[name]:.2g}" for name in COLUMNS)
    return tables.table(f"Differences from steps of 1/{SHORTEST} in %, angle / frequency",
                        ["ratio", *(f"1/{steps}" for steps in STEPS)], [[f"{ratio:g}", *(shown(ratio, s) for s in STEPS)] for ratio in RATIOS])


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("--docs", action="store_true", help="put the stored table into docs/jump_conditions.md, without measuring")
    options = parser.parse_args()
    if not options.docs:
        before = runs.children_seconds()
        found = measure(str(command_line.program(options)))
        stored = {"command": COMMAND, "git_revision": store.revision(), "machine": store.processor(), "cpu_seconds": runs.children_seconds() - before,
                  "differences": outputs.rounded(found, 4)}
        print(tables.text(table_of(stored["differences"])))
        store.write(RESULT, outputs.rounded(stored, 4))
    elif RESULT.exists():
        stored = json.loads(RESULT.read_text())
        tables.write_into(PAGE, {"inertia_steps": tables.block([table_of(stored["differences"])], f"`{COMMAND}`, {stored['cpu_seconds'] / 60:.0f} min of one core.")})


if __name__ == "__main__":
    main()
