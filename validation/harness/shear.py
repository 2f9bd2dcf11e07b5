# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the cases in shear flow share: their scenes' keys and what is read from their courses."""

import math

import numpy as np

from . import outputs
from .runs import Run

TREADING, TUMBLING = "scenes/paper/fig4_tank_treading.toml", "scenes/paper/fig9_tumbling.toml"
COARSE = {"domain.cells": 64, "mesh.latitudes": 32}
# The half y > 0, with the plane y = 0 as one of symmetry: the same to round-off, in half the time.
HALF = {"domain.lower": [-6, 0, -6], "domain.mirror": [False, True, False]}


def corrected(context):
    """The thickness correction takes damping away: on 128^3 cells reduced volume 0.8 stops at t = 3.4 with dt = 1/24."""
    return {"coupling.thickness_correction": True} | ({"time.step": "1/48"} if context.paper else {})


def paper_scheme(cells):
    """The paper's own scheme and step in the box [-6,6]^3."""
    return {"method.preset": "paper", "time.markers": "euler", "membrane.sigma0": 600, "time.step": f"1/{3 * cells}"}


def treading(name, context, volume, scene=TREADING, **keys):
    """A run at the level's resolution."""
    if keys.get("domain.mirror") and "domain.cells" not in keys:
        n = 128 if context.paper else 64
        keys["domain.cells"] = [n, n // 2, n]
    return Run(name, scene, {"vesicles.0.reduced_volume": volume} | ({} if context.paper else COARSE) | keys)


def steady(folder, window=1.0):
    """Means over the last `window` of time, and how far the angle still moved in it; nan for a run that stopped before its end."""
    if outputs.summary(folder)["status"] != "completed":
        return dict.fromkeys(("angle_deg", "drift_deg", "frequency", "area_error"), math.nan)
    course = outputs.course(folder)
    last = course["time"] >= course["time"][-1] - window
    angle = outputs.unwrapped(course["inclination_angle_deg"])[last]
    return {"angle_deg": float(np.mean(angle)), "drift_deg": float(angle[-1] - angle[0]),
            "frequency": float(np.mean(course["tank_treading_frequency"][last])),
            "area_error": float(course["area_error"][-1])}


def half_turns(course):
    """Times at which the long axis lies along the flow (the angle falls through 0, -180, -360 ...), by interpolation."""
    time, angle = course["time"], outputs.unwrapped(course["inclination_angle_deg"])
    crossings = []
    for i in range(1, len(time)):
        for k in range(math.ceil(angle[i] / 180), math.ceil(angle[i - 1] / 180)):
            crossings.append(float(np.interp(-180 * k, [-angle[i - 1], -angle[i]], [time[i - 1], time[i]])))
    return crossings
