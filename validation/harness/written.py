# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Whether what a run has written is whole, and whether two runs have written the same (docs/results.md)."""

import json
import tomllib
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

SNAPSHOTS = ("vesicle", "fluid")
LISTED_LATER = 1 / 50  # of many snapshots this share may not be in the list yet (libcoupling/src/snapshot_series.cpp)


def problems(folder):
    """What is wrong with the files of a folder, of a run that may have been killed; empty if nothing."""
    found = []
    for check in (_checkpoint, _table, _snapshots, _texts):
        try:
            found += check(folder)
        except Exception as error:  # whatever a reader says of a damaged file
            found.append(f"{check.__name__[1:]}: {type(error).__name__}: {error}")
    return found


def differences(a, b):
    """Between the results of two finished runs of a scene, to the last bit; times of computing do not count."""
    found = []
    for name in ("checkpoint.h5", "diagnostics.csv", "vesicle.xdmf", "fluid.xdmf", "scene.toml"):
        if (a / name).read_bytes() != (b / name).read_bytes():
            found.append(f"{name} differs")
    for name in SNAPSHOTS:
        if _contents(a / f"{name}.h5") != _contents(b / f"{name}.h5"):
            found.append(f"{name}.h5 differs")
    for key in ("status", "steps", "time", "time_step"):
        first, second = (json.loads((folder / "summary.json").read_text())[key] for folder in (a, b))
        if first != second:
            found.append(f"summary.json: {key} is {second}, was {first}")
    if _names(a / "snapshots") != _names(b / "snapshots"):
        found.append("snapshots: not the same files")
    found += [f"{file.name} is left" for file in [*b.rglob("*.part"), *b.glob("run.lock*")]]
    return found


def size(folder):
    """Bytes of all files."""
    return sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())


def steps_of_table(folder):
    """The last step of the table, -1 if there is none."""
    file = folder / "diagnostics.csv"
    rows = file.read_text().splitlines()[1:] if file.exists() else []
    return int(rows[-1].split(",")[0]) if rows else -1


def _checkpoint(folder):
    if not (folder / "checkpoint.h5").exists():
        return []
    _contents(folder / "checkpoint.h5")  # reads it all, against its checksums
    with h5py.File(folder / "checkpoint.h5", "r") as file:
        step = int(file.attrs["steps"])
    found = []
    for name in SNAPSHOTS:
        upto = [k for k in _snapshot_steps(folder, name) if k <= step]
        listed = _steps(folder, name)
        if step not in upto:
            found.append(f"snapshots: {name} has no step {step}, the checkpoint has")
        if len(set(upto) - set(listed)) > len(listed) * LISTED_LATER:
            found.append(f"{name}.h5 lists {listed}, there are {upto} up to step {step} of the checkpoint")
    if steps_of_table(folder) < step:
        found.append(f"diagnostics.csv ends before step {step} of the checkpoint")
    return found


def _table(folder):
    file = folder / "diagnostics.csv"
    if not file.exists():
        return []
    text = file.read_text()
    found = [] if text.endswith("\n") else ["diagnostics.csv ends within a row"]
    rows = [row.split(",") for row in text.splitlines()]
    if any(len(row) != len(rows[0]) for row in rows):
        found.append("diagnostics.csv has rows of different lengths")
    steps = [int(row[0]) for row in rows[1:]]
    if steps != list(range(len(steps))):
        found.append("diagnostics.csv: steps are missing or twice there")
    return found


def _snapshots(folder):
    found = []
    for name in SNAPSHOTS:
        steps = _snapshot_steps(folder, name)
        if steps != list(range(len(steps))):
            found.append(f"snapshots: {name}: steps are missing: {steps}")
        listed = _steps(folder, name)
        if listed != list(range(len(listed))) or not set(listed) <= set(steps):
            found.append(f"{name}.h5 lists {listed}, there are {steps}")
        if not (folder / f"{name}.h5").exists():
            continue
        contents = _contents(folder / f"{name}.h5")
        sets = [{key.split("/", 3)[3] for key in contents if key.startswith(f"/steps/{step:09d}/")} for step in listed]
        if any(of_step != sets[0] for of_step in sets):
            found.append(f"{name}.h5: a snapshot is not complete")
        if (folder / f"{name}.xdmf").exists():
            named = {item.text.strip() for item in ElementTree.parse(folder / f"{name}.xdmf").iter("DataItem")
                     if item.get("Format") == "HDF"}
            found += [f"{name}.xdmf names {item}, which is not there" for item in named if not _is_there(folder, item)]
    return found


def _is_there(folder, item):
    """item: FILE:/DATA/SET"""
    name, data_set = item.split(":")
    if not (folder / name).exists():
        return False
    with h5py.File(folder / name, "r") as file:
        return data_set in file


def _texts(folder):
    if (folder / "summary.json").exists():
        json.loads((folder / "summary.json").read_text())
    if (folder / "scene.toml").exists():
        tomllib.loads((folder / "scene.toml").read_text())
    return []


def _snapshot_steps(folder, name):
    return sorted(int(file.stem.split("_")[1]) for file in (folder / "snapshots").glob(f"{name}_*.h5"))


def _steps(folder, name):
    """Those that the list names."""
    if not (folder / f"{name}.h5").exists():
        return []
    with h5py.File(folder / f"{name}.h5", "r") as file:
        return sorted(map(int, file["steps"]))


def _contents(file):
    """Every attribute and data set as bytes, by path, also in the files that a list of snapshots links to."""
    result = {}

    def add(name, thing):
        for key, value in thing.attrs.items():
            result[f"{name}@{key}"] = np.asarray(value).tobytes()
        if isinstance(thing, h5py.Dataset):
            result[name] = str(thing.dtype) + str(thing.shape), thing[()].tobytes()
        else:
            for child in thing:
                add(f"{name}/{child}", thing[child])

    with h5py.File(file, "r") as opened:
        add("", opened)
    return result


def _names(folder):
    return sorted(file.name for file in folder.iterdir()) if folder.exists() else []
