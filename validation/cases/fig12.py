# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 12: bullet, parachute and croissant in rectangular ducts: curvature of the rear and widths as numbers.

Near its rear pole the membrane is fitted by x = x0 + (k_y y^2 + k_z z^2)/2: k > 0 where the rear bulges out, k < 0 where it is hollow.
"""

import numpy as np

from harness import drawing, outputs
from harness.runs import Run
from harness.tables import table

TITLE = "bullet, parachute and croissant in a duct (figure 12)"
SHAPES = {"bullet": "rear convex", "parachute": "rear concave", "croissant": "wider in z, the narrow direction"}
CELLS = {"bullet": [160, 24, 24], "parachute": [160, 24, 24], "croissant": [160, 24, 20]}  # of the quarter y, z > 0
AXES = {"bullet": [3, 3, 2.5], "parachute": [3, 3, 1.7], "croissant": [3, 3, 2.2]}
SNAPSHOTS = [0, 4, 8, 16]


def run_of(context, shape, across=False):
    quarter = {"domain.mirror": [False, True, True], "domain.lower": [-10, 0, 0]}  # the same to round-off, in a quarter of the time
    n_y, n_z = CELLS[shape][1:]
    keys = quarter | {"domain.cells": [320, 2 * n_y, 2 * n_z] if context.paper else CELLS[shape], "mesh.latitudes": 64 if context.paper else 32}
    if across:  # the short axis along z, as the paper writes its ellipsoids
        keys["vesicles.0.axes"] = AXES[shape]
    return Run(f"{shape}{', short axis along z' if across else ''}", f"scenes/paper/fig12_{shape}.toml", keys)


def rear(membrane, reach=0.35):
    """Curvatures of the rear along y and z."""
    points = membrane["points"] - membrane["points"].mean(axis=0)
    near = points[(points[:, 0] < 0) & (np.hypot(points[:, 1], points[:, 2]) < reach)]
    columns = np.stack([np.ones(len(near)), near[:, 1] ** 2 / 2, near[:, 2] ** 2 / 2], axis=1)
    _, k_y, k_z = np.linalg.lstsq(columns, near[:, 0], rcond=None)[0]
    return float(k_y), float(k_z)


def compute(context):
    runs = [run_of(context, shape, across) for across in (False, True) for shape in SHAPES]
    folders = context.run(runs)
    values, rows = {"shapes": {}}, []
    for run in runs:
        course, summary = outputs.course(folders[run.name]), outputs.summary(folders[run.name])
        shots = outputs.membranes(folders[run.name])
        last = shots[-1]
        (k_y, k_z), (before_y, before_z) = rear(last), rear(shots[-2])
        widths = np.ptp(last["points"], axis=0)
        speed = np.gradient(course["centroid_x"], course["time"])[-1]
        values["shapes"][run.name] = {
            "status": summary["status"], "time": last["time"], "rear_curvature_y": k_y, "rear_curvature_z": k_z, "length": widths[0],
            "width_y": widths[1], "width_z": widths[2], "speed": float(speed), "x": float(course["centroid_x"][-1])}
        rows.append([run.name, last["time"], float(course["centroid_x"][-1]), float(speed), k_y, k_z, f"{k_y - before_y:+.2f}, {k_z - before_z:+.2f}",
                     *map(float, widths), float(widths[2] / widths[1]), float(course["max_local_area_error"].max()), SHAPES[run.name.split(",")[0]]])
    values["tables"] = [table(
        "", ["shape", "t", "x", "speed", "rear curvature along y", "along z", "change in the last 2", "length", "width in y", "width in z", "z over y",
             "largest local area error", "the paper"], rows)]
    return values


def draw(context, values, path):
    figure, panels = drawing.figure(3, 5, figsize=(10, 6))
    for row, shape in zip(panels, SHAPES):
        shots = outputs.membranes(context.folders[shape], SNAPSHOTS)
        for axes, shot in zip(row, shots):
            centre = shot["points"].mean(axis=0)
            moved = shot | {"points": shot["points"] - centre}
            drawing.membrane(axes, moved, drawing.view_from([-0.75, -0.6, 0.3]))
            drawing.picture(axes, 1.6)
            axes.set_title(f"{shape}, t = {shot['time']:.3g}, x = {centre[0]:.1f}", fontsize=7)
        last = shots[-1] | {"points": shots[-1]["points"] - shots[-1]["points"].mean(axis=0)}
        drawing.outline(row[-1], last, normal=1, colors="0.7", linewidths=3.0)  # x-z
        drawing.outline(row[-1], last, normal=2, colors="black", linewidths=0.9)  # x-y
        drawing.picture(row[-1], 1.6)
        row[-1].set_title("x-z thick, x-y thin", fontsize=7)
    drawing.save(figure, path)
