# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""history.png: what diagnostics.csv says about a run, against time."""

import dataclasses
import textwrap
from typing import Callable

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import NullFormatter

from . import plot_references

# Okabe and Ito's colours: told apart by colour-blind readers too, and by their line styles in print.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#B0A000"]
LINE_STYLES = ["-", "--", ":", "-."]
FEW = 4  # vesicles of which each final value is written
MANY = 8  # vesicles beyond which curves give way to their mean and range
ROUND_OFF = 1e-10  # relative errors below it are those of adding up
GREY = "0.35"


@dataclasses.dataclass
class Quantity:
    """A panel: `of` takes the columns of a vesicle, `span` is the least height of the axis, so that round-off stays flat, `unit` follows
    numbers, `axis` says it beside the axis."""

    key: str
    label: str
    of: Callable
    span: float
    axis: str = ""
    unit: str = ""
    angle: bool = False


def _column(name):
    return lambda course: course[name]


def _velocity_along(direction):
    def of(course):
        if len(course["time"]) < 2:
            return np.full(len(course["time"]), np.nan)
        position = sum(d * course[f"centroid_{axis}"] for d, axis in zip(direction, "xyz"))
        return np.gradient(position, course["time"])

    return of


INCLINATION = Quantity("inclination", "inclination angle", _column("inclination_angle_deg"), 2.0, "degrees", "°", angle=True)
FREQUENCY = Quantity("frequency", "tank-treading frequency", _column("tank_treading_frequency"), 0.02, "1 / time")
DEFORMATION = Quantity("deformation", "deformation (L - S)/(L + S)", _column("deformation"), 0.01)
ENERGY = Quantity("energy", "bending energy", _column("bending_energy"), 0.1, "$\\int H^2 dA\\,/\\,2$")
DISTANCE = Quantity("distance", "least distance to another vesicle", lambda course: course.get("min_distance"), 0.02, "radii", " r")
HEIGHT = Quantity("height", "height z of the centroid", _column("centroid_z"), 0.02, "radii", " r")


def panels(run, courses):
    """What is worth a panel depends on what drives the vesicles."""
    flow = run.parameter("flow.type", "shear")
    gravity = np.array(run.parameter("gravity.acceleration", [0, 0, 0]), dtype=float)
    chosen = [INCLINATION, FREQUENCY]
    if np.any(gravity) and any(run.parameter(f"vesicles.{v}.density_difference", 0) for v in range(len(courses))):
        along = gravity / np.linalg.norm(gravity)
        chosen = [Quantity("settling", "velocity along gravity", _velocity_along(along), 0.01, "radii / time"), INCLINATION]
    elif flow == "rest":
        chosen = [ENERGY, DEFORMATION]
    elif flow == "extension":
        chosen = [INCLINATION, DEFORMATION]
    elif flow in ("plane_poiseuille", "duct"):
        chosen = [HEIGHT, INCLINATION, FREQUENCY]
    if len(courses) > 1:
        chosen.append(DISTANCE)
    return [q for q in chosen if any(_defined(q.of(course)) for course in courses)]


def _defined(values):
    return values is not None and np.any(np.isfinite(values))


def _break_turns(angle):
    """The angle lives in (-90, 90]: a vesicle that turns over must not draw a line across the panel."""
    angle = np.array(angle, dtype=float)
    angle[1:][np.abs(np.diff(angle)) > 90] = np.nan
    return angle


def half_turn(time, angle):
    """Time between the last two crossings of the flow's direction by an axis that tumbles; None where it does not."""
    if not np.all(np.isfinite(angle)):
        return None
    turned = -np.unwrap(angle, period=180)  # grows where the flow turns it as shear does
    levels = 180 * np.arange(np.ceil(turned.min() / 180), np.floor(turned.max() / 180) + 1)
    if len(levels) < 2 or np.any(np.diff(turned) <= 0):
        return None
    return float(np.ptp(np.interp(levels[-2:], turned, time)))


