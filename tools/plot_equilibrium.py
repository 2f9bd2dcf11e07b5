#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Least bending energy against reduced volume, with the shapes, from the folder of the app equilibrium_shape.

    equilibrium_shape --branch prolate --reduced-volume 0.6:1:0.02 --out out/equilibrium
    equilibrium_shape --branch oblate --reduced-volume 0.52:1:0.02 --out out/equilibrium
    plot_equilibrium.py out/equilibrium

Draws the branches that the folder has.
"""
import argparse
import json
import sys
from pathlib import Path

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as error:
    sys.exit(f"{error}. A python that has what this needs is found by: scripts/python.sh {' '.join(sys.argv)}")

# Okabe and Ito's colours: told apart by colour-blind readers too.
COLOURS = {"prolate": "#0072B2", "oblate": "#D55E00"}
STYLE = {
    "font.size": 10,
    "axes.titlesize": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "savefig.dpi": 160,
}
INSETS = 5  # shapes per branch
INSET_SIZE = 0.17  # of the axes' width
INSET_DISTANCE = {"prolate": -0.17, "oblate": 0.13}  # from the curve, of the axes' height


class MissingData(Exception):
    """The folder has not what the picture needs."""


def read_branch(folder, branch):
    """The shapes that were found, in order of reduced volume, with their meridians."""
    path = folder / f"{branch}.json"
    if not path.exists():
        raise MissingData(f"{path} is missing (equilibrium_shape --branch {branch} --out {folder} writes it)")
    shapes = [shape for shape in json.loads(path.read_text())["shapes"] if shape["converged"]]
    if not shapes:
        raise MissingData(f"{path} has no shapes that converged")
    for shape in shapes:
        meridian = folder / f"{branch}_{shape['reduced_volume']:.12g}_meridian.csv"
        if meridian.exists():
            table = np.genfromtxt(meridian, delimiter=",", names=True)
            shape["outline"] = np.array([[*table["rho"], *-table["rho"][::-1]], [*table["z"], *table["z"][::-1]]])
    return sorted(shapes, key=lambda shape: shape["reduced_volume"])


def draw_outlines(axes, branch, shapes, reach):
    """Some of the shapes beside the curve, axis upright; `reach` is half the size of an inset."""
    drawable = [shape for shape in shapes if "outline" in shape]
    if not drawable:
        return
    chosen = np.unique(np.linspace(0, len(drawable) - 1, INSETS).round().astype(int))
    for shape in (drawable[k] for k in chosen):
        point = (shape["reduced_volume"], shape["bending_energy_over_sphere"])
        x, y = axes.transAxes.inverted().transform(axes.transData.transform(point))
        y += INSET_DISTANCE[branch]
        inset = axes.inset_axes([x - INSET_SIZE / 2, y - INSET_SIZE / 2, INSET_SIZE, INSET_SIZE])
        inset.fill(*shape["outline"], facecolor="0.93", edgecolor=COLOURS[branch], linewidth=1.2)
        inset.set(aspect="equal", xlim=(-reach, reach), ylim=(-reach, reach))
        inset.axis("off")
        axes.plot(*point, "o", color=COLOURS[branch], markersize=4)


def draw(branches, target):
    figure, axes = plt.subplots(figsize=(7.5, 5.5))
    for branch, shapes in branches.items():
        volumes = [shape["reduced_volume"] for shape in shapes]
        energies = [shape["bending_energy_over_sphere"] for shape in shapes]
        axes.plot(volumes, energies, color=COLOURS[branch], linewidth=1.8, label=branch)
    axes.set(xlabel="reduced volume", ylabel="bending energy over that of the sphere")
    axes.grid(color="0.9")
    axes.margins(x=0.1, y=0.35)
    axes.legend(frameon=False, loc="upper right")
    axes.set(xlim=axes.get_xlim(), ylim=axes.get_ylim())  # the insets move nothing
    figure.tight_layout()
    outlines = [shape["outline"] for shapes in branches.values() for shape in shapes if "outline" in shape]
    reach = max((np.abs(outline).max() for outline in outlines), default=1)
    for branch, shapes in branches.items():
        draw_outlines(axes, branch, shapes, 1.05 * reach)
    figure.savefig(target)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="the --out of equilibrium_shape")
    parser.add_argument("--out", type=Path, help="the picture (default: FOLDER/equilibrium_shapes.png)")
    arguments = parser.parse_args()
    if not arguments.folder.is_dir():
        parser.error(f"{arguments.folder} is not a folder")

    branches = {}
    for branch in COLOURS:
        try:
            branches[branch] = read_branch(arguments.folder, branch)
        except MissingData as missing:
            print(f"{branch} branch not drawn: {missing}", file=sys.stderr)
    if not branches:
        return 1
    target = arguments.out or arguments.folder / "equilibrium_shapes.png"
    plt.rcParams.update(STYLE)
    draw(branches, target)
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main())
