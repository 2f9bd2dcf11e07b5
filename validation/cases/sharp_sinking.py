# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""A sinking sphere whose membrane keeps its area: a flow along it that keeps every area and has the symmetry of sinking is none, so it sinks as a
solid sphere does, whatever its viscosity.

In a box 6 wide that repeats along all axes, without inertia; the speed is that of a cubic array of solid spheres, relative to the mean flow
(Sangani & Acrivos, Int. J. Multiphase Flow 8, 343, 1982, after Hasimoto, J. Fluid Mech. 5, 317, 1959). Mean speed of t = 0.25 to 1.25, in which the
sphere crosses five spacings of the coarsest grid.
"""

import math

import numpy as np

from harness import drawing, outputs
from harness.runs import Run
from harness.tables import table

TITLE = "a sinking sphere at viscosity ratios 0.2 to 20, sharp and delta"
RATIOS = [0.2, 1, 5, 20]
METHODS = ["sharp", "delta"]
WIDTH, PULL, END, SETTLED = 6.0, 9.0, 1.25, 0.25
CELLS = {"coarse": [30, 48], "paper": [30, 48, 64]}


def solid_speed():
    """Of the volume fraction c of spheres: Stokes's times 1 - 1.7601 c^(1/3) + c - ..."""
    c = 4 * math.pi / 3 / WIDTH**3
    hindered = 1 - 1.7601 * c ** (1 / 3) + c - 1.5593 * c**2 + 3.9799 * c ** (8 / 3) - 3.0734 * c ** (10 / 3)
    return 2 / 9 * PULL * hindered


def run_of(method, ratio, cells):
    keys = {"domain.lower": [-WIDTH / 2] * 3, "domain.upper": [WIDTH / 2] * 3, "domain.periodic": [True] * 3, 
            "domain.cells": cells, "flow.type": "rest", "fluid.inertia": "none", "fluid.viscosity_ratio": ratio, "coupling.method": method,
            "gravity.acceleration": [0, 0, -PULL], "vesicles.0.density_difference": 1,
            "vesicles.0.rotation_deg": 0, "vesicles.0.centre": [0.013, -0.021, 0.037], "membrane.sigma0": 2000,
            "mesh.latitudes": 16 if cells <= 30 else 24 if cells <= 48 else 32, "time.step": "1/24", "time.end": END,
            "output.diagnostics_every": "1/24", "output.vesicle_every": 0, "output.checkpoint_every": 0}
    return Run(f"{method}, ratio {ratio}, {cells}", "bench/studies/stability/start.toml", keys)


def state(folder):
    course = outputs.course(folder)
    time, height = course["time"], course["centroid_z"]
    last = time >= SETTLED - 1e-9
    speeds = -np.diff(height[last]) / np.diff(time[last])
    return {"speed": float((height[last][0] - height[-1]) / (time[-1] - time[last][0])), "ripple": float(np.std(speeds) / np.mean(speeds)),
            "local_area_error": float(course["max_local_area_error"].max()), "deformation": float(course["deformation"].max())}


def compute(context):
    cells = CELLS[context.level]
    runs = {(m, r, n): run_of(m, r, n) for n in cells for m in METHODS for r in RATIOS}
    folders = context.run(list(runs.values()))
    states = {key: state(folders[run.name]) for key, run in runs.items()}
    exact, rows = solid_speed(), []
    for n in cells:
        for m in METHODS:
            speeds = [states[m, r, n]["speed"] for r in RATIOS]
            off = [f"{100 * (s / exact - 1):+.2f} %" for s in speeds]
            spread = (max(speeds) - min(speeds)) / exact
            ripple = max(states[m, r, n]["ripple"] for r in RATIOS)
            rows.append([f"R/{n / WIDTH:.3g}", m, *off, f"{100 * spread:.2f} %", f"{100 * ripple:.2f} %"])
    values = {"states": {runs[key].name: value for key, value in states.items()}, "solid_speed": exact}
    values["tables"] = [table(f"Speed against that of solid spheres, {exact:.4f}",
                              ["h", "", *(f"ratio {r}" for r in RATIOS), "from the slowest to the fastest", "ripple on the grid, largest"], rows)]
    return values


def draw(context, values, path):
    figure, axes = drawing.figure(figsize=(5, 3.2))
    for m, colour in zip(METHODS, drawing.COLOURS):
        for n, style in zip(CELLS[context.level], ("o--", "s-", "^:")):
            speeds = [values["states"][f"{m}, ratio {r}, {n}"]["speed"] / values["solid_speed"] for r in RATIOS]
            axes.semilogx(RATIOS, speeds, style, color=colour, label=f"{m}, R/{n / WIDTH:.3g}")
    axes.axhline(1, color="0.4", linewidth=1)
    axes.set(xlabel="viscosity ratio", ylabel="speed over that of a solid sphere")
    axes.legend(fontsize=7)
    drawing.save(figure, path)
