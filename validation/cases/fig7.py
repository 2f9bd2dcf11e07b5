# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 7: what bending resistance does to the shape in tank-treading: Ca = 0.25, 2.5, 25 of the paper at t = 5."""

from harness import drawing, outputs, shear
from harness.tables import table

TITLE = "shapes at Ca = 0.25, 2.5, 25 (figure 7)"
VOLUMES, CAPILLARY = [0.975, 0.9, 0.8], [0.25, 2.5, 25]


def run_of(context, volume, ca):
    """The stiffest and longest starts far from its shape: with the correction it stops at t = 0.1 on 128^3 cells, even with dt = 1/96."""
    keys = {"time.end": 5, "membrane.capillary_number": ca}
    keys |= {"time.step": "1/96"} if (volume, ca) == (0.8, 0.25) else shear.corrected(context)
    return shear.treading(f"{volume}, Ca {ca}", context, volume, **shear.HALF, **keys)


def compute(context):
    runs = {(v, ca): run_of(context, v, ca) for v in VOLUMES for ca in CAPILLARY}
    folders = context.run(list(runs.values()))
    values, rows = {"shapes": {}}, []
    for (volume, ca), run in runs.items():
        course = outputs.course(folders[run.name])
        axes = [float(course[f"semi_axis_{i}"][-1]) for i in (1, 2, 3)]
        shot = outputs.membranes(folders[run.name], [5])[0]
        values["shapes"][run.name] = {
            "status": outputs.summary(folders[run.name])["status"],
            "semi_axes": axes, "angle_deg": float(course["inclination_angle_deg"][-1]),
            "frequency": float(course["tank_treading_frequency"][-1]), "bending_energy": float(course["bending_energy"][-1]),
            "deformation": float(course["deformation"][-1]), "largest_mean_curvature": float(shot["mean_curvature"].max()),
            "smallest_mean_curvature": float(shot["mean_curvature"].min())}
        s = values["shapes"][run.name]
        rows.append([volume, ca, s["status"], s["angle_deg"], s["frequency"], *axes, s["deformation"], s["bending_energy"],
                     s["largest_mean_curvature"], s["smallest_mean_curvature"]])
    values["tables"] = [table("At t = 5", ["reduced volume", "Ca", "ended", "angle, degrees", "frequency", "semi-axes", "", "", "deformation",
                                           "1/2 int H^2", "largest H", "smallest H"], rows)]
    return values


def draw(context, values, path):
    figure, panels = drawing.figure(3, 3, figsize=(7.5, 6))
    for row, volume in zip(panels, VOLUMES):
        for axes, ca in zip(row, CAPILLARY):
            drawing.membrane(axes, outputs.membranes(context.folders[f"{volume}, Ca {ca}"], [5])[0])
            drawing.picture(axes, 2.0, 1.3)
            axes.set_title(f"{volume}, Ca = {ca}")
    drawing.save(figure, path)
