# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 3: relaxation of an oblate 3:3:1 and a prolate 1:1:2.8 with the tension force in its two forms, and how near to the shapes of
least energy the vesicles come to rest.

The first part is the paper's scheme to t = 4 and 8, with the paper's Laplacian of H and with the accurate one. The second takes shape following
to rest, in slow flow (Re = 1e-3), where it has no limit of stability: the final energy is compared with that which the app equilibrium_shape,
exact to 1e-12, finds at the vesicle's own reduced volume.
"""

import json
import math

import numpy as np

from harness import drawing, outputs
from harness.runs import Run
from harness.tables import table

TITLE = "relaxation: forms of the tension, and rest (figure 3)"
SHAPES = {"oblate": 1.3, "prolate": 2.58}  # times at which the paper's non-divergence form blows up
ENDS = {"oblate": 4, "prolate": 8}
FORMS, LAPLACIANS = ["divergence", "non_divergence"], ["paper", "cartesian"]


def form_run(context, shape, form, laplacian):
    n = 64 if context.paper else 32
    keys = {"membrane.tension_form": form, "membrane.laplacian": laplacian, "domain.cells": n, "mesh.latitudes": n // 2,
            "time.step": f"1/{6 * n}", "membrane.sigma0": 9.375 * n, "time.end": ENDS[shape]}
    return Run(f"{shape}, {form}, {laplacian}", f"scenes/paper/fig3_{shape}.toml", keys)


def rest_run(shape, n):
    octant = {"domain.mirror": [True, True, True], "domain.lower": [0, 0, 0], "domain.cells": n // 2}  # the same to round-off
    keys = octant | {"fluid.reynolds_number": 1e-3, "method.preset": "standard", "time.markers": "shape_following",
                     "membrane.volume": "projection", "membrane.sigma0": 9000,
                     "time.step": f"1/{max(24, n // 2)}", "time.end": 40, "mesh.latitudes": n // 2,
                     "output.diagnostics_every": 0.25, "output.vesicle_every": 5}
    return Run(f"{shape} to rest, N = {n}", f"scenes/paper/fig3_{shape}.toml", keys)


def first_noise(course):
    """When the surface divergence first exceeds ten times its least value so far after t = 0.1: well before a run stops."""
    time, noise = course["time"], course["surface_divergence_max"]
    for i in np.flatnonzero(time > 0.1):
        if noise[i] > 10 * np.nanmin(noise[(time > 0.05) & (np.arange(len(time)) <= i)]):
            return float(time[i])
    return math.nan


def compute(context):
    forms = {(s, f, lap): form_run(context, s, f, lap) for s in SHAPES for f in FORMS for lap in LAPLACIANS}
    sizes = [32, 64, 96]
    rests = {(s, n): rest_run(s, n) for s in SHAPES for n in sizes}
    folders = context.run([*forms.values(), *rests.values()])
    values, rows = {"series": {}, "forms": {}, "rest": {}}, []
    for (shape, form, laplacian), run in forms.items():
        course, summary = outputs.course(folders[run.name]), outputs.summary(folders[run.name])
        found = {"status": summary["status"], "time": summary["time"], "noise_from": first_noise(course) if summary["status"] == "stopped" else math.nan,
                 "divergence_at_end": float(course["surface_divergence_max"][-1]), "energy_at_end": float(course["bending_energy"][-1])}
        values["forms"][run.name] = found
        values["series"][run.name] = dict(zip(("time", "surface_divergence", "energy"), outputs.thinned(
            course["time"], course["surface_divergence_max"], course["bending_energy"], count=81)))
        rows.append([shape, form.replace("_", "-"), laplacian, found["status"], found["time"], found["noise_from"],
                     f"{found['divergence_at_end']:.1e}", f"blows up at {SHAPES[shape]}" if form == "non_divergence" else "stable"])
    tables = [table("Forms of the tension force, oblate to t = 4, prolate to t = 8 (the paper's scheme)",
                    ["shape", "form", "Lap H", "ended", "at t", "noise from t", "surface divergence then", "the paper"], rows)]
    rows = []
    for (shape, n), run in rests.items():
        course, summary = outputs.course(folders[run.name]), outputs.summary(folders[run.name])
        volume = float(course["reduced_volume"][-1])
        least = json.loads(context.app("equilibrium_shape", "--branch", shape, "--reduced-volume", f"{volume:.12g}", "--json", "--quiet"))
        least = least["shapes"][0]["bending_energy"]
        energy = float(course["bending_energy"][-1])
        change = energy - float(np.interp(course["time"][-1] - 5, course["time"], course["bending_energy"]))
        axes = [float(course[f"semi_axis_{i}"][-1]) for i in (1, 2, 3)]
        values["rest"][run.name] = {"status": summary["status"], "reduced_volume": volume, "energy": energy, "least_energy": least,
                                    "change_over_5": change, "semi_axes": axes}
        rows.append([shape, n, summary["status"], summary["time"], f"{volume:.5f}", f"{energy:.5f}", f"{least:.5f}",
                     f"{energy / least - 1:+.1e}", f"{change:.1e}", *axes])
    tables.append(table("At rest: 1/2 int H^2 against the least energy of the branch at the same reduced volume",
                        ["shape", "N", "ended", "at t", "reduced volume", "energy", "least energy", "difference", "change in the last 5",
                         "semi-axes", "", ""], rows))
    values["tables"] = tables
    return values


def draw(context, values, path):
    figure = drawing.plt.figure(figsize=(9.5, 8))
    top, bottom = figure.subfigures(2, 1, height_ratios=[1.5, 1])
    panels = top.subplots(4, 4)
    row = 0
    for shape, blows in SHAPES.items():
        for form in FORMS:
            name = f"{shape}, {form}, paper"
            last = values["forms"][name]["time"]
            for axes, shot in zip(panels[row], outputs.membranes(context.folders[name], [0, min(blows, last), last / 2 + blows / 2, last])):
                drawing.membrane(axes, shot, drawing.view_from([0.3, -0.9, 0.35]))
                drawing.picture(axes, 2.1, 1.5 if shape == "oblate" else 2.1)
                axes.set_title(f"{form.replace('_', '-')}, t = {shot['time']:.3g}", fontsize=7, pad=1)
            row += 1
    left, right = bottom.subplots(1, 2)
    for name, series in values["series"].items():
        shape, form, laplacian = name.split(", ")
        colour = drawing.BLUE if form == "divergence" else drawing.VERMILLION
        left.semilogy(series["time"], np.array(series["surface_divergence"], dtype=float), "-" if shape == "oblate" else "--", color=colour,
                      alpha=1.0 if laplacian == "paper" else 0.4, label=name.replace("_", "-"))
    left.set(xlabel="t", ylabel="largest surface divergence", ylim=(1e-4, 1e3))
    left.legend(fontsize=5.5, ncol=2)
    for (name, rest), colour in zip(values["rest"].items(), drawing.COLOURS):
        course = outputs.course(context.folders[name])
        right.semilogy(course["time"], np.abs(course["bending_energy"] / rest["least_energy"] - 1), color=colour, label=name)
    right.set(xlabel="t", ylabel="energy over the least, less 1", ylim=(1e-7, 1))
    right.legend(fontsize=6)
    drawing.save(figure, path)
