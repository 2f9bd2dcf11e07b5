# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The look of the figures."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402

from . import outputs  # noqa: E402

# Okabe and Ito's colours: told apart by colour-blind readers too.
BLUE, ORANGE, GREEN, VERMILLION, PURPLE, SKY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"
COLOURS = [BLUE, ORANGE, GREEN, VERMILLION, PURPLE, SKY, "0.3", "0.6"]
plt.rcParams.update({"font.size": 9, "axes.titlesize": 9, "axes.spines.top": False, "axes.spines.right": False,
                     "axes.grid": True, "grid.color": "0.92", "legend.frameon": False, "legend.fontsize": 8,
                     "figure.constrained_layout.use": True, "savefig.dpi": 96, "lines.linewidth": 1.5})


def save(figure, path):
    """A PNG of few colours, which keeps it small."""
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path)
    plt.close(figure)
    try:
        from PIL import Image
    except ImportError:
        return
    Image.open(path).convert("RGB").quantize(96).save(path, optimize=True)


def _unit(vectors):
    return vectors / (np.linalg.norm(vectors, axis=-1, keepdims=True) + 1e-300)


def view_from(direction, up=(0, 0, 1)):
    towards = _unit(np.asarray(direction, dtype=float))
    right = _unit(np.cross(up, towards))
    return np.stack([right, np.cross(towards, right), towards])


SIDE = view_from([0.0, -1.0, 0.0])  # the shear plane: x to the right, z up
LIGHT = _unit(np.array([-0.45, 0.65, 0.62]))


def membrane(axes, snapshot, view=SIDE, colour=(0.55, 0.72, 0.88), shift=(0.0, 0.0), mesh=True):
    """The cells of the mesh that are seen, far to near, lit from the upper left."""
    points = snapshot["points"] @ view.T
    corners = points[snapshot["faces"]]
    normal = _unit(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]))
    front = np.flatnonzero(normal[:, 2] > 0)
    front = front[np.argsort(corners[front, :, 2].mean(axis=1))]
    shade = 0.55 + 0.45 * np.clip(normal[front] @ LIGHT, 0, 1)[:, None]
    faces = np.clip(np.asarray(colour) * shade, 0, 1)
    edges = faces * 0.75 if mesh else faces
    axes.add_collection(PolyCollection(corners[front, :, :2] + np.asarray(shift), facecolors=faces, edgecolors=edges, linewidths=0.25))


def outline(axes, snapshot, normal=1, **style):
    axes.add_collection(LineCollection(outputs.section(snapshot, normal), **style))


def picture(axes, half_width, half_height=None, centre=(0.0, 0.0)):
    """Axes that show lengths true to scale and nothing else."""
    axes.set_aspect("equal")
    axes.set(xlim=(centre[0] - half_width, centre[0] + half_width),
             ylim=(centre[1] - (half_height or half_width), centre[1] + (half_height or half_width)))
    axes.axis("off")


def gaps(angle):
    """Angles in (-90, 90] for drawing: no line where one turns over."""
    angle = np.array(angle, dtype=float)
    angle[1:][np.abs(np.diff(angle)) > 90] = np.nan
    return angle


def figure(*arguments, **options):
    return plt.subplots(*arguments, **options)

