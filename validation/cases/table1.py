# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Table 1: errors of H, K and Lap H on a sphere, an ellipsoid 1:2:4 and r = 1 + exp(-3 Re Y_3^2)."""

import json

from harness import drawing
from harness.tables import table

TITLE = "accuracy of H, K and the Laplacian of H (table 1)"
SURFACES = {"sphere": "unit sphere", "ellipsoid": "ellipsoid 1:2:4", "y32": "1 + exp(-3 Re Y_3^2)"}
# form of Lap H, upsampling, truncated: the paper's two columns, and ours
FORMS = {"paper_plain": ("paper", 1, False), "paper_upsampled": ("paper", 2, True), "ours": ("cartesian", 2, False)}


def compute(context):
    measured = json.loads(context.app("geometry_accuracy", "--sampling", "1", "--json"))
    values, rows = {}, []
    for surface, name in SURFACES.items():
        for n in sorted({m["latitudes"] for m in measured}):
            found = {}
            for label, form in FORMS.items():
                m = next(m for m in measured if (m["surface"], m["latitudes"]) == (surface, n)
                         and (m["formula"], m["upsampling"], m["truncated"]) == form)
                found[label] = m
            ours, plain, upsampled = found["ours"], found["paper_plain"], found["paper_upsampled"]
            values[f"{surface}, N = {n}"] = {
                "H": ours["error_H"], "K": ours["error_K"], "H_paper": ours["paper_H"], "K_paper": ours["paper_K"],
                "lapH_paper_form": plain["error_lapH"], "lapH_paper": plain["paper_lapH"],
                "lapH_paper_form_upsampled": upsampled["error_lapH"], "lapH_paper_upsampled": upsampled["paper_lapH"],
                "lapH": ours["error_lapH"]}
            rows.append([name, n, *(f"{v:.2e}" if v is not None else "" for v in values[f"{surface}, N = {n}"].values())])
    return {"errors": values, "tables": [table(
        "Largest errors over the markers", ["surface", "N", "H", "K", "H, paper", "K, paper", "Lap H, Eq. (14)", "paper", "upsampled, cut", "paper",
                                            "Lap H, ours"], rows)]}


def draw(context, values, path):
    figure, panels = drawing.figure(1, 3, figsize=(10, 3.4), sharex=True)
    lines = {"H": ("H", "o-", drawing.BLUE), "H_paper": ("H, paper", "x:", drawing.BLUE),
             "lapH_paper_form": ("Lap H as in the paper", "s-", drawing.ORANGE), "lapH_paper": ("Lap H, paper", "x:", drawing.ORANGE),
             "lapH_paper_form_upsampled": ("as in the paper, upsampled", "s-", drawing.VERMILLION),
             "lapH_paper_upsampled": ("paper, upsampled", "x:", drawing.VERMILLION), "lapH": ("Lap H, ours", "o-", drawing.GREEN)}
    for axes, (surface, name) in zip(panels, SURFACES.items()):
        known = [key for key in values["errors"] if key.startswith(surface)]
        sizes = [int(key.split("= ")[1]) for key in known]
        for key, (label, style, colour) in lines.items():
            axes.loglog(sizes, [values["errors"][k][key] for k in known], style, color=colour, label=label, markersize=4)
        axes.set(title=name, xlabel="latitudes")
    panels[0].set_ylabel("largest error")
    panels[0].legend(fontsize=6)
    drawing.save(figure, path)
