#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Growth of the cost: time and memory of a step against cells, latitudes and vesicles, with one thread and two, beside what the plan says.

usage: scripts/python.sh bench/studies/growth.py [--quick] [--apps FOLDER] [--docs]

Wants a quiet machine with 4 GB: times are wall milliseconds per step, the least of three runs of a few steps without output. Memory is the peak
resident size of the run. Writes bench/results/growth.json and docs/figures/growth.png (--quick: the small sizes once, growth.quick.json
and no picture); --docs puts the stored tables into docs/studies/growth.md. Exit code 1 if the memory of a plan is off by more than a tenth.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "validation"))
from harness import command_line, drawing, outputs, plans, runs, store, tables  # noqa: E402

RESULTS = ROOT / "bench" / "results"
PAGE = ROOT / "docs" / "studies" / "growth.md"
STEP = 960  # steps per unit of time: nothing moves far, so that sizes differ and shapes do not
ALLOWED = 0.1  # of memory
# What varies; the others stay at CELLS, LATITUDES and one vesicle. Several vesicles have a radius of 0.6 and a box of their own.
CELLS, LATITUDES = 64, 32
SWEEPS = {"cells": [32, 48, 64, 96, 128, 192, 256], "latitudes": [16, 24, 32, 48, 64, 96, 128], "vesicles": [1, 2, 4, 8, 16, 32, 64]}
QUICK = {"cells": [32, 48, 64], "latitudes": [16, 32], "vesicles": [1, 8]}
TITLES = {"cells": f"cells along each axis ({LATITUDES} latitudes, one vesicle)", "latitudes": f"latitudes ({CELLS}^3 cells, one vesicle)",
          "vesicles": f"vesicles of {LATITUDES} latitudes ({CELLS}^3 cells)"}


def scene(cells, latitudes, vesicles, steps):
    """Vesicles at reduced volume 0.9 in the lower left places of a 4 x 4 x 4 array in shear flow; one alone has radius 1."""
    places = [(-4.5 + 3 * i, -4.5 + 3 * j, -4.5 + 3 * k) for k in range(4) for j in range(4) for i in range(4)]
    text = f"""[domain]
cells = {cells}
[membrane]
sigma0 = 2000
[mesh]
latitudes = {latitudes}
[time]
step = "1/{STEP}"
end = "{steps}/{STEP}"
[output]
diagnostics_every = 0
vesicle_every = 0
fluid_every = 0
checkpoint_every = 0
"""
    for place in places[:vesicles]:
        where = 'radius = 0.6\ncentre = [{}, {}, {}]'.format(*place) if vesicles > 1 else ""
        text += f'[[vesicles]]\nshape = "prolate"\nreduced_volume = 0.9\n{where}\n'
    return text


# A process starts with the peak of the one that it is copied from: that of a small one is below what is measured.
LAUNCHER = """import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"""


def run(program, file, folder, threads):
    """Peak MB and the summary."""
    command = [sys.executable, "-I", "-S", "-c", LAUNCHER, program, file, "--out", folder, "--quiet", "--threads", str(threads)]
    peak = subprocess.run(command, env=runs.environment(threads), check=True, stdout=subprocess.PIPE, text=True).stdout
    return int(peak) * 1024 / 1e6, outputs.summary(pathlib.Path(folder))


