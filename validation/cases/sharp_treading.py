# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Sharp membranes against the delta function: steady tank-treading against the grid, in a box 6 wide.

Walls at z = -3 and 3, periodic along x and y, quasi-static flow, dt = 1/24, means over the last unit of time: to t = 8, at ratio 5 to t = 12, when
its angle still falls by 0.05 degrees in a unit of time, as does that of the reduced volume 0.7. The limit of each method is that of the two finest
grids, second order for the sharp membrane and first order for the delta function; errors are against the sharp one.
"""

from harness import drawing, shear
from harness.runs import Run
from harness.tables import table

TITLE = "sharp membranes and the delta function against the grid"
BODIES = [(0.9, 1), (0.7, 1), (0.9, 5)]
METHODS = {"sharp": 2, "delta": 1}
# Cells along the box, for R/h = 5, 8, 12, 16.
COARSE, PAPER = [30, 48, 72], [30, 48, 72, 96]


def cells(context):
    return PAPER if context.paper else COARSE


def run_of(volume, ratio, method, n):
    # From near the steady angle: the start is not what is asked for.
    latitudes = 16 if n <= 30 else 24 if n <= 48 else 32 if n <= 72 else 40
    keys = {"domain.cells": n, "domain.lower": [-3, -3, -3], "domain.upper": [3, 3, 3],
            "domain.periodic": [True, True, False], "fluid.inertia": "none", "fluid.viscosity_ratio": ratio,
            "mesh.latitudes": max(latitudes, 24 if volume < 0.8 else 0), "membrane.sigma0": 2000, "time.step": "1/24",
            "time.end": 12 if ratio > 1 else 8, "vesicles.0.reduced_volume": volume, "vesicles.0.rotation_deg": 60,
            "coupling.method": method, "output.fluid_every": 100, "output.checkpoint_every": 100}
    return Run(f"{volume}, {ratio}, {method}, {n}", shear.TREADING, keys)


def limit(values, n, order):
    """Of the two finest grids."""
    weight = (n[-1] / n[-2]) ** order
    return (weight * values[-1] - values[-2]) / (weight - 1)


def compute(context):
    n = cells(context)
    runs = {(v, r, m, k): run_of(v, r, m, k) for v, r in BODIES for m in METHODS for k in n}
    folders = context.run(list(runs.values()))
    steady = {key: shear.steady(folders[run.name]) for key, run in runs.items()}
    values, rows = {"steady": {runs[key].name: state for key, state in steady.items()}}, []
    for volume, ratio in BODIES:
        limits = {m: {q: limit([steady[volume, ratio, m, k][q] for k in n], n, order) for q in ("angle_deg", "frequency")}
                  for m, order in METHODS.items()}
        best = limits["sharp"]
        for k in n:
            row = [volume, ratio, f"R/{k / 6:.3g}"]
            for m in METHODS:
                state = steady[volume, ratio, m, k]
                row += [state["angle_deg"], f"{state['angle_deg'] - best['angle_deg']:+.3f}", state["frequency"],
                        f"{100 * (state['frequency'] / best['frequency'] - 1):+.2f} %"]
            rows.append(row)
        row = [volume, ratio, "limit"]
        for m in METHODS:
            row += [limits[m]["angle_deg"], f"{limits[m]['angle_deg'] - best['angle_deg']:+.3f}", limits[m]["frequency"],
                    f"{100 * (limits[m]['frequency'] / best['frequency'] - 1):+.2f} %"]
        rows.append(row)
    columns = ["reduced volume", "ratio", "h"]
    for m in METHODS:
        columns += [f"{m}: angle, degrees", "off", "frequency", "off"]
    values["tables"] = [table("", columns, rows)]
    return values


def draw(context, values, path):
    figure, panels = drawing.plt.subplots(1, len(BODIES), figsize=(9, 2.8))
    n = cells(context)
    for axes, (volume, ratio) in zip(panels, BODIES):
        for method, colour in zip(METHODS, drawing.COLOURS):
            angles = [values["steady"][f"{volume}, {ratio}, {method}, {k}"]["angle_deg"] for k in n]
            axes.plot([6 / k for k in n], angles, "o-", color=colour, label=method)
        axes.set(xlabel="h/R", xlim=(0, None), title=f"{volume}, ratio {ratio}")
    panels[0].set_ylabel("inclination, degrees")
    panels[0].legend(fontsize=7)
    drawing.save(figure, path)
