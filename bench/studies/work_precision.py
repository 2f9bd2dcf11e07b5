#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run time against error: sweeps of the settings of a scene, each run against a reference of the case's own.

usage: scripts/python.sh bench/studies/work_precision.py CASE... [--quick] [--jobs N] [--apps FOLDER] [--docs]
       scripts/python.sh bench/studies/work_precision.py --list | --estimate

CASE is one of tank_treading, ratio_5, ratio_20, relaxation, duct, extension, unseen and unseen_tilted (what method.accuracy chooses, on scenes that were
not used to choose it), or all. Writes bench/results/work_precision/CASE.json (CASE.quick.json
with --quick: coarser references and fewer runs) and docs/figures/work_precision_CASE.png; --docs puts the stored tables into
docs/studies/work_precision.md. Runs have one thread each and are kept in out/validation: what is done is not run again, and what was
interrupted goes on from its checkpoint. Seconds are of the processor, of whole runs with start and output: on shared cores they vary by a fifth.
--list shows the cases, --estimate what their runs will take by the plan's model.
"""

import argparse
import json
import pathlib
import re
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "validation"))
from harness import outputs, runs, store, tables  # noqa: E402
from precision import cases, report, study  # noqa: E402

RESULTS = ROOT / "bench" / "results" / "work_precision"
PAGE = ROOT / "docs" / "studies" / "work_precision.md"


def stored_file(name, quick):
    return RESULTS / f"{name}{'.quick' if quick else ''}.json"


def carry_out(name, options):
    case = cases.load(name, options.quick)
    print(f"== {name}{' (quick)' if options.quick else ''}: {case.title}", flush=True)
    start = time.monotonic()
    wanted = case.runs()
    # The longest first: with several jobs they end together.
    order = sorted(wanted.values(), key=lambda run: -cost(run))
    runs.execute_all(order, ROOT / options.apps / "vesicles", options.jobs, lambda line: print(line, flush=True))
    result = {"case": name, "title": case.title, "command": f"scripts/python.sh bench/studies/work_precision.py {name}{' --quick' if options.quick else ''}",
              "git_revision": store.revision(), "machine": store.machine()} | study.evaluate(case, wanted)
    RESULTS.mkdir(parents=True, exist_ok=True)
    stored_file(name, options.quick).write_text(store.compact(outputs.rounded(result, 5)) + "\n")
    for stored in report.tables_of(result):
        print(tables.text(stored))
    if not options.quick or not stored_file(name, False).exists():
        report.draw(result, ROOT / "docs" / "figures" / f"work_precision_{name}.png")
    print(f"   {time.monotonic() - start:.0f} s", flush=True)


def cost(run):
    """Rough: cells times steps."""
    x, y, z = run.keys["domain.cells"]
    return x * y * z / step_of(run) * run.keys["time.end"]


def step_of(run):
    part = str(run.keys.get("time.step", "1/48")).split("/")
    return float(part[0]) / (float(part[1]) if len(part) == 2 else 1.0)


def estimate(name, options):
    """Processor minutes by the model of docs/plan.md, without what is done."""
    total = 0.0
    for run in case_runs(name, options.quick):
        command = [str(ROOT / options.apps / "vesicles"), run.scene, "--plan"] + [a for s in run.settings() for a in ("--set", s)]
        plan = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
        total += float(re.search(r"estimate: (\S+) s per step", plan).group(1)) * run.keys["time.end"] / step_of(run)
    return total / 60


def case_runs(name, quick):
    missing = [run for run in cases.load(name, quick).runs().values() if not runs.finished(run)]
    return {run.folder(): run for run in missing}.values()


def write_docs():
    blocks = {}
    for name in cases.BUILDERS:
        file = next((f for f in (stored_file(name, False), stored_file(name, True)) if f.exists()), None)
        if file is None:
            continue
        stored = json.loads(file.read_text())
        blocks[f"work_precision_{name}"] = "\n" + "\n\n".join(tables.markdown(t) for t in report.tables_of(stored)) + f"\n\n{report.source(stored)}\n"
    PAGE.write_text(tables.insert(PAGE.read_text(), blocks))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", help="names of cases, or all")
    parser.add_argument("--quick", action="store_true", help="coarser references, fewer runs")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time (default 1)")
    parser.add_argument("--apps", default="build/release/apps", help="folder of the programs (default build/release/apps)")
    parser.add_argument("--list", action="store_true", help="list the cases")
    parser.add_argument("--estimate", action="store_true", help="what the runs that are missing will take")
    parser.add_argument("--docs", action="store_true", help="put the stored tables into docs/studies/work_precision.md")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: (runs.stop(), sys.exit(143)))
    unknown = [name for name in options.cases if name != "all" and name not in cases.BUILDERS]
    if unknown:
        parser.error(f"unknown case {unknown[0]}: one of all, {', '.join(cases.BUILDERS)}")
    if not (options.cases or options.list or options.estimate or options.docs):
        parser.error("name a case, or --list")
    chosen = list(cases.BUILDERS) if "all" in options.cases or not options.cases else options.cases
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