def mean_and_range(values, angle):
    """Over vesicles (count, times): mean, least, largest; of angles around the mean axis, as 89 and -89 degrees are near."""
    if not angle:
        return np.nanmean(values, axis=0), np.nanmin(values, axis=0), np.nanmax(values, axis=0)
    mean = 0.5 * np.degrees(np.angle(np.nanmean(np.exp(2j * np.radians(values)), axis=0)))
    away = (values - mean + 90) % 180 - 90
    mean = _break_turns(mean)
    return mean, mean + np.nanmin(away, axis=0), mean + np.nanmax(away, axis=0)


def _number(value, unit=""):
    """Three digits; what is nothing but round-off is 0."""
    return (f"{value:#.3g}".rstrip(".") if abs(value) >= 1e-9 else "0") + unit


def _final(values, quantity):
    """The last values in words."""
    last = [v[-1] for v in values if np.isfinite(v[-1])]
    if not last:
        return "not defined at the end"
    if len(last) <= FEW and not len({_number(value) for value in last}) == 1:
        return ", ".join(_number(value) for value in last) + f"{quantity.unit} at the end"
    mean, least, largest = (float(v[0]) for v in mean_and_range(np.array(last)[:, None], quantity.angle))
    if _number(least) == _number(largest):
        return f"{_number(mean, quantity.unit)} at the end"
    return f"{_number(least)} to {_number(largest, quantity.unit)} at the end, mean {_number(mean, quantity.unit)}"


def _line_of(v, rows):
    """One row is a point."""
    style = {"color": COLOURS[v % len(COLOURS)], "linestyle": LINE_STYLES[v % len(LINE_STYLES)], "linewidth": 1.6}
    return style | ({"marker": "o"} if rows < 2 else {})


def _draw_quantity(axes, quantity, courses, references):
    time = courses[0]["time"]
    values = [quantity.of(course) for course in courses]
    if len(values) > MANY:
        with np.errstate(all="ignore"):
            mean, least, largest = mean_and_range(np.array(values), quantity.angle)
        axes.fill_between(time, least, largest, color=COLOURS[0], alpha=0.2, linewidth=0)
        axes.plot(time, mean, color=COLOURS[0], linewidth=1.8)
    else:
        for v, value in enumerate(values):
            axes.plot(time, _break_turns(value) if quantity.angle else value, label=f"vesicle {v}", **_line_of(v, len(time)))
    said = [f"{quantity.label}: {_final(values, quantity)}"]
    if quantity.angle and len(values) == 1 and (half := half_turn(time, values[0])):
        said.append(f"half a turn took {_number(half)}")
    for value, text in references:
        if value is None:
            said.append(text)
            continue
        axes.axhline(value, color=GREY, linewidth=1.0, dashes=(6, 3))
        axes.annotate(_number(value, quantity.unit), (1, value), xycoords=("axes fraction", "data"), xytext=(3, 0), textcoords="offset points",
                      color=GREY, va="center", fontsize=8)
        said.append(f"{text} {_number(value, quantity.unit)}")
    axes.set_title("; ".join(said), loc="left")
    axes.set_ylabel(quantity.axis)
    low, high = axes.get_ylim()
    if high - low < quantity.span:
        axes.set_ylim((low + high - quantity.span) / 2, (low + high + quantity.span) / 2)
    axes.ticklabel_format(axis="y", useOffset=False)


ERRORS = [("max_local_area_error", "local area, largest", 0), ("area_error", "area", 1), ("volume_error", "volume", 2)]


