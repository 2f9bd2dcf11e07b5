# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""A map as a picture: a square for each run, coloured by its verdict."""

import math

import numpy as np
from harness import drawing
from harness.drawing import plt
from harness.runs import number

from . import verdicts

COLOURS = {verdicts.STABLE: "#8fd0b8", verdicts.NOISY: "#f2c14e", verdicts.BLOWN_UP: "#d55e00", verdicts.REFUSED: "0.85"}


def draw(what, cells, path):
    panels = list(dict.fromkeys(cell["panel"] for cell in cells))
    xs, ys = (list(dict.fromkeys(cell[key] for cell in cells)) for key in ("x", "y"))
    columns = min(3, len(panels))
    rows = math.ceil(len(panels) / columns)
    wide = 0.9 if isinstance(ys[0], str) else 0.0  # names of formulas
    size = columns * (1.0 + wide + 0.42 * len(xs)) + 0.2, rows * (0.9 + 0.34 * len(ys)) + 0.5
    figure, axes = drawing.figure(rows, columns, figsize=size, squeeze=False)
    for axis, panel in zip(axes.flat, panels):
        own = {(xs.index(cell["x"]), ys.index(cell["y"])): cell for cell in cells if cell["panel"] == panel}
        _squares(axis, own)
        _outline(axis, {at for at, cell in own.items() if cell["recommended"]})
        _lines(axis, what.limits(panel) + _convection(xs, ys, own), xs, ys)
        axis.set(title=panel, xlim=(-0.5, len(xs) - 0.5), ylim=(-0.5, len(ys) - 0.5), xlabel=what.x.label, ylabel="" if wide else what.y.label)
        axis.set_xticks(range(len(xs)), [str(x) for x in xs], rotation=45 if len(str(xs[-1])) > 3 else 0)
        axis.set_yticks(range(len(ys)), [f"{y:g}" if isinstance(y, (int, float)) else y for y in ys])
        axis.grid(False)
    for axis in axes.flat[len(panels):]:
        axis.axis("off")
    _legend(figure)
    drawing.save(figure, path)


def _squares(axis, own):
    for (i, j), cell in own.items():
        hatch = "////" if cell["verdict"] == verdicts.REFUSED else None
        axis.add_patch(plt.Rectangle((i - 0.5, j - 0.5), 1, 1, facecolor=COLOURS[cell["verdict"]], edgecolor="white", linewidth=0.8, hatch=hatch))
        colour = "white" if cell["verdict"] == verdicts.BLOWN_UP else "0.15"
        axis.text(i, j, _text(cell), ha="center", va="center", fontsize=6, color=colour, zorder=4)


def _text(cell):
    """The surface divergence, or when it blew up; ! where the plan warns."""
    mark = " !" if cell["warnings"] else ""
    if cell["verdict"] == verdicts.REFUSED:
        return ""
    if cell["verdict"] == verdicts.BLOWN_UP:
        return f"t {cell['time']:.2g}{mark}"
    divergence = cell["divergence"]
    return f"{divergence:.1g}{mark}" if divergence < 10 else f">10{mark}"


def _outline(axis, inside):
    """Edges of squares inside whose neighbour is not."""
    for i, j in inside:
        for (di, dj), x, y in (((-1, 0), (-0.5, -0.5), (-0.5, 0.5)), ((1, 0), (0.5, 0.5), (-0.5, 0.5)),
                               ((0, -1), (-0.5, 0.5), (-0.5, -0.5)), ((0, 1), (-0.5, 0.5), (0.5, 0.5))):
            if (i + di, j + dj) not in inside:
                axis.plot([i + v for v in x], [j + v for v in y], color="black", linewidth=1.8, solid_capstyle="round", clip_on=False)


def _position(value, values):
    """Where a value lies among the squares, by its logarithm, beyond the ends too."""
    known, at = [math.log(number(v)) for v in values], list(range(len(values)))
    if known[0] > known[-1]:
        known, at = known[::-1], at[::-1]
    slope, far = (known[-1] - known[0]) / (len(known) - 1), 3 * (at[-1] - at[0]) / (len(at) - 1)
    return float(np.interp(math.log(value), [known[0] - 3 * slope, *known, known[-1] + 3 * slope], [at[0] - far, *at, at[-1] + far]))


def _lines(axis, limits, xs, ys):
    for label, x, y in limits:
        path_x, path_y = (np.exp(np.linspace(np.log(v[:-1]), np.log(v[1:]), 50, axis=-1)).ravel() for v in (x, y))
        at_x, at_y = [_position(v, xs) for v in path_x], [_position(v, ys) for v in path_y]
        axis.plot(at_x, at_y, "--", color=drawing.BLUE, linewidth=1.2)
        seen = [k for k, (p, q) in enumerate(zip(at_x, at_y)) if 0 <= p <= len(xs) - 1.4 and 0 <= q <= len(ys) - 0.6]
        if label and seen:
            k = seen[len(seen) // 2]
            axis.text(at_x[k], at_y[k] + 0.5, label, fontsize=6, color=drawing.BLUE, ha="center", va="center", zorder=5,
                      bbox={"facecolor": "white", "alpha": 0.7, "edgecolor": "none", "pad": 0.8})


def _convection(xs, ys, own):
    """The longest stable step by the plan, where there is one."""
    limit = {}
    for (i, j), cell in own.items():
        if cell["convection"]:
            limit[j] = cell["convection"]
    if len(limit) < 2:
        return []
    rows = sorted(limit)
    return [("convection", [limit[j] for j in rows], [number(ys[j]) for j in rows])]


def _legend(figure):
    handles = [plt.Rectangle((0, 0), 1, 1, facecolor=colour, hatch="////" if kind == verdicts.REFUSED else None, edgecolor="white", label=kind)
               for kind, colour in COLOURS.items()]
    handles.append(plt.Line2D([], [], color="black", linewidth=1.8, label="recommended"))
    handles.append(plt.Line2D([], [], color=drawing.BLUE, linestyle="--", label="limit by theory"))
    handles.append(plt.Line2D([], [], linestyle="none", label="numbers: surface divergence, or when it blew up; ! the plan warns"))
    below = 0.35 / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, below, 1, 1 - below))
    figure.legend(handles=handles, loc="lower center", ncols=4 if figure.get_figwidth() < 9 else 7, fontsize=6.5)
