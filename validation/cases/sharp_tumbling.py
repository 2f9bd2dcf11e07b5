# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tumbling of a sharp membrane at viscosity ratio 20, reduced volume 0.9: half turns against the grid, and twelve turns in one run.

In a box 6 wide, walls at z = -3 and 3, periodic along x and y, without inertia, dt = 1/48, from across the flow. The limit is of second order, from
the two finest grids.
"""

import numpy as np

from harness import drawing, outputs, shear
from harness.runs import Run
from harness.tables import table

TITLE = "tumbling of sharp membranes at ratio 20 against the grid, and twelve turns"
CELLS, LATITUDES = [32, 48, 64], {32: 24, 48: 32, 64: 40}
END, LONG_END = 25, 245  # two half turns, and twelve turns


def run_of(cells, end):
    keys = {"domain.lower": [-3] * 3, "domain.upper": [3] * 3, "domain.mirror": [False] * 3, "domain.periodic": [True, True, False],
            "domain.cells": cells, "mesh.latitudes": LATITUDES[cells], "fluid.inertia": "none", "fluid.viscosity_ratio": 20,
            "membrane.sigma0": 2000, "coupling.method": "sharp", "time.step": "1/48", "time.end": end, "vesicles.0.rotation_deg": 0,
            "output.vesicle_every": 0, "output.checkpoint_every": 10}
    return Run(f"{cells} cells to t = {end}", "scenes/paper/half_box.toml", keys)


def state(folder):
    summary, course = outputs.summary(folder), outputs.course(folder)
    later = course["time"] > 1
    return {"status": summary["status"], "time": summary["time"], "half_turns": np.diff(shear.half_turns(course)).tolist(),
            "divergence": float(course["surface_divergence_max"][later].max()),
            "local_area_error": float(course["max_local_area_error"].max()), "area_error": float(np.abs(course["area_error"]).max()),
            "volume_error": float(np.abs(course["volume_error"]).max()), "velocity_noise": summary["largest_errors"]["velocity_noise"]}


def compute(context):
    runs = {n: run_of(n, END if n > CELLS[0] else LONG_END) for n in CELLS}
    folders = context.run(list(runs.values()))
    states = {key: state(folders[run.name]) for key, run in runs.items()}
    mean = {n: float(np.mean(states[n]["half_turns"][:2])) for n in CELLS}
    weight = (CELLS[-1] / CELLS[-2]) ** 2
    limit = (weight * mean[CELLS[-1]] - mean[CELLS[-2]]) / (weight - 1)
    rows = []
    for n in CELLS:
        s = states[n]
        halves = s["half_turns"]
        later = f"{len(halves)}: {min(halves):.3f} to {max(halves):.3f}, the last {halves[-1]:.3f}" if len(halves) > 2 else ""
        rows.append([f"R/{n / 6:.3g}", s["status"], s["time"], ", ".join(f"{h:.3f}" for h in halves[:2]), later,
                     f"{mean[n]:.4f}", f"{100 * (mean[n] / limit - 1):+.2f} %",
                     f"{s['divergence']:.1e}", f"{s['velocity_noise']:.1e}", f"{s['local_area_error']:.1e}", f"{s['area_error']:.0e}",
                     f"{s['volume_error']:.0e}"])
    rows.append(["limit", "", "", "", "", f"{limit:.4f}", "", "", "", "", "", ""])
    course = outputs.course(folders[runs[CELLS[0]].name])
    series = dict(zip(("time", "angle_deg", "divergence"), outputs.thinned(course["time"], course["inclination_angle_deg"],
                                                                           course["surface_divergence_max"], count=1001)))
    return {"states": {runs[key].name: value for key, value in states.items()}, "limit": limit, "series": series,
            "tables": [table("", ["h", "ended", "t", "the first half turns", "all", "mean of the first", "off the limit",
                                  "largest surface divergence after t = 1", "largest noise of the velocity", "largest local area error", "area error",
                                  "volume error"], rows)]}


def draw(context, values, path):
    figure, axes = drawing.figure(2, 1, figsize=(8, 4), sharex=True)
    series = {key: np.array([np.nan if v is None else v for v in column], dtype=float) for key, column in values["series"].items()}
    axes[0].plot(series["time"], drawing.gaps(series["angle_deg"]), color=drawing.BLUE, linewidth=0.8)
    axes[0].set_ylabel("inclination, degrees")
    axes[1].semilogy(series["time"], series["divergence"], color=drawing.BLUE, linewidth=0.8)
    axes[1].set(xlabel="t", ylabel="surface divergence")
    drawing.save(figure, path)
