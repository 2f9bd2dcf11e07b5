# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause

# %% [markdown]
# # A flow and a force of your own
#
# A flow is a function u(x, t), and a force on a membrane one of time, vesicle and surface. Here a vesicle lies in a uniaxial extension, which
# would carry it away along z as soon as it is off the middle, and a spring between its centre and the origin holds it. Three seconds.

# %%
import numpy as np
import vesiflow


def extension(x, t, rate=0.5):
    return -rate / 2 * x[0], -rate / 2 * x[1], rate * x[2]


def spring(t, vesicle, surface, stiffness=40.0):
    centre = surface.area_weight @ surface.positions / surface.area
    return np.tile(-stiffness * centre / surface.area, (len(surface.positions), 1))  # force per area


scene = {
    "domain": {"lower": [-4, -4, -4], "upper": [4, 4, 4], "cells": 32},
    "coupling": {"method": "delta"},
    "fluid": {"inertia": "none"},
    "mesh": {"latitudes": 16},
    "time": {"step": "1/24", "end": 2.0},
    "vesicles": [{"shape": "prolate", "reduced_volume": 0.95, "centre": [0, 0, 0.2]}],
}
heights = {}
for held in (False, True):
    simulation = vesiflow.Simulation(scene, flow=extension)
    if held:
        simulation.add_force(spring)
    simulation.run()
    heights[held] = simulation.diagnostics["centroid_z"]
    print(f"{'held' if held else 'free'}: the centre goes from {heights[held][0]:.3f} to {heights[held][-1]:.3f}")

# %% [markdown]
# A free vesicle follows the flow, dz/dt = rate z, to the few per cent that its size and the coarse grid make. The spring takes stiffness / drag
# from the rate. The drag of a sphere far from walls is 6 pi; that of one in a cylinder of four radii is 2.0 times as large (Haberman and Sayre,
# 1958). A cube is a little wider than the cylinder in it, and has ends; so the factor should be near 2.0, to some twenty per cent.

# %%
free, taken = (np.log(z[-1] / z[len(z) // 2]) for z in (heights[False], heights[True]))  # over the second half, a time of 1
drag = 40.0 / (6 * np.pi * (free - taken))
print(f"rate {free:.3f}, with the spring {taken:.3f}: the drag is {drag:.2f} times that of a sphere without walls")
assert abs(free / 0.5 - 1) < 0.08
assert taken < 0  # it is held
assert 1.6 < drag < 2.4
