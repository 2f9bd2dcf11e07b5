# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 9: tumbling at viscosity ratio 20, reduced volumes 0.975, 0.9, 0.8, to t = 20."""

import math

from harness import drawing, outputs, shear, theory
from harness.tables import table

TITLE = "tumbling at viscosity ratio 20 to t = 20 (figure 9)"
VOLUMES = [0.975, 0.9, 0.8]
SNAPSHOTS = [0, 2.5, 5, 7.5, 10]


def run_of(context, volume):
    """On 128^3 cells reduced volume 0.8 with the scene's sigma0 = 2000 (g = 111) grows noise of a factor 2 in 0.4 of time from t = 9."""
    keys = {"membrane.sigma0": 1000} if context.paper and volume == 0.8 else {}
    return shear.treading(f"{volume}", context, volume, scene=shear.TUMBLING, **keys)


def compute(context):
    runs = {v: run_of(context, v) for v in VOLUMES}
    folders = context.run(list(runs.values()))
    values, rows = {"series": {}, "crossings": {}}, []
    for volume, run in runs.items():
        course = outputs.course(folders[run.name])
        summary = outputs.summary(folders[run.name])
        crossings = shear.half_turns(course)
        values["crossings"][run.name] = crossings
        values["series"][run.name] = dict(zip(
            ("time", "angle_deg", "deformation", "local_area_error"),
            outputs.thinned(course["time"], course["inclination_angle_deg"], course["deformation"], course["max_local_area_error"], count=101)))
        half = crossings[1] - crossings[0] if len(crossings) > 1 else math.nan
        largest = {key: float(abs(course[key]).max()) for key in ("area_error", "volume_error", "max_local_area_error")}
        rows.append([volume, summary["status"], summary["time"], crossings[0] if crossings else "", half, theory.half_period(volume, 20),
                     float(course["deformation"].min()), float(course["deformation"].max()), largest["max_local_area_error"],
                     largest["area_error"], largest["volume_error"]])
    values["tables"] = [table(
        "", ["reduced volume", "ended", "t", "first along the flow at t", "half a turn takes", "Keller & Skalak", "least deformation",
             "largest", "largest local area error", "area error", "volume error"], rows)]
    return values


def draw(context, values, path):
    figure = drawing.plt.figure(figsize=(9.5, 7.5))
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.8, 1])
    for row, volume in zip(top.subplots(len(VOLUMES), len(SNAPSHOTS)), VOLUMES):
        for axes, shot in zip(row, outputs.membranes(context.folders[f"{volume}"], SNAPSHOTS)):
            drawing.membrane(axes, shot)
            drawing.picture(axes, 2.2, 2.1)
            axes.set_title(f"{volume}, t = {shot['time']:.3g}")
    axes = bottom.subplots()
    for volume, colour in zip(VOLUMES, drawing.COLOURS):
        series = values["series"][f"{volume}"]
        axes.plot(series["time"], drawing.gaps(series["angle_deg"]), color=colour, label=f"{volume}")
    axes.set(xlabel="t", ylabel="inclination, degrees")
    axes.legend()
    drawing.save(figure, path)
