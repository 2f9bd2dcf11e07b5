# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What became of a run, measured from its diagnostics (docs/stability.md gives the reasons for the numbers)."""

import math
import re

import numpy as np

from harness import outputs

STABLE, NOISY, BLOWN_UP, REFUSED = "stable", "noisy", "blown up", "refused"
LOUD = 0.1            # surface divergence, in shear rates
ABOVE_QUIETEST = 2.0  # times that of the quietest run of the same problem
JITTER = 0.05         # degrees, from step to step
TAIL = 1e-4           # share of the shape's energy in the top third of the degrees


def jitter(angle):
    """Amplitude of what changes its sign from row to row: fourth differences over 16 leave that alone, and of a smooth course dt^4/16 times its
    fourth derivative."""
    return float(np.max(np.abs(np.diff(angle, 4)))) / 16 if len(angle) > 4 else math.nan


def growth_rate(time, values):
    """Of an exponential through values > 0, by least squares of their logarithm."""
    good = np.isfinite(values) & (values > 0)
    return float(np.polyfit(time[good], np.log(values[good]), 1)[0]) if good.sum() > 3 else math.nan


def measures(folder):
    """Numbers of the last quarter of a run; those of a run that stopped are of the time before it did."""
    summary = outputs.summary(folder)
    course = outputs.course(folder)
    time = course["time"]
    last, half = time >= 0.75 * time[-1], time >= 0.5 * time[-1]
    angle = outputs.unwrapped(course["inclination_angle_deg"])
    largest = lambda name: float(np.nanmax(np.abs(course[name][last])))  # noqa: E731
    return {
        "completed": summary["status"] == "completed", "time": summary["time"], "steps": summary["steps"], "start_parts": summary["start_parts"],
        "reason": cause(summary["stop_reason"]),
        "divergence": largest("surface_divergence_max"), "local_area": largest("max_local_area_error"),
        "growth": growth_rate(time[half], course["surface_divergence_max"][half]),
        "jitter": jitter(angle[last]), "tail": largest("spectrum_tail"), "angle": float(angle[-1]),
        "needed_latitudes": float(course["needed_latitudes"][-1]),
        "area_error": largest("area_error"), "volume_error": largest("volume_error"),
    }


def cause(stop_reason):
    return re.sub(r"^stopped in step.*?: ", "", stop_reason.split("\n")[0]) if stop_reason else None


def judge(measured, quietest):
    """quietest: least divergence of the runs of the same problem, which no run can be blamed for."""
    if not measured["completed"]:
        return BLOWN_UP
    loud = measured["divergence"] > max(LOUD, ABOVE_QUIETEST * quietest)
    return NOISY if loud or measured["jitter"] > JITTER or measured["tail"] > TAIL else STABLE
