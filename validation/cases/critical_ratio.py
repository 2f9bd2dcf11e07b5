# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Viscosity ratios at which tank-treading ends and tumbling begins, by bisection at reduced volumes 0.95, 0.9, 0.8.

Between the two a vesicle at Ca = 2.5 (10 in the literature's units) may tremble: its angle swings through zero and back. A run starts 10 degrees above
the flow; tank-treading means that the angle stays above -2 degrees to the end, tumbling that it falls below -80.
"""

from harness import drawing, outputs, shear, theory
from harness.runs import Run
from harness.tables import table

TITLE = "critical viscosity ratio for tumbling"
VOLUMES = [0.95, 0.9, 0.8]
END = 30


def run_of(context, volume, ratio):
    grid = {"domain.cells": [120, 60, 120], "mesh.latitudes": 64} if context.paper else {"domain.cells": [60, 30, 60]}
    keys = {"vesicles.0.reduced_volume": volume, "fluid.viscosity_ratio": ratio, "time.end": END, "time.step": "1/32",
            "membrane.sigma0": 2000, "vesicles.0.rotation_deg": 80}
    return Run(f"{volume}, ratio {ratio}", "scenes/paper/half_box.toml", keys | grid)


def motion(course):
    angle = outputs.unwrapped(course["inclination_angle_deg"])
    if angle.min() < -80:
        return "tumbling"
    return "tank-treading" if angle.min() > -2 else "trembling"


def compute(context):
    values, rows, counts = {"motions": {}, "critical": {}}, [], 4 if not context.paper else 5
    for volume in VOLUMES:
        kinds = {}

        def kind(ratio):
            if ratio not in kinds:
                run = run_of(context, volume, ratio)
                folder = context.run([run])[run.name]
                kinds[ratio] = motion(outputs.course(folder))
                values["motions"][run.name] = {"motion": kinds[ratio], **shear.steady(folder)}
            return kinds[ratio]

        expected = theory.critical_ratio(volume)
        brackets = {}
        for name, low_kinds in (("end of tank-treading", ("tank-treading",)), ("onset of tumbling", ("tank-treading", "trembling"))):
            low, high = round(0.7 * expected, 2), round(2.3 * expected, 2)
            for _ in range(counts):
                middle = round(0.5 * (low + high), 2)
                low, high = (middle, high) if kind(middle) in low_kinds else (low, middle)
            brackets[name] = [low, high]
        values["critical"][str(volume)] = brackets | {"keller_skalak": expected}
        rows.append([volume, *(f"{low:.2f} to {high:.2f}" if high in kinds else f"above {low:.2f}" for low, high in brackets.values()), expected])
    values["tables"] = [table(f"Runs to t = {END}", ["reduced volume", "tank-treading ends at ratio", "tumbling begins at", "Keller & Skalak: both"], rows)]
    return values


def draw(context, values, path):
    figure, axes = drawing.figure(figsize=(6, 4))
    marks = {"tank-treading": ("o", drawing.BLUE), "trembling": ("^", drawing.ORANGE), "tumbling": ("s", drawing.VERMILLION)}
    for kind, (mark, colour) in marks.items():
        some = [name for name, state in values["motions"].items() if state["motion"] == kind]
        axes.plot([float(name.split(",")[0]) for name in some], [float(name.split("ratio ")[1]) for name in some], mark, color=colour, label=kind)
    fine = [0.78 + 0.002 * i for i in range(100)]
    axes.plot(fine, [theory.critical_ratio(v) for v in fine], color="0.5", label="Keller & Skalak")
    axes.set(xlabel="reduced volume", ylabel="viscosity ratio", ylim=(0, 20))
    axes.legend()
    drawing.save(figure, path)
