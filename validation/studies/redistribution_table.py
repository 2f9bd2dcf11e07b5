#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The table of validation/studies/redistribution.sh: how long each run lasted and how its mesh and its membrane fared."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line, outputs, tables  # noqa: E402


def at(course, time):
    """The index of the row nearest to a time, or None when the run did not reach it."""
    row = int(np.argmin(np.abs(course["time"] - time)))
    return row if abs(course["time"][row] - time) < 0.2 else None


def outcome(summary):
    if summary["status"] == "completed":
        return f"reached t = {summary['time']:.0f}"
    return f"**stopped at t = {summary['time']:.2f}**"


def overview(runs):
    rows = []
    for name, folder in runs.items():
        summary, course = outputs.summary(folder), outputs.course(folder)
        vesicle = summary["vesicles"][0] or {}
        last = [format(course[key][-1], form) for key, form in (
            ("inclination_angle_deg", ".2f"), ("tank_treading_frequency", ".4f"), ("area_error", ".1e"), ("max_local_area_error", ".1e"),
            ("volume_error", ".1e"))]
        rows.append([name, outcome(summary), str(vesicle.get("redistributions", "-")), *last, f"{summary['wall_seconds']:.0f}"])
    print(tables.markdown(tables.table("", ["run", "outcome", "redistributions", "inclination, degrees", "frequency", "area error",
                                            "local area error", "volume error", "wall s"], rows)))


def history(title, never, redistributed, times):
    print(f"\n{title}: without / with redistribution\n")
    columns = (("mesh_aspect_ratio", ".2f"), ("spectrum_tail", ".0e"), ("max_local_area_error", ".3f"),
               ("surface_divergence_max", ".3f"), ("bending_energy", ".2f"), ("inclination_angle_deg", ".2f"))
    courses = [outputs.course(never), outputs.course(redistributed)]
    rows = []
    for time in times:
        found = [(course, at(course, time)) for course in courses]
        both = lambda key, form: " / ".join("-" if row is None else format(course[key][row], form) for course, row in found)  # noqa: E731
        rows.append([f"{time:g}", *(both(key, form) for key, form in columns)])
    print(tables.markdown(tables.table("", ["t", "mesh aspect ratio", "spectrum tail", "local area error", "surface divergence", "bending energy",
                                            "inclination"], rows)))


def main():
    runs = {folder.name: folder for folder in outputs.folders(command_line.folder_of_runs(__doc__))}
    revision = outputs.summary(runs["shear"])["git_revision"]
    print(f"Revision {revision}, made by `validation/studies/redistribution.sh`. Values at the last row of each run.\n")
    overview(runs)
    history("Shear, reduced volume 0.7", runs["shear_never"], runs["shear"], (1, 2, 4, 5, 6, 7, 8, 8.6, 10, 15, 20, 25, 30))
    history("Fluid at rest, reduced volume 0.7", runs["relaxation_never"], runs["relaxation"], (1, 2, 5, 10, 15, 20))
    history("Shear, reduced volume 0.8", runs["shear_08_never"], runs["shear_08"], (1, 5, 10, 12, 14, 16))


if __name__ == "__main__":
    main()
