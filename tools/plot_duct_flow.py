#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Flow in rectangular ducts: a cross-section with its error against the series, and the convergence of several runs.

    duct_flow --cells 8 --refine 4 --out out/duct/periodic
    duct_flow --cells 8 --refine 3 --ends walls --out out/duct/walls
    plot_duct_flow.py out/duct/periodic out/duct/walls

The cross-section is that of the first folder's finest grid.
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

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#999999"]  # Okabe and Ito
STYLE = {"font.size": 10, "axes.titlesize": 10, "savefig.dpi": 160}


def read(folder):
    source = folder / "duct_flow.json"
    if not source.exists():
        sys.exit(f"{source} is missing (duct_flow --out {folder} writes it)")
    return json.loads(source.read_text())


def name_of(run):
    d, e = run["half_widths"]
    if run["ends"] == "periodic":
        return f"periodic, {d:g} : {e:g}"
    how = "Stokes" if run["method"] == "stokes" else f"Re = {run['reynolds_number']:g}"
    return f"walls, {d:g} : {e:g}, {how}"


def draw_section(figure, axes, folder, run):
    cells = run["grids"][-1]["cells"]
    path = folder / f"cross_section_{'x'.join(map(str, cells))}.csv"
    table = np.genfromtxt(path, delimiter=",", names=True)
    y, z, u, series = (table[name].reshape(cells[2], cells[1]) for name in ("y", "z", "u", "series"))
    image = axes.pcolormesh(y, z, 1e4 * (u - series), cmap="viridis", shading="nearest", rasterized=True)
    contours = axes.contour(y, z, u, levels=np.arange(0.1, 1, 0.1), colors="white", linewidths=0.8)
    axes.clabel(contours, contours.levels[::2], fontsize=7)
    axes.set(aspect="equal", xlabel="$y$", ylabel="$z$")
    axes.set_title(f"$u$ (contours) and its error, $10^{{-4}}$ (colours), {cells[1]} x {cells[2]} cells")
    figure.colorbar(image, ax=axes, fraction=0.046, pad=0.03)


def draw_convergence(axes, runs):
    for index, run in enumerate(runs):
        cells = np.array([grid["cells"][1] for grid in run["grids"]])
        colour = COLOURS[index % len(COLOURS)]
        marker = "osD^v<>"[index % 7]
        errors = [grid["error_l2"] for grid in run["grids"]]
        axes.loglog(cells, errors, marker + "-", color=colour, markersize=4, linewidth=1, label=name_of(run))
    ends = np.array([8, 128])
    reference = 0.25 * runs[0]["grids"][0]["error_l2"] * (8 / ends) ** 2
    axes.loglog(ends, reference, "k--", linewidth=0.8, label="slope $-2$")
    axes.set(xlabel="cells across the width", ylabel="root mean square error of $u$")
    axes.set_xticks([8, 16, 32, 64, 128], ["8", "16", "32", "64", "128"])
    axes.minorticks_off()
    axes.grid(color="0.9")
    axes.legend(frameon=False, fontsize=8)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=Path, nargs="+", help="the --out of runs of duct_flow")
    parser.add_argument("--out", type=Path, default=Path("duct_flow.png"), help="the picture")
    arguments = parser.parse_args()
    runs = [read(folder) for folder in arguments.folders]

    plt.rcParams.update(STYLE)
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6))
    draw_section(figure, left, arguments.folders[0], runs[0])
    draw_convergence(right, runs)
    figure.tight_layout()
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(arguments.out)
    print(arguments.out)


if __name__ == "__main__":
    main()