def _draw_errors(axes, courses):
    """The largest over the vesicles; what is round-off is said and not drawn."""
    time, kept = courses[0]["time"], []
    for key, name, style in ERRORS:
        size = np.max([np.abs(course[key]) for course in courses], axis=0)
        if not np.nanmax(size, initial=0) > ROUND_OFF:
            kept.append(name)
            continue
        axes.plot(time, np.where(size > ROUND_OFF, size, np.nan), label=f"{name}, {size[-1]:.1e} at the end", **_line_of(style, len(time)))
    said = "relative errors" + (f"; {' and '.join(kept)}: round-off, below {ROUND_OFF:g}" if kept else "")
    axes.set_title(said, loc="left")
    if len(kept) == len(ERRORS):
        axes.set(yticks=[], ylim=(0, 1))
        return
    axes.set_yscale("log")
    axes.yaxis.set_minor_formatter(NullFormatter())
    shown = np.concatenate([line.get_ydata() for line in axes.lines])
    axes.set_ylim(10 ** np.floor(np.log10(np.nanmin(shown))), 10 ** np.ceil(np.log10(np.nanmax(shown)) + 0.05))
    axes.legend(frameon=False, fontsize=8)


def time_label(run):
    sheared = run.parameter("flow.type", "shear") in ("shear", "oscillating_shear") and run.parameter("flow.rate", 1) == 1
    return "time (1 / shear rate)" if sheared else "time (in units of the scene, docs/scene.md)"


def state(run):
    """Where the run stands, in a few words."""
    status, time, end = run.summary.get("status"), run.summary.get("time"), run.parameter("time.end")
    if status is None:
        return "state not known: summary.json is missing or not readable"
    if status == "completed":
        return f"completed at t = {time:g}"
    if status == "running":
        return f"under way, or killed: t = {time:g} of {end:g} at its last checkpoint"
    reason = run.summary.get("stop_reason")  # its first line says step, time and cause
    return textwrap.shorten(reason.splitlines()[0], 150) if reason else f"{status} at t = {time:g} of {end:g}"


def settings(run):
    """How it was computed, and how it went, in a line."""
    about = []
    if run.parameter("domain.cells"):
        step = run.parameter("time.step")
        even = abs(round(1 / step) * step - 1) < 1e-6
        about = ["×".join(map(str, run.parameter("domain.cells"))) + " cells", f"{run.parameter('mesh.latitudes')} latitudes",
                 f"steps of 1/{round(1 / step)}" if even else f"steps of {step:g}"]
    return ", ".join([*about, state(run)])


def label(figure, run, notes=()):
    """What was computed on top, how, how it went and what is to be noted at the bottom."""
    title = run.parameter("title") or run.folder.resolve().name
    figure.suptitle(title.replace("^3", "³"), fontsize=12)
    width = int(16 * figure.get_figwidth())
    lines = [textwrap.fill(line, width) for line in (settings(run), "; ".join(note for note in notes if note)) if line]
    figure.supxlabel("\n".join(lines), fontsize=8, color=GREY)


def draw(run):
    """The figure, and None: nothing is to be said about it."""
    courses = run.diagnostics()
    chosen = panels(run, courses)
    figure, axes = plt.subplots(len(chosen) + 1, 1, sharex=True, figsize=(7.5, 1.9 * len(chosen) + 2.9), constrained_layout=True, squeeze=False)
    axes = axes[:, 0]
    references = plot_references.of(run, courses)
    for panel, quantity in zip(axes, chosen):
        _draw_quantity(panel, quantity, courses, references.get(quantity.key, []))
    _draw_errors(axes[-1], courses)
    for panel in axes:
        panel.grid(color="0.9")
        if len(courses[0]["time"]) > 1:
            panel.set_xlim(courses[0]["time"][0], courses[0]["time"][-1])
    axes[-1].set_xlabel(time_label(run))
    if 1 < len(courses) <= MANY and chosen:
        axes[0].legend(loc="upper left", bbox_to_anchor=(1.1, 1), borderaxespad=0, frameon=False, fontsize=8)
    label(figure, run, [f"curves are means of {len(courses)} vesicles, bands go from the least to the largest"] if len(courses) > MANY else [])
    return figure, None
