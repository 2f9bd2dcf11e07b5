# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""A vesicle that is carried across the grid by more than a hundred cells, beside one that stays: the same flow, seen from a moving frame.

The flow is (z, 0, 0) and the box 6 wide, h = R/5.3. Around z = 0 the vesicle stays; around z = 1, with the walls at z = -2 and 4, all moves by 1
in a unit of time, 5.3 spacings. Reduced volume 0.9, from near the steady angle, dt = 1/24 to t = 20; sharp membranes without inertia, delta functions
at Re = 1e-3. What the grid does is seen in the second half of the run.
"""

import numpy as np

from harness import drawing, outputs
from harness.runs import Run
from harness.tables import table

TITLE = "a vesicle that is carried across the grid, beside one that stays"
RATIOS, METHODS, SPEEDS = [1, 5], ["sharp", "delta"], [0, 1]
STEP, END, HALF_WIDTH = 1 / 24, 20, 3
START = {1: 63, 5: 80}


def run_of(method, ratio, speed):
    lower, upper = [-HALF_WIDTH] * 2 + [speed - HALF_WIDTH], [HALF_WIDTH] * 2 + [speed + HALF_WIDTH]
    keys = {"domain.lower": lower, "domain.upper": upper, "domain.mirror": [False] * 3, "domain.periodic": [True, True, False], "domain.cells": 32,
            "mesh.latitudes": 24, "fluid.viscosity_ratio": ratio, "coupling.method": method, "membrane.sigma0": 2000, "time.step": "1/24",
            "time.end": END, "vesicles.0.rotation_deg": START[ratio], "vesicles.0.centre": [0, 0, speed], "output.diagnostics_every": "1/24",
            "output.vesicle_every": 0, "output.checkpoint_every": 0}
    if method == "sharp":
        keys["fluid.inertia"] = "none"
    return Run(f"{method}, ratio {ratio}, {'moving' if speed else 'staying'}", "scenes/paper/half_box.toml", keys)


def ripple(values):
    """Root mean square of what is left of a parabola."""
    at = np.linspace(-1, 1, len(values))
    return float(np.std(values - np.polyval(np.polyfit(at, values, 2), at)))


def state(folder, speed):
    summary, course = outputs.summary(folder), outputs.course(folder)
    half = course["time"] >= 0.5 * END
    velocity = np.diff(course["centroid_x"][half]) / np.diff(course["time"][half]) - speed
    angle = outputs.unwrapped(course["inclination_angle_deg"])[half]
    return {"status": summary["status"], "angle": float(angle.mean()), "angle_ripple": ripple(angle),
            "frequency": float(course["tank_treading_frequency"][half].mean()), "frequency_ripple": ripple(course["tank_treading_frequency"][half]),
            "velocity_ripple": ripple(velocity), "off": float(np.abs(course["centroid_z"] - speed).max()),
            "divergence": float(course["surface_divergence_max"][half].max()),
            "local_area_error": float(course["max_local_area_error"][half].max()), "area_error": float(np.abs(course["area_error"]).max()),
            "volume_error": float(np.abs(course["volume_error"]).max()), "velocity_noise": summary["largest_errors"]["velocity_noise"]}


def compute(context):
    runs = {(m, r, s): run_of(m, r, s) for r in RATIOS for m in METHODS for s in SPEEDS}
    folders = context.run(list(runs.values()))
    states, rows = {}, []
    for (m, r, s), run in runs.items():
        one = states[run.name] = state(folders[run.name], s)
        rows.append([r, m, f"{s * END * 32 / (2 * HALF_WIDTH):.0f}", f"{one['angle']:.3f}", f"{one['angle_ripple']:.1e}", f"{one['frequency']:.4f}",
                     f"{one['frequency_ripple']:.1e}", f"{one['velocity_ripple']:.1e}", f"{one['velocity_noise']:.1e}", f"{one['divergence']:.1e}",
                     f"{one['local_area_error']:.1e}", f"{one['area_error']:.0e}", f"{one['volume_error']:.0e}", f"{one['off']:.1e}"])
    return {"states": states, "tables": [table("", [
        "ratio", "", "cells crossed", "angle, degrees", "its ripple", "frequency", "its ripple", "ripple of the centre's velocity",
        "largest noise of the membrane's velocity", "largest surface divergence", "largest local area error", "area error", "volume error",
        "off its height"], rows)]}


def draw(context, values, path):
    figure, panels = drawing.plt.subplots(1, len(RATIOS), figsize=(8, 3))
    for axes, ratio in zip(panels, RATIOS):
        for method, colour in zip(METHODS, drawing.COLOURS):
            for way, style in (("moving", "-"), ("staying", "--")):
                course = outputs.course(context.folders[f"{method}, ratio {ratio}, {way}"])
                last = course["time"] > 0.9 * END
                angle = outputs.unwrapped(course["inclination_angle_deg"])[last]
                axes.plot(course["time"][last], angle - angle.mean(), style, color=colour, linewidth=1, label=f"{method}, {way}")
        axes.set(xlabel="t", title=f"ratio {ratio}")
    panels[0].set_ylabel("angle less its mean, degrees")
    panels[0].legend(fontsize=7)
    drawing.save(figure, path)
