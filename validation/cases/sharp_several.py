# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Eight vesicles in shear that pass each other closely (scenes/eight_vesicles.toml), without repulsion, sharp and delta, at viscosity ratios 1 and 5.

Sharp membranes without inertia and with steps of 1/24, delta functions with the scene's Re = 1e-3 and steps of 1/48; 24 latitudes, to t = 10.
"""

import numpy as np

from harness import drawing, outputs
from harness.runs import Run
from harness.tables import table

TITLE = "eight vesicles that pass each other, sharp and delta"
RATIOS, METHODS, END, VESICLES = [1, 5], ["sharp", "delta"], 10, 8
SPACING = 0.1


def run_of(method, ratio):
    keys = {"coupling.method": method, "fluid.viscosity_ratio": ratio, "repulsion.range": 0, "mesh.latitudes": 24, "time.end": END,
            "output.vesicle_every": 0, "output.fluid_every": 0, "output.checkpoint_every": 0}
    if method == "sharp":
        keys |= {"fluid.inertia": "none", "time.step": "1/24"}
    return Run(f"{method}, ratio {ratio}", "scenes/eight_vesicles.toml", keys)


def state(folder):
    summary, course = outputs.summary(folder), outputs.course(folder)
    distance = course["min_distance"].reshape(-1, VESICLES).min(axis=1)
    time = course["time"].reshape(-1, VESICLES)[:, 0]
    at = int(np.argmin(distance))
    return {"status": summary["status"], "reason": (summary["stop_reason"] or "")[:200] or None, "time": summary["time"],
            "least_distance": float(distance[at]), "least_at": float(time[at]), "near": float(np.mean(distance < SPACING)),
            "local_area_error": float(course["max_local_area_error"].max()), "area_error": float(np.abs(course["area_error"]).max()),
            "volume_error": float(np.abs(course["volume_error"]).max()),
            "divergence": float(course["surface_divergence_max"][course["time"] > 1].max()),
            "velocity_noise": summary["largest_errors"]["velocity_noise"], "heights": course["centroid_z"].reshape(-1, VESICLES)[-1].tolist(),
            "courses": {"time": time.tolist(), "distance": [round(d, 4) for d in distance.tolist()]}}


def compute(context):
    runs = {(m, r): run_of(m, r) for r in RATIOS for m in METHODS}
    folders = context.run(list(runs.values()))
    states, rows = {}, []
    for (m, r), run in runs.items():
        s = states[run.name] = state(folders[run.name])
        rows.append([r, m, s["status"], s["time"], f"{s['least_distance']:.3f} at {s['least_at']:g}", f"{100 * s['near']:.0f} %",
                     f"{s['divergence']:.1e}", f"{s['velocity_noise']:.1e}",
                     f"{s['local_area_error']:.1e}", f"{s['area_error']:.0e}", f"{s['volume_error']:.0e}"])
    return {"states": states, "tables": [table("", [
        "ratio", "", "ended", "t", "least distance between markers, at t", "rows with less than one spacing",
        "largest surface divergence after t = 1", "largest noise of the velocity", "largest local area error", "area error", "volume error"], rows)]}


def draw(context, values, path):
    figure, axes = drawing.figure(figsize=(6, 3.2))
    for i, (name, s) in enumerate(values["states"].items()):
        axes.plot(s["courses"]["time"], s["courses"]["distance"], color=drawing.COLOURS[i], label=name)
    axes.axhline(SPACING, color="0.5", linestyle=":", linewidth=1)
    axes.set(xlabel="t", ylabel="least distance between markers", ylim=(0, None))
    axes.legend()
    drawing.save(figure, path)
