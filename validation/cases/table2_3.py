# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tables 2 and 3: relaxation of the oblate 3:3:1 to t = 0.5 at h = 6/32 ... 6/256: differences of successive grids, and conservation.

Two ways: as the paper computes it, and implicit at the same step with sigma0 = 16000 and its equations solved to 1e-8, so that the velocities, which are
increments over small steps, are right to 1e-5. (Shape following, which takes one evaluation of the fluid where this takes 3 to 5, is unstable above
sigma0 = 4000 here: Re = 1.) Columns are the paper's: the surface divergence is that of the velocity which moves the membrane, filtered as in
the paper's Step 4, or cut to the degrees that the implicit step keeps; local areas are those of material points, which are the markers of the
paper's scheme, and the strain that the implicit step carries.
"""

import h5py
import numpy as np

from harness import drawing, outputs, spectral
from harness.runs import Run
from harness.tables import table

TITLE = "relaxation of an oblate: convergence and conservation (tables 2, 3)"
SCENE = "scenes/paper/relaxation_oblate.toml"
PAPER_2 = {  # velocities u, v, w, pressure, positions
    64: [5.200e-1, 5.233e-1, 4.478e-1, 3.598e-1, 1.012e-2],
    128: [1.007e-1, 1.016e-1, 9.260e-2, 1.230e-1, 2.140e-3],
    256: [3.148e-2, 3.235e-2, 2.636e-2, 7.203e-2, 5.738e-4]}
PAPER_3 = {  # surface divergence, local area, area, volume
    32: [8.710e-3, 8.218e-3, 2.112e-3, 7.928e-5], 64: [2.013e-3, 1.466e-3, 9.486e-4, 2.631e-5],
    128: [3.364e-4, 5.039e-4, 4.493e-4, 6.671e-6], 256: [1.221e-4, 2.494e-4, 2.233e-4, 7.250e-6]}
NAMES_2, NAMES_3 = ["u", "v", "w", "p", "X"], ["div U", "local area", "area", "volume"]
SCHEMES = ["paper's preset", "implicit"]


def run_of(scheme, n):
    octant = {"domain.mirror": [True, True, True], "domain.lower": [0, 0, 0], "domain.cells": n // 2}  # the same to round-off
    keys = octant | {"mesh.latitudes": n // 2, "output.vesicle_every": 0.5, "output.fluid_every": 0, "output.checkpoint_every": 0.1}
    if scheme == "implicit":
        keys |= {"method.preset": "standard", "membrane.volume": "projection", "time.markers": "implicit", "membrane.sigma0": 16000, "time.implicit_tolerance": 1e-8}
    else:
        keys |= {"membrane.sigma0": 9.375 * n}
    # The paper's step is not stable with its tension on the finest grid, where g = 16.7.
    steps = 12 * n if n == 256 and scheme == "paper's preset" else 6 * n
    keys["time.step"] = f"1/{steps}"
    return Run(f"{scheme}, N = {n}", SCENE, keys, keep_checkpoint=True)


def resolved_degrees(n):
    """Of the implicit step (docs/time_integration.md): n < 0.7 pi/h on the unit sphere, and no more than two thirds of the latitudes."""
    return min(int(0.7 * np.pi * n / 6), (n // 2) * 2 // 3)


def fields(folder, n):
    """u, v, w, p without their ghosts, and the positions on the mesh."""
    with h5py.File(folder / "checkpoint.h5") as file:
        inside = (slice(1, -1),) * 3
        result = [file[f"velocity/{axis}"][inside] for axis in "xyz"] + [file["pressure"][inside]]
        positions = file["vesicle_0/positions"][:].reshape(3, -1).T
    result[3] -= result[3].mean()
    return result + [spectral.on_mesh(positions, n // 2)]


def halved(fine, component):
    """A field at the points of the grid with half the cells: means over the cells' shares; faces that both have stay as they are."""
    along = 2 - component if component < 3 else None  # axis of the array: z, y, x
    for axis in range(3):
        even = [slice(None)] * 3
        odd = [slice(None)] * 3
        even[axis], odd[axis] = slice(0, None, 2), slice(1, None, 2)
        fine = fine[tuple(even)] if axis == along else 0.5 * (fine[tuple(even)] + fine[tuple(odd)])
    return fine


def difference(coarse, fine, component):
    if component == 4:
        onto = spectral.synthesis(spectral.analysis(fine[4]), coarse[4].shape[0])
        return np.sqrt(np.mean((onto - coarse[4]) ** 2) / np.mean(onto**2))
    onto = halved(fine[component], component)
    return np.sqrt(np.mean((onto - coarse[component]) ** 2))


