#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The table of validation/studies/redistribution.sh: how long each run lasted and how its mesh and its membrane fared."""
import csv
import json
import sys
from pathlib import Path


def rows(folder):
    with open(folder / "diagnostics.csv") as file:
        return list(csv.DictReader(file))


def at(table, time):
    """The row nearest to a time, or None when the run did not reach it."""
    row = min(table, key=lambda r: abs(float(r["time"]) - time))
    return row if abs(float(row["time"]) - time) < 0.2 else None


def outcome(summary):
    if summary["status"] == "completed":
        return f"reached t = {summary['time']:.0f}"
    return f"**stopped at t = {summary['time']:.2f}**"


def overview(runs):
    print("| run | outcome | redistributions | inclination, degrees | frequency | area error | local area error |"
          " volume error | wall s |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name, folder in runs.items():
        summary, last = json.loads((folder / "summary.json").read_text()), rows(folder)[-1]
        vesicle = summary["vesicles"][0] or {}
        angle = float(last["inclination_angle_deg"] or "nan")
        print(f"| {name} | {outcome(summary)} | {vesicle.get('redistributions', '-')} | {angle:.2f} |"
              f" {float(last['tank_treading_frequency']):.4f} | {float(last['area_error']):.1e} |"
              f" {float(last['max_local_area_error']):.1e} | {float(last['volume_error']):.1e} |"
              f" {summary['wall_seconds']:.0f} |")


def history(title, never, redistributed, times):
    print(f"\n{title}: without / with redistribution\n")
    print("| t | mesh aspect ratio | spectrum tail | local area error | surface divergence | bending energy | inclination |")
    print("|---|---|---|---|---|---|---|")
    columns = (("mesh_aspect_ratio", ".2f"), ("spectrum_tail", ".0e"), ("max_local_area_error", ".3f"),
               ("surface_divergence_max", ".3f"), ("bending_energy", ".2f"), ("inclination_angle_deg", ".2f"))
    tables = [rows(never), rows(redistributed)]
    for time in times:
        found = [at(table, time) for table in tables]
        cells = [" / ".join(format(float(row[key] or "nan"), form) if row else "-" for row in found)
                 for key, form in columns]
        print(f"| {time:g} | " + " | ".join(cells) + " |")


def main():
    out = Path(sys.argv[1])
    runs = {folder.name: folder for folder in sorted(out.iterdir()) if (folder / "summary.json").exists()}
    revision = json.loads((runs["shear"] / "summary.json").read_text())["git_revision"]
    print(f"Revision {revision}, made by `validation/studies/redistribution.sh`. Values at the last row of each run.\n")
    overview(runs)
    history("Shear, reduced volume 0.7", runs["shear_never"], runs["shear"], (1, 2, 4, 5, 6, 7, 8, 8.6, 10, 15, 20, 25, 30))
    history("Fluid at rest, reduced volume 0.7", runs["relaxation_never"], runs["relaxation"], (1, 2, 5, 10, 15, 20))
    history("Shear, reduced volume 0.8", runs["shear_08_never"], runs["shear_08"], (1, 5, 10, 12, 14, 16))


if __name__ == "__main__":
    main()
