#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of docs/fluid.md from scratch: runs programs of a build, and draws what they write.

usage: draw_fluid_tour.py [BUILD] [OUT]        BUILD: build/release; OUT: docs/images/fluid. Takes five minutes.
"""
import json
import os
import subprocess
import sys
from pathlib import Path

import plot_flow
from plot_flow import np, plt

ROOT = Path(__file__).resolve().parent.parent
BLUE, VERMILLION, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#777777"
TREATMENTS = {"explicit": (VERMILLION, "^-"), "extrapolated": (BLUE, "o-"), "implicit": (GREEN, "s-")}
# Numbers of the pictures come out the same with any number of threads; one does not disturb others on the machine.
ENVIRONMENT = dict(os.environ, OMP_WAIT_POLICY="passive", OMP_NUM_THREADS="1")


def run(*command):
    print(" ".join(str(part) for part in command))
    return subprocess.run(command, check=True, capture_output=True, text=True, env=ENVIRONMENT).stdout


def flow_fields(build, folder, **options):
    """The folder that the app has written with these options, and its summary."""
    words = [word for name, value in options.items() for word in (f"--{name.replace('_', '-')}", str(value))]
    run(build / "apps/flow_fields", *words, "--out", folder)
    return json.loads((folder / "summary.json").read_text())


def plain(axes):
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=8)


def draw_cell(out):
    """A corner of the grid in a plane: where each quantity lives, and the ghosts beyond the walls."""
    figure, axes = plt.subplots(figsize=(7.6, 4.4))
    for i in range(4):
        axes.plot([i, i], [0, 2.6], color="#999999", lw=0.8, zorder=0)
    for k in range(3):
        axes.plot([0, 3.6], [k, k], color="#999999", lw=0.8, zorder=0)
    axes.plot([0, 0, 3.6], [2.6, 0, 0], color="black", lw=3, zorder=1)
    axes.annotate("walls", (0, 2.45), (-0.75, 2.5), fontsize=10, arrowprops={"arrowstyle": "-", "lw": 0.7}, va="center")

    def points(kind, offset, counts, colour, marker, label):
        inside = [(i + offset[0], k + offset[1]) for i in range(counts[0]) for k in range(counts[1])]
        ghosts = [(x + offset[0], -1 + offset[1]) for x in range(counts[0])]
        ghosts += [(-1 + offset[0], k + offset[1]) for k in range(counts[1])]
        axes.scatter(*zip(*inside), marker=marker, s=90, color=colour, zorder=3, label=label)
        axes.scatter(*zip(*ghosts), marker=marker, s=90, facecolors="white", edgecolors=colour, zorder=2)
        for i, k in ((0, 0), (0, 1), (1, 0), (1, 1)):
            x, z = i + offset[0], k + offset[1]
            axes.annotate(f"{kind}({i},{k})", (x, z), (5, 6), textcoords="offset points", fontsize=8, color=colour)

    points("p", (0.5, 0.5), (3, 2), GREY, "o", r"pressure, viscosity, div u: Field<Cell>")
    points("u", (0.0, 0.5), (4, 2), BLUE, ">", "u: Field<FaceX>")
    points("w", (0.5, 0.0), (3, 3), VERMILLION, "^", "w: Field<FaceZ>")
    axes.scatter([], [], marker="o", s=90, facecolors="white", edgecolors="black", label="ghosts: index -1 or extent")
    axes.annotate("", (1, 2.35), (2, 2.35), arrowprops={"arrowstyle": "<->", "color": "#999999", "lw": 0.7})
    axes.text(1.45, 2.4, "$h_x$", fontsize=9, color="#666666")
    axes.set_xlim(-1.35, 4.0)
    axes.set_ylim(-1.25, 2.7)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.text(3.75, 0.03, "x", fontsize=11)
    axes.text(0.03, 2.62, "z", fontsize=11)
    axes.legend(frameon=False, fontsize=8.5, loc="lower right", ncols=2, bbox_to_anchor=(1.02, -0.08))
    plot_flow.save(figure, out / "cell.png")


def draw_iterations(build, scratch, out):
    sizes, ratios = [16, 24, 32, 48, 64], {5: BLUE, 20: GREEN, 100: VERMILLION}
    cases = {
        "velocity of the implicit treatment: pcg+fft": dict(
            inertia="full", reynolds_number=0.001, treatment="implicit", velocity_solver="pcg", time_step=0.01, end=0.01
        ),
        "Stokes: velocity and pressure together": dict(inertia="none"),
    }
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.1), sharey=True)
    for axes, (title, options) in zip(panels, cases.items()):
        for ratio, colour in ratios.items():
            counts = [
                flow_fields(build, scratch / "iterations", cells=cells, ratio=ratio, **options)["iterations_of_first_step"]
                for cells in sizes
            ]
            print(title, ratio, counts)
            axes.plot(sizes, counts, "o-", color=colour, markersize=4, label=f"viscosity ratio {ratio}")
        axes.set_title(title, fontsize=10)
        axes.set_xlabel("cells along each edge", fontsize=9)
        axes.set_xticks(sizes)
        axes.set_ylim(0, 75)
        plain(axes)
    panels[0].set_ylabel("iterations from a flow at rest", fontsize=9)
    panels[1].legend(frameon=False, fontsize=8, loc="upper right", ncols=3)
    plot_flow.save(figure, out / "iterations.png")


def draw_order(build, out):
    rows = json.loads(run(build / "bench/flow_accuracy", "--json"))
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.8))
    for axes, quantity, title, lowest in zip(
        panels, ("velocity_l2", "pressure_l2"), ("velocity", "pressure"), (1e-3, 2e-3)
    ):
        for reynolds_number, colour in ((0.001, GREEN), (1, BLUE), (10, VERMILLION)):
            for ratio, style in ((1, "o-"), (20, "s--")):
                chosen = [r for r in rows if (r["reynolds_number"], r["ratio"]) == (reynolds_number, ratio)]
                cells = np.array([r["cells"] for r in chosen])
                errors = np.array([r[quantity] for r in chosen])
                order = np.log(errors[-2] / errors[-1]) / np.log(cells[-1] / cells[-2])
                label = f"Re = {reynolds_number:g}, ratio {ratio}: order {order:.2f}"
                axes.loglog(cells, errors, style, color=colour, markersize=4, label=label)
        guide = np.array([cells[0], cells[-1]])
        top = 2 * max(r[quantity] for r in rows)
        axes.loglog(guide, top * (guide[0] / guide) ** 2, ":", color=GREY)
        axes.text(20, top, "order 2", fontsize=8, color=GREY)
        axes.set_ylim(lowest, 2 * top)
        axes.set_xticks(cells, [str(c) for c in cells])
        axes.minorticks_off()
        axes.set_title(f"L2 error of the {title}", fontsize=10)
        axes.set_xlabel("cells along each edge", fontsize=9)
        axes.legend(frameon=False, fontsize=7.5, loc="lower left")
        plain(axes)
    plot_flow.save(figure, out / "order.png")


def draw_treatments(build, scratch, out):
    """Walls that swing as sin 3t, ratio 20, Re = 1: errors at t = 1 of the velocity in the middle plane."""
    options = dict(cells=24, inertia="full", reynolds_number=1, frequency=3, end=1)
    numbers = {"explicit": [8, 16, 32, 64, 128, 256], "extrapolated": [8, 16, 32, 64, 128, 256], "implicit": [8, 16, 32, 64]}
    shown = 32
    folder = scratch / "treatments"
    flow_fields(build, folder, treatment="extrapolated", time_step=1 / 2048, **options)
    exact = plot_flow.Plane(folder).velocity()

    figure = plt.figure(figsize=(11.5, 3.1))
    lines = figure.add_subplot(144)
    for place, (treatment, (colour, style)) in enumerate(TREATMENTS.items(), start=141):
        largest, table = [], []
        for n in numbers[treatment]:
            summary = flow_fields(build, folder, treatment=treatment, time_step=1 / n, **options)
            plane = plot_flow.Plane(folder)
            error = np.sqrt(((plane.velocity() - exact) ** 2).sum(axis=0))
            largest.append(error.max())
            table.append(f"1/{n}: {error.max():.1e}, {1e3 * summary['seconds_per_step'] * n:.0f} ms")
            if n == shown:
                axes = plot_flow.axes_of(figure, place, f"{treatment}, dt = 1/{shown}")
                image = plot_flow.paint(axes, plane, error, cmap="magma", vmin=0, vmax=0.35)
                plot_flow.outline(axes, plane)
        print(treatment, "; ".join(table))
        lines.loglog([1 / n for n in numbers[treatment]], largest, style, color=colour, markersize=4)
    figure.colorbar(image, ax=figure.axes[1:], shrink=0.8, label="error of the velocity", location="left", pad=0.06)
    steps = np.array([1 / 256, 1 / 24])
    lines.loglog(steps, 0.0008 * (steps / steps[0]) ** 2, ":", color=GREY)
    lines.text(1 / 110, 0.0022, "dt$^2$", fontsize=8, color=GREY)
    lines.set_xlabel("dt", fontsize=9)
    lines.set_title("largest error", fontsize=10)
    for treatment, place in (("explicit", (1 / 256, 0.3)), ("extrapolated", (1 / 256, 0.03)), ("implicit", (1 / 28, 2e-3))):
        lines.text(*place, treatment, fontsize=8, color=TREATMENTS[treatment][0])
    lines.set_ylim(5e-4, 2)
    plain(lines)
    plot_flow.save(figure, out / "treatments.png")


def main():
    build = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release").resolve()
    out = Path(sys.argv[2] if len(sys.argv) > 2 else ROOT / "docs/images/fluid")
    for program in ("apps/flow_fields", "bench/flow_accuracy"):
        if not (build / program).exists():
            sys.exit(f"{build / program} is not there. {__doc__}")
    scratch = build / "fluid_tour"
    scratch.mkdir(exist_ok=True)
    out.mkdir(parents=True, exist_ok=True)
    flow_fields(build, scratch / "ball", cells=64)
    plot_flow.draw(scratch / "ball", out / "ball_in_shear.png")
    draw_cell(out)
    draw_order(build, out)
    draw_treatments(build, scratch, out)
    draw_iterations(build, scratch, out)


if __name__ == "__main__":
    main()
