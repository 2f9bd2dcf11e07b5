# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Viscosity ratios at which the tank-treading of a sharp membrane ends and its tumbling begins, on two grids.

In a box 6 wide, walls at z = -3 and 3, periodic along x and y, without inertia, dt = 1/24, from 10 degrees above the flow, to t = 30. Both ratios are
zeros of smooth functions of the ratio, found by secants, of the second moments M of the volume in the plane of the flow:

- Tank-treading ends where the least angle of the run is -2 degrees, the rule of the case critical_ratio.
- While a vesicle trembles, (M_xx - M_zz, 2 M_xz) goes round a point on the right of the origin, and while it tumbles round the origin. The rightmost
  or leftmost place where that curve crosses 2 M_xz = 0 upwards tells which: (M_xx - M_zz)/(M_xx + M_zz) is positive there when the angle comes back,
  negative when it goes on, and tumbling begins where it is zero. The last crossing of the run counts.
"""

import math

import numpy as np

from harness import drawing, outputs, theory
from harness.runs import Run
from harness.tables import table

TITLE = "critical viscosity ratios of sharp membranes on two grids"
VOLUMES = [0.95, 0.9]
CELLS = {"coarse": [32, 48], "paper": [32, 48, 72]}
LATITUDES = {32: 24, 48: 32, 72: 40}
END, LEAST_ANGLE = 30, -2.0
# Where to begin to look, on the coarsest grid.
FIRST = {0.95: {"end of tank-treading": (7.5, 8.0), "onset of tumbling": (10.0, 10.6)},
         0.9: {"end of tank-treading": (6.0, 6.4), "onset of tumbling": (7.6, 8.0)}}
TOLERANCE, BRACKET = 1e-3, 0.015  # relative: nearer to a run, or between two runs, the function is interpolated


def run_of(volume, ratio, cells):
    keys = {"domain.lower": [-3] * 3, "domain.upper": [3] * 3, "domain.mirror": [False] * 3, "domain.periodic": [True, True, False],
            "domain.cells": cells, "mesh.latitudes": LATITUDES[cells], "fluid.inertia": "none", "fluid.viscosity_ratio": ratio,
            "membrane.sigma0": 2000, "coupling.method": "sharp", "time.step": "1/24", "time.end": END,
            "vesicles.0.reduced_volume": volume, "vesicles.0.rotation_deg": 80, "output.vesicle_every": 0.25, "output.checkpoint_every": 0}
    return Run(f"{volume}, ratio {ratio}, {cells} cells", "scenes/paper/half_box.toml", keys)


def moments(membrane):
    """(M_xx - M_zz, 2 M_xz)/(M_xx + M_zz) of the volume, by its tetrahedra with the centre."""
    points, faces = membrane["points"] - membrane["points"].mean(axis=0), membrane["faces"]
    a, b, c = (np.concatenate([points[faces[:, i]], points[faces[:, j]]]) for i, j in ((0, 0), (1, 2), (2, 3)))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    total = a + b + c
    first = (volume[:, None] * total).sum(axis=0) / 4
    second = sum(np.einsum("i,ij,ik->jk", volume, v, v) for v in (a, b, c, total)) / 20
    second = second - np.outer(first, first) / volume.sum()
    scale = second[0, 0] + second[2, 2]
    return (second[0, 0] - second[2, 2]) / scale, 2 * second[0, 2] / scale


def measures(folder):
    snapshots = outputs.membranes(folder)
    time = np.array([s["time"] for s in snapshots])
    across, along = np.array([moments(s) for s in snapshots]).T
    angle = np.degrees(np.unwrap(np.arctan2(along, across))) / 2
    crossings = []
    for i in range(1, len(time)):
        if along[i - 1] < 0 <= along[i]:
            share = -along[i - 1] / (along[i] - along[i - 1])
            crossings.append(float(across[i - 1] + share * (across[i] - across[i - 1])))
    least = int(np.argmin(angle))
    lowest = float(angle[least])
    if 0 < least < len(angle) - 1:
        low, middle, high = angle[least - 1:least + 2]
        lowest = float(middle - (high - low) ** 2 / (8 * (high - 2 * middle + low)))
    return {"least_angle": lowest, "last_angle": float(angle[-1]), "crossings": crossings, "status": outputs.summary(folder)["status"],
            "volume_error": float(np.abs(outputs.course(folder)["volume_error"]).max()), "time": time.tolist(), "angle": angle.tolist()}


def value_of(name, state):
    """Positive below the critical ratio, negative above; nan where the run does not tell."""
    if name == "end of tank-treading":
        return state["least_angle"] - LEAST_ANGLE
    return state["crossings"][-1] if state["crossings"] else math.nan


def compute(context):
    cells, values, rows, drawn = CELLS[context.level], {"states": {}, "critical": {}}, [], {}

    def state_of(volume, ratio, n):
        run = run_of(volume, ratio, n)
        if run.name not in drawn:
            drawn[run.name] = measures(context.run([run])[run.name])
            values["states"][run.name] = {k: v for k, v in drawn[run.name].items() if k not in ("time", "angle")}
        return drawn[run.name]

    for volume in VOLUMES:
        found = {}
        for n in cells:
            for name in FIRST[volume]:
                if n == cells[0]:
                    ratios = list(FIRST[volume][name])
                else:
                    ratios = [round(found[name, cells[cells.index(n) - 1]] * factor, 3) for factor in (1.0, 1.01)]
                found[name, n] = critical(ratios, lambda ratio, n=n: value_of(name, state_of(volume, ratio, n)))
        values["critical"][str(volume)] = {f"{name}, {n}": ratio for (name, n), ratio in found.items()}
        for name in FIRST[volume]:
            ratios = [found[name, n] for n in cells]
            rows.append([volume, name, *(f"{r:.3f}" for r in ratios), f"{100 * (ratios[0] / ratios[-1] - 1):+.2f} %",
                         *([f"{100 * (ratios[1] / ratios[-1] - 1):+.2f} %"] if len(cells) > 2 else []), theory.critical_ratio(volume)])
    names = [f"R/{n / 6:.3g}" for n in cells]
    between = [f"{name} against {names[-1]}" for name in names[:-1]]
    values["tables"] = [table("Critical viscosity ratios", ["reduced volume", "", *names, *between, "Keller & Skalak: both"], rows)]
    values["courses"] = {name: {"time": state["time"], "angle": [round(a, 3) for a in state["angle"]]} for name, state in drawn.items()}
    return values


def critical(ratios, function):
    """Where the function, positive below and negative above, is zero: by secants, kept inside what is known; the last step is interpolated only."""
    known = {ratio: function(ratio) for ratio in ratios}
    for _ in range(6):
        told = {r: f for r, f in known.items() if not math.isnan(f)}
        if len(told) < 2:
            ratio = round(1.04 * max(known), 3)
            known[ratio] = function(ratio)
            continue
        (a, f), (b, g) = sorted(told.items(), key=lambda point: abs(point[1]))[:2]
        root = a - f * (b - a) / (g - f)
        low, high = max((r for r in told if told[r] > 0), default=None), min((r for r in told if told[r] <= 0), default=None)
        if low is not None and high is not None:
            if not low <= root <= high:
                root = low + (high - low) * told[low] / (told[low] - told[high])
            if high - low < BRACKET * low:
                return root
        else:
            root = min(max(root, 0.9 * a), 1.1 * a)
        if min(abs(root - r) for r in told) < TOLERANCE * root:
            return root
        ratio = round(root, 3)
        known[ratio] = function(ratio)
    return root


def draw(context, values, path):
    figure, panels = drawing.plt.subplots(1, len(VOLUMES), figsize=(9, 3), sharey=True)
    n = CELLS[context.level][-1]
    for axes, volume in zip(panels, VOLUMES):
        for name, course in sorted(values["courses"].items()):
            if name.startswith(f"{volume},") and name.endswith(f" {n} cells"):
                axes.plot(course["time"], course["angle"], linewidth=1, label=name.split(", ")[1])
        axes.set(xlabel="t", title=f"{volume}", ylim=(-100, 50))
        axes.legend(fontsize=7)
    panels[0].set_ylabel("angle, degrees")
    drawing.save(figure, path)
