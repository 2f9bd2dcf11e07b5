#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of validation/studies/thickness_correction.sh."""
import csv
import json
import sys
from pathlib import Path

length = 12.0  # of the box


def rows_of(folder):
    with open(folder / "diagnostics.csv") as file:
        return list(csv.DictReader(file))


def angles(rows):
    """Times, and inclinations in degrees followed through turns."""
    times, values, turns = [], [], 0.0
    for row in rows:
        angle = float(row["inclination_angle_deg"])
        if values and angle + turns - values[-1] > 90.0:
            turns -= 180.0
        times.append(float(row["time"]))
        values.append(angle + turns)
    return times, values


def time_at(rows, wanted):
    times, values = angles(rows)
    for i in range(1, len(values)):
        if values[i - 1] >= wanted > values[i]:
            return times[i - 1] + (times[i] - times[i - 1]) * (values[i - 1] - wanted) / (values[i - 1] - values[i])
    return None


def quantities(group, rows):
    if group == "tumbling":
        return {"time of angle 0": time_at(rows, 0.0), "of -60 degrees": time_at(rows, -60.0)}
    last = rows[-1]
    return {"inclination / pi": float(last["inclination_angle_deg"]) / 180,
            "frequency": float(last["tank_treading_frequency"]),
            "max abs div W": float(last["surface_divergence_max"])}


def extrapolated(points):
    """Linear in h through the two finest (cells, value)."""
    (coarse, a), (fine, b) = sorted(points)[-2:]
    return (b * fine - a * coarse) / (fine - coarse)


def main():
    out = Path(sys.argv[1])
    record = {}
    for summary in sorted(out.glob("*/summary.json")):
        group, corrected, cells = summary.parent.name.rsplit("_", 2)
        status = json.loads(summary.read_text())["status"]
        values = quantities(group, rows_of(summary.parent)) if status == "completed" else {"stopped": None}
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
