#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Centreline velocities of the lid-driven cube beside published points, and the flow in its mid-plane.

    lid_cavity --cells 32 48 64 --out out/lid_cavity
    plot_lid_cavity.py out/lid_cavity
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

# Okabe and Ito's colours, from pale to dark with the grids.
COLOURS = ["#56B4E9", "#009E73", "#E69F00", "#0072B2"]
PUBLISHED = {
    "marker": "o",
    "linestyle": "none",
    "markersize": 4,
    "markerfacecolor": "none",
    "color": "black",
    "zorder": 5,
}
STYLE = {"font.size": 10, "axes.titlesize": 10, "savefig.dpi": 160}


def draw_profiles(axes, result):
    """u to the right against y upwards, and v upwards against x to the right, on one pair of axes from -1/2 to 1."""
    other = axes.twiny(), axes.twinx()
    for grid, colour in zip(result["grids"], COLOURS[-len(result["grids"]) :]):
        u, v = grid["u_along_y"], grid["v_along_x"]
        axes.plot(u["values"], u["positions"], color=colour, linewidth=1.2, label=f"{grid['cells']}$^3$ cells")
        other[1].plot([2 * x - 1 for x in v["positions"]], v["values"], color=colour, linewidth=1.2)
    if "published" in result:
        rows = result["published"]
        points = [(row["published"], row["y"]) for row in rows["u_along_y"]]
        axes.plot(*zip(*points), **PUBLISHED, label="Albensoeder & Kuhlmann (2005)")
        points = [(2 * row["x"] - 1, row["published"]) for row in rows["v_along_x"]]
        other[1].plot(*zip(*points), **PUBLISHED)
    axes.set(xlim=(-1, 1), ylim=(0, 1), xlabel="$u$ at $(1/2, y, 1/2)$", ylabel="$y$")
    other[0].set(xlim=(0, 1), xlabel="$x$")
    other[1].set(ylim=(-1, 1), ylabel="$v$ at $(x, 1/2, 1/2)$")
    axes.grid(color="0.9")
    axes.legend(frameon=False, loc="upper left", fontsize=8)


def draw_plane(figure, axes, path, cells):
    table = np.genfromtxt(path, delimiter=",", names=True)
    x, y, u, v = (table[name].reshape(cells, cells) for name in ("x", "y", "u", "v"))
    speed = np.hypot(u, v)
    image = axes.pcolormesh(x, y, speed, cmap="viridis", shading="nearest", rasterized=True, vmin=0)
    uniform = (np.arange(cells) + 0.5) / cells
    axes.streamplot(uniform, uniform, u, v, color="white", linewidth=0.6, density=1.5, arrowsize=0.7)
    axes.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xlabel="$x$", ylabel="$y$")
    axes.set_title(f"speed and direction of $(u, v)$ at $z = 1/2$, {cells}$^3$ cells")
    figure.colorbar(image, ax=axes, fraction=0.046, pad=0.03)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="the --out of lid_cavity")
    parser.add_argument("--out", type=Path, help="the picture (default: FOLDER/lid_cavity.png)")
    arguments = parser.parse_args()
    source = arguments.folder / "lid_cavity.json"
    if not source.exists():
        parser.error(f"{source} is missing (lid_cavity --out {arguments.folder} writes it)")
    result = json.loads(source.read_text())
    cells = result["grids"][-1]["cells"]

    plt.rcParams.update(STYLE)
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5))
    draw_profiles(left, result)
    draw_plane(figure, right, arguments.folder / f"mid_plane_{cells}.csv", cells)
    figure.suptitle(f"Lid-driven cube, Re = {result['reynolds_number']:g}", fontsize=11)
    figure.tight_layout()
    target = arguments.out or arguments.folder / "lid_cavity.png"
    target.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(target)
    print(target)


if __name__ == "__main__":
    main()
