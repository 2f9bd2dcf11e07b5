#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The table of validation/studies/viscosity_ratio.sh: angle at t = 4 at ratio 5, time of zero angle at ratio 20, by treatment and step."""
import csv
import json
import sys
from pathlib import Path


def rows(folder):
    with open(folder / "diagnostics.csv") as file:
        return list(csv.DictReader(file))


def time_of_zero_angle(table):
    """When the inclination first changes from positive to negative, by linear interpolation; None if it does not."""
    for before, after in zip(table, table[1:]):
        a, b = float(before["inclination_angle_deg"] or "nan"), float(after["inclination_angle_deg"] or "nan")
        if 0 <= a < 45 and b < 0:
            t, step = float(before["time"]), float(after["time"]) - float(before["time"])
            return t + step * a / (a - b)
    return None


def milliseconds_of_step(summary):
    """Without diagnostics and output, which these runs have many of."""
    phases = summary["phase_seconds"]
    return 1e3 * sum(phases[key] for key in phases if not key.startswith(("diagnostics", "output"))) / summary["steps"]


def main():
    out = Path(sys.argv[1])
    found = {}
    for folder in out.iterdir():
        if not (folder / "summary.json").exists():
            continue
        ratio, treatment, steps = folder.name.split("_")
        table, summary = rows(folder), json.loads((folder / "summary.json").read_text())
        if summary["status"] == "running":
            continue
        if ratio == "ratio5":
            value = f"{float(table[-1]['inclination_angle_deg']) / 180:.5f} pi"
        else:
            time = time_of_zero_angle(table)
            value = f"{time:.3f}" if time else "not reached"
        if summary["status"] != "completed":
            value = f"stopped at t = {summary['time']:.2f}"
        found[ratio, treatment, int(steps)] = (value, milliseconds_of_step(summary))
    print("| treatment | steps per unit time | ratio 5: angle at t = 4 | ms a step | ratio 20: time of zero angle | ms a step |")
    print("|---|---|---|---|---|---|")
    order = ["explicit", "extrapolated", "implicit", "none"]
    for treatment, steps in sorted({key[1:] for key in found}, key=lambda k: (order.index(k[0]), k[1])):
        cells = []
        for ratio in ("ratio5", "ratio20"):
            value = found.get((ratio, treatment, steps))
            cells += [value[0], f"{value[1]:.0f}"] if value else ["", ""]
        print(f"| {treatment} | {steps} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
