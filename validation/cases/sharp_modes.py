# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Velocity of a resting membrane under a given force, sharp and delta, against the grid: bench/micro/sharp_accuracy.cpp.

A sphere and a prolate of axes 1:1:2 with the volume of the unit sphere, askew in a box 6 wide. Errors are root mean squares over the membrane,
relative to the velocity; the limit is that of the sharp membrane on 96^3 and 128^3 cells, extrapolated with second order; on 64^3 and 96^3 at
ratios 0.2 and 20 and between walls.
Forces: a harmonic of degree n of the parameters times the normal, or as a tension (grad s - 2 H s n).
"""

import hashlib
import json
import math

from harness import drawing, runs
from harness.tables import table

TITLE = "velocity of a resting membrane under given forces, sharp and delta"
WIDTH = 6
BODIES = {"sphere": 1, "1:1:2": 2}
CELLS, SOME = [32, 48, 64, 96], [32, 48, 64]
RATIOS, WALL_RATIOS = [0.2, 1, 5, 20], [1, 5]
DEGREES, WALL_DEGREES = [2, 3, 4, 6, 8, 10], [2, 4, 8]
# Cells, those that the limit is extrapolated from, ratios, degrees.
SETS = {"periodic": [(CELLS, [96, 128], [1, 5], DEGREES), (SOME, [64, 96], [0.2, 20], DEGREES)],
        "walls": [(SOME, [64, 96], WALL_RATIOS, WALL_DEGREES)]}
PROGRAM = "../bench/sharp_accuracy"
AT = 48  # cells of the tables that show one grid


def words(name, values):
    return [f"--{name}", *map(str, values)]


def answer(context, *arguments):
    """Of the program, kept in out/validation as runs are."""
    kept = runs.STORE / f"sharp_modes-{hashlib.sha1(' '.join(arguments).encode()).hexdigest()[:10]}.json"
    if not kept.exists():
        before = context.app_seconds
        found = json.loads(context.app(PROGRAM, *arguments))
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_text(json.dumps(found | {"seconds": context.app_seconds - before}))
        context.app_seconds = before
    found = json.loads(kept.read_text())
    context.app_seconds += found["seconds"]
    return found["modes"]


def found_by(context, body, where):
    """Errors by force, degree and ratio."""
    found = {}
    for cells, reference, ratios, degrees in SETS[where]:
        command = ["--aspect", str(BODIES[body])] + ["--walls"] * (where == "walls")
        for name, values in zip(("cells", "reference", "ratio", "degree"), (cells, reference, ratios, degrees)):
            command += words(name, values)
        for m in answer(context, *command):
            found[m["force"], m["degree"], m["ratio"]] = {method: dict(zip(cells, m[method])) for method in ("sharp", "delta", "solves")}
    return found


def shown(error, digits=3):
    return "-" if error is None else f"{100 * error:.{digits}g}"


def order(errors, coarse, fine):
    if errors.get(coarse) is None or errors.get(fine) is None:
        return "-"
    return f"{math.log(errors[coarse] / errors[fine]) / math.log(fine / coarse):.1f}"


def spacing(cells):
    return f"R/{cells / WIDTH:.3g}"


def compute(context):
    periodic = {body: found_by(context, body, "periodic") for body in BODIES}
    between = {body: found_by(context, body, "walls") for body in BODIES}
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
                    row.append(f"{shown(errors['delta'][AT])} / {shown(errors['sharp'][AT])}, {order(errors['sharp'], 32, 64)}")
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
        table(f"At {spacing(AT)}, by viscosity ratio: delta / sharp in %, order of the sharp membrane from R/5.3 to R/10.7",
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
