#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What fluid.precision = "mixed" gains in whole runs, and what it changes.

usage: scripts/python.sh bench/studies/mixed_precision.py [--quick] [--apps FOLDER] [--docs]

A vesicle of reduced volume 0.9 tank-treads in a box 8 wide, in steps of 1/24, by delta functions at viscosity ratio 1. Cost: each number is a difference
of two runs without output, of 12 steps and of 24 (128^3 cells) to 240 (32^3) more; runs in both precisions alternate, and medians of five are taken. Change: both precisions run for 100
units of time on 32^3 cells (and at ratio 5 with sharp membranes, whose velocities are iterated, for 10), and what the membrane does is compared, with
the largest divergence on the way. Writes bench/results/mixed_precision.json (--quick: 32^3 cells once and short, nothing stored); --docs puts the stored
tables into docs/performance.md.
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

RESULT = ROOT / "bench" / "results" / "mixed_precision.json"
PAGE = ROOT / "docs" / "performance.md"
COMMAND = "scripts/python.sh bench/studies/mixed_precision.py"
GRIDS = {32: (16, 240), 64: (32, 96), 96: (32, 48), 128: (64, 24)}  # cells: latitudes, steps
WARM_UP = 12
BOX = {"domain.lower": "[-4,-4,-4]", "domain.upper": "[4,4,4]", "time.step": "1/24", "coupling.thickness_correction": "false", "coupling.method": "delta"}
SILENT = {f"output.{what}_every": 0 for what in ("diagnostics", "vesicle", "fluid", "checkpoint")} | {"output.report": "false"}
FLOWS = {"Re = 1e-3": {"fluid.reynolds_number": 1e-3}, "Re = 1": {"fluid.reynolds_number": 1},
         "Re = 1, ratio 5, sharp": {"fluid.reynolds_number": 1, "fluid.viscosity_ratio": 5, "coupling.method": "sharp"}}


def run(program, folder, keys):
    command = [program, "scenes/tank_treading.toml", "--out", folder, "--quiet", "--threads", "1"]
    before = runs.children_seconds()
    subprocess.run(command + [part for key, value in (BOX | keys).items() for part in ("--set", f"{key}={value}")], check=True, cwd=ROOT,
                   env=runs.environment(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return runs.children_seconds() - before, outputs.summary(pathlib.Path(folder))


def step_of(program, cells, precision):
    """Milliseconds of a whole step by the processor's clock."""
    latitudes, steps = GRIDS[cells]
    keys = SILENT | {"domain.cells": cells, "mesh.latitudes": latitudes, "fluid.precision": precision}
    with tempfile.TemporaryDirectory() as work:
        (early, _), (late, _) = (run(program, f"{work}/{n}", keys | {"time.end": f"{n}/24"}) for n in (WARM_UP, WARM_UP + steps))
    return 1e3 * (late - early) / steps


def cost(program, cells, repetitions):
    pairs = [{precision: step_of(program, cells, precision) for precision in ("double", "mixed")} for _ in range(repetitions)]
    ratios = sorted(p["mixed"] / p["double"] for p in pairs)
    result = {"cells": cells, "latitudes": GRIDS[cells][0], "ratio": statistics.median(ratios), "least": ratios[0], "greatest": ratios[-1]}
    runs.say(str(result))
    return result


def change(program, name, end):
    keys = {"domain.cells": 32, "mesh.latitudes": GRIDS[32][0], "time.end": end, "output.diagnostics_every": 1} | FLOWS[name]
    courses, divergences = {}, {}
    with tempfile.TemporaryDirectory() as work:
        for precision in ("double", "mixed"):
            folder = pathlib.Path(work) / precision
            _, summary = run(program, folder, SILENT | keys | {"fluid.precision": precision})
            courses[precision] = outputs.course(folder)
            divergences[precision] = summary["largest_errors"]["divergence"]
    a, b = courses["double"], courses["mixed"]
    angle = max(abs(x - y) for x, y in zip(a["inclination_angle_deg"], b["inclination_angle_deg"]))
    frequency = max(abs(x - y) for x, y in zip(a["tank_treading_frequency"], b["tank_treading_frequency"]))
    result = {"flow": name, "end": end, "angle": angle, "frequency": frequency, "double": divergences["double"], "mixed": divergences["mixed"]}
    runs.say(str(result))
    return result


def tables_of(stored):
    yield tables.table("CPU time of whole runs, mixed over double:", ("cells, latitudes", "a step", "of five pairs of runs"),
                       [(f"{p['cells']}^3, {p['latitudes']}", f"{p['ratio']:.2f}", f"{p['least']:.2f} to {p['greatest']:.2f}") for p in stored["cost"]])
    yield tables.table("What changes, at most on the way, on 32^3 cells:", ("flow", "time", "angle, degrees", "frequency", "div u in double", "in mixed"),
                       [(p["flow"], p["end"], p["angle"], p["frequency"], p["double"], p["mixed"]) for p in stored["change"]])


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("--quick", action="store_true", help="32^3 cells, once and short, nothing stored")
    parser.add_argument("--docs", action="store_true", help="put the stored tables into docs/performance.md, without measuring")
    options = parser.parse_args()
    if not options.docs:
        program = command_line.program(options)
        costs = [cost(program, cells, 1 if options.quick else 5) for cells in ([32] if options.quick else GRIDS)]
        changes = [change(program, name, 2 if options.quick else 10 if "sharp" in name else 100) for name in FLOWS]
        stored = {"command": COMMAND, "git_revision": store.revision(), "machine": store.processor(), "cost": outputs.rounded(costs, 4),
                  "change": changes}
        for table in tables_of(stored):
            print(tables.text(table))
        if not options.quick:
            store.write(RESULT, stored)
    else:
        stored = json.loads(RESULT.read_text())
        tables.write_into(PAGE, {"mixed_precision": tables.block(tables_of(stored), f"`{COMMAND}`, one thread, {stored['machine']}.")})


if __name__ == "__main__":
    main()
