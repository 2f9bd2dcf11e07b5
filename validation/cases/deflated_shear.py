# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""A strongly deflated vesicle, reduced volume 0.65, tank-treading from a start across the flow."""

from harness import drawing, outputs, shear, theory
from harness.tables import percent, table

TITLE = "reduced volume 0.65 in shear"
VOLUMES, SNAPSHOTS = [0.7, 0.65], [0, 1, 3, 20]


def run_of(context, volume, step):
    latitudes = 80 if context.paper else 56
    keys = {"mesh.latitudes": latitudes, "time.end": 20, "time.step": step}
    if context.paper:
        keys["membrane.sigma0"] = 2000
    return shear.treading(f"{volume}, dt = {step}", context, volume, **shear.HALF, **keys)


def compute(context):
    runs = {(v, s): run_of(context, v, s) for v in VOLUMES for s in ("1/24", "1/48")}
    folders = context.run(list(runs.values()))
    values, rows = {"steady": {}, "series": {}}, []
    for (volume, step), run in runs.items():
        course, summary = outputs.course(folders[run.name]), outputs.summary(folders[run.name])
        state = shear.steady(folders[run.name])
        values["steady"][run.name] = state | {"status": summary["status"], "time": summary["time"]}
        values["series"][run.name] = dict(zip(("time", "angle_deg", "frequency"), outputs.thinned(
            course["time"], course["inclination_angle_deg"], course["tank_treading_frequency"])))
        angle, frequency = theory.inclination(volume, 1), theory.frequency(volume, 1)
        rows.append([volume, step, summary["status"], summary["time"], state["angle_deg"], "stopped" if state["drift_deg"] != state["drift_deg"] else f"{state['drift_deg']:+.3f}", angle, state["frequency"], frequency,
                     percent(state["frequency"], frequency), float(course["max_local_area_error"].max()), summary["vesicles"][0]["redistributions"]])
    values["tables"] = [table("", ["reduced volume", "dt", "ended", "t", "angle, degrees", "change in the last unit of time", "Keller & Skalak", "frequency",
                                   "Keller & Skalak", "difference", "largest local area error", "redistributions"], rows)]
    return values


def draw(context, values, path):
    figure = drawing.plt.figure(figsize=(9.5, 4.6))
    left, right = figure.subfigures(1, 2, width_ratios=[1.6, 1])
    panels = left.subplots(len(VOLUMES), len(SNAPSHOTS))
    for row, volume in zip(panels, VOLUMES):
        for axes, shot in zip(row, outputs.membranes(context.folders[f"{volume}, dt = 1/48"], SNAPSHOTS)):
            drawing.membrane(axes, shot)
            drawing.picture(axes, 2.9, 2.7)
            axes.set_title(f"{volume}, t = {shot['time']:.3g}", fontsize=7)
    axes = right.subplots()
    for (name, series), colour in zip(values["series"].items(), drawing.COLOURS):
        axes.plot(series["time"], series["angle_deg"], color=colour, label=name)
    axes.set(xlabel="t", ylabel="inclination, degrees", ylim=(0, 60))
    axes.legend(fontsize=7)
    drawing.save(figure, path)
