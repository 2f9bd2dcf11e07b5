#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The table of validation/studies/viscosity_ratio.sh: angle at t = 4 at ratio 5, time of zero angle at ratio 20, by treatment and step."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line, outputs, tables  # noqa: E402


def time_of_zero_angle(course):
    """When the inclination first changes from positive to negative, by linear interpolation; None if it does not."""
    times, angles = course["time"], course["inclination_angle_deg"]
    for t, after, a, b in zip(times, times[1:], angles, angles[1:]):
        if 0 <= a < 45 and b < 0:
            return float(t + (after - t) * a / (a - b))
    return None


def milliseconds_of_step(summary):
    """Without diagnostics and output, which these runs have many of."""
    phases = summary["phase_seconds"]
    return 1e3 * sum(phases[key] for key in phases if not key.startswith(("diagnostics", "output"))) / summary["steps"]


def main():
    found = {}
    for folder in outputs.folders(command_line.folder_of_runs(__doc__)):
        ratio, treatment, steps = folder.name.split("_")
        course, summary = outputs.course(folder), outputs.summary(folder)
        if summary["status"] == "running":
            continue
        if ratio == "ratio5":
            value = f"{course['inclination_angle_deg'][-1] / 180:.5f} pi"
        else:
            time = time_of_zero_angle(course)
            value = f"{time:.3f}" if time else "not reached"
        if summary["status"] != "completed":
            value = f"stopped at t = {summary['time']:.2f}"
        found[ratio, treatment, int(steps)] = (value, milliseconds_of_step(summary))
    columns = ["treatment", "steps per unit time", "ratio 5: angle at t = 4", "ms a step", "ratio 20: time of zero angle", "ms a step"]
    rows = []
    order = ["explicit", "extrapolated", "implicit", "none"]
    for treatment, steps in sorted({key[1:] for key in found}, key=lambda k: (order.index(k[0]), k[1])):
        cells = []
        for ratio in ("ratio5", "ratio20"):
            value = found.get((ratio, treatment, steps))
            cells += [value[0], f"{value[1]:.0f}"] if value else ["", ""]
        rows.append([treatment, str(steps), *cells])
    print(tables.markdown(tables.table("", columns, rows)))


if __name__ == "__main__":
    main()
