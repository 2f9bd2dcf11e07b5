#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Sizes of reports: runs of 1, 8 and 64 vesicles with 201 snapshots each, and what their pages hold.

usage: scripts/python.sh bench/studies/report_size.py [--quick] [--apps FOLDER]

Prints a table: bytes of the page, snapshots that are kept, error of the positions that is allowed, seconds that writing the page takes and
their share of the run's. --quick: 21 snapshots. Exit code 1 if a page is larger than 3 MB.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "validation"))
from harness import command_line, runs, tables  # noqa: E402

MOST_BYTES = 3_000_000
STEP = 24  # in a unit of time
# Vesicles along each axis, cells along each axis, latitudes.
CASES = [(1, 32, 32), (2, 40, 24), (4, 48, 16)]


def scene(along, cells, latitudes, steps):
    """Prolate vesicles of radius 1 in shear flow, turned by different angles, each in the middle of a cube of edge 3; one alone in a box of edge 6."""
    edge = 6 if along == 1 else 3 * along
    half = edge / 2
    text = f"""title = "{along**3} vesicles"
[domain]
lower = [{-half}, {-half}, {-half}]
upper = [{half}, {half}, {half}]
cells = {cells}
periodic = [true, true, false]
[mesh]
latitudes = {latitudes}
[membrane]
sigma0 = 2000
[time]
step = "1/{STEP}"
end = "{steps}/{STEP}"
[output]
diagnostics_every = 0.25
vesicle_every = "1/{STEP}"
fluid_every = 1
checkpoint_every = 0
report = false
"""
    width = edge / along
    for number in range(along**3):
        place = [-half + width * (0.5 + number // along**axis % along) for axis in range(3)]
        text += f'[[vesicles]]\nreduced_volume = 0.9\nradius = 0.8\ncentre = {place}\nrotation_deg = {60 + 7 * (number % 9)}\n'
    return text


def measure(apps, along, cells, latitudes, steps):
    with tempfile.TemporaryDirectory() as work:
        file, folder = pathlib.Path(work, "scene.toml"), pathlib.Path(work, "run")
        file.write_text(scene(along, cells, latitudes, steps))
        subprocess.run([apps / "vesicles", file, "--out", folder, "--quiet", "--threads", "1"], env=runs.environment(1), check=True,
                       stderr=subprocess.DEVNULL)
        start = time.perf_counter()
        subprocess.run([apps / "report", folder, "--quiet", "--threads", "1"], env=runs.environment(1), check=True)
        seconds = time.perf_counter() - start
        page = (folder / "report.html").read_text()
        summary = json.loads((folder / "summary.json").read_text())
        kept = re.search(r"It holds (\d+) of the (\d+) snapshots of the membranes", page)
        error = re.search(r"positions are off by (\S+) r", page)
        return [along**3, latitudes, len(page.encode()), f"{kept[1]} of {kept[2]}", float(error[1]), seconds,
                f"{100 * seconds / summary['wall_seconds']:.1f} %"]


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("--quick", action="store_true", help="21 snapshots")
    options = parser.parse_args()
    apps = pathlib.Path(command_line.program(options)).parent
    rows = []
    for case in CASES:
        rows.append(measure(apps, *case, steps=20 if options.quick else 200))
        print(f"{rows[-1][0]} vesicles: {rows[-1][2]} bytes", file=sys.stderr, flush=True)
    columns = ["vesicles", "latitudes", "bytes", "snapshots kept", "error of positions, r", "seconds to write", "of the run's time"]
    print(tables.text(tables.table("", columns, rows)))
    return 1 if any(row[2] > MOST_BYTES for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
