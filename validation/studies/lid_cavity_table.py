#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of validation/studies/lid_cavity.md, from the JSON that lid_cavity --out writes.

usage: scripts/python.sh validation/studies/lid_cavity_table.py LID_CAVITY_JSON
"""
import json
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line, extrapolation, tables  # noqa: E402

LINES = {"u_along_y": ("u", "y", "(1/2, y, 1/2)"), "v_along_x": ("v", "x", "(x, 1/2, 1/2)")}
EXTREMA = {"u_minimum": "min u", "v_maximum": "max v", "v_minimum": "min v"}


def table(head, rows):
    print(tables.markdown(tables.table("", head, rows)), end="\n\n")


def order_of(values, cells):
    """p of q + C h^p through three grids, by bisection; None if they are not in that form with 0.5 < p < 4."""
    (a, b, c), (n, m, k) = values, cells

    def mismatch(p):
        return (a - b) / (b - c) - (n**-p - m**-p) / (m**-p - k**-p)

    low, high = 0.5, 4.0
    if mismatch(low) * mismatch(high) > 0:
        return None
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if mismatch(low) * mismatch(middle) > 0 else (low, middle)
    return low


def extrema(grids):
    head = ["cells", "steps", "time", "change per unit time", "seconds"]
    for name in EXTREMA.values():
        head += [name, "at"]
    rows = []
    for grid in grids:
        row = [f"{grid['cells']}^3", str(grid["steps"]), f"{grid['time']:.1f}", f"{grid['change']:.1e}"]
        row.append(f"{grid['seconds']:.0f}")
        for key in EXTREMA:
            row += [f"{grid[key]['value']:.5f}", f"{grid[key]['position']:.4f}"]
        rows.append(row)
    cells = [grid["cells"] for grid in grids[-3:]]
    limits, orders = ["h -> 0, order 2"] + [""] * 4, ["order seen"] + [""] * 4
    for key in EXTREMA:
        values = [grid[key]["value"] for grid in grids[-3:]]
        order = order_of(values, cells)
        limits += [f"{extrapolation.at_zero([n**-2 for n in cells[1:]], values[1:]):.5f}", ""]
        orders += [f"{order:.2f}" if order else "none", ""]
    table(head, rows + [limits, orders])


def deviations(result):
    cells = [grid["cells"] for grid in result["grids"]]
    head, columns = ["cells"], []
    for key, (name, _, _) in LINES.items():
        points = result["published"][key]
        for norm in ("rms", "max"):
            head += [f"{name}, {norm}", "order"]
            sets = [[row["grids"][g] - row["published"] for row in points] for g in range(len(cells))]
            sets.append([row["extrapolated"] - row["published"] for row in points])
            if norm == "rms":
                columns.append([math.sqrt(sum(d * d for d in s) / len(s)) for s in sets])
            else:
                columns.append([max(map(abs, s)) for s in sets])
    rows = []
    for g, name in enumerate([f"{n}^3" for n in cells] + ["h -> 0"]):
        row = [name]
        for column in columns:
            between_grids = 0 < g < len(cells)
            order = math.log(column[g - 1] / column[g]) / math.log(cells[g] / cells[g - 1]) if between_grids else None
            row += [f"{column[g]:.2e}", f"{order:.2f}" if order else ""]
        rows.append(row)
    table(head, rows)


def profiles(result):
    for key, (name, axis, where) in LINES.items():
        print(f"{name} at {where}:\n")
        head = [axis, "published"] + [f"{grid['cells']}^3" for grid in result["grids"]] + ["h -> 0", "difference"]
        rows = []
        for row in result["published"][key]:
            numbers = [row["published"], *row["grids"], row["extrapolated"], row["extrapolated"] - row["published"]]
            rows.append([f"{row[axis]:.4f}"] + [f"{number:.5f}" for number in numbers])
        table(head, rows)


def main():
    parser = command_line.parser(__doc__, apps=False)
    parser.add_argument("file", type=pathlib.Path, metavar="LID_CAVITY_JSON")
    result = json.loads(parser.parse_args().file.read_text())
    print(f"Reynolds number {result['reynolds_number']:g}. Published: {result['published']['reference']}.\n")
    print("Extrema on the centrelines:\n")
    extrema(result["grids"])
    print("Differences from the published points, with the order of their fall from grid to grid:\n")
    deviations(result)
    profiles(result)
    print("h -> 0: extrapolated from the last two grids, errors taken as O(h^2). Order seen: of q + C h^p through the last three.")


if __name__ == "__main__":
    main()
