# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause

# %% [markdown]
# # Curvatures of a measured shape
#
# libvesicle alone: a triangle mesh, as microscopes and segmentation give, becomes a smooth surface with curvatures and a bending force. The mesh
# `red_cell.off` has 1002 vertices of Evans and Fung's average red cell with 0.2 % of noise, as measured shapes have. Two seconds.

# %%
from pathlib import Path

import numpy as np
from vesiflow import vesicle

folder = Path(__file__).parent if "__file__" in globals() else Path(".")
fit = vesicle.from_mesh(folder / "red_cell.off", latitudes=32, degrees=12)
surface = fit.surface
print(fit.description)
print(f"area {surface.area:.4f}, volume {surface.volume:.4f}, reduced volume {surface.reduced_volume:.4f}")

# %% [markdown]
# The mean curvature is negative in the dimples and positive at the rim. That the Gaussian curvature integrates to 4 pi says how well the mesh
# resolves the shape, whatever that is.

# %%
curvature = surface.mean_curvature
dimple, rim = curvature[np.argmin(np.hypot(*surface.positions[:, :2].T))], curvature.max()
total = surface.integral(surface.gaussian_curvature)
print(f"mean curvature: {dimple:.2f} in the dimple, at most {rim:.2f}; int K dA = 4 pi to {abs(total / (4 * np.pi) - 1):.0e}")
print(f"bending energy {surface.bending_energy() / (2 * np.pi):.2f} of a sphere's")

# %% [markdown]
# The exact surface is known here: at a distance from the axis it has a curvature, against which the fitted one is held. Noise of 0.2 % moves the
# vertices by as much, and a curvature of degree n by up to n^2 = 144 times that over the root of the number of vertices per coefficient (7):
# about 0.1 of the inverse radius at the worst markers, half of it in the mean. More degrees follow the noise, fewer miss the rim.

# %%
exact = vesicle.biconcave_disc(latitudes=64)
distance, sampled = (np.hypot(*shape.positions[:, :2].T) / shape.effective_radius for shape in (exact, surface))
nearest = np.argsort(distance)
error = curvature * surface.effective_radius - np.interp(sampled, distance[nearest], exact.mean_curvature[nearest])
rms = np.sqrt(surface.integral(error**2) / surface.area)
print(f"error of the mean curvature: {rms:.3f} (rms), beside a largest curvature of {exact.mean_curvature.max():.2f}, in inverse radii")
assert rms < 0.08
assert fit.rms_distance < 0.004  # along the normal the noise is 0.0028 of the effective radius
assert abs(surface.reduced_volume / exact.reduced_volume - 1) < 0.005
assert abs(surface.bending_energy() / exact.bending_energy() - 1) < 0.02
assert abs(total / (4 * np.pi) - 1) < 1e-6
