# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Points of the paper's figures 8 to 11 with sharp membranes on two grids, R/5.3 and R/8.

In boxes 6 wide (the paper's are 12), walls at z = -3 and 3, periodic along x and y, so that the comparison is of the grids and not with the paper.
Figures 8 and 9 without inertia. Starts as in the cases fig8, fig9 and fig10_11.
"""

import math

import numpy as np

from harness import drawing, outputs, shear, theory
from harness.runs import Run
from harness.tables import table

from . import fig8, fig9

TITLE = "points of figures 8 to 11, sharp membranes on two grids"
VOLUMES = [0.975, 0.95, 0.9]  # of those of figure 8
CELLS, LATITUDES = [32, 48], {32: 24, 48: 32}
NUMBERS = {1: ("1/48", 12), 9: ("1/96", 10)}  # Re: step, end
ANGLE, PART = 0.3, 0.01  # what was asked: degrees, or of a value


def run_of(name, cells, **keys):
    common = {"domain.lower": [-3] * 3, "domain.upper": [3] * 3, "domain.mirror": [False] * 3, "domain.periodic": [True, True, False],
              "domain.cells": cells, "mesh.latitudes": LATITUDES[cells], "coupling.method": "sharp", "membrane.sigma0": 2000,
              "output.vesicle_every": 0, "output.checkpoint_every": 5, "output.diagnostics_every": "1/24"}
    return Run(f"{name}, {cells}", "scenes/paper/half_box.toml", common | keys)


def treading(ratio, volume, cells):
    expected = theory.inclination(volume, ratio)
    start = 10.0 if math.isnan(expected) else expected
    return run_of(f"ratio {ratio}, {volume}", cells, **{
        "fluid.inertia": "none", "fluid.viscosity_ratio": ratio, "vesicles.0.reduced_volume": volume, "time.end": 12, "time.step": "1/24",
        "vesicles.0.rotation_deg": round(90 - start, 1)})


def tumbling(volume, cells):
    return run_of(f"ratio 20, {volume}", cells, **{
        "fluid.inertia": "none", "fluid.viscosity_ratio": 20, "vesicles.0.reduced_volume": volume, "time.end": 20, "time.step": "1/48",
        "vesicles.0.rotation_deg": 0})


def with_inertia(reynolds, cells):
    step, end = NUMBERS[reynolds]
    return run_of(f"Re = {reynolds}", cells, **{
        "fluid.reynolds_number": reynolds, "fluid.viscosity_ratio": 20, "time.end": end, "time.step": step, "vesicles.0.rotation_deg": 0})


def met(yes):
    return "yes" if yes else "no"


def compute(context):
    treads = {(r, v, n): treading(r, v, n) for r in fig8.RATIOS for v in VOLUMES for n in CELLS}
    tumbles = {(v, n): tumbling(v, n) for v in fig9.VOLUMES for n in CELLS}
    folders = context.run([*treads.values(), *tumbles.values()])
    inertia = {(re, n): with_inertia(re, n) for re in NUMBERS for n in CELLS}
    folders = context.run(list(inertia.values()))
    values, rows = {"steady": {}, "crossings": {}, "ends": {}}, []
    for r in fig8.RATIOS:
        for v in VOLUMES:
            states = [values["steady"].setdefault(treads[r, v, n].name, shear.steady(folders[treads[r, v, n].name])) for n in CELLS]
            off = states[0]["angle_deg"] - states[1]["angle_deg"]
            part = states[0]["frequency"] / states[1]["frequency"] - 1
            rows.append([r, v, *(s["angle_deg"] for s in states), f"{off:+.3f}", f"{states[1]['drift_deg']:+.2f}",
                         *(s["frequency"] for s in states), f"{100 * part:+.2f} %",
                         met(abs(off) <= max(ANGLE, PART * abs(states[1]["angle_deg"])) and abs(part) <= PART)])
    names = [f"R/{n / 6:.3g}" for n in CELLS]
    eight = table("Figure 8: the last unit of time before t = 12", ["viscosity ratio", "reduced volume", *(f"angle, {n}" for n in names),
                  "difference", "change in that time", *(f"frequency, {n}" for n in names), "difference", "asked for"], rows)
    rows = []
    for v in fig9.VOLUMES:
        crossings = [values["crossings"].setdefault(tumbles[v, n].name, shear.half_turns(outputs.course(folders[tumbles[v, n].name]))) for n in CELLS]
        first, half = [c[0] for c in crossings], [c[1] - c[0] for c in crossings]
        parts = [x[0] / x[1] - 1 for x in (first, half)]
        rows.append([v, *first, f"{100 * parts[0]:+.2f} %", *half, f"{100 * parts[1]:+.2f} %", met(max(map(abs, parts)) <= PART)])
    nine = table("Figure 9: tumbling at ratio 20", ["reduced volume", *(f"first along the flow at t, {n}" for n in names), "difference",
                 *(f"half a turn, {n}" for n in names), "difference", "asked for"], rows)
    rows = []
    for re in NUMBERS:
        courses = [outputs.course(folders[inertia[re, n].name]) for n in CELLS]
        ends = [outputs.summary(folders[inertia[re, n].name]) for n in CELLS]
        angles = [outputs.unwrapped(c["inclination_angle_deg"]) for c in courses]
        crossings = [shear.half_turns(c) for c in courses]
        for n, angle, c, end in zip(CELLS, angles, crossings, ends):
            values["ends"][inertia[re, n].name] = {"angle": float(angle[-1]), "crossings": c, "status": end["status"], "time": end["time"]}
        together = min(len(a) for a in angles)
        apart = float(np.max(np.abs(angles[0][:together] - angles[1][:together])))
        turns = [c[0] if c else math.nan for c in crossings]
        off = angles[0][together - 1] - angles[1][together - 1]
        good = abs(turns[0] / turns[1] - 1) <= PART if crossings[0] and crossings[1] else abs(off) <= max(ANGLE, PART * abs(angles[1][-1]))
        completed = all(end["status"] == "completed" for end in ends)
        rows.append([re, NUMBERS[re][0], *(f"{end['status']}, {end['time']:.3g}" for end in ends), *turns, *(float(a[-1]) for a in angles),
                     f"{off:+.3f}", f"{apart:.2f}", met(good and completed)])
    ten = table("Figures 10 and 11: ratio 20, reduced volume 0.9, with inertia", ["Re", "dt", *(f"ended at t, {n}" for n in names),
                *(f"first along the flow at t, {n}" for n in names), *(f"angle at the end, {n}" for n in names), "difference at the last common time",
                "largest of the run", "asked for"], rows)
    values["tables"] = [eight, nine, ten]
    return values


def draw(context, values, path):
    figure, axes = drawing.figure(figsize=(5.5, 4))
    fine = np.linspace(0.89, 0.999, 200)
    for ratio, colour in zip(fig8.RATIOS, drawing.COLOURS):
        axes.plot([theory.excess_area(v) for v in fine], [theory.inclination(v, ratio) for v in fine], color=colour, linewidth=1,
                  label=f"Keller & Skalak, ratio {ratio}")
        for n, mark in zip(CELLS, "+o"):
            points = [values["steady"][f"ratio {ratio}, {v}, {n}"]["angle_deg"] for v in VOLUMES]
            axes.plot([theory.excess_area(v) for v in VOLUMES], points, mark, color=colour, markerfacecolor="none", label=f"R/{n / 6:.3g}")
    axes.set(xlabel="excess area", ylabel="inclination, degrees")
    axes.legend(fontsize=7)
    drawing.save(figure, path)
