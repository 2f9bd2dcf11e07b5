# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Sharp membranes against the delta function: steady tank-treading against the grid, in a box 6 wide.

Walls at z = -3 and 3, periodic along x and y, quasi-static flow, dt = 1/24, means over the last unit of time: to t = 8; to t = 12 at other
viscosity ratios, to 20 at ratio 8, where the angle still falls slowly. The limit of each method is that of the two finest grids, second
order for the sharp membrane and first order for the delta function; errors are against the sharp one. Orders are those of the angle and of
the frequency over the three finest grids.
"""

import math

from harness import drawing, shear
from harness.runs import Run
from harness.tables import table

TITLE = "sharp membranes and the delta function against the grid"
SHARP, DELTA = "sharp", "delta"
ORDERS = {SHARP: 2, DELTA: 1}
# Reduced volume and viscosity ratio: by both methods, and by the sharp one alone.
COMPARED = [(0.9, 1), (0.7, 1), (0.9, 5)]
BODIES = [*COMPARED, (0.975, 1), (0.8, 1), *((volume, ratio) for volume in (0.95, 0.9) for ratio in (0.2, 2.7, 5, 8) if (volume, ratio) != (0.9, 5))]
# Cells along the box, for R/h = 5, 8, 12, 16.
COARSE, PAPER = [30, 48, 72], [30, 48, 72, 96]


def cells(context):
    return PAPER if context.paper else COARSE


def methods_of(body):
    return (SHARP, DELTA) if body in COMPARED else (SHARP,)


def run_of(volume, ratio, method, n):
    # From near the steady angle: the start is not what is asked for.
    latitudes = 16 if n <= 30 else 24 if n <= 48 else 32 if n <= 72 else 40
    keys = {"domain.cells": n, "domain.lower": [-3, -3, -3], "domain.upper": [3, 3, 3],
            "domain.periodic": [True, True, False], "fluid.inertia": "none", "fluid.viscosity_ratio": ratio,
            "mesh.latitudes": max(latitudes, 24 if volume < 0.8 else 0), "membrane.sigma0": 2000, "time.step": "1/24",
            "time.end": 8 if ratio == 1 else 12 if ratio < 8 else 20, "vesicles.0.reduced_volume": volume,
            "vesicles.0.rotation_deg": 60, "coupling.method": method, "output.fluid_every": 100, "output.checkpoint_every": 100}
    return Run(f"{volume}, {ratio}, {method}, {n}", shear.TREADING, keys)


def limit(values, n, order):
    """Of the two finest grids."""
    weight = (n[-1] / n[-2]) ** order
    return (weight * values[-1] - values[-2]) / (weight - 1)


def order_of(values, n):
    """p of a + b h^p through the three finest grids, by bisection; nan if they tell of none from 0.1 to 8."""
    first, second = values[-3] - values[-2], values[-2] - values[-1]

    def excess(p):
        return (n[-3] ** -p - n[-2] ** -p) / (n[-2] ** -p - n[-1] ** -p) - first / second

    low, high = 0.1, 8.0
    if second == 0 or not excess(low) < 0 < excess(high):
        return math.nan
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    return low


def shown(order):
    return "" if math.isnan(order) else f"{order:.1f}"


def compute(context):
    n = cells(context)
    runs = {(*body, m, k): run_of(*body, m, k) for body in BODIES for m in methods_of(body) for k in n}
    folders = context.run(list(runs.values()))
    steady = {key: shear.steady(folders[run.name]) for key, run in runs.items()}
    values, rows = {"steady": {runs[key].name: state for key, state in steady.items()}}, []

    def course(body, method, quantity):
        return [steady[*body, method, k][quantity] for k in n]

    def row_of(body, spacing, states, best):
        row = [*body, spacing]
        for state in states:
            row += [state["angle_deg"], f"{state['angle_deg'] - best['angle_deg']:+.3f}", state["frequency"],
                    f"{100 * (state['frequency'] / best['frequency'] - 1):+.2f} %"]
        return row + ["-"] * (3 + 4 * len(ORDERS) - len(row))

    for body in BODIES:
        limits = [{q: limit(course(body, m, q), n, ORDERS[m]) for q in ("angle_deg", "frequency")} for m in methods_of(body)]
        for k in n:
            rows.append(row_of(body, f"R/{k / 6:.3g}", [steady[*body, m, k] for m in methods_of(body)], limits[0]))
        rows.append(row_of(body, "limit", limits, limits[0]))
    columns = ["reduced volume", "ratio", "h"]
    for m in ORDERS:
        columns += [f"{m}: angle, degrees", "off", "frequency", "off"]
    orders = [[*body, *(shown(order_of(course(body, SHARP, q), n)) for q in ("angle_deg", "frequency"))] for body in BODIES]
    values["tables"] = [table("", columns, rows),
                        table("Orders of the sharp membrane", ["reduced volume", "ratio", "of the angle", "of the frequency"], orders)]
    return values


def draw(context, values, path):
    figure, panels = drawing.plt.subplots(1, len(COMPARED), figsize=(9, 2.8))
    n = cells(context)
    for axes, (volume, ratio) in zip(panels, COMPARED):
        for method, colour in zip(ORDERS, drawing.COLOURS):
            angles = [values["steady"][f"{volume}, {ratio}, {method}, {k}"]["angle_deg"] for k in n]
            axes.plot([6 / k for k in n], angles, "o-", color=colour, label=method)
        axes.set(xlabel="h/R", xlim=(0, None), title=f"{volume}, ratio {ratio}")
    panels[0].set_ylabel("inclination, degrees")
    panels[0].legend(fontsize=7)
    drawing.save(figure, path)
