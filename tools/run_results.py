# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What tools read of a run: the files that docs/results.md describes, in one place.

Lengths are in effective radii, times in 1/shear rate. What a run has not written raises MissingData, whose message says why.
"""

import json
import warnings
from pathlib import Path

import h5py
import numpy as np


class MissingData(Exception):
    """The run has not written what is asked for."""


class Run:
    """The folder of a run, under way or ended."""

    def __init__(self, folder):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise MissingData(f"{self.folder} is not a folder")
        names = ("summary.json", "diagnostics.csv", "vesicle.h5")
        if not any((self.folder / name).exists() for name in names):
            raise MissingData(f"{self.folder} holds no run: none of {', '.join(names)} is there")
        self.summary = _read_json(self.folder / "summary.json")

    def parameter(self, key, default=None):
        """A key of the scene, as in docs/scene.md, with the value that was used; of vesicles by number, `vesicles.0.radius`."""
        value = self.summary.get("parameters", {}).get(key)
        return default if value is None else value

    def box(self):
        """Lower and upper corner (3), periodic and mirror by axis; None without a summary."""
        lower, upper = self.parameter("domain.lower"), self.parameter("domain.upper")
        if lower is None or upper is None:
            return None
        none = [False, False, False]
        return np.array(lower), np.array(upper), self.parameter("domain.periodic", none), self.parameter("domain.mirror", none)

    def diagnostics(self):
        """diagnostics.csv as one dictionary of columns per vesicle, rows that all vesicles have; what is not defined is nan."""
        path = self.folder / "diagnostics.csv"
        if not path.exists():
            raise MissingData(f"{path} is missing ({self._why('output.diagnostics_every')})")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of a file without rows, and of a last row that is being written
            table = np.genfromtxt(path, delimiter=",", names=True, ndmin=1, invalid_raise=False)
        if table.dtype.names is None or table.size == 0:
            raise MissingData(f"{path} has no rows yet")
        courses = [table[table["vesicle"] == v] for v in np.unique(table["vesicle"])]
        rows = min(len(course) for course in courses)
        return [{name: course[name][:rows] for name in table.dtype.names} for course in courses]

    def membrane_times(self):
        return self._times("vesicle", "output.vesicle_every")

    def membranes(self, number):
        """Snapshot by its number: for each vesicle points (count, 3), tension (count), and faces (count, 4), the cells between the markers."""
        with self._open("vesicle", "output.vesicle_every") as file:
            group = file["steps"][sorted(file["steps"])[number]]
            names = sorted((n for n in group if n.startswith("vesicle_")), key=lambda n: int(n.split("_")[1]))
            return [_membrane(group[name]) for name in names]

    def fluid_times(self):
        return self._times("fluid", "output.fluid_every")

    def fluid(self, number):
        """Snapshot by its number: coordinates of the cell centres by axis, and the velocity (nz, ny, nx, 3), read when it is indexed."""
        file = self._open("fluid", "output.fluid_every")
        lower, upper, cells = (np.asarray(file.attrs[key]) for key in ("lower", "upper", "cells"))
        centres = [lower[d] + (np.arange(cells[d]) + 0.5) * (upper[d] - lower[d]) / cells[d] for d in range(3)]
        return centres, file["steps"][sorted(file["steps"])[number]]["velocity"]

    def _times(self, name, key):
        with self._open(name, key) as file:
            return np.array([float(file["steps"][step].attrs["time"]) for step in sorted(file["steps"])])

    def _open(self, name, key):
        path = self.folder / f"{name}.h5"
        if not path.exists():
            raise MissingData(f"{path} is missing ({self._why(key)})")
        try:
            file = h5py.File(path, "r")
        except OSError as error:
            raise MissingData(f"{path} is not readable: {error}") from None
        if not file.get("steps"):
            file.close()
            raise MissingData(f"{path} has no snapshots yet")
        return file

    def _why(self, key):
        """Why a file is not there."""
        every = self.parameter(key)
        if every == 0:
            return f"{key} = 0 in its scene"
        if self.summary.get("status") == "running":
            return f"nothing is written yet, t = {self.summary.get('time', 0):g}"
        return "or the program was built without HDF5" if every else "its scene is not known"


def _read_json(path):
    """An unreadable summary, or none, is an empty one: pictures need little of it."""
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return {}


def _membrane(group):
    rows, columns = int(group.attrs["latitudes"]), int(group.attrs["longitudes"])
    marker = np.arange(rows * columns).reshape(rows, columns)
    # The poles follow the markers and close the first and the last row.
    marker = np.vstack([np.full(columns, rows * columns), marker, np.full(columns, rows * columns + 1)])
    east = np.roll(marker, -1, axis=1)
    faces = np.stack([marker[:-1], marker[1:], east[1:], east[:-1]], axis=-1).reshape(-1, 4)
    return group["positions"][:], group["tension"][:], faces
