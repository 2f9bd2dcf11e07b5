# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""membrane.png: the membranes of a run in a few moments, coloured by their tension, and the flow around them."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import animation
from matplotlib.collections import LineCollection, PolyCollection

from . import plot_history
from .errors import MissingData
from .plot_smooth import smooth

GREY, ORANGE = "0.35", "#D55E00"
ROWS = 128  # of cells from pole to pole that a membrane is drawn with, where it is alone: too small to be seen


def unit(vectors):
    vectors = np.asarray(vectors, dtype=float)
    return vectors / (np.linalg.norm(vectors, axis=-1, keepdims=True) + 1e-300)


# Seen from the side of the shear plane, a little from the right and above.
TOWARDS = unit([0.2, -0.92, 0.33])
RIGHT = unit(np.cross([0, 0, 1], TOWARDS))
VIEW = np.stack([RIGHT, np.cross(TOWARDS, RIGHT), TOWARDS])
LIGHT = unit([-0.45, 0.65, 0.62])
HALFWAY = unit(LIGHT + [0, 0, 1])


# ---- where things are ----


def place(membranes, box):
    """As whole vesicles inside the box: those that left through a periodic end come back through the other, and mirror images join."""
    if box is None:
        return membranes
    lower, upper, periodic, mirror = box
    placed = []
    for points, tension, faces in membranes:
        turns = np.where(periodic, np.floor((points.mean(axis=0) - lower) / (upper - lower)), 0)
        placed.append((points - turns * (upper - lower), tension, faces))
    for axis in np.flatnonzero(mirror):
        apart = [m for m in placed if m[0][:, axis].min() > lower[axis]]
        flip = np.where(np.arange(3) == axis, -1.0, 1.0)
        placed += [(points * flip + 2 * lower * (np.arange(3) == axis), tension, faces[:, ::-1]) for points, tension, faces in apart]
    return placed


def whole_box(box):
    """Lower and upper corner of the box with its mirror images."""
    lower, upper, _, mirror = box
    return np.where(mirror, 2 * lower - upper, lower), upper


def _edges(box):
    """Edges of the whole box as seen: (12, 2 ends, 2)."""
    lower, upper = whole_box(box)
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    pairs = [(a, b) for a in range(8) for b in range(a) if np.abs(corners[a] - corners[b]).sum() == 1]
    return ((lower + corners * (upper - lower)) @ VIEW.T[:, :2])[np.array(pairs)]


def frames(run, snapshots, box):
    """Centres (count, 2) and half the size (2) of the panels, and whether the box is in them: one scale, one place where that leaves
    the vesicles large enough, else the panels go along with them."""
    seen = [np.concatenate([points @ VIEW.T[:, :2] for points, _, _ in membranes]) for membranes in snapshots]
    least, most = np.array([s.min(axis=0) for s in seen]), np.array([s.max(axis=0) for s in seen])
    size, together = (most - least).max(axis=0), most.max(axis=0) - least.min(axis=0)
    if box is not None:
        edges = _edges(box).reshape(-1, 2)
        # Walls matter to what sinks and to what a channel guides; elsewhere the box is drawn where the vesicles fill it.
        walled = np.any(run.parameter("gravity.acceleration", [0])) or run.parameter("flow.type") in ("plane_poiseuille", "duct")
        if np.all(np.ptp(edges, axis=0) < (4 if walled else 1.7) * np.maximum(together, together.max() / 2)):
            corners = np.concatenate([edges, least, most])
            return np.tile((corners.min(axis=0) + corners.max(axis=0)) / 2, (len(seen), 1)), 0.53 * np.ptp(corners, axis=0), True
    if np.all(together < 2 * size.max()):
        return np.tile((least.min(axis=0) + most.max(axis=0)) / 2, (len(seen), 1)), _roomy(together), False
    return (least + most) / 2, _roomy(size), False


def _roomy(size):
    return 0.56 * np.maximum(size, 0.6 * size.max())


# ---- membranes ----


def _facets(points, tension, faces):
    """Corners (count, 4, 3), outward normals (count, 3) and tension (count) of the cells of a mesh: normals are means of those of the
    vertices, so that light does not show the cells."""
    corners = points[faces]
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    of_vertex = np.zeros_like(points)
    for corner in range(4):
        np.add.at(of_vertex, faces[:, corner], normals)
    return corners, unit(unit(of_vertex)[faces].mean(axis=1)), tension[faces].mean(axis=1)


