# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figures 4 and 5: tank-treading at reduced volumes 0.975, 0.9 and 0.8: shapes, angle, frequency of Eq. (34), errors of area."""

import numpy as np

from harness import drawing, outputs, shear, theory
from harness.tables import percent, signed, table

TITLE = "tank-treading: angle, frequency, area errors against time (figures 4, 5)"
VOLUMES = [0.975, 0.9, 0.8]
SNAPSHOTS = [0, 1, 3, 15]


def compute(context, schemes=None):
    runs = {(scheme, volume): shear.treading(f"{scheme}, {volume}", context, volume, **keys)
            for scheme, keys in (schemes or {"shape following": {}, "corrected": shear.corrected(context)}).items() for volume in VOLUMES}
    folders = context.run(list(runs.values()))
    values = {"series": {}, "steady": {}}
    rows = []
    for (scheme, volume), run in runs.items():
        course = outputs.course(folders[run.name])
        state = shear.steady(folders[run.name])
        early = np.interp(5.0, course["time"], outputs.unwrapped(course["inclination_angle_deg"]))
        errors = {key: float(np.max(np.abs(course[key]))) for key in ("area_error", "volume_error", "max_local_area_error")}
        values["steady"][run.name] = state | {"angle_at_5_deg": float(early)} | errors
        values["series"][run.name] = dict(zip(
            ("time", "angle_deg", "frequency", "local_area_error", "area_error"),
            outputs.thinned(course["time"], course["inclination_angle_deg"], course["tank_treading_frequency"],
                            course["max_local_area_error"], course["area_error"])))
        angle, frequency = theory.inclination(volume, 1), theory.frequency(volume, 1)
        rows.append([scheme, volume, "stopped" if np.isnan(state["angle_deg"]) else state["angle_deg"], angle, signed(state["angle_deg"] - angle), state["frequency"], frequency,
                     percent(state["frequency"], frequency), signed(early - state["angle_deg"]),
                     errors["max_local_area_error"], state["area_error"], errors["volume_error"]])
    values["tables"] = [table(
        "Steady values (mean of the last unit of time before t = 15)",
        ["scheme", "reduced volume", "angle, degrees", "Keller & Skalak", "difference", "frequency", "Keller & Skalak", "difference",
         "angle at t = 5 less steady", "largest local area error", "area error at the end", "largest volume error"], rows)]
    return values


def draw(context, values, path):
    figure = drawing.plt.figure(figsize=(9.5, 8.4))
    top, bottom = figure.subfigures(2, 1, height_ratios=[1, 1.25])
    for row, volume in zip(top.subplots(len(VOLUMES), len(SNAPSHOTS)), VOLUMES):
        for axes, shot in zip(row, outputs.membranes(context.folders[f"shape following, {volume}"], SNAPSHOTS)):
            drawing.membrane(axes, shot)
            drawing.picture(axes, 2.2, 2.1 if shot["time"] == 0 else 1.35)
            axes.set_title(f"{volume}, t = {shot['time']:.3g}")
    draw_courses(bottom, values)
    drawing.save(figure, path)


def draw_courses(figure, values):
    panels = figure.subplots(2, 2, sharex=True)
    shown = {"angle_deg": "inclination, degrees", "frequency": "frequency, Eq. (34)", "local_area_error": "largest local area error",
             "area_error": "area error"}
    for axes, (key, label) in zip(panels.flat, shown.items()):
        for volume, colour in zip(VOLUMES, drawing.COLOURS):
            names = [name for name in values["series"] if name.endswith(f", {volume}")]
            for name, style in zip(names, ("-", "--")):
                series = values["series"][name]
                axes.plot(series["time"], series[key], style, color=colour, label=name if key == "angle_deg" else None)
            level = {"angle_deg": theory.inclination, "frequency": theory.frequency}.get(key)
            if level:
                axes.axhline(level(volume, 1), color=colour, linewidth=0.7)
        axes.set_ylabel(label)
    panels[0, 0].set_ylim(0, 95)
    panels[0, 0].legend(ncol=2, fontsize=6, loc="upper right")
    panels[0, 1].set_ylim(0.25, 0.55)
    panels[1, 0].set(yscale="log", xlabel="t", ylim=(1e-5, 1e-1))
    panels[1, 1].set(xlabel="t")
    panels[0, 1].set_title("thin lines: Keller & Skalak")
