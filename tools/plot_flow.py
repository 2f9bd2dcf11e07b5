#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""A picture of the flow that the app flow_fields has written: speed, streamlines, pressure, and the ball.

usage: plot_flow.py FOLDER [--out FILE]        FILE: FOLDER/flow.png
"""
import argparse
import io
import sys
from pathlib import Path

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    from PIL import Image
except ImportError as error:
    sys.exit(f"{error}. A python that has what this needs is found by: scripts/python.sh {' '.join(sys.argv)}")


class Plane:
    """The columns of plane.csv as arrays over (z, x)."""

    def __init__(self, folder):
        try:
            table = np.genfromtxt(Path(folder) / "plane.csv", delimiter=",", names=True)
        except OSError as error:
            sys.exit(f"{error}: run build/release/apps/flow_fields --out FOLDER first")
        self.x, self.z = np.unique(table["x"]), np.unique(table["z"])
        self.table = table

    def __call__(self, name):
        return self.table[name].reshape(self.z.size, self.x.size)

    def velocity(self):
        return np.array([self("u"), self("v"), self("w")])


def axes_of(figure, place, title):
    axes = figure.add_subplot(place)
    axes.set_aspect("equal")
    axes.set_title(title, fontsize=10)
    axes.set_xticks([-2, -1, 0, 1, 2])
    axes.set_yticks([-2, -1, 0, 1, 2])
    axes.tick_params(labelsize=8)
    axes.set_xlim(-2, 2)
    axes.set_ylim(-2, 2)
    return axes


def paint(axes, plane, values, **options):
    half = 0.5 * (plane.x[1] - plane.x[0])
    low, high = plane.x[0] - half, plane.x[-1] + half
    return axes.imshow(values, extent=(low, high, low, high), origin="lower", interpolation="bilinear", **options)


def outline(axes, plane, colour="white"):
    """Where the viscosity is halfway between the two."""
    mu = plane("viscosity")
    if mu.max() > 1.001 * mu.min():
        axes.contour(plane.x, plane.z, mu, levels=[0.5 * (mu.min() + mu.max())], colors=colour, linewidths=1.2)


def draw(folder, path):
    plane = Plane(folder)
    u, v, w = plane.velocity()
    figure = plt.figure(figsize=(9.6, 3.9))

    axes = axes_of(figure, 121, "speed and streamlines, plane y = 0")
    image = paint(axes, plane, np.sqrt(u**2 + v**2 + w**2), cmap="viridis")
    figure.colorbar(image, ax=axes, shrink=0.85).ax.tick_params(labelsize=8)
    axes.streamplot(plane.x, plane.z, u, w, color="white", linewidth=0.5, density=1.1, arrowsize=0.6)
    outline(axes, plane, "#D55E00")

    axes = axes_of(figure, 122, "pressure, and what the ball changes in the shear flow")
    p = plane("pressure")
    largest = np.abs(p).max()
    image = paint(axes, plane, p, cmap="RdBu_r", vmin=-largest, vmax=largest)
    figure.colorbar(image, ax=axes, shrink=0.85).ax.tick_params(labelsize=8)
    x, z = np.meshgrid(plane.x, plane.z)
    every = max(1, plane.x.size // 20)
    part = (slice(every // 2, None, every),) * 2
    moving = u - z * u[-1].mean() / z[-1].mean()
    axes.quiver(x[part], z[part], moving[part], w[part], scale=12, width=0.004)
    outline(axes, plane, "#D55E00")
    save(figure, path)


def save(figure, path):
    """With 256 colours, a third of the size."""
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=100, bbox_inches="tight")
    plt.close(figure)
    Image.open(buffer).convert("RGB").quantize(256, dither=Image.Dither.NONE).save(path, optimize=True)
    print(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="what flow_fields got as --out")
    parser.add_argument("--out", type=Path, help="the picture; FOLDER/flow.png if not given")
    options = parser.parse_args()
    draw(options.folder, options.out or options.folder / "flow.png")


if __name__ == "__main__":
    main()