def draw_membranes(axes, membranes, colours):
    """Facets far to near, each in its tension's colour, lit from the upper left."""
    rows = ROWS if len(membranes) == 1 else ROWS // 2 if len(membranes) <= 8 else ROWS // 4
    corners, normals, tension = (np.concatenate(part) for part in zip(*(_facets(*smooth(m, rows)) for m in membranes)))
    corners, normals = corners @ VIEW.T, normals @ VIEW.T
    front = np.flatnonzero(normals[:, 2] > -0.1)
    front = front[np.argsort(corners[front, :, 2].mean(axis=1))]
    diffuse = np.clip(normals[front] @ LIGHT, 0, 1)[:, None]
    shine = 0.12 * np.clip(normals[front] @ HALFWAY, 0, 1)[:, None] ** 30
    colour = np.clip(colours.to_rgba(tension[front])[:, :3] * (0.55 + 0.48 * diffuse) + shine, 0, 1)
    axes.add_collection(PolyCollection(corners[front, :, :2], facecolors=colour, edgecolors=colour, linewidths=0.3, rasterized=True))


def tension_colours(snapshots):
    """White where there is no tension, red where the membrane is pulled, blue where it is pushed; the least and the largest shown."""
    tension = np.concatenate([values for membranes in snapshots for _, values, _ in membranes])
    low, high = np.percentile(tension, [0.5, 99.5])
    largest = max(abs(low), abs(high))
    if largest < 1e-9:  # nothing but round-off
        low, high, largest = -1, 1, 1
    darkest = 1.3 * largest  # the ends of the map are too dark to show what the light does
    return plt.cm.ScalarMappable(plt.Normalize(-darkest, darkest), "RdBu_r"), min(low, 0), max(high, 0)


