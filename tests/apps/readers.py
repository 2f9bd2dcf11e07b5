#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""readers.py VESICLES: while a run writes every file in every step, all of them can be read at any moment, as docs/results.md has them.

Reads again and again, then ends the run and reads once more, with the locks that h5py takes. What a list or a table has once said it says ever after.
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import xml.etree.ElementTree as ElementTree

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "validation" / "robustness"))
import kills


def steps_of_snapshots(folder, name, key, shape):
    """All steps that the list names: each opens, and of the last the data are there."""
    with h5py.File(folder / f"{name}.h5", "r") as file:
        names = sorted(file["steps"])
        assert all(int(file["steps"][step].attrs["step"]) == int(step) for step in names)
        data = file["steps"][names[-1]][key][:]
        assert data.shape == shape and abs(data).max() < 100, data.shape
        return [int(step) for step in names]


def steps_of_xdmf(folder, name):
    items = [item.text for item in ElementTree.parse(folder / f"{name}.xdmf").iter("DataItem") if item.get("Format") == "HDF"]
    for item in items[-3:]:
        file, data_set = item.split(":")
        with h5py.File(folder / file, "r") as opened:
            assert data_set in opened, item
    return len(items)


def steps_of_table(folder):
    text = (folder / "diagnostics.csv").read_text()
    rows = list(csv.DictReader(text[: text.rfind("\n") + 1].splitlines()))
    assert all(None not in row.values() for row in rows), "a row is not whole"
    return [int(row["step"]) for row in rows]


def step_of_checkpoint(folder):
    with h5py.File(folder / "checkpoint.h5", "r") as file:
        file.visititems(lambda name, thing: thing[()] if isinstance(thing, h5py.Dataset) else None)  # against its checksums
        return int(file.attrs["steps"])


LOOKS = {
    "vesicle.h5": lambda folder: steps_of_snapshots(folder, "vesicle", "vesicle_0/positions", (130, 3)),
    "fluid.h5": lambda folder: steps_of_snapshots(folder, "fluid", "velocity", (16, 16, 16, 3)),
    "vesicle.xdmf": lambda folder: steps_of_xdmf(folder, "vesicle"),
    "fluid.xdmf": lambda folder: steps_of_xdmf(folder, "fluid"),
    "diagnostics.csv": steps_of_table,
    "summary.json": lambda folder: json.loads((folder / "summary.json").read_text())["steps"],
    "checkpoint.h5": step_of_checkpoint,
    "scene.toml": lambda folder: len(tomllib.loads((folder / "scene.toml").read_text())),
}

# The run has no end of its own: it is ended when it has been looked at that often and is beyond that step.
LEAST_LOOKS, LEAST_STEPS = 100, 24
TERMINATED = 143  # exit code


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        folder = work / "run"
        (work / "scene.toml").write_text(kills.SCENE)
        command = [*kills.start_command(program, work / "scene.toml", "equal steps", folder), "--set", "time.end=1000"]
        run = subprocess.Popen(list(map(str, command)))
        try:
            seen, looks, running = {}, 0, True
            while running:
                if looks >= LEAST_LOOKS and seen.get("diagnostics.csv", [0])[-1] >= LEAST_STEPS:
                    run.terminate()
                    run.wait()
                running = run.poll() is None  # once more when it has ended
                for file, look in LOOKS.items():
                    if not (folder / file).exists():
                        assert file not in seen, f"{file} is gone"
                        continue
                    found = look(folder)
                    before = seen.get(file, found)
                    if isinstance(found, list):
                        assert found[: len(before)] == before and found == list(range(len(found))), f"{file}: {before}, then {found}"
                    else:
                        assert found >= before, f"{file}: {before}, then {found}"
                    seen[file] = found
                    looks += running
        finally:
            run.kill()
            run.wait()
        assert run.returncode == TERMINATED, f"exit code {run.returncode}"
        assert set(seen) == set(LOOKS), f"only {sorted(seen)}"
        last = seen["summary.json"]
        assert all(seen[file][-1] == last for file in ("vesicle.h5", "fluid.h5", "diagnostics.csv")), seen
        assert seen["checkpoint.h5"] == last, seen
        print(f"{looks} looks at files of a run under way, all good")


if __name__ == "__main__":
    main()
