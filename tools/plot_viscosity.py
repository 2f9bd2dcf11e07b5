#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Temporal error against time spent of the treatments of a field of viscosity, from bench/viscosity_treatments.

    plot_viscosity.py bench/results/viscosity_treatments.json docs/images/fluid/viscosity_treatments.png
    plot_viscosity.py bench/results/viscosity_treatments.json --table
    plot_viscosity.py bench/results/viscosity_solvers.json --solvers

With --table and --solvers it prints Markdown tables instead.
"""
import argparse
import itertools
import json
import statistics
import sys
from pathlib import Path

# Okabe and Ito's colours: told apart by colour-blind readers too.
TREATMENTS = {
    "explicit": ("explicit", "#D55E00", "s"),
    "extrapolated": ("extrapolated", "#0072B2", "o"),
    "implicit": ("implicit, to 1e-10", "#000000", "D"),
    "loose": ("implicit, to 1e-5", "#009E73", "^"),
    "stokes": ("no inertia, to 1e-8", "#CC79A7", "v"),
    "stokes_loose": ("no inertia, to 1e-4", "#E69F00", "<"),
}
STYLE = {"font.size": 9, "axes.titlesize": 9, "axes.spines.top": False, "axes.spines.right": False, "savefig.dpi": 160}


def runs_of(study, treatment):
    return [run for run in study["runs"] if run["treatment"] == treatment]


def draw_study(axes, study):
    """One panel; runs that blew up stand on its upper edge, at the time they would have taken had they got through."""
    for treatment, (label, colour, marker) in TREATMENTS.items():
        runs = runs_of(study, treatment)
        if not runs:
            continue
        sound = [run for run in runs if "error" in run]
        axes.loglog([run["cpu_seconds"] for run in sound], [run["error"] for run in sound], color=colour, marker=marker,
                    markersize=4, linewidth=1, label=label)
        for run in runs:
            if "error" not in run:
                axes.plot(run["cpu_seconds"] / max(run["blew_up_after"], 1.0 / run["steps"]), 0.97, marker="x",
                          color=colour, transform=axes.get_xaxis_transform(), clip_on=False)
    axes.axhline(study["reference_error"], color="0.6", linestyle=":", linewidth=1)
    axes.set_title(f"ratio {study['ratio']:g}, Re = {study['reynolds_number']:g}, {study['cells']}³")
    axes.grid(alpha=0.25, which="major")


def draw(studies, path):
    try:
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError as error:
        sys.exit(f"{error}. A python that has what this needs is found by: scripts/python.sh {' '.join(sys.argv)}")
    plt.rcParams.update(STYLE)
    columns = 3
    rows = -(-len(studies) // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(3.2 * columns, 2.6 * rows), sharey=True, squeeze=False)
    for axes, study in itertools.zip_longest(grid.flat, studies):
        if study:
            draw_study(axes, study)
            axes.set_xlabel("CPU seconds")
        else:
            axes.set_visible(False)
    for axes in grid[:, 0]:
        axes.set_ylabel("relative error of u")
    entries = {}
    for axes in grid.flat:
        entries.update(zip(*reversed(axes.get_legend_handles_labels())))
    figure.tight_layout(rect=(0, 0.35 / figure.get_figheight(), 1, 1))
    figure.legend(entries.values(), entries.keys(), loc="lower center", ncol=len(entries), frameon=False)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path)


def cell(run):
    if "error" not in run:
        return f"blew up at t = {run['blew_up_after']:.2g}"
    return f"{run['error']:.2g} ({run['cpu_seconds']:.2g} s)"


def print_treatments(studies):
    steps = sorted({run["steps"] for s in studies for run in s["runs"]})
    print("| cells, Re, ratio | treatment | " + " | ".join(f"dt = 1/{n}" for n in steps) + " |")
    print("|---|---|" + "---|" * len(steps))
    for s in studies:
        for treatment, (label, _, _) in TREATMENTS.items():
            found = {run["steps"]: run for run in runs_of(s, treatment)}
            if found:
                cells = " | ".join(cell(found[n]) if n in found else "" for n in steps)
                print(f"| {s['cells']}^3, {s['reynolds_number']:g}, {s['ratio']:g} | {label} | {cells} |")


def cost_of_schedule(study):
    """Least mean seconds per step over how many steps the factor is kept, and that number of steps."""
    costs = []
    for steps in range(1, len(study["solve_seconds"]) + 1):
        total = sum(study["solve_seconds"][:steps]) + sum(study["update_seconds"][:steps])
        costs.append((total / steps, steps))
    return min(costs)


def print_solvers(studies):
    print("| cells, form, Re, ratio | solver | first update, s | iterations | solve, s | factor kept for | s per step |")
    print("|---|---|---|---|---|---|---|")
    later = slice(2, None)  # steps with an extrapolated guess
    for s in studies:
        head = f"| {s['cells']}^3, {s['form']}, {s['reynolds_number']:g}, {s['ratio']:g} | {s['solver']} | "
        if "refused" in s:
            print(head + "refused: too large | | | | |")
            continue
        iterations = s["iterations"][later]
        solve = statistics.median(s["solve_seconds"][later])
        if s["solver"] == "cholmod":
            cost, kept = cost_of_schedule(s)
            kept = f"{kept} steps"
        else:
            cost, kept = solve + statistics.median(s["update_seconds"][later]), ""
        span = f"{min(iterations):g} to {max(iterations):g}"
        print(f"{head}{s['update_seconds'][0]:.2g} | {span} | {solve:.2g} | {kept} | {cost:.2g} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path)
    parser.add_argument("picture", type=Path, nargs="?")
    parser.add_argument("--table", action="store_true", help="print the errors and times of the treatments")
    parser.add_argument("--solvers", action="store_true", help="print the iterations and times of the solvers")
    arguments = parser.parse_args()
    results = json.loads(arguments.results.read_text())
    if arguments.table:
        print_treatments(results)
    elif arguments.solvers:
        print_solvers(results)
    elif arguments.picture:
        draw(results, arguments.picture)
    else:
        parser.error("nothing to do: name a picture, or give --table or --solvers")


if __name__ == "__main__":
    main()
