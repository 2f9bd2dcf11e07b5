#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run time against error: sweeps of the settings of a scene, each run against a reference of the case's own.

usage: scripts/python.sh bench/studies/work_precision.py CASE... [--quick] [--jobs N] [--apps FOLDER] [--docs]
       scripts/python.sh bench/studies/work_precision.py --list | --estimate

CASE is one of tank_treading, ratio_5, ratio_5_sharp, ratio_20, relaxation, duct, extension, and, of what method.accuracy chooses, on scenes that were not used to
choose it, unseen, unseen_tilted, unseen_contrast, unseen_inertia and unseen_thin_inertia; or all. Writes bench/results/work_precision/CASE.json (CASE.quick.json with --quick: coarser
references and fewer runs) and docs/figures/work_precision_CASE.png; --docs puts the stored tables into
docs/studies/work_precision.md. Runs have one thread each and are kept in out/validation: what is done is not run again, and what was
interrupted goes on from its checkpoint. Seconds are of the processor, of whole runs with start and output: on shared cores they vary by a fifth.
--list shows the cases, --estimate what their runs will take by the plan's model.
"""

import json
import pathlib
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "validation"))
from harness import command_line, outputs, plans, runs, store, tables  # noqa: E402
from precision import cases, report, study  # noqa: E402

RESULTS = ROOT / "bench" / "results" / "work_precision"
PAGE = ROOT / "docs" / "studies" / "work_precision.md"


def stored_file(name, quick):
    return RESULTS / f"{name}{'.quick' if quick else ''}.json"


def command_of(name, quick):
    return f"scripts/python.sh bench/studies/work_precision.py {name}" + " --quick" * quick


def carry_out(name, options):
    case = cases.load(name, options.quick)
    runs.say(f"== {name}{' (quick)' if options.quick else ''}: {case.title}")
    start = time.monotonic()
    wanted = case.runs()
    # The longest first: with several jobs they end together.
    order = sorted(wanted.values(), key=lambda run: -cost(run))
    runs.execute_all(order, command_line.program(options), options.jobs)
    result = {"case": name, "title": case.title, "command": command_of(name, options.quick),
              "git_revision": store.revision(), "machine": store.machine()} | study.evaluate(case, wanted)
    store.write(stored_file(name, options.quick), outputs.rounded(result, 5))
    for stored in report.tables_of(result):
        print(tables.text(stored))
    if not options.quick or not stored_file(name, False).exists():
        report.draw(result, ROOT / "docs" / "figures" / f"work_precision_{name}.png")
    runs.say(f"   {time.monotonic() - start:.0f} s")


def cost(run):
    """Rough: cells times steps."""
    x, y, z = run.keys["domain.cells"]
    return x * y * z / step_of(run) * run.keys["time.end"]


def step_of(run):
    return runs.number(run.keys.get("time.step", "1/48"))


def estimate(name, options):
    """Processor minutes by the model of docs/plan.md, without what is done."""
    total = 0.0
    for run in case_runs(name, options.quick):
        plan = plans.plan(command_line.program(options), run.scene, run.settings())
        total += plan.seconds_per_step * run.keys["time.end"] / step_of(run)
    return total / 60


def case_runs(name, quick):
    missing = [run for run in cases.load(name, quick).runs().values() if not runs.finished(run)]
    return {run.folder(): run for run in missing}.values()


def write_docs():
    blocks = {}
    for name in cases.BUILDERS:
        quick = not stored_file(name, False).exists()
        if quick and not stored_file(name, True).exists():
            continue
        stored = json.loads(stored_file(name, quick).read_text())
        blocks[f"work_precision_{name}"] = tables.block(report.tables_of(stored), report.source(stored, command_of(name, quick)))
    tables.write_into(PAGE, blocks)


def main():
    parser = command_line.parser(__doc__, jobs=True)
    parser.add_argument("cases", nargs="*", help="names of cases, or all")
    parser.add_argument("--quick", action="store_true", help="coarser references, fewer runs")
    parser.add_argument("--list", action="store_true", help="list the cases")
    parser.add_argument("--estimate", action="store_true", help="what the runs that are missing will take")
    parser.add_argument("--docs", action="store_true", help="put the stored tables into docs/studies/work_precision.md")
    options = parser.parse_args()
    runs.stop_when_told()
    if not (options.cases or options.list or options.estimate or options.docs):
        parser.error("name a case, or --list")
    chosen = command_line.chosen(parser, options.cases or ["all"], cases.BUILDERS, "case")
    if options.list:
        for name in cases.BUILDERS:
            print(f"{name:15s} {cases.load(name, options.quick).title}")
    if options.estimate:
        for name in chosen:
            print(f"{name:15s} {len(case_runs(name, options.quick)):3d} runs to do, about {estimate(name, options):.1f} processor minutes")
    elif options.cases:
        for name in chosen:
            carry_out(name, options)
    if options.docs:
        write_docs()


if __name__ == "__main__":
    main()
