#!/usr/bin/env python3
"""Pictures of a run: history.png and membrane.png from the files that docs/results.md describes.

Draws what the folder has. A run without snapshots gives the history alone; without fluid snapshots the
membranes alone.
"""
import argparse
import sys
from pathlib import Path

try:
    import matplotlib

    matplotlib.use("Agg")
    import h5py
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.collections import LineCollection, PolyCollection
except ImportError as error:
    sys.exit(f"{error}. A python that has what this needs is found by: scripts/python.sh {' '.join(sys.argv)}")

# Okabe and Ito's colours: told apart by colour-blind readers too.
BLUE, ORANGE, GREEN, VERMILLION = "#0072B2", "#E69F00", "#009E73", "#D55E00"
LINE_STYLES = ["-", "--", ":", "-."]  # one per vesicle
STYLE = {
    "font.size": 10,
    "axes.titlesize": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "savefig.dpi": 160,
}


class MissingData(Exception):
    """The run has not written what a picture needs."""


# ---- history ----


def read_diagnostics(path):
    """diagnostics.csv as one dictionary of columns per vesicle."""
    if not path.exists():
        raise MissingData(f"{path} is missing")
    table = np.genfromtxt(path, delimiter=",", names=True, ndmin=1)
    if table.dtype.names is None or table.size == 0:
        raise MissingData(f"{path} has no rows")
    vesicles = np.unique(table["vesicle"])
    return [{name: table[table["vesicle"] == v][name] for name in table.dtype.names} for v in vesicles]


def break_turns(angle):
    """The angle lives in (-90, 90]: a vesicle that turns over must not draw a line across the panel."""
    angle = angle.copy()
    angle[1:][np.abs(np.diff(angle)) > 90] = np.nan
    return angle


def draw_history(folder, target):
    histories = read_diagnostics(folder / "diagnostics.csv")
    figure, (angle, frequency, errors) = plt.subplots(
        3, 1, sharex=True, figsize=(7, 7.5), height_ratios=[1, 1, 1.4], constrained_layout=True
    )
    for v, history in enumerate(histories):
        line = {"linestyle": LINE_STYLES[v % len(LINE_STYLES)], "linewidth": 1.6}
        time = history["time"]
        angle.plot(time, break_turns(history["inclination_angle_deg"]), color=BLUE, label=f"vesicle {v}", **line)
        frequency.plot(time, history["tank_treading_frequency"], color=BLUE, **line)
        for key, name, color in [
            ("max_local_area_error", "local area, largest", ORANGE),
            ("area_error", "area", GREEN),
            ("volume_error", "volume", VERMILLION),
        ]:
            size = np.abs(history[key])
            errors.plot(time, np.where(size > 0, size, np.nan), color=color, label=None if v else name, **line)

    angle.set_ylabel("inclination angle (degrees)")
    frequency.set_ylabel("tank-treading frequency")
    frequency.set_ylim(bottom=min(0, frequency.get_ylim()[0]))
    errors.set_ylabel("size of relative error")
    errors.set_yscale("log")
    errors.set_xlabel("time (1 / shear rate)")
    errors.legend(loc="lower left", bbox_to_anchor=(0, 1), ncol=3, frameon=False, borderaxespad=0)
    if len(histories) > 1:
        angle.legend(loc="lower left", bbox_to_anchor=(0, 1), ncol=4, frameon=False, borderaxespad=0)
    for axes in (angle, frequency, errors):
        axes.grid(color="0.9")
        axes.margins(x=0)
    figure.align_ylabels()
    figure.savefig(target)


# ---- membrane ----


def open_snapshots(path):
    """The HDF5 file and the names of its steps in order."""
    if not path.exists():
        raise MissingData(f"{path} is missing (snapshots off in the scene, or a build without HDF5)")
    try:
        file = h5py.File(path, "r")
    except OSError as error:
        raise MissingData(f"{path} is not readable: {error}") from None
    steps = sorted(file.get("steps", []))
    if not steps:
        raise MissingData(f"{path} has no snapshots yet")
    return file, steps


