#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Maps of where runs are stable, noisy, blown up or refused: docs/stability.md.

usage: scripts/python.sh bench/studies/stability_map.py MAP... [--quick] [--jobs N] [--apps build/release/apps]
       scripts/python.sh bench/studies/stability_map.py all
       scripts/python.sh bench/studies/stability_map.py --docs

Each map runs its scenes with one thread each (--jobs N: N at a time), and writes bench/results/stability/MAP.LEVEL.json and
docs/figures/stability_MAP.png. --quick takes fewer cells of each map. What has been run is not run again, and what was interrupted goes
on: results are in out/stability. --docs puts the stored tables, the full ones where there are both, into
docs/studies/stability_maps.md.
"""

import json
import math
import pathlib
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "validation"))

from harness import command_line, outputs, plans, runs, store, tables  # noqa: E402
from harness.store import machine, revision, seconds  # noqa: E402
from stability import long_runs, maps, picture, verdicts  # noqa: E402

RESULTS = ROOT / "bench" / "results" / "stability"
FIGURES = ROOT / "docs" / "figures"
PAGE = ROOT / "docs" / "studies" / "stability_maps.md"
NAMES = [*maps.ALL, *long_runs.ALL]
LEVELS = ("quick", "full")


def command_of(name, level):
    return f"scripts/python.sh bench/studies/stability_map.py {name}" + " --quick" * (level == "quick")


def carry_out(what, level, program, jobs):
    quick = level == "quick"
    wanted = {cell: what.run(*cell, quick) for cell in what.cells(quick)}
    planned = {cell: plans.plan(program, run.scene, run.settings()) for cell, run in wanted.items()}
    accepted = {cell: run for cell, run in wanted.items() if not planned[cell].refused}
    runs.execute_all(list(accepted.values()), program, jobs)
    measured = {cell: verdicts.measures(run.folder()) for cell, run in accepted.items()}
    quietest = {}
    for cell, values in measured.items():
        problem = what.same_problem(*cell)
        if values["completed"] and problem is not None:
            quietest[problem] = min(quietest.get(problem, math.inf), values["divergence"])
    cells = []
    for cell, run in wanted.items():
        panel, x, y = cell
        plan = planned[cell]
        limit = plan.longest_step
        entry = {"panel": panel, "x": x, "y": y, "verdict": verdicts.REFUSED, "warnings": plan.warnings, "refused": plan.refused,
                 "convection": limit, "recommended": bool(what.recommended(panel, x, y, limit or math.inf))}
        if cell in measured:
            entry |= {"verdict": verdicts.judge(measured[cell], quietest.get(what.same_problem(*cell), 0.0))} | measured[cell]
            entry |= {key: value for key, value in runs.provenance(run).items() if key in ("cpu_seconds", "git_revision")}
            entry["command"] = run.command("build/release/apps/vesicles")
        cells.append(entry)
    return cells


def counts(what, cells):
    """A table: verdicts by panel, in all and inside the recommended region."""
    kinds = (verdicts.STABLE, verdicts.NOISY, verdicts.BLOWN_UP, verdicts.REFUSED)
    rows = []
    for panel in dict.fromkeys(cell["panel"] for cell in cells):
        own = [cell for cell in cells if cell["panel"] == panel]
        inside = [cell for cell in own if cell["recommended"]]
        unwarned = [cell for cell in own if cell["verdict"] == verdicts.BLOWN_UP and not cell["warnings"]]
        many = lambda some: [str(sum(cell["verdict"] == kind for cell in some)) for kind in kinds]  # noqa: E731
        rows.append([panel, ", ".join(many(own)), ", ".join(many(inside)), str(len(unwarned))])
    names = ", ".join(kinds)
    columns = ["", f"all: {names}", "recommended region: the same", "blown up without a warning of the plan"]
    return tables.table(what.title[0].upper() + what.title[1:], columns, rows)


def exceptions(cells):
    """A table: what did not stay stable inside the recommended region."""
    some = [cell for cell in cells if cell["recommended"] and cell["verdict"] != verdicts.STABLE]
    rows = [[cell["panel"], str(cell["x"]), str(cell["y"]),
             cell["verdict"] + (f" at t = {cell['time']:.2g}" if cell["verdict"] == verdicts.BLOWN_UP else ""),
             tables.number(cell.get("divergence"), 2), tables.number(cell.get("jitter"), 2), "yes" if cell["warnings"] else "no"] for cell in some]
    return rows


def stored(what, level, cells):
    header = ["", what.x.label, what.y.label, "verdict", "surface divergence", "jitter, degrees", "warned"]
    rows = exceptions(cells)
    of_tables = [counts(what, cells)] + ([tables.table("Not stable inside the recommended region", header, rows)] if rows else [])
    return {"map": what.name, "level": level, "title": what.title, "command": command_of(what.name, level),
            "source": what.source, "git_revision": revision(), "machine": machine(),
            "cpu_seconds": round(sum(cell.get("cpu_seconds", 0.0) for cell in cells), 1),
            "values": {"tables": of_tables}, "cells": {f"{c['panel']} | {c['x']} | {c['y']}": outputs.rounded(c, 4) for c in cells}}


def title_of(name):
    return long_runs.ALL[name][0] if name in long_runs.ALL else maps.ALL[name].title


def carry_out_long(name, level, program, jobs):
    wanted = long_runs.runs_of(name, level == "quick")
    runs.execute_all(list(wanted.values()), program, jobs)
    values = {each: long_runs.measures(run.folder()) for each, run in wanted.items()}
    origin = {each: runs.provenance(run) for each, run in wanted.items()}
    return {"map": name, "level": level, "title": title_of(name), "command": command_of(name, level), "source": "",
            "git_revision": revision(), "machine": machine(), "cpu_seconds": round(sum(run["cpu_seconds"] for run in origin.values()), 1),
            "runs": origin, "values": {"tables": [long_runs.of_table(values)]}, "cells": outputs.rounded(values, 6)}


def is_finest(name, level):
    return level == "full" or not (RESULTS / f"{name}.full.json").exists()


def write_docs():
    blocks, rows = {}, []
    for name in NAMES:
        levels = {level: json.loads(file.read_text()) for level in LEVELS if (file := RESULTS / f"{name}.{level}.json").exists()}
        if not levels:
            continue
        level = "full" if "full" in levels else "quick"
        best = levels[level]
        source = f"`{command_of(name, level)}`, {len(best['cells'])} runs, {seconds(best['cpu_seconds'])} of one core"
        blocks[name] = tables.block(best["values"]["tables"], source + (f"; recommended: {best['source']}." if best["source"] else "."))
        rows.append([name, best["title"], *(seconds(levels[level]["cpu_seconds"] if level in levels else None) for level in LEVELS)])
    blocks["times"] = tables.block([tables.table("", ["map", "what", *LEVELS], rows)])
    tables.write_into(PAGE, blocks)


def main():
    parser = command_line.parser(__doc__, jobs=True)
    parser.add_argument("maps", nargs="*", metavar="MAP", help=f"all, {', '.join(NAMES)}")
    parser.add_argument("--quick", dest="level", action="store_const", const="quick", default="full", help="fewer cells of each map")
    parser.add_argument("--docs", action="store_true", help="put the stored tables into docs/studies/stability_maps.md")
    options = parser.parse_args()
    runs.stop_when_told()
    program = command_line.program(options)
    for name in command_line.chosen(parser, options.maps, NAMES, "map"):
        start, figure = time.monotonic(), FIGURES / f"stability_{name}.png"
        runs.say(f"== {name} ({options.level}): {title_of(name)}")
        if name in long_runs.ALL:
            result = carry_out_long(name, options.level, program, options.jobs)
            draw = lambda: long_runs.draw(result["cells"], figure)  # noqa: E731
        else:
            cells = carry_out(maps.ALL[name], options.level, program, options.jobs)
            result = stored(maps.ALL[name], options.level, cells)
            draw = lambda: picture.draw(maps.ALL[name], cells, figure)  # noqa: E731
        store.write(RESULTS / f"{name}.{options.level}.json", result)
        for each in result["values"]["tables"]:
            print(tables.text(each))
        if is_finest(name, options.level):
            draw()
        runs.say(f"   {time.monotonic() - start:.0f} s")
    if options.docs:
        write_docs()
    if not (options.maps or options.docs):
        parser.error("name a map, or --docs")


if __name__ == "__main__":
    main()
