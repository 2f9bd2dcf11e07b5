# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figures 10 and 11: inertia at viscosity ratio 20, reduced volume 0.9: tumbling at small Re, tank-treading at large; where it changes."""

import math

from harness import drawing, outputs, shear
from harness.tables import table

TITLE = "Reynolds numbers 1e-3 to 9 at ratio 20: from tumbling to tank-treading (figures 10, 11)"
NUMBERS = [1e-3, 1e-2, 1e-1, 1, 3, 5, 9]
SHOWN, SNAPSHOTS = [1, 5, 9], [0, 2.5, 5, 10, 15]


def run_of(context, reynolds, end=20):
    """With inertia steps are limited by the fluid's convection beside its extrapolated viscous term (docs/time_integration.md#convection): for Re = 1 and
    9 to 1/97 and 1/139 on 64^3 cells, to 1/137 and 1/264 on 128^3."""
    keys = {"fluid.reynolds_number": reynolds, "time.end": end}
    if reynolds >= 1:
        steps = (160 if reynolds <= 1 else 288) if context.paper else (112 if reynolds <= 1 else 192)
        keys["time.step"] = f"1/{steps}"
    return shear.treading(f"Re = {reynolds:g}", context, 0.9, scene=shear.TUMBLING, **shear.HALF, **keys)


def motion(folder):
    """tumbling: has turned through; tank-treading: the angle is above the flow and does not fall any more."""
    angle = outputs.unwrapped(outputs.course(folder)["inclination_angle_deg"])
    if angle.min() < -80:
        return "tumbling"
    state = shear.steady(folder)
    return "tank-treading" if state["angle_deg"] > 0 and state["drift_deg"] > -0.05 else "undecided"


def compute(context):
    runs = {re: run_of(context, re, end=20 if re < 3 else 15) for re in NUMBERS}
    context.run(list(runs.values()))
    kinds = {re: motion(context.folders[run.name]) for re, run in runs.items()}
    low = max(re for re in NUMBERS if kinds[re] == "tumbling")
    high = min(re for re in NUMBERS if kinds[re] == "tank-treading")
    for _ in range(1 if context.paper else 2):
        middle = 0.5 * (low + high)
        runs[middle] = run_of(context, middle, end=20)
        context.run([runs[middle]])
        kinds[middle] = motion(context.folders[runs[middle].name])
        low, high = (middle, high) if kinds[middle] == "tumbling" else (low, middle)
    high = min(re for re in runs if kinds[re] == "tank-treading")
    values, rows = {"series": {}, "motion": {}, "transition_between": [low, high]}, []
    for re in sorted(runs):
        course, summary = outputs.course(context.folders[runs[re].name]), outputs.summary(context.folders[runs[re].name])
        state, crossings = shear.steady(context.folders[runs[re].name]), shear.half_turns(course)
        values["series"][f"{re:g}"] = dict(zip(("time", "angle_deg"), outputs.thinned(course["time"], course["inclination_angle_deg"], count=81)))
        values["motion"][f"{re:g}"] = state | {"motion": kinds[re], "crossings": crossings, "status": summary["status"]}
        rows.append([f"{re:g}", summary["status"], summary["time"], kinds[re], crossings[0] if crossings else "",
                     crossings[1] - crossings[0] if len(crossings) > 1 else "",
                     "" if kinds[re] == "tumbling" else f"{state['angle_deg']:.2f} ({state['drift_deg']:+.2f})",
                     float(course["max_local_area_error"].max()),
                     "tumbling" if re < 1 else "tumbling, later" if re == 1 else "tank-treading" if re in (5, 9) else ""])
    values["tables"] = [
        table(f"The motion changes between Re = {low:g} and {high:g}",
              ["Re", "ended", "t", "motion", "first along the flow at t", "half a turn takes", "angle at the end, degrees (change in the last unit of time)",
               "largest local area error", "the paper"], rows)]
    return values


def draw(context, values, path):
    figure = drawing.plt.figure(figsize=(9.5, 8))
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.6, 1])
    for row, re in zip(top.subplots(len(SHOWN), len(SNAPSHOTS)), SHOWN):
        for axes, shot in zip(row, outputs.membranes(context.folders[f"Re = {re:g}"], SNAPSHOTS)):
            drawing.membrane(axes, shot)
            drawing.picture(axes, 2.2, 1.8)
            axes.set_title(f"Re = {re}, t = {shot['time']:.3g}")
    axes = bottom.subplots()
    shades = drawing.plt.cm.viridis([i / len(values["series"]) for i in range(len(values["series"]))])
    for (re, series), colour in zip(values["series"].items(), shades):
        axes.plot(series["time"], drawing.gaps([math.nan if a is None else a for a in series["angle_deg"]]), color=colour, label=f"Re = {re}")
    axes.set(xlabel="t", ylabel="inclination, degrees", xlim=(0, 20))
    axes.legend(ncol=2, fontsize=7)
    drawing.save(figure, path)
