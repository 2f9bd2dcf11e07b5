#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of validation/studies/thickening.sh: inclination and frequency by delta function and spacing, and extrapolated to h = 0."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line, extrapolation, outputs, tables  # noqa: E402

LENGTH = 12.0  # of the box


def extrapolated(points, terms):
    """The value at h = 0 of the polynomial through the finest `terms` points (h, value)."""
    finest = sorted(points)[:terms]
    return extrapolation.at_zero(*zip(*finest)) if len(finest) == terms else None


def read(out):
    found = {}
    for folder in outputs.folders(out):
        name, cells = folder.name.rsplit("_", 1)
        if outputs.summary(folder)["status"] != "completed":
            continue
        course = outputs.course(folder)
        found.setdefault(name, {})[int(cells)] = float(course["inclination_angle_deg"][-1]) / 180, float(course["tank_treading_frequency"][-1])
    return found


def main():
    out = command_line.folder_of_runs(__doc__)
    found = read(out)
    record = {}
    for which, (label, digits) in enumerate([("inclination / pi", 5), ("frequency", 4)]):
        counts = sorted({n for values in found.values() for n in values})
        rows = []
        for name, values in found.items():
            points = [(LENGTH / n, value[which]) for n, value in values.items()]
            limits = [extrapolated(points, terms) for terms in (2, 3)]
            cells = [values[n][which] if n in values else None for n in counts] + limits
            rows.append([name, *("" if c is None else f"{c:.{digits}f}" for c in cells)])
            entry = record.setdefault(name, {})
            entry[label] = {"by_cells": {str(n): v[which] for n, v in sorted(values.items())},
                            "linear": limits[0], "quadratic": limits[1]}
        print(tables.markdown(tables.table("", [label, *(f"12/{n}" for n in counts), "h = 0, linear", "quadratic"], rows)), end="\n\n")
    (out / "thickening.json").write_text(json.dumps(record, indent=1) + "\n")


if __name__ == "__main__":
    main()
