# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""How long half a turn takes at viscosity ratio 20, beside Keller and Skalak: pi/sqrt(1/4 - C^2)."""

import numpy as np

from harness import drawing, outputs, shear, theory
from harness.runs import Run
from harness.tables import percent, table

TITLE = "tumbling period at viscosity ratio 20"
VOLUMES = [0.975, 0.95, 0.9, 0.8]


def run_of(context, volume):
    grid = {"domain.cells": [120, 60, 120], "mesh.latitudes": 64} if context.paper else {"domain.cells": [60, 30, 60]}
    keys = {"vesicles.0.reduced_volume": volume, "fluid.viscosity_ratio": 20, "time.end": 35, "time.step": "1/48", "membrane.sigma0": 2000,
            "vesicles.0.rotation_deg": 0}
    return Run(f"{volume}", "scenes/paper/half_box.toml", keys | grid)


def compute(context):
    runs = {v: run_of(context, v) for v in VOLUMES}
    folders = context.run(list(runs.values()))
    values, rows = {"series": {}, "half_turns": {}}, []
    for volume, run in runs.items():
        course = outputs.course(folders[run.name])
        halves = np.diff(shear.half_turns(course))
        expected = theory.half_period(volume, 20)
        values["half_turns"][run.name] = halves.tolist()
        values["series"][run.name] = dict(zip(("time", "angle_deg"), outputs.thinned(course["time"], course["inclination_angle_deg"], count=181)))
        rows.append([volume, ", ".join(f"{h:.2f}" for h in halves), expected, percent(float(halves[-1]), expected) if len(halves) else "",
                     float(course["max_local_area_error"].max()), float(np.abs(course["area_error"]).max()), float(np.abs(course["volume_error"]).max())])
    values["tables"] = [table("", ["reduced volume", "half turns", "Keller & Skalak", "difference of the last", "largest local area error", "area error",
                                   "volume error"], rows)]
    return values


def draw(context, values, path):
    figure, axes = drawing.figure(figsize=(8, 3.4))
    for (volume, series), colour in zip(values["series"].items(), drawing.COLOURS):
        axes.plot(series["time"], drawing.gaps(series["angle_deg"]), color=colour, label=volume)
    axes.set(xlabel="t", ylabel="inclination, degrees")
    axes.legend(ncol=4)
    drawing.save(figure, path)
