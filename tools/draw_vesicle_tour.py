#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of docs/vesicle.md from scratch: runs the apps of a build, and draws what they write.

usage: draw_vesicle_tour.py [BUILD] [OUT]        BUILD: build/release; OUT: docs/images/vesicle. Takes two minutes.
"""
import json
import os
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import h5py
import matplotlib.pyplot as plt
import numpy as np

import plot_surface

ROOT = Path(__file__).resolve().parent.parent
FORMS = {
    ("cartesian", 2, False): ("Cartesian, 2x", plot_surface.BLUE, "o-"),
    ("christoffel", 2, False): ("Christoffel, 2x", "#009E73", "s-"),
    ("cartesian", 1, False): ("Cartesian, no upsampling", "#56B4E9", "o:"),
    ("cartesian", 2, True): ("Cartesian, 2x, truncated", "#CC79A7", "o--"),
    ("paper", 2, True): ("Eq. (14), 2x, truncated: the paper", plot_surface.VERMILLION, "^-"),
}
GALLERY = [
    ("prolate, v = 0.8", ["prolate", "--reduced-volume", "0.8"]),
    ("oblate, v = 0.8", ["oblate", "--reduced-volume", "0.8"]),
    ("ellipsoid 1:2:4", ["ellipsoid"]),
    ("biconcave disc", ["biconcave"]),
]


def run(*command):
    print(" ".join(str(part) for part in command))
    environment = dict(os.environ, OMP_WAIT_POLICY="passive")
    return subprocess.run(command, check=True, capture_output=True, text=True, env=environment).stdout


def fields(build, scratch, name, *arguments):
    run(build / "apps/surface_fields", *arguments, "--out", scratch / name)
    return plot_surface.Grid(scratch / name / "markers.csv")


def draw_quantities(build, scratch, out):
    fine = fields(build, scratch, "fine", "biconcave", "--latitudes", "72")
    plot_surface.draw_overview(fine, out / "geometry.png")
    for name in plot_surface.SCALARS:
        plot_surface.draw_scalar(fine, name, out / f"{name}.png")
    coarse = fields(build, scratch, "coarse", "biconcave", "--latitudes", "32")
    for name in plot_surface.VECTORS:
        plot_surface.draw_vectors(coarse, name, out / f"{name}.png")
    plot_surface.draw_mesh(coarse, out / "mesh.png")
    plot_surface.draw_spectrum(scratch / "coarse", out / "spectrum.png")


def draw_gallery(build, scratch, out):
    figure = plt.figure(figsize=(12, 2.9))
    for place, (title, arguments) in enumerate(GALLERY, start=141):
        grid = fields(build, scratch, arguments[0], *arguments, "--latitudes", "64")
        axes = plot_surface.add_axes(figure, grid.vector("position"), place, zoom=1.2)
        plot_surface.paint_scalar(axes, grid, "mean_curvature")
        axes.set_title(title, fontsize=11)
    plot_surface.save(figure, out / "shapes.png")


def draw_accuracy(build, out):
    rows = json.loads(run(build / "apps/geometry_accuracy", "--json"))
    figure, panels = plt.subplots(1, 2, figsize=(9.5, 3.6), sharey=True)
    for axes, surface, title in zip(panels, ("ellipsoid", "y32"), ("ellipsoid 1:2:4", r"$r = 1 + e^{-3 Y_3^2}$")):
        for (formula, upsampling, truncated), (label, colour, style) in FORMS.items():
            chosen = [
                row
                for row in rows
                if (row["surface"], row["formula"], row["upsampling"], row["truncated"])
                == (surface, formula, upsampling, truncated)
            ]
            axes.loglog(
                [row["latitudes"] for row in chosen],
                [row["error_lapH"] for row in chosen],
                style,
                color=colour,
                label=label,
                markersize=4,
            )
        axes.set_xticks([16, 32, 64, 128], ["16", "32", "64", "128"])
        axes.minorticks_off()
        axes.set(title=title, xlabel=r"latitudes $N_\theta$")
        axes.spines[["top", "right"]].set_visible(False)
    panels[0].set_ylabel(r"max error of $\Delta_\Gamma H$")
    figure.legend(*panels[1].get_legend_handles_labels(), frameon=False, fontsize=8, loc="lower center", ncols=3)
    figure.subplots_adjust(bottom=0.27)
    plot_surface.save(figure, out / "accuracy.png")


def draw_redistribution(build, scratch, out):
    """The mesh of a tank-treading vesicle of reduced volume 0.7 at t = 8, wound up and redistributed."""
    figure = plt.figure(figsize=(9, 3.2))
    titles = {"never": "t = 8, never redistributed", "when_needed": "t = 8, redistributed when needed"}
    for place, (choice, title) in enumerate(titles.items(), start=121):
        folder = scratch / f"wound_{choice}"
        scene = ROOT / "scenes/paper/deflated_tank_treading.toml"
        settings = [f"mesh.redistribute={choice}", "time.end=8", "output.fluid_every=0", "output.vesicle_every=8"]
        options = [word for setting in settings for word in ("--set", setting)]
        run(build / "apps/shear_flow", scene, "--out", folder, "--quiet", *options)
        with h5py.File(folder / "vesicle.h5") as file:
            vesicle = file["steps"][sorted(file["steps"])[-1]]["vesicle_0"]
            latitudes, longitudes = int(vesicle.attrs["latitudes"]), int(vesicle.attrs["longitudes"])
            rings = vesicle["positions"][: latitudes * longitudes].reshape(latitudes, longitudes, 3)
        rings = np.concatenate([rings, rings[:, :1]], axis=1)
        x = [rings[..., axis] for axis in range(3)]
        axes = plot_surface.add_axes(figure, x, place, zoom=1.0)
        axes.view_init(elev=12, azim=-80)
        plot_surface.paint_mesh(axes, x)
        axes.set_title(title, fontsize=11)
    plot_surface.save(figure, out / "redistribution.png")


def main():
    build = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release").resolve()
    out = Path(sys.argv[2] if len(sys.argv) > 2 else ROOT / "docs/images/vesicle")
    if not (build / "apps/surface_fields").exists():
        sys.exit(f"{build}: no apps there. {__doc__}")
    scratch = build / "vesicle_tour"
    scratch.mkdir(exist_ok=True)
    out.mkdir(parents=True, exist_ok=True)
    draw_quantities(build, scratch, out)
    draw_gallery(build, scratch, out)
    draw_accuracy(build, out)
    draw_redistribution(build, scratch, out)
    for branch, volumes in (("prolate", "0.6:1:0.02"), ("oblate", "0.52:1:0.02")):
        run(build / "apps/equilibrium_shape", "--branch", branch, "--reduced-volume", volumes, "--out", scratch / "eq")
    run(sys.executable, ROOT / "tools/plot_equilibrium.py", scratch / "eq", "--out", out / "equilibrium.png")


if __name__ == "__main__":
    main()
