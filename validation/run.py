#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the validation cases: scenes, numbers, figures.

usage: scripts/python.sh validation/run.py CASE... [--coarse | --paper] [--jobs N]
       scripts/python.sh validation/run.py all --coarse
       scripts/python.sh validation/run.py --list
       scripts/python.sh validation/run.py --docs

Each case runs its scenes one after the other with one thread each (--jobs N: N at a time), and writes validation/results/CASE.LEVEL.json and
docs/figures/CASE.png. --coarse (default) takes minutes, --paper takes the paper's resolution. What has been run is not run again, and a run that was
interrupted goes on from its checkpoint: results are in out/validation. --docs puts the stored tables, the finer where
there are both, into docs/studies/paper_experiments.md and beyond_the_paper.md.
"""

import argparse
import json
import pathlib
import resource
import signal
import subprocess
import sys
import time

import cases
from harness import outputs, runs, tables
from harness.store import compact, machine, revision, seconds

RESULTS = runs.ROOT / "validation" / "results"
FIGURES = runs.ROOT / "docs" / "figures"
PAGES = [runs.ROOT / "docs" / "studies" / name for name in ("paper_experiments.md", "beyond_the_paper.md")]


class Context:
    """What a case sees: its level, the programs, and its runs' files."""

    def __init__(self, level, build, jobs):
        self.level, self.build, self.jobs = level, pathlib.Path(build), jobs
        self.used, self.folders, self.app_seconds = [], {}, 0.0

    @property
    def paper(self):
        return self.level == "paper"

    def cpu_seconds(self):
        """Of its runs, whichever case they were first made for."""
        of_runs = sum(runs.provenance(run)["cpu_seconds"] for run in {r.folder(): r for r in self.used}.values())
        return round(of_runs + self.app_seconds, 1)

    def app(self, name, *arguments):
        """Standard output of another app."""
        command = [str(self.build / name), *arguments]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        output = subprocess.run(command, cwd=runs.ROOT, check=True, capture_output=True, text=True).stdout
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.app_seconds += after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return output

    def run(self, what):
        """Runs what is missing of a list of runs; folders by name."""
        runs.execute_all(what, self.build / "vesicles", self.jobs, lambda line: print(line, flush=True))
        self.used += what
        self.folders.update({run.name: run.folder() for run in what})
        return self.folders


def carry_out(name, context):
    case = cases.load(name)
    print(f"== {name} ({context.level}): {case.TITLE}", flush=True)
    start = time.monotonic()
    values = case.compute(context)
    result = {
        "case": name, "level": context.level, "title": case.TITLE,
        "command": f"scripts/python.sh validation/run.py {name} --{context.level}",
        "git_revision": revision(), "machine": machine(),
        "cpu_seconds": context.cpu_seconds(),
        "runs": {run.name: runs.provenance(run) for run in context.used},
        "values": outputs.rounded(values),
    }
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / f"{name}.{context.level}.json").write_text(compact(result) + "\n")
    for stored in values["tables"]:
        print(tables.text(stored))
    if context.paper or not (RESULTS / f"{name}.paper.json").exists():
        case.draw(context, values, FIGURES / f"{name}.png")
    print(f"   {time.monotonic() - start:.0f} s", flush=True)


def write_docs():
    blocks = {}
    total = {}
    for file in sorted(RESULTS.glob("*.*.json")):  # coarse before paper, so that the finer one stays
        stored = json.loads(file.read_text())
        case, level = file.name.split(".")[:2]
        blocks[case] = "\n" + "\n\n".join(tables.markdown(t) for t in stored["values"]["tables"])
        blocks[case] += f"\n\n`{stored['command']}`, {len(stored['runs'])} runs, {seconds(stored['cpu_seconds'])} of one core.\n"
        total.setdefault(case, {})[level] = stored["cpu_seconds"]
    rows = [[case, cases.load(case).TITLE, *(seconds(total[case].get(level)) for level in ("coarse", "paper"))] for case in cases.NAMES if case in total]
    rows.append(["all", "", *(seconds(sum(t.get(level, 0) for t in total.values())) for level in ("coarse", "paper"))])
    blocks["times"] = "\n" + tables.markdown(tables.table("", ["case", "what", "coarse", "paper"], rows)) + "\n"
    for page in PAGES:
        page.write_text(tables.insert(page.read_text(), blocks))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", help="names of cases, or all")
    level = parser.add_mutually_exclusive_group()
    level.add_argument("--coarse", dest="level", action="store_const", const="coarse", default="coarse")
    level.add_argument("--paper", dest="level", action="store_const", const="paper")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time (default 1)")
    parser.add_argument("--apps", default="build/release/apps", help="folder of the programs (default build/release/apps)")
    parser.add_argument("--list", action="store_true", help="list the cases")
    parser.add_argument("--docs", action="store_true", help="put the stored tables into docs/studies")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: (runs.stop(), sys.exit(143)))
    if options.list:
        for name in cases.NAMES:
            print(f"{name:22s} {cases.load(name).TITLE}")
    unknown = [name for name in options.cases if name != "all" and name not in cases.NAMES]
    if unknown:
        parser.error(f"unknown case {unknown[0]}: one of all, {', '.join(cases.NAMES)}")
    for name in cases.NAMES if "all" in options.cases else options.cases:
        carry_out(name, Context(options.level, runs.ROOT / options.apps, options.jobs))
    if options.docs:
        write_docs()
    if not (options.cases or options.list or options.docs):
        parser.error("name a case, or --list")


if __name__ == "__main__":
    main()
