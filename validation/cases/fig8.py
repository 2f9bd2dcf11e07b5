# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 8: steady angle at viscosity ratios 2.7, 5 and 8 against excess area, beside Keller and Skalak."""

import math

import numpy as np

from harness import drawing, shear, theory
from harness.tables import signed, table

TITLE = "steady angle at viscosity ratios 2.7, 5, 8 against excess area (figure 8)"
RATIOS, VOLUMES = [2.7, 5, 8], [0.985, 0.975, 0.95, 0.925, 0.9]
REFINED = 0.95  # the reduced volume at which the error of the grid is measured, with half as many cells again


def run_of(context, ratio, volume, refined=False, corrected=False):
    """From Keller and Skalak's angle (or 10 degrees where they have none), so that little is left to turn."""
    expected = theory.inclination(volume, ratio)
    start = 10.0 if math.isnan(expected) else expected
    keys = {"fluid.viscosity_ratio": ratio, "time.end": 12, "time.step": "1/24" if ratio <= 5 else "1/32", "vesicles.0.rotation_deg": round(90 - start, 1)}
    if refined:
        n = 192 if context.paper else 96
        keys |= {"domain.cells": [n, n // 2, n], "mesh.latitudes": n // 2}
    if corrected:
        keys["coupling.thickness_correction"] = True
    name = f"ratio {ratio}, {volume}{', refined' if refined else ''}{', corrected' if corrected else ''}"
    return shear.treading(name, context, volume, scene=shear.TUMBLING, **shear.HALF, **keys)


def compute(context):
    runs = {(r, v): run_of(context, r, v) for r in RATIOS for v in VOLUMES}
    finer = {r: run_of(context, r, REFINED, refined=True) for r in RATIOS}
    thin = {r: run_of(context, r, REFINED, corrected=True) for r in RATIOS}
    folders = context.run([*runs.values(), *finer.values(), *thin.values()])
    values, rows, refined = {"steady": {}, "refined": {}}, [], []
    for (ratio, volume), run in runs.items():
        state = shear.steady(folders[run.name])
        moving = abs(state["drift_deg"]) > 0.5
        values["steady"][run.name] = state | {"excess_area": theory.excess_area(volume), "moving": bool(moving)}
        expected = theory.inclination(volume, ratio)
        rows.append([ratio, volume, theory.excess_area(volume), state["angle_deg"], f"{state['drift_deg']:+.2f}",
                     "tumbles" if math.isnan(expected) else expected,
                     signed(state["angle_deg"] - expected), theory.quasi_spherical_inclination(volume, ratio), state["frequency"]])
    for ratio, run in finer.items():
        state, coarser = shear.steady(folders[run.name]), values["steady"][f"ratio {ratio}, {REFINED}"]
        limit = 3 * state["angle_deg"] - 2 * coarser["angle_deg"]
        corrected = shear.steady(folders[thin[ratio].name])["angle_deg"]
        values["refined"][run.name] = state | {"limit_deg": limit, "corrected_deg": corrected}
        expected = theory.inclination(REFINED, ratio)
        refined.append([ratio, coarser["angle_deg"], corrected, state["angle_deg"], limit, "tumbles" if math.isnan(expected) else expected])
    grid = table(f"The grid's part, reduced volume {REFINED}: angle, linear in h",
                 ["viscosity ratio", "on this grid", "corrected", "h smaller by 1.5", "h to 0", "Keller & Skalak"], refined)
    values["tables"] = [table("At t = 12", ["viscosity ratio", "reduced volume", "excess area", "angle, degrees", "change in the last unit of time",
                                            "Keller & Skalak", "difference", "quasi-spherical theory", "frequency"], rows), grid]
    return values


def draw(context, values, path):
    figure, axes = drawing.figure(figsize=(5.5, 4))
    fine = np.linspace(0.89, 0.999, 200)
    for ratio, colour in zip(RATIOS, drawing.COLOURS):
        axes.plot([theory.excess_area(v) for v in fine], [theory.inclination(v, ratio) for v in fine], color=colour, linewidth=1,
                  label=f"Keller & Skalak, ratio {ratio}")
        axes.plot([theory.excess_area(v) for v in fine], [theory.quasi_spherical_inclination(v, ratio) for v in fine], color=colour, linewidth=1,
                  linestyle="--", label="quasi-spherical theory" if ratio == RATIOS[0] else None)
        points = [values["steady"][f"ratio {ratio}, {v}"] for v in VOLUMES]
        limit = values["refined"][f"ratio {ratio}, {REFINED}, refined"]["limit_deg"]
        axes.plot([theory.excess_area(REFINED)], [limit], "x", color=colour, label="h to 0" if ratio == RATIOS[0] else None)
        for moving, fill in ((False, colour), (True, "white")):
            some = [p for p in points if p["moving"] == moving]
            axes.plot([p["excess_area"] for p in some], [p["angle_deg"] for p in some], "o", color=colour, markerfacecolor=fill,
                      label=None if moving else f"ours, ratio {ratio}")
    axes.set(xlabel="excess area", ylabel="inclination, degrees", title="open: still turning", ylim=(-12, 45))
    axes.legend(fontsize=7)
    drawing.save(figure, path)