def size(all_fields, component):
    return 1.0 if component == 4 else np.sqrt(np.mean(all_fields[component] ** 2))


def conservation(folder, n, scheme):
    course, shot = outputs.course(folder), None
    with h5py.File(folder / "vesicle.h5") as file:
        shot = file["steps"][sorted(file["steps"])[-1]]["vesicle_0"]
        positions, velocity = (spectral.on_mesh(shot[key][:], n // 2) for key in ("positions", "velocity"))
    filtered = spectral.kept(velocity, resolved_degrees(n)) if scheme == "implicit" else spectral.paper_filter(positions, velocity)
    divergence = spectral.surface_divergence(positions, filtered)
    local = "max_label_area_error" if scheme != "implicit" else "max_local_area_error"
    return [float(np.max(np.abs(divergence))), *(abs(float(course[key][-1])) for key in (local, "area_error", "volume_error"))]


def compute(context):
    sizes = [32, 64, 128, 256] if context.paper else [32, 64, 128]
    folders = context.run([run_of(scheme, n) for n in sizes for scheme in SCHEMES])
    values = {"sizes": sizes, "differences": {}, "orders": {}, "conservation": {}}
    rows_2, rows_3 = [], []
    for scheme in SCHEMES:
        solutions = {n: fields(folders[f"{scheme}, N = {n}"], n) for n in sizes}
        finest = [size(solutions[sizes[-1]], c) for c in range(5)]
        last = None
        for coarse, n in zip(sizes, sizes[1:]):
            found = [float(difference(solutions[coarse], solutions[n], c) / finest[c]) for c in range(5)]
            orders = [float(np.log2(a / b)) for a, b in zip(last, found)] if last else [None] * 5
            published = [float(np.log2(a / b)) for a, b in zip(PAPER_2[coarse], PAPER_2[n])] if last else [None] * 5
            values["differences"][f"{scheme}, N = {n}"], values["orders"][f"{scheme}, N = {n}"] = found, orders
            rows_2.append([scheme, f"6/{n}", *(cell for c in range(5) for cell in (found[c], orders[c]))])
            rows_2.append(["the paper", f"6/{n}", *(cell for c in range(5) for cell in (PAPER_2[n][c], published[c]))])
            last = found
        for n in sizes:
            found = conservation(folders[f"{scheme}, N = {n}"], n, scheme)
            values["conservation"][f"{scheme}, N = {n}"] = found
            rows_3.append([scheme, f"6/{n}", *(cell for c in range(4) for cell in (found[c], PAPER_3[n][c]))])
    values["tables"] = [
        table("Table 2: differences of successive grids over the norm on the finest, and orders",
              ["scheme", "h", *(cell for name in NAMES_2 for cell in (name, "order"))], rows_2),
        table("Table 3: largest errors at t = 0.5", ["scheme", "h", *(cell for name in NAMES_3 for cell in (name, "paper"))], rows_3)]
    return values


def draw(context, values, path):
    figure, panels = drawing.figure(1, 2, figsize=(9.5, 4))
    sizes = values["sizes"]
    for scheme, style in zip(SCHEMES, ("o-", "s--")):
        for c, name in enumerate(NAMES_2):
            panels[0].loglog([6 / n for n in sizes[1:]], [values["differences"][f"{scheme}, N = {n}"][c] for n in sizes[1:]], style,
                             color=drawing.COLOURS[c], label=f"{name}, {scheme}", markersize=4)
        for c, name in enumerate(NAMES_3):
            found = [values["conservation"][f"{scheme}, N = {n}"][c] for n in sizes]
            if max(found) < 1e-12:
                continue
            panels[1].loglog([6 / n for n in sizes], found, style, color=drawing.COLOURS[c], label=f"{name}, {scheme}", markersize=4)
    for c in range(5):
        panels[0].loglog([6 / n for n in PAPER_2], [PAPER_2[n][c] for n in PAPER_2], "x:", color=drawing.COLOURS[c])
    for c in range(4):
        panels[1].loglog([6 / n for n in PAPER_3], [PAPER_3[n][c] for n in PAPER_3], "x:", color=drawing.COLOURS[c])
    panels[0].set(xlabel="h", ylabel="difference from the next coarser grid", title="crosses: the paper")
    panels[1].set(xlabel="h", ylabel="largest relative error", ylim=(1e-6, 3e-2),
                  title="area and volume of implicit are below 1e-13")
    for axes in panels:
        axes.legend(fontsize=6, ncol=2)
    drawing.save(figure, path)