def read_membranes(group):
    """Points, tension, and faces of every vesicle of one snapshot. Faces are the cells between the markers."""
    membranes = []
    for name in sorted((n for n in group if n.startswith("vesicle_")), key=lambda n: int(n.split("_")[1])):
        rows, columns = int(group[name].attrs["latitudes"]), int(group[name].attrs["longitudes"])
        marker = np.arange(rows * columns).reshape(rows, columns)
        # The poles follow the markers and close the first and the last row.
        north, south = rows * columns, rows * columns + 1
        marker = np.vstack([np.full(columns, north), marker, np.full(columns, south)])
        east = np.roll(marker, -1, axis=1)
        faces = np.stack([marker[:-1], marker[1:], east[1:], east[:-1]], axis=-1).reshape(-1, 4)
        membranes.append((group[name]["positions"][:], group[name]["tension"][:], faces))
    return membranes


def unit(vectors):
    vectors = np.asarray(vectors, dtype=float)
    return vectors / (np.linalg.norm(vectors, axis=-1, keepdims=True) + 1e-300)


# Seen from the side of the shear plane, a little from the right and above.
TOWARDS = unit([0.2, -0.92, 0.33])
RIGHT = unit(np.cross([0, 0, 1], TOWARDS))
VIEW = np.stack([RIGHT, np.cross(TOWARDS, RIGHT), TOWARDS])
LIGHT = unit([-0.45, 0.65, 0.62])
HALFWAY = unit(LIGHT + [0, 0, 1])


def draw_membranes(axes, membranes, colours):
    """Cells far to near, each in its tension's colour, lit from the upper left; edges are the mesh lines."""
    corners = np.concatenate([(points @ VIEW.T)[faces] for points, _, faces in membranes])
    tension = np.concatenate([values[faces].mean(axis=1) for _, values, faces in membranes])
    normal = unit(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]))
    front = np.flatnonzero(normal[:, 2] > 0)
    front = front[np.argsort(corners[front, :, 2].mean(axis=1))]

    diffuse = np.clip(normal[front] @ LIGHT, 0, 1)[:, None]
    shine = 0.15 * np.clip(normal[front] @ HALFWAY, 0, 1)[:, None] ** 30
    colour = colours.to_rgba(tension[front])[:, :3] * (0.6 + 0.45 * diffuse)
    colour = np.clip(colour + shine, 0, 1)
    axes.add_collection(
        PolyCollection(corners[front, :, :2], facecolors=colour, edgecolors=colour * 0.8, linewidths=0.35)
    )


def outline(membranes):
    """Where the membranes cross the plane y = 0: segments (count, 2 ends, x and z)."""
    segments = []
    for points, _, faces in membranes:
        for triangles in (points[faces[:, [0, 1, 2]]], points[faces[:, [0, 2, 3]]]):
            start, end = triangles, np.roll(triangles, -1, axis=1)
            cuts = (start[:, :, 1] >= 0) != (end[:, :, 1] >= 0)  # no edge of a triangle, or two
            start, end = start[cuts], end[cuts]
            fraction = start[:, 1] / (start[:, 1] - end[:, 1])
            segments.append((start + fraction[:, None] * (end - start))[:, ::2].reshape(-1, 2, 2))
    return np.concatenate(segments)


def read_slice(path, time):
    """Velocity in the plane y = 0 of the snapshot nearest in time: x, z, (nz, nx, 3), its time."""
    file, steps = open_snapshots(path)
    step = min(steps, key=lambda s: abs(file["steps"][s].attrs["time"] - time))
    lower, upper, cells = (np.asarray(file.attrs[key]) for key in ("lower", "upper", "cells"))
    width = (upper - lower) / cells
    x, y, z = (lower[d] + (np.arange(cells[d]) + 0.5) * width[d] for d in range(3))
    # Between the two cell planes around y = 0, or the one that lies on it.
    below = int(np.clip(np.searchsorted(y, 0.0, side="right") - 1, 0, len(y) - 2))
    weight = np.clip((0.0 - y[below]) / width[1], 0, 1)
    velocity = file["steps"][step]["velocity"]
    plane = (1 - weight) * velocity[:, below] + weight * velocity[:, below + 1]
    return x, z, plane, float(file["steps"][step].attrs["time"])


