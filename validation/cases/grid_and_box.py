# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Steady angle and frequency without the errors of grid and box: extrapolated in the spacing h and in the width B of the box.

At B = 12 the limit h -> 0 is taken twice, from runs with and without correction of the thickness, each by a quadratic in h through three
spacings; the correction's is the value, and the difference of the two and the distance from the next coarser estimate make its error. What the walls
do is a term b/B^3 (the stresslet of the vesicle and its image), fitted to the two widest boxes at h = 0.2 with the correction; its error is the change
against the fit to the next two, and that of the same effect at h = 0.1.
"""

import numpy as np

from harness import drawing, shear, theory
from harness.extrapolation import at_zero
from harness.runs import Run
from harness.tables import percent, table

TITLE = "steady angle and frequency extrapolated in grid spacing and box width"
VOLUMES = [0.975, 0.9, 0.8]
WIDTHS = [6, 8, 12, 16, 24]
SCHEMES = ["plain", "corrected"]
KEYS = {"angle": "angle_deg", "frequency": "frequency"}


def spacings(context):
    return [0.2, 0.15, 0.1, 0.075] if context.paper else [0.2, 0.15, 0.1]


def run_of(volume, scheme, width, h):
    n, half = round(width / h), width / 2
    keys = {"domain.cells": [n, n // 2, n], "domain.lower": [-half, 0, -half], "domain.upper": [half, half, half],
            "mesh.latitudes": 8 * round(6 / h / 8 + 0.49), "vesicles.0.reduced_volume": volume,
            "vesicles.0.rotation_deg": round(90 - theory.inclination(volume, 1), 1)}
    if scheme == "corrected":
        keys["coupling.thickness_correction"] = True
    if scheme == "corrected" and h < 0.15 or h < 0.1:  # less damping: see shear.corrected
        keys["time.step"] = "1/48"
    return Run(f"{volume}, {scheme}, box {width}, h {h}", "scenes/paper/half_box.toml", keys)


def runs_of(context):
    for volume in VOLUMES:
        for scheme in SCHEMES:
            for h in spacings(context):
                yield volume, scheme, 12, h
        for width in WIDTHS:
            yield volume, "corrected", width, 0.2
        for width in (6, 8):
            yield volume, "corrected", width, 0.1


def extrapolate(found, volume, hs, key):
    """found[scheme, width, h]; the value, its error, and the parts they are made of."""
    at = lambda scheme, width, h: found[volume, scheme, width, h][key]  # noqa: E731
    limits = {s: at_zero(hs[-3:], [at(s, 12, h) for h in hs[-3:]]) for s in SCHEMES}
    linear = {s: at_zero(hs[-2:], [at(s, 12, h) for h in hs[-2:]]) for s in SCHEMES}
    grid_error = max(abs(limits["corrected"] - limits["plain"]), abs(limits["corrected"] - linear["corrected"]))
    wall = lambda a, b: (at("corrected", a, 0.2) - at("corrected", b, 0.2)) / (a**-3 - b**-3)  # noqa: E731
    far, near = wall(16, 24), wall(12, 16)
    box = -far * 12.0**-3
    box_error = abs(far - near) * 12.0**-3
    return {"value": limits["corrected"] + box, "error": float(np.hypot(grid_error, box_error)), "limit_h": limits, "limit_h_linear": linear,
            "grid_error": grid_error, "box_term": box, "box_error": box_error,
            "width_6_less_12": {"h 0.2": at("corrected", 6, 0.2) - at("corrected", 12, 0.2), "h 0.1": at("corrected", 6, 0.1) - at("corrected", 12, 0.1)}}


def compute(context):
    wanted = list(dict.fromkeys(runs_of(context)))
    runs = {w: run_of(*w) for w in wanted}
    folders = context.run(list(runs.values()))
    found = {w: shear.steady(folders[run.name]) for w, run in runs.items()}
    hs = spacings(context)
    values = {"steady": {runs[w].name: state for w, state in found.items()}, "extrapolated": {}, "spacings": hs}
    rows, details = [], []
    for volume in VOLUMES:
        for name, key in KEYS.items():
            result = extrapolate(found, volume, hs, key)
            values["extrapolated"][f"{volume}, {name}"] = result
            expected = (theory.inclination if name == "angle" else theory.frequency)(volume, 1)
            rows.append([volume, name, f"{result['value']:.4g} +- {result['error']:.2g}", expected, f"{result['value'] - expected:+.3g}",
                         percent(result["value"], expected), result["limit_h"]["plain"], result["limit_h"]["corrected"], f"{result['box_term']:+.2g}"])
            for scheme in SCHEMES:
                details.append([volume, name, f"B = 12, {scheme}", *(f"h = {h}: {found[volume, scheme, 12, h][key]:.5g}" for h in hs[:5]),
                                *[""] * (5 - len(hs))])
            details.append([volume, name, "h = 0.2, corrected", *(f"B = {w}: {found[volume, 'corrected', w, 0.2][key]:.5g}" for w in WIDTHS)])
    values["tables"] = [
        table("Extrapolated to h = 0 and to a box without end (angle in degrees)",
              ["reduced volume", "of", "value", "Keller & Skalak", "difference", "", "B = 12, h to 0, plain", "corrected", "from B = 12 to no walls"], rows),
        table("What it is made of", ["reduced volume", "of", "runs", "", "", "", "", ""], details)]
    return values


def draw(context, values, path):
    figure, panels = drawing.figure(2, 2, figsize=(9, 6))
    hs = values["spacings"]
    for row, (name, key) in zip(panels, KEYS.items()):
        for volume, colour in zip(VOLUMES, drawing.COLOURS):
            result = values["extrapolated"][f"{volume}, {name}"]
            limit = result["limit_h"]["corrected"]
            off = lambda found, reference: 100 * (np.array(found) / reference - 1)  # noqa: E731
            for scheme, style in zip(SCHEMES, ("s--", "o-")):
                found = [values["steady"][f"{volume}, {scheme}, box 12, h {h}"][key] for h in hs]
                row[0].plot([*hs, 0], off([*found, result["limit_h"][scheme]], limit), style, color=colour, markersize=4, label=f"{volume}, {scheme}")
            row[0].errorbar([0], [0], [100 * result["grid_error"] / limit], color=colour, capsize=3)
            found = [values["steady"][f"{volume}, corrected, box {w}, h 0.2"][key] for w in WIDTHS]
            row[1].semilogx(WIDTHS, off(found, found[-1] + result["box_term"] * (12 / WIDTHS[-1]) ** 3), "o-", color=colour, markersize=4, label=f"{volume}")
        row[0].set(xlabel="h (box 12 wide)", ylabel=f"{name}: % above the limit")
        row[1].set(xlabel="width of the box (h = 0.2, corrected)", xticks=WIDTHS, xticklabels=WIDTHS)
        row[1].minorticks_off()
    panels[0, 0].legend(fontsize=7)
    drawing.save(figure, path)
