#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of validation/studies/thickness_correction.sh."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line, extrapolation, outputs  # noqa: E402


def time_at(course, wanted):
    """When the inclination, followed through turns, first falls through an angle in degrees; None if it does not."""
    times, values = course["time"], outputs.unwrapped(course["inclination_angle_deg"])
    for i in range(1, len(values)):
        if values[i - 1] >= wanted > values[i]:
            return float(times[i - 1] + (times[i] - times[i - 1]) * (values[i - 1] - wanted) / (values[i - 1] - values[i]))
    return None


def quantities(group, course):
    if group == "tumbling":
        return {"time of angle 0": time_at(course, 0.0), "of -60 degrees": time_at(course, -60.0)}
    last = {key: float(values[-1]) for key, values in course.items()}
    return {"inclination / pi": last["inclination_angle_deg"] / 180, "frequency": last["tank_treading_frequency"],
            "max abs div W": last["surface_divergence_max"]}


def extrapolated(points):
    """Linear in h through the two finest (cells, value)."""
    cells, values = zip(*sorted(points)[-2:])
    return extrapolation.at_zero([1 / n for n in cells], values)


def main():
    out = command_line.folder_of_runs(__doc__)
    record = {}
    for folder in outputs.folders(out):
        group, corrected, cells = folder.name.rsplit("_", 2)
        status = outputs.summary(folder)["status"]
        values = quantities(group, outputs.course(folder)) if status == "completed" else {"stopped": None}
        for name, value in values.items():
            record.setdefault(group, {}).setdefault(name, {}).setdefault(corrected, {})[cells] = value
    for file in sorted(out.glob("modes_*.txt")):
        group, corrected, cells = file.stem.rsplit("_", 2)
        for line in file.read_text().splitlines()[2:]:
            word = line.split()
            if word[1] == cells:
                name = f"n = {word[4]}: rate, over theory, in a sphere"
                record.setdefault(group, {}).setdefault(name, {}).setdefault(corrected, {})[cells] = [
                    float(word[5]), float(word[7]), float(word[9])]
    for group, names in record.items():
        for name, sets in names.items():
            for corrected, values in sorted(sets.items()):
                cells = sorted(values, key=int)
                text = [", ".join(f"{x:.4f}" for x in v) if isinstance(v := values[n], list)
                        else "-" if v is None else f"{v:.5f}" for n in cells]
                known = [(int(n), values[n]) for n in cells if isinstance(values[n], float)]
                limit = f"{extrapolated(known):.5f}" if len(known) > 1 else ""
                label = "corrected" if corrected == "true" else "as it is"
                print(f"| {group} | {name} | {label} | " + " | ".join(f"{n}: {t}" for n, t in zip(cells, text)) + f" | {limit} |")
    (out / "thickness_correction.json").write_text(json.dumps(record, indent=1) + "\n")


if __name__ == "__main__":
    main()