def draw_slice(figure, flow, membranes):
    x, z, velocity, time = flow
    # The neighbourhood of the membranes: the undisturbed flow further out would hide the small speeds inside.
    points = np.concatenate([points[:, ::2] for points, _, _ in membranes])
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    near = 1.1 * np.ptp(points, axis=0).max()
    in_x, in_z = np.abs(x - centre[0]) <= near, np.abs(z - centre[1]) <= near
    x, z, velocity = x[in_x], z[in_z], velocity[in_z][:, in_x]

    axes = figure.subplots()
    speed = np.linalg.norm(velocity, axis=-1)
    picture = axes.pcolormesh(x, z, speed, cmap="Blues", vmin=0, shading="gouraud", rasterized=True)
    lines = {"color": "0.25", "linewidth": 0.6, "density": 1.3, "arrowsize": 0.7}
    axes.streamplot(x, z, velocity[..., 0], velocity[..., 2], **lines)
    axes.add_collection(LineCollection(outline(membranes), colors=VERMILLION, linewidths=2.2, zorder=3))
    axes.set(aspect="equal", xlabel="x", ylabel="z", title=f"flow in the plane y = 0, t = {time:.3g}")
    axes.set(xlim=(x[0], x[-1]), ylim=(z[0], z[-1]))
    axes.spines[:].set_visible(False)
    figure.colorbar(picture, ax=axes, orientation="horizontal", label="speed", shrink=0.6, aspect=30)


def draw_axes_cross(axes, corner, size):
    """The directions x, y, z as seen in this view."""
    for name, direction in zip("xyz", VIEW.T[:, :2]):
        tip = corner + size * direction
        arrow = {"arrowstyle": "-|>", "color": "0.4", "lw": 0.9, "mutation_scale": 7, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", tip, corner, arrowprops=arrow)
        axes.annotate(name, tip + 0.4 * (tip - corner), ha="center", va="center", color="0.4", fontsize=9)


def draw_membrane(folder, target):
    file, steps = open_snapshots(folder / "vesicle.h5")
    chosen = list(dict.fromkeys([steps[0], steps[len(steps) // 2], steps[-1]]))
    groups = [file["steps"][step] for step in chosen]
    snapshots = [read_membranes(group) for group in groups]
    times = [float(group.attrs["time"]) for group in groups]

    try:
        flow, note = read_slice(folder / "fluid.h5", times[-1]), None
    except MissingData as missing:
        flow, note = None, f"no velocity slice: {missing}"

    widths = [2.9 * len(chosen)] + ([4] if flow else [])
    figure = plt.figure(figsize=(sum(widths), 4.2 if flow else 3.4), constrained_layout=True)
    left, *right = figure.subfigures(1, len(widths), width_ratios=widths, squeeze=False)[0]
    panels = np.atleast_1d(left.subplots(1, len(chosen)))

    tension = np.concatenate([values for snapshot in snapshots for _, values, _ in snapshot])
    low, high = np.percentile(tension, [1, 99])
    colours = plt.cm.ScalarMappable(plt.Normalize(low, high if high > low else low + 1), "YlOrBr")
    seen = np.concatenate([points @ VIEW.T[:, :2] for snapshot in snapshots for points, _, _ in snapshot])
    middle, reach = (seen.min(axis=0) + seen.max(axis=0)) / 2, 0.54 * np.ptp(seen, axis=0)
    reach = np.maximum(reach, 0.7 * reach.max())
    for axes, membranes, time in zip(panels, snapshots, times):
        draw_membranes(axes, membranes, colours)
        axes.set_aspect("equal", adjustable="datalim")  # the panel keeps its height beside the slice
        axes.set_title(f"t = {time:.3g}")
        axes.set(xlim=middle[0] + reach[0] * np.array([-1, 1]), ylim=middle[1] + reach[1] * np.array([-1, 1]))
        axes.axis("off")
    draw_axes_cross(panels[0], middle + reach * [-0.85, -0.9], 0.25 * reach[0])
    scale = {"orientation": "horizontal", "shrink": 0.4, "aspect": 40}
    left.colorbar(colours, ax=list(panels), label="membrane tension", **scale)
    if flow:
        draw_slice(right[0], flow, snapshots[-1])
    figure.savefig(target)
    return note


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="the folder of the run")
    parser.add_argument("--out", type=Path, help="where the pictures go (default: FOLDER/pictures)")
    arguments = parser.parse_args()
    if not arguments.folder.is_dir():
        parser.error(f"{arguments.folder} is not a folder")
    out = arguments.out or arguments.folder / "pictures"
    out.mkdir(parents=True, exist_ok=True)

    plt.rcParams.update(STYLE)
    drawn = 0
    for name, draw in [("history.png", draw_history), ("membrane.png", draw_membrane)]:
        try:
            note = draw(arguments.folder, out / name)
        except MissingData as missing:
            print(f"{name} not drawn: {missing}", file=sys.stderr)
            continue
        drawn += 1
        print(f"{out / name}" + (f" ({note})" if note else ""))
    return 0 if drawn else 1


if __name__ == "__main__":
    sys.exit(main())
