# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Velocity of a resting membrane under a given force, sharp and delta, against the grid: bench/micro/sharp_accuracy.cpp.

A sphere and a prolate of axes 1:1:2 with the volume of the unit sphere, askew in a box 6 wide. Errors are root mean squares over the membrane, relative
to the velocity; the limit is that of the sharp membrane on 96^3 and 128^3 cells (between walls: 64^3 and 96^3), extrapolated with second order.
Forces: a harmonic of degree n of the parameters times the normal, or as a tension (grad s - 2 H s n).
"""

import json
import math

from harness import drawing
from harness.tables import table

TITLE = "velocity of a resting membrane under given forces, sharp and delta"
WIDTH = 6
BODIES = {"sphere": 1, "1:1:2": 2}
CELLS, REFERENCE = [32, 48, 64, 96], [96, 128]
WALL_CELLS, WALL_REFERENCE = [32, 48, 64], [64, 96]
RATIOS, WALL_RATIOS = [0.2, 1, 5, 20], [1, 5]
DEGREES, WALL_DEGREES = [2, 3, 4, 6, 8, 10], [2, 4, 8]
PROGRAM = "../bench/sharp_accuracy"
AT = 48  # cells of the tables that show one grid


def words(name, values):
    return [f"--{name}", *map(str, values)]


def found_by(context, body, has_walls):
    """Errors by force, degree and ratio."""
    settings = ((WALL_CELLS, WALL_REFERENCE, WALL_RATIOS, WALL_DEGREES) if has_walls else (CELLS, REFERENCE, RATIOS, DEGREES))
    command = ["--aspect", str(BODIES[body])] + ["--walls"] * has_walls
    for name, values in zip(("cells", "reference", "ratio", "degree"), settings):
        command += words(name, values)
    modes = json.loads(context.app(PROGRAM, *command))["modes"]
    return {(m["force"], m["degree"], m["ratio"]): {method: dict(zip(settings[0], m[method])) for method in ("sharp", "delta", "solves")} for m in modes}


def shown(error, digits=3):
    return "-" if error is None else f"{100 * error:.{digits}g}"


def order(errors, coarse, fine):
    if errors.get(coarse) is None or errors.get(fine) is None:
        return "-"
    return f"{math.log(errors[coarse] / errors[fine]) / math.log(fine / coarse):.1f}"


def spacing(cells):
    return f"R/{cells / WIDTH:.3g}"


def compute(context):
    periodic = {body: found_by(context, body, False) for body in BODIES}
    between = {body: found_by(context, body, True) for body in BODIES}
    equal, ratios, walls = [], [], []
    for body in BODIES:
        for force in ("normal", "tension"):
            for n in DEGREES:
                errors = periodic[body][force, n, 1]
                equal.append([body, f"{force}, {n}", *(f"{shown(errors['delta'][c])} / {shown(errors['sharp'][c])}" for c in CELLS),
                              order(errors["sharp"], 32, 64), order(errors["sharp"], 48, 96)])
                row = [body, f"{force}, {n}"]
                for ratio in RATIOS:
                    errors = periodic[body][force, n, ratio]
                    row.append(f"{shown(errors['delta'][AT])} / {shown(errors['sharp'][AT])}, {order(errors['sharp'], AT, 96)}")
                ratios.append(row)
            for n in WALL_DEGREES:
                row = [body, f"{force}, {n}"]
                for ratio in WALL_RATIOS:
                    errors = between[body][force, n, ratio]
                    row.append(f"{shown(errors['delta'][AT])} / {shown(errors['sharp'][AT])}, {order(errors['sharp'], 32, 64)}")
                walls.append(row)
    stored = {f"{where}, {body}, {force}, {n}, ratio {ratio}": {method: {str(c): v for c, v in series.items()} for method, series in errors.items()}
              for where, all_of in (("periodic", periodic), ("walls", between)) for body, found in all_of.items()
              for (force, n, ratio), errors in found.items()}
    return {"errors": stored, "tables": [
        table("Errors at equal viscosities, delta / sharp in %, and orders of the sharp membrane; -: the grid is left without such a force",
              ["body", "force, degree", *(spacing(c) for c in CELLS), "order, R/5.3 to R/10.7", "order, R/8 to R/16"], equal),
        table(f"At {spacing(AT)}, by viscosity ratio: delta / sharp in %, order of the sharp membrane from there to R/16",
              ["body", "force, degree", *(f"ratio {r:g}" for r in RATIOS)], ratios),
        table(f"Between walls at z = -3 and 3, at {spacing(AT)}: delta / sharp in %, order of the sharp membrane from R/5.3 to R/10.7",
              ["body", "force, degree", *(f"ratio {r:g}" for r in WALL_RATIOS)], walls)]}


def draw(context, values, path):
    figure, panels = drawing.plt.subplots(1, len(BODIES), figsize=(8, 3.2), sharey=True)
    for axes, body in zip(panels, BODIES):
        for (n, colour) in zip((2, 4, 8), drawing.COLOURS):
            for method, style in (("sharp", "o-"), ("delta", "s--")):
                errors = values["errors"][f"periodic, {body}, tension, {n}, ratio 1"]
                points = [(WIDTH / int(c), e) for c, e in errors[method].items() if e is not None]
                axes.loglog(*zip(*points), style, color=colour, label=f"{method}, degree {n}")
        axes.set(xlabel="h/R", title=f"{body}, tension")
    panels[0].set_ylabel("error of the velocity")
    panels[0].legend(fontsize=6)
    drawing.save(figure, path)
