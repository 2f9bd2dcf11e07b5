# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Long runs: whether noise grows, area and volume drift, and a periodic motion stays so."""

import math

import numpy as np
from harness import drawing, outputs, shear
from harness.runs import Run
from harness.tables import table

from . import maps, verdicts

FOLLOWING = {"time.step": "1/24", "membrane.sigma0": 2000}
EXPLICIT = {"time.markers": "euler", "time.step": "1/192", "membrane.sigma0": 600}
TUMBLING = maps.ROOMY | {"fluid.viscosity_ratio": 30, "time.step": "1/48", "membrane.sigma0": 2000}
RUNS = {  # name: end, quick end, keys
    "shape_following": (100, 20, FOLLOWING),
    "implicit": (100, 10, FOLLOWING | {"time.markers": "implicit"}),
    "euler": (100, 10, EXPLICIT),
    "euler, preset paper": (100, 10, EXPLICIT | {"method.preset": "paper"}),
    "ratio 5": (100, 20, FOLLOWING | {"fluid.viscosity_ratio": 5}),
    "Re = 1": (100, 20, FOLLOWING | {"fluid.reynolds_number": 1}),
    "thickness correction": (100, 20, FOLLOWING | {"coupling.thickness_correction": True}),
    "reduced volume 0.7": (100, 20, maps.ROOMY | FOLLOWING | {"vesicles.0.reduced_volume": 0.7}),
    "tumbling, ratio 30": (220, 20, TUMBLING),
    "at rest": (100, 20, FOLLOWING | {"flow.type": "rest"}),
}
SHARP = FOLLOWING | maps.SHARP | {"fluid.inertia": "none"}
SHARP_RUNS = {
    "no inertia": (100, 20, SHARP),
    "ratio 5": (100, 20, SHARP | {"fluid.viscosity_ratio": 5}),
    "Re = 1": (100, 20, FOLLOWING | maps.SHARP | {"fluid.reynolds_number": 1}),
    "Re = 1, ratio 5": (100, 20, FOLLOWING | maps.SHARP | {"fluid.reynolds_number": 1, "fluid.viscosity_ratio": 5}),
    "reduced volume 0.7": (100, 20, maps.ROOMY | SHARP | {"vesicles.0.reduced_volume": 0.7}),
    "reduced volume 0.65": (100, 20, maps.ROOMY | SHARP | {"vesicles.0.reduced_volume": 0.65}),
    "Ca = 0.1": (100, 20, SHARP | {"membrane.capillary_number": 0.1}),
}
# By name: title and runs.
ALL = {"long": ("long runs", RUNS), "sharp_long": ("sharp membranes: long runs", SHARP_RUNS)}


def runs_of(of_map, quick):
    # Without walls at the ends of the flow, from which the centre would not be a stable place (docs/stability.md#long-runs).
    common = maps.SMALL | {"domain.periodic": [True, False, False], "output.diagnostics_every": 0.25, "output.checkpoint_every": 10}
    return {name: Run(name, maps.SCENE, common | keys | {"time.end": quick_end if quick else end}, store=maps.STORE)
            for name, (end, quick_end, keys) in ALL[of_map][1].items()}


def slope(time, values):
    good = np.isfinite(values)
    return float(np.polyfit(time[good], values[good], 1)[0]) if good.sum() > 3 else math.nan


def measures(folder):
    """Rates over the second half of the run."""
    summary, course = outputs.summary(folder), outputs.course(folder)
    time = course["time"]
    half = time >= 0.5 * time[-1]
    angle = outputs.unwrapped(course["inclination_angle_deg"])
    turns = shear.half_turns(course)
    column = lambda name: course[name][half]  # noqa: E731
    return {
        "status": summary["status"], "time": summary["time"], "reason": verdicts.cause(summary["stop_reason"]),
        "divergence": float(np.nanmax(column("surface_divergence_max"))),
        "growth": verdicts.growth_rate(time[half], column("surface_divergence_max")),
        "area_error": float(course["area_error"][-1]), "area_drift": slope(time[half], column("area_error")),
        "volume_error": float(course["volume_error"][-1]), "volume_drift": slope(time[half], column("volume_error")),
        "angle": float(angle[-1]), "angle_drift": slope(time[half], angle[half]) if len(turns) < 2 else math.nan,
        "local_area": float(np.nanmax(column("max_local_area_error"))), "mesh_area_ratio": float(course["mesh_area_ratio"][-1]),
        "off_centre": float(np.linalg.norm([course[f"centroid_{axis}"][-1] for axis in "xyz"])),
        "half_turns": len(turns), "periods": [float(b - a) for a, b in zip(turns[:-2], turns[2:])],
        "courses": outputs.thinned(time, course["surface_divergence_max"], course["area_error"], course["volume_error"], count=201),
    }


def of_table(values):
    rows = []
    for name, v in values.items():
        periods = v["periods"]
        motion = (f"{v['half_turns'] / 2:g} turns, period {periods[0]:.3f} at first, {periods[-1]:.3f} at last" if len(periods) > 1
                  else f"{v['angle']:.3f}, drifting by {tiny(v['angle_drift'])}")
        end = f"{v['time']:.0f}" if v["status"] == "completed" else f"{v['time']:.2f}, stopped"
        rows.append([name, end, tiny(v["divergence"]), f"{v['growth']:+.4f}",
                     f"{tiny(v['area_error'])}, {tiny(v['area_drift'])}", f"{tiny(v['volume_error'])}, {tiny(v['volume_drift'])}",
                     tiny(v["local_area"]), tiny(v["off_centre"]), motion])
    return table("Second half of each run; rates per unit time", ["", "to t", "largest surface divergence", "its growth rate", "area error, drift",
                 "volume error, drift", "largest local area error", "off centre", "inclination in degrees, or turns"], rows)


def tiny(value):
    return "" if math.isnan(value) else f"{value:.1e}"


def draw(values, path):
    figure, axes = drawing.figure(1, 3, figsize=(11, 3.4))
    for (name, v), colour in zip(values.items(), drawing.COLOURS * 2):
        time, divergence, area, volume = (np.array([math.nan if x is None else x for x in column]) for column in v["courses"])
        style = {"color": colour, "linewidth": 1, "linestyle": "-" if list(values).index(name) < len(drawing.COLOURS) else "--"}
        axes[0].semilogy(time, divergence, label=name, **style)
        axes[1].semilogy(time, np.abs(area) + 1e-17, **style)
        axes[2].semilogy(time, np.abs(volume) + 1e-17, **style)
    for axis, title in zip(axes, ("surface divergence, largest", "area error", "volume error")):
        axis.set(title=title, xlabel="t")
    axes[0].axhline(verdicts.LOUD, color="0.4", linestyle=":", linewidth=1)
    axes[0].set_ylim(1e-4, 10)
    below = 0.16
    figure.get_layout_engine().set(rect=(0, below, 1, 1 - below))
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower center", ncols=5)
    drawing.save(figure, path)
