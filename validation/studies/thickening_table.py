#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of validation/studies/thickening.sh: inclination and frequency by delta function and spacing, and extrapolated to h = 0."""
import csv
import json
import sys
from pathlib import Path

length = 12.0  # of the box


def last_row(folder):
    with open(folder / "diagnostics.csv") as file:
        return list(csv.DictReader(file))[-1]


def extrapolated(points, terms):
    """The value at h = 0 of the polynomial through the finest `terms` points (h, value)."""
    finest = sorted(points)[:terms]
    if len(finest) < terms:
        return None
    value = 0.0
    for i, (hi, vi) in enumerate(finest):
        weight = 1.0
        for j, (hj, _) in enumerate(finest):
            if j != i:
                weight *= hj / (hj - hi)
        value += weight * vi
    return value


def read(out):
    found = {}
    for summary in sorted(out.glob("*/summary.json")):
        name, cells = summary.parent.name.rsplit("_", 1)
        if json.loads(summary.read_text())["status"] != "completed":
            continue
        row = last_row(summary.parent)
        found.setdefault(name, {})[int(cells)] = (
            float(row["inclination_angle_deg"]) / 180, float(row["tank_treading_frequency"]))
    return found


def main():
    out = Path(sys.argv[1])
    found = read(out)
    record = {}
    for which, (label, digits) in enumerate([("inclination / pi", 5), ("frequency", 4)]):
        counts = sorted({n for values in found.values() for n in values})
        print(f"| {label} | " + " | ".join(f"12/{n}" for n in counts) + " | h = 0, linear | quadratic |")
        print("|---" * (len(counts) + 3) + "|")
        for name, values in found.items():
            points = [(length / n, value[which]) for n, value in values.items()]
            limits = [extrapolated(points, terms) for terms in (2, 3)]
            cells = [values[n][which] if n in values else None for n in counts] + limits
            print(f"| {name} | " + " | ".join("" if c is None else f"{c:.{digits}f}" for c in cells) + " |")
            entry = record.setdefault(name, {})
            entry[label] = {"by_cells": {str(n): v[which] for n, v in sorted(values.items())},
                            "linear": limits[0], "quadratic": limits[1]}
        print()
    (out / "thickening.json").write_text(json.dumps(record, indent=1) + "\n")


if __name__ == "__main__":
    main()