def steps_for(cells):
    return max(4, min(48, 48 * 64**3 // cells**3))


def measure(program, cells, latitudes, vesicles, threads, repetitions):
    with tempfile.TemporaryDirectory() as work:
        file = f"{work}/scene.toml"
        pathlib.Path(file).write_text(scene(cells, latitudes, vesicles, steps_for(cells)))
        planned = plans.plan(program, file, threads=threads)
        done = [run(program, file, f"{work}/{i}", threads) for i in range(repetitions)]
    best = min((summary for _, summary in done), key=lambda summary: summary["seconds_per_step"])
    phases = best["phase_seconds"]
    fluid = sum(seconds for phase, seconds in phases.items() if phase.startswith("fluid"))
    return {"cells": cells, "latitudes": latitudes, "vesicles": vesicles, "threads": threads, "steps": best["steps"],
            "ms": 1e3 * best["seconds_per_step"], "planned_ms": 1e3 * planned.seconds_per_step, "fluid_share": fluid / sum(phases.values()),
            "mb": max(peak for peak, _ in done), "planned_mb": planned.memory_mb}


def study(program, sweeps, repetitions):
    found = {}
    for name, sizes in sweeps.items():
        found[name] = []
        for size in sizes:
            what = {"cells": CELLS, "latitudes": LATITUDES, "vesicles": 1} | {name: size}
            for threads in (1, 2):
                point = measure(program, **what, threads=threads, repetitions=repetitions)
                found[name].append(point)
                runs.say(f"{name} {size}, threads {threads}: {point['ms']:.4g} ms (plan {point['planned_ms']:.4g}), "
                         f"{point['mb']:.0f} MB (plan {point['planned_mb']:.0f})")
    return found


def misses(stored):
    return [p for points in stored["sweeps"].values() for p in points if abs(p["planned_mb"] / p["mb"] - 1) > ALLOWED]


def plan_less_use(point):
    """Of memory."""
    return tables.percent(point["planned_mb"], point["mb"])


def tables_of(stored):
    made = []
    for name, points in stored["sweeps"].items():
        one, two = ([p for p in points if p["threads"] == n] for n in (1, 2))
        rows, last = [], None
        for a, b in zip(one, two):
            order = "" if last is None else f"{np.log(a['ms'] / last['ms']) / np.log(a[name] / last[name]):.2f}"
            rows.append([a[name], a["ms"], order, a["planned_ms"], f"{100 * a['fluid_share']:.0f} %", b["ms"], a["ms"] / b["ms"],
                         a["mb"], a["planned_mb"], plan_less_use(a), b["mb"], plan_less_use(b)])
            last = a
        columns = [name, "ms per step", "power", "planned", "fluid", "two threads, ms", "gain", "MB", "planned", "plan less use",
                   "MB, two threads", "plan less use"]
        made.append(tables.table(f"By {TITLES[name]}", columns, rows))
    return made


def draw(stored, path):
    figure, panels = drawing.figure(2, 3, figsize=(10, 6), sharex="col")
    for column, (name, points) in zip(panels.T, stored["sweeps"].items()):
        for threads, colour in ((1, drawing.BLUE), (2, drawing.ORANGE)):
            chosen = [p for p in points if p["threads"] == threads]
            sizes = [p[name] for p in chosen]
            column[0].loglog(sizes, [p["ms"] for p in chosen], "o-", color=colour, markersize=4, label=f"{threads} thread{'s' * (threads > 1)}")
            column[1].loglog(sizes, [p["mb"] for p in chosen], "o-", color=colour, markersize=4)
        one = [p for p in points if p["threads"] == 1]
        column[0].loglog([p[name] for p in one], [p["planned_ms"] for p in one], "k:", linewidth=1, label="plan")
        column[1].loglog([p[name] for p in one], [p["planned_mb"] for p in one], "k:", linewidth=1)
        column[0].set_title(TITLES[name], fontsize=8)
        column[1].set(xlabel=name, xticks=[p[name] for p in one], xticklabels=[p[name] for p in one])
        column[1].minorticks_off()
    panels[0, 0].set(ylabel="ms per step")
    panels[1, 0].set(ylabel="peak MB")
    panels[0, 0].legend()
    drawing.save(figure, path)


def command_of(quick):
    return "scripts/python.sh bench/studies/growth.py" + " --quick" * quick


def stored_file(quick):
    return RESULTS / f"growth{'.quick' * quick}.json"


def write_docs():
    quick = not stored_file(False).exists()
    if quick and not stored_file(True).exists():
        return
    stored = json.loads(stored_file(quick).read_text())
    tables.write_into(PAGE, {"growth": tables.block(tables_of(stored), f"`{command_of(quick)}`, {stored['machine']}.")})


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("--quick", action="store_true", help="small sizes, once")
    parser.add_argument("--docs", action="store_true", help="put the stored tables into docs/studies/growth.md, without measuring")
    options = parser.parse_args()
    if options.docs:
        write_docs()
        return 0
    found = study(str(command_line.program(options)), QUICK if options.quick else SWEEPS, 1 if options.quick else 3)
    stored = {"command": command_of(options.quick), "git_revision": store.revision(), "machine": store.processor(),
              "sweeps": outputs.rounded(found, 5)}
    store.write(stored_file(options.quick), stored)
    for table in tables_of(stored):
        print(tables.text(table))
    if not options.quick:
        draw(stored, ROOT / "docs" / "figures" / "growth.png")
    off = misses(stored)
    for point in off:
        print(f"planned memory off by more than {100 * ALLOWED:g} %: {point}", file=sys.stderr)
    return 1 if off else 0


if __name__ == "__main__":
    sys.exit(main())
