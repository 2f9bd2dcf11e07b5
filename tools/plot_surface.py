#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a surface, one per quantity, from the tables that the app surface_fields writes.

usage: plot_surface.py FOLDER [--out FOLDER] [--quantity NAME ...]
"""
import argparse
import sys
from pathlib import Path

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as error:
    sys.exit(f"{error}. A python that has what this needs is found by: scripts/python.sh {' '.join(sys.argv)}")

BLUE, VERMILLION = "#0072B2", "#D55E00"  # Okabe and Ito: told apart by colour-blind readers too
SCALARS = {
    "mean_curvature": ("mean curvature $H$", "viridis"),
    "gaussian_curvature": ("Gaussian curvature $K$", "viridis"),
    "laplacian_of_mean_curvature": (r"$\Delta_\Gamma H$", "RdBu_r"),
    "tension": (r"tension $\sigma/\sigma_0$", "RdBu_r"),
}
VECTORS = {
    "normal": ("unit normal", 0.35),
    "bending_force": ("bending force per area", 0.6),
    "tension_force": ("tension force per area", 0.6),
}


class Grid:
    """The columns of markers.csv as arrays over (colatitude, longitude), closed in longitude and capped at the poles."""

    def __init__(self, path):
        try:
            table = np.genfromtxt(path, delimiter=",", names=True)
        except OSError as error:
            sys.exit(f"{error}: run build/release/apps/surface_fields SURFACE --out FOLDER first")
        self.latitudes = np.unique(table["colatitude"]).size
        self.table = table

    def __call__(self, name):
        rings = self.table[name].reshape(self.latitudes, -1)
        rings = np.hstack([rings, rings[:, :1]])
        cap = [np.full_like(rings[:1], rings[row, :-1].mean()) for row in (0, -1)]
        return np.vstack([cap[0], rings, cap[1]])

    def vector(self, name):
        return [self(f"{name}_{axis}") for axis in "xyz"]

    def markers(self, name):
        return np.stack([self.table[f"{name}_{axis}"] for axis in "xyz"])


def add_axes(figure, x, place=111, zoom=1.35):
    axes = figure.add_subplot(place, projection="3d", computed_zorder=False)
    axes.set_box_aspect([np.ptp(c) for c in x], zoom=zoom)
    axes.set_axis_off()
    axes.view_init(elev=28, azim=-55)
    return axes


def axes_of(grid):
    figure = plt.figure(figsize=(4.2, 3.6))
    x = grid.vector("position")
    return figure, add_axes(figure, x), x


def shaded(axes, x, colours, **options):
    axes.plot_surface(*x, facecolors=colours, rstride=1, cstride=1, antialiased=False, shade=False, **options)


def face_values(values):
    return 0.25 * (values[1:, 1:] + values[:-1, 1:] + values[1:, :-1] + values[:-1, :-1])


def paint_scalar(axes, grid, name):
    """The surface coloured by a scalar; returns what a colour bar needs."""
    colours = SCALARS[name][1]
    values = grid(name)
    bound = np.abs(values).max()
    norm = plt.Normalize(-bound, bound) if colours == "RdBu_r" else plt.Normalize(values.min(), values.max())
    mapping = matplotlib.cm.ScalarMappable(norm, colours)
    shaded(axes, grid.vector("position"), mapping.to_rgba(face_values(values)))
    return mapping


def draw_scalar(grid, name, target):
    figure, axes, _ = axes_of(grid)
    figure.colorbar(paint_scalar(axes, grid, name), ax=axes, shrink=0.6, pad=0.02, label=SCALARS[name][0])
    save(figure, target)


def paint_mesh(axes, x):
    axes.plot_surface(*x, rstride=1, cstride=1, color="#f4f6fa", edgecolor=BLUE, linewidth=0.3, shade=False)


def paint_plain(axes, x):
    axes.plot_surface(*x, rstride=1, cstride=1, color="#eef1f6", edgecolor="#d3d9e4", linewidth=0.2, shade=False)


def draw_overview(grid, target):
    """Mesh, curvatures and Laplacian of H side by side."""
    figure = plt.figure(figsize=(12, 2.9))
    x = grid.vector("position")
    paint_mesh(add_axes(figure, x, 141), x)
    figure.axes[0].set_title("markers", fontsize=11)
    for place, name in enumerate(("mean_curvature", "gaussian_curvature", "laplacian_of_mean_curvature"), start=142):
        axes = add_axes(figure, x, place)
        figure.colorbar(paint_scalar(axes, grid, name), ax=axes, shrink=0.55, pad=0.0)
        axes.set_title(SCALARS[name][0], fontsize=11)
    save(figure, target)


def draw_vectors(grid, name, target):
    label, length = VECTORS[name]
    figure, axes, x = axes_of(grid)
    paint_plain(axes, x)
    points, vectors = grid.markers("position"), grid.markers(name)
    strength = np.linalg.norm(vectors, axis=0)
    # Arrows on every few markers of the side that is seen.
    view = np.array([np.cos(np.radians(-55)), np.sin(np.radians(-55)), 0.6])
    seen = view @ grid.markers("normal") > 0.05
    longitudes = points.shape[1] // grid.latitudes
    row, column = np.divmod(np.arange(points.shape[1]), longitudes)
    chosen = seen & (row % max(1, grid.latitudes // 14) == 0) & (column % max(1, grid.latitudes // 10) == 0)
    arrows = vectors[:, chosen] / strength.max() * length
    axes.quiver(*points[:, chosen], *arrows, color=BLUE, linewidth=0.8, arrow_length_ratio=0.3)
    axes.set_title(f"{label}, at most {strength.max():.3g}" if name != "normal" else label, fontsize=10)
    save(figure, target)


def draw_mesh(grid, target):
    figure, axes, x = axes_of(grid)
    paint_mesh(axes, x)
    axes.set_title(f"markers: {grid.latitudes} latitudes, {x[0].shape[1] - 1} longitudes", fontsize=10)
    save(figure, target)


def draw_spectrum(folder, target):
    table = np.genfromtxt(folder / "spectrum.csv", delimiter=",", names=True)
    figure, axes = plt.subplots(figsize=(4.8, 3.3))
    for name, label, colour in (("mean_curvature", "$H$", BLUE), ("positions", "$X$", VERMILLION)):
        axes.semilogy(table["degree"], np.maximum(table[name], 1e-18), ".", color=colour, label=label)
    axes.semilogy(table["degree"], table["mean_curvature_law"], "-", color=BLUE, linewidth=0.8, label="fitted law")
    axes.set(xlabel="degree $n$", ylabel="amplitude", ylim=(1e-17, None))
    axes.legend(frameon=False)
    axes.spines[["top", "right"]].set_visible(False)
    save(figure, target)


def save(figure, target):
    figure.savefig(target, dpi=130, bbox_inches="tight")
    plt.close(figure)
    print(target)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="where surface_fields has written its tables")
    parser.add_argument("--out", type=Path, help="where the pictures go; the same folder unless given")
    names = ["overview", "mesh", "spectrum", *SCALARS, *VECTORS]
    parser.add_argument("--quantity", nargs="+", choices=names, default=names, metavar="NAME", help=", ".join(names))
    arguments = parser.parse_args()
    out = arguments.out or arguments.folder
    out.mkdir(parents=True, exist_ok=True)
    grid = Grid(arguments.folder / "markers.csv")
    for name in arguments.quantity:
        target = out / f"{name}.png"
        if name == "overview":
            draw_overview(grid, target)
        elif name == "mesh":
            draw_mesh(grid, target)
        elif name == "spectrum":
            draw_spectrum(arguments.folder, target)
        elif name in SCALARS:
            draw_scalar(grid, name, target)
        else:
            draw_vectors(grid, name, target)


if __name__ == "__main__":
    main()
