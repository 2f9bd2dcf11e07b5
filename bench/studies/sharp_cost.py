#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a step with sharp membranes costs beside one with delta functions, by phase.

usage: scripts/python.sh bench/studies/sharp_cost.py [--quick] [--apps FOLDER] [--docs]

A vesicle of reduced volume 0.9 tank-treads in a box 8 wide, in steps of 1/24, without output. Each number is a difference of two runs, to t = 2 and to
t = 4, so that starts do not count: seconds of the processor over steps. Runs of both methods alternate, and medians of three are taken. Writes
bench/results/sharp_cost.json (--quick: 32^3 cells once, and nothing stored); --docs puts the stored tables into docs/coupling.md.
"""

import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "validation"))
from harness import command_line, outputs, runs, store, tables  # noqa: E402

RESULT = ROOT / "bench" / "results" / "sharp_cost.json"
PAGE = ROOT / "docs" / "coupling.md"
COMMAND = "scripts/python.sh bench/studies/sharp_cost.py"
GRIDS = {32: 16, 64: 32, 96: 32}  # cells, latitudes
CASES = [(1e-3, 1), (1e-3, 5), (1, 1), (1, 5)]  # Reynolds number, viscosity ratio
FROM, TO, STEPS = 2, 4, 48
# Phases that are told one by one; the others are the membranes' own work and diagnostics.
PHASES = {"grid": ("spread", "interpolate"), "fluid": ("fluid_convection", "fluid_viscous", "fluid_momentum", "fluid_projection", "indicator")}


def run(program, folder, end, keys):
    settings = {"domain.lower": "[-4,-4,-4]", "domain.upper": "[4,4,4]", "time.step": "1/24", "time.end": end, "coupling.thickness_correction": "false",
                "output.diagnostics_every": 0, "output.vesicle_every": 0, "output.fluid_every": 0, "output.checkpoint_every": 0} | keys
    command = [program, "scenes/tank_treading.toml", "--out", folder, "--quiet", "--threads", "1"]
    before = runs.children_seconds()
    subprocess.run(command + [part for key, value in settings.items() for part in ("--set", f"{key}={value}")], check=True, cwd=ROOT, env=runs.environment(),
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return runs.children_seconds() - before, outputs.summary(pathlib.Path(folder))["phase_seconds"]


def step_of(program, cells, reynolds_number, ratio, method):
    """Milliseconds: of a whole step by the processor's clock, and of its phases."""
    keys = {"domain.cells": cells, "mesh.latitudes": GRIDS[cells], "fluid.reynolds_number": reynolds_number, "fluid.viscosity_ratio": ratio, "coupling.method": method}
    with tempfile.TemporaryDirectory() as work:
        (early, early_phases), (late, late_phases) = (run(program, f"{work}/{end}", end, keys) for end in (FROM, TO))
    phases = {name: sum(late_phases.get(p, 0.0) - early_phases.get(p, 0.0) for p in of) for name, of in PHASES.items()}
    return {"step": 1e3 * (late - early) / STEPS} | {name: 1e3 * seconds / STEPS for name, seconds in phases.items()}


def measure(program, cells, reynolds_number, ratio, repetitions):
    all_of = {"delta": [], "sharp": []}
    for _ in range(repetitions):
        for method, steps in all_of.items():
            steps.append(step_of(program, cells, reynolds_number, ratio, method))
    middle = {method: {name: statistics.median(s[name] for s in steps) for name in steps[0]} for method, steps in all_of.items()}
    quotient = statistics.median(s["step"] / d["step"] for s, d in zip(all_of["sharp"], all_of["delta"]))
    runs.say(f"{cells}^3 cells, Re = {reynolds_number:g}, ratio {ratio}: {middle}, sharp / delta {quotient:.2f}")
    return {"cells": cells, "reynolds_number": reynolds_number, "ratio": ratio, "quotient": quotient} | middle


def tables_of(stored):
    rows = []
    for p in stored["points"]:
        text = [f"{p['delta'][name]:.3g} / {p['sharp'][name]:.3g}" for name in ("step", *PHASES)]
        rows.append([f"{p['cells']}^3", f"{p['reynolds_number']:g}", p["ratio"], *text, f"{p['quotient']:.2f}"])
    return [tables.table("Milliseconds of a step, delta / sharp", ["cells", "Re", "ratio", "step", "between membranes and grid", "fluid", "sharp over delta"], rows)]


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("--quick", action="store_true", help="32^3 cells, once, nothing stored")
    parser.add_argument("--docs", action="store_true", help="put the stored tables into docs/coupling.md, without measuring")
    options = parser.parse_args()
    if not options.docs:
        program = str(command_line.program(options))
        points = [measure(program, cells, *case, 1 if options.quick else 3) for cells in (list(GRIDS)[:1] if options.quick else GRIDS) for case in CASES]
        stored = {"command": COMMAND, "git_revision": store.revision(), "machine": store.processor(), "points": outputs.rounded(points, 4)}
        for table in tables_of(stored):
            print(tables.text(table))
        if not options.quick:
            store.write(RESULT, stored)
    elif RESULT.exists():
        stored = json.loads(RESULT.read_text())
        tables.write_into(PAGE, {"sharp_cost": tables.block(tables_of(stored), f"`{COMMAND}`, one thread, {stored['machine']}.")})


if __name__ == "__main__":
    main()