def _draw_compass(figure):
    """The directions x, y, z as seen in this view, in the lower left corner."""
    size = 0.7 / figure.bbox.width * figure.dpi, 0.7 / figure.bbox.height * figure.dpi
    axes = figure.add_axes([0, 0.02, *size])
    axes.set(xlim=(-0.4, 1.5), ylim=(-0.4, 1.5), aspect="equal")
    axes.axis("off")
    for name, direction in zip("xyz", VIEW.T[:, :2]):
        arrow = {"arrowstyle": "-|>", "color": GREY, "lw": 0.9, "mutation_scale": 7, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", direction, (0, 0), arrowprops=arrow)
        axes.annotate(name, 1.3 * direction, ha="center", va="center", color=GREY, fontsize=8)


def _draw_scale(axes, centre, reach):
    """The length of one radius, below the lower right corner of a panel."""
    end, height = centre[0] + reach[0], centre[1] - 1.02 * reach[1]
    axes.plot([end - 1, end], [height, height], color=GREY, linewidth=2, clip_on=False)
    axes.annotate("1 r", (end - 0.5, height), xytext=(0, 2), textcoords="offset points", ha="center", color=GREY, fontsize=8, annotation_clip=False)


def _draw_panels(figure, run, snapshots, times, box):
    centres, reach, boxed = frames(run, snapshots, box)
    stacked = len(snapshots) > 1 and reach[0] > 1.7 * reach[1]
    panels = np.atleast_1d(figure.subplots(*((len(snapshots), 1) if stacked else (1, len(snapshots)))))
    colours, low, high = tension_colours(snapshots)
    for axes, membranes, time, centre in zip(panels, snapshots, times, centres):
        if boxed:
            axes.add_collection(LineCollection(_edges(box), colors="0.75", linewidths=0.7, zorder=0))
        draw_membranes(axes, membranes, colours)
        axes.set_aspect("equal")
        axes.set_title(f"t = {time:.3g}", fontsize=10)
        axes.set(xlim=centre[0] + reach[0] * np.array([-1, 1]), ylim=centre[1] + reach[1] * np.array([-1, 1]))
        axes.axis("off")
    _draw_compass(figure)
    _draw_scale(panels[-1], centres[-1], reach)
    bar = figure.colorbar(colours, ax=list(panels), orientation="horizontal", shrink=0.6, aspect=40)
    bar.ax.set_xlim(low, high)
    bar.set_label("membrane tension (viscosity × r / time): red, above 0, is pulled; blue, below 0, is pushed together", fontsize=8)
    if not np.allclose(centres, centres[0]):
        return "panels go along with the vesicles, at one scale"
    return None


# ---- flow ----


def outline(membranes, y):
    """Where the membranes cross a plane of constant y: segments (count, 2 ends, x and z)."""
    segments = []
    for points, _, faces in membranes:
        for triangles in (points[faces[:, [0, 1, 2]]], points[faces[:, [0, 2, 3]]]):
            start, end = triangles, np.roll(triangles, -1, axis=1)
            cuts = (start[:, :, 1] >= y) != (end[:, :, 1] >= y)  # no edge of a triangle, or two
            start, end = start[cuts], end[cuts]
            fraction = (start[:, 1] - y) / (start[:, 1] - end[:, 1])
            segments.append((start + fraction[:, None] * (end - start))[:, ::2].reshape(-1, 2, 2))
    return np.concatenate(segments)


def plane_of(membranes):
    """The y of a centroid whose plane cuts most vesicles, the nearest to 0 of them."""
    centres = [float(points[:, 1].mean()) for points, _, _ in membranes]
    def cut(y):
        return sum(points[:, 1].min() < y < points[:, 1].max() for points, _, _ in membranes)
    best = max(centres, key=lambda y: (cut(y), -abs(y)))
    return 0.0 if abs(best) < 1e-6 or cut(0.0) >= cut(best) else best


def _slice(run, number, y, box):
    """Velocity in the plane of that y: x, z, (nz, nx, 3), with mirror images and, along a periodic x, the boxes beside."""
    (x, ys, z), velocity = run.fluid(number)
    below = int(np.clip(np.searchsorted(ys, y, side="right") - 1, 0, len(ys) - 2))
    weight = np.clip((y - ys[below]) / (ys[1] - ys[0]), 0, 1)
    plane = (1 - weight) * velocity[:, below] + weight * velocity[:, below + 1]
    lower, upper, periodic, mirror = box if box else (None, None, [False] * 3, [False] * 3)
    if mirror[0]:
        x, plane = np.concatenate([2 * lower[0] - x[::-1], x]), np.concatenate([plane[:, ::-1] * [-1, 1, 1], plane], axis=1)
    if mirror[2]:
        z, plane = np.concatenate([2 * lower[2] - z[::-1], z]), np.concatenate([plane[::-1] * [1, 1, -1], plane])
    if periodic[0]:
        x, plane = np.concatenate([x + k * (upper[0] - lower[0]) for k in (-1, 0, 1)]), np.concatenate([plane] * 3, axis=1)
    return x, z, plane


def _draw_slice(figure, run, box):
    """The flow of the last fluid snapshot around the membranes of the nearest one of theirs."""
    number = len(run.fluid_times()) - 1
    time = run.fluid_times()[number]
    times = run.membrane_times()
    nearest = int(np.argmin(np.abs(times - time)))
    membranes = place(run.membranes(nearest), box)
    y = plane_of(membranes)
    x, z, velocity = _slice(run, number, y, box)
    # The neighbourhood of the membranes: the undisturbed flow further out would hide the small speeds inside.
    points = np.concatenate([points[:, ::2] for points, _, _ in membranes])
    centre, near = (points.min(axis=0) + points.max(axis=0)) / 2, 0.5 * np.ptp(points, axis=0) + 0.6 * min(np.ptp(points, axis=0).max(), 3)
    in_x, in_z = np.abs(x - centre[0]) <= near[0], np.abs(z - centre[1]) <= near[1]
    x, z, velocity = x[in_x], z[in_z], velocity[in_z][:, in_x]
    axes = figure.subplots()
    picture = axes.pcolormesh(x, z, np.linalg.norm(velocity, axis=-1), cmap="Blues", vmin=0, shading="gouraud", rasterized=True)
    if np.any(velocity[..., ::2]):
        axes.streamplot(x, z, velocity[..., 0], velocity[..., 2], color="0.25", linewidth=0.6, density=1.3, arrowsize=0.7)
    axes.add_collection(LineCollection(outline([smooth(m, 64) for m in membranes], y), colors=ORANGE, linewidths=2.2, zorder=3))
    axes.set(aspect="equal", xlabel="x / r", ylabel="z / r", xlim=(x[0], x[-1]), ylim=(z[0], z[-1]))
    late = "" if abs(times[nearest] - time) < 1e-9 else f", membranes at t = {times[nearest]:.3g}"
    axes.set_title(f"flow in the plane y = {y:.3g}, t = {time:.3g}{late}", fontsize=10)
    axes.spines[:].set_visible(False)
    figure.colorbar(picture, ax=axes, orientation="horizontal", label="speed (r / time)", shrink=0.7, aspect=30)
    return (x[-1] - x[0]) / (z[-1] - z[0])


# ---- the picture ----


def _layout(run, snapshots, box, flow):
    """Width of the membranes' and of the flow's part, and the height, in inches."""
    _, reach, _ = frames(run, snapshots, box)
    aspect = reach[0] / reach[1]
    if aspect > 1.7 and len(snapshots) > 1:
        width = 7.0
        height = len(snapshots) * (width / aspect + 0.3) + 1.4
    else:
        panel = np.clip(3.6 / aspect, 2.4, 5.0)  # height of a panel
        width, height = max(len(snapshots) * panel * aspect, 4.0), panel + 1.7
    return width, (4.2 if flow else 0), max(height, 4.6 if flow else 0)


def draw(run):
    """The figure, and a note on what it leaves out or None."""
    times, box = run.membrane_times(), run.box()
    chosen = sorted({0, len(times) // 2, len(times) - 1})
    snapshots = [place(run.membranes(number), box) for number in chosen]
    try:
        run.fluid_times()
        flow, notes = True, []
    except MissingData as missing:
        flow, notes = False, [f"no flow: {missing}"]
    left_width, right_width, height = _layout(run, snapshots, box, flow)
    figure = plt.figure(figsize=(left_width + right_width, height), constrained_layout=True)
    parts = figure.subfigures(1, 2 if flow else 1, width_ratios=[left_width, right_width][: 2 if flow else 1], squeeze=False)[0]
    said = [_draw_panels(parts[0], run, snapshots, times[chosen], box)]
    if flow:
        _draw_slice(parts[1], run, box)
    if box and any(box[3]):
        said.append("with the half that symmetry gives: " + ", ".join(f"mirror {axis} = {box[0][d]:g}" for d, axis in enumerate("xyz") if box[3][d]))
    if box and any(box[2]):
        said.append("the box repeats along " + " and ".join(axis for d, axis in enumerate("xyz") if box[2][d]))
    plot_history.label(figure, run, said)
    return figure, "; ".join(notes) or None


# ---- the animation ----


def animate(run, folder, frames_per_second=12):
    """Writes membrane.mp4 of all snapshots, one view and one scale, or membrane.gif where there is no ffmpeg; returns its path."""
    times, box = run.membrane_times(), run.box()
    snapshots = [place(run.membranes(number), box) for number in range(len(times))]
    centres, reach, boxed = frames(run, snapshots, box)
    colours, _, _ = tension_colours(snapshots)
    height = 4.5
    figure = plt.figure(figsize=(height * float(np.clip(reach[0] / reach[1], 0.5, 2.5)), height), dpi=120)
    axes = figure.add_axes([0, 0, 1, 0.93])

    def show(number):
        axes.clear()
        if boxed:
            axes.add_collection(LineCollection(_edges(box), colors="0.75", linewidths=0.7, zorder=0))
        draw_membranes(axes, snapshots[number], colours)
        centre = centres[number]
        axes.set(aspect="equal", xlim=centre[0] + reach[0] * np.array([-1, 1]), ylim=centre[1] + reach[1] * np.array([-1, 1]))
        axes.set_title(f"t = {times[number]:.2f}", fontsize=10)
        axes.axis("off")

    movie = animation.FuncAnimation(figure, show, frames=len(times), init_func=lambda: None)
    has_ffmpeg = animation.writers.is_available("ffmpeg")
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / ("membrane.mp4" if has_ffmpeg else "membrane.gif")
    writer = animation.FFMpegWriter(frames_per_second) if has_ffmpeg else animation.PillowWriter(frames_per_second)
    movie.save(path, writer=writer)
    plt.close(figure)
    return path
