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
there are both, into paper_experiments.md, beyond_the_paper.md and sharp_membranes.md of docs/studies.
"""

import json
import subprocess
import time

import cases
from harness import command_line, outputs, runs, store, tables
from harness.store import machine, revision, seconds

RESULTS = runs.ROOT / "validation" / "results"
FIGURES = runs.ROOT / "docs" / "figures"
PAGES = [runs.ROOT / "docs" / "studies" / name for name in ("paper_experiments.md", "beyond_the_paper.md", "sharp_membranes.md")]


class Context:
    """What a case sees: its level, the programs, and its runs' files."""

    def __init__(self, options):
        self.options, self.level = options, options.level
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
        command = [str(command_line.program(self.options, name)), *arguments]
        before = runs.children_seconds()
        output = subprocess.run(command, cwd=runs.ROOT, check=True, capture_output=True, text=True).stdout
        self.app_seconds += runs.children_seconds() - before
        return output

    def run(self, what):
        """Runs what is missing of a list of runs; folders by name."""
        runs.execute_all(what, command_line.program(self.options), self.options.jobs)
        self.used += what
        self.folders.update({run.name: run.folder() for run in what})
        return self.folders


def carry_out(name, context):
    case = cases.load(name)
    runs.say(f"== {name} ({context.level}): {case.TITLE}")
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
    store.write(RESULTS / f"{name}.{context.level}.json", result)
    for stored in values["tables"]:
        print(tables.text(stored))
    if context.paper or not (RESULTS / f"{name}.paper.json").exists():
        case.draw(context, values, FIGURES / f"{name}.png")
    runs.say(f"   {time.monotonic() - start:.0f} s")


def write_docs():
    blocks = {}
    total = {}
    for file in sorted(RESULTS.glob("*.*.json")):  # coarse before paper, so that the finer one stays
        stored = json.loads(file.read_text())
        case, level = file.name.split(".")[:2]
        source = f"`{stored['command']}`, {len(stored['runs'])} runs, {seconds(stored['cpu_seconds'])} of one core."
        blocks[case] = tables.block(stored["values"]["tables"], source)
        total.setdefault(case, {})[level] = stored["cpu_seconds"]
    levels = ("coarse", "paper")
    rows = [[case, cases.load(case).TITLE, *(seconds(total[case].get(level)) for level in levels)] for case in cases.NAMES if case in total]
    rows.append(["all", "", *(seconds(sum(t.get(level, 0) for t in total.values())) for level in levels)])
    blocks["times"] = tables.block([tables.table("", ["case", "what", *levels], rows)])
    for page in PAGES:
        tables.write_into(page, blocks)


def main():
    parser = command_line.parser(__doc__, jobs=True)
    parser.add_argument("cases", nargs="*", help="names of cases, or all")
    level = parser.add_mutually_exclusive_group()
    level.add_argument("--coarse", dest="level", action="store_const", const="coarse", default="coarse")
    level.add_argument("--paper", dest="level", action="store_const", const="paper")
    parser.add_argument("--list", action="store_true", help="list the cases")
    parser.add_argument("--docs", action="store_true", help="put the stored tables into docs/studies")
    options = parser.parse_args()
    runs.stop_when_told()
    if options.list:
        for name in cases.NAMES:
            print(f"{name:22s} {cases.load(name).TITLE}")
    for name in command_line.chosen(parser, options.cases, cases.NAMES, "case"):
        carry_out(name, Context(options))
    if options.docs:
        write_docs()
    if not (options.cases or options.list or options.docs):
        parser.error("name a case, or --list")


if __name__ == "__main__":
    main()
