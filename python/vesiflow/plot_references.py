# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What theory says about a run, where the answer is known: values that pictures show beside what was computed."""

import math

import numpy as np

from . import theory

# Least (1/2) int H^2 dA by reduced volume: equilibrium_shape --branch prolate and oblate (docs/equilibrium_shapes.md).
LEAST_ENERGY = {
    "prolate": {0.5: 17.2623, 0.55: 14.8081, 0.6: 12.9452, 0.65: 11.4852, 0.7: 10.3250, 0.75: 9.4363, 0.8: 8.7175, 0.85: 8.0781, 0.9: 7.4748,
                0.95: 6.8836, 1: 6.2832},
    "oblate": {0.55: 13.1149, 0.6: 12.2879, 0.65: 11.4746, 0.7: 10.6758, 0.75: 9.8928, 0.8: 9.1266, 0.85: 8.3789, 0.9: 7.6520, 0.95: 6.9499,
               1: 6.2832},
}


def of(run, courses):
    """Lists of (value, label) by the key of a panel (plot_history.Quantity); none where vesicles differ in what decides it. A value of
    None has no place on the axis: the label says all."""
    flow = run.parameter("flow.type", "shear")
    result = {}
    volume = _shared([round(float(course["reduced_volume"][0]), 4) for course in courses])
    ratio = _shared([run.parameter(f"vesicles.{v}.viscosity_ratio", run.parameter("fluid.viscosity_ratio", 1)) for v in range(len(courses))])
    if flow == "shear" and volume and ratio:
        result |= _shear(volume, ratio, run.parameter("flow.rate", 1))
    curved = [run.parameter(f"vesicles.{v}.spontaneous_curvature", run.parameter("membrane.spontaneous_curvature", 0)) for v in range(len(courses))]
    if flow == "rest" and volume and not any(curved):
        result["energy"] = _least_energies(volume)
    pull = _shared([abs(run.parameter(f"vesicles.{v}.density_difference", 0)) * run.parameter(f"vesicles.{v}.radius", 1) ** 2 for v in range(len(courses))])
    if pull:
        speed = 2 / 9 * pull * float(np.linalg.norm(run.parameter("gravity.acceleration", [0, 0, 0])))
        result["settling"] = [(math.copysign(speed, run.parameter("vesicles.0.density_difference", 1)), "a solid sphere without walls")]
    return result


def _shared(values):
    """The value that all have, or None."""
    return values[0] if values and len(set(values)) == 1 else None


def _shear(volume, ratio, rate):
    if volume > 0.9999:
        return {"frequency": [(abs(rate) / 2, "a solid sphere")]}
    angle = theory.inclination(volume, ratio)
    if rate <= 0:
        return {}
    if math.isnan(angle):
        return {"inclination": [(None, f"Keller & Skalak's ellipsoid: {theory.half_period(volume, ratio) / rate:.3g}")]}
    return {"inclination": [(angle, "Keller & Skalak's ellipsoid")], "frequency": [(rate * theory.frequency(volume, ratio), "Keller & Skalak's")]}


def _least_energies(volume):
    lines = []
    for branch, energies in LEAST_ENERGY.items():
        volumes = sorted(energies)
        if volumes and volumes[0] <= volume <= 1:
            lines.append((float(np.interp(volume, volumes, [energies[v] for v in volumes])), f"least of {branch}s"))
    return lines
