# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a run has written: the files that docs/results.md describes, in one place.

>>> import vesiflow
>>> run = vesiflow.open("out/tank_treading_coarse")  # doctest: +SKIP
>>> run.status, run.table()["inclination_angle_deg"][-1]  # doctest: +SKIP
('completed', 27.69)
>>> run.snapshots[-1].membranes[0].tension.max()  # doctest: +SKIP
28.3

Snapshots are read when an array of theirs is asked for. Lengths are in effective radii, times in 1/shear rate. What a run has not written
raises MissingData, whose message says why.
"""
from __future__ import annotations

import json
import os
import warnings
from pathlib import Path
from typing import Any, Callable, Sequence, Union

import numpy as np

from .errors import MissingData
from .table import Table

__all__ = ["FluidSnapshot", "MembraneRecord", "MissingData", "Run", "Snapshot", "Snapshots"]


def open(folder: Union[str, "os.PathLike[str]"]) -> Run:  # noqa: A001: vesiflow.open reads as it should
    """The results in the folder of a run, under way or ended."""
    return Run(folder)


class _Snapshot:
    """One time of a run. Its arrays are read from the file when they are asked for, each time anew."""

    def __init__(self, run: Run, number: int) -> None:
        self._run, self.number = run, number

    @property
    def time(self) -> float:
        """In 1/shear rate."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"<snapshot {self.number} of {self._run.folder}, t = {self.time:.6g}>"


class MembraneRecord:
    """A membrane in a snapshot. Arrays are at the markers, as those of vesiflow.coupling.Membrane: the poles that files have are left out."""

    def __init__(self, read: Callable[[str], np.ndarray], latitudes: int, longitudes: int) -> None:
        self._read, self.latitudes, self.longitudes = read, latitudes, longitudes

    def _markers(self, name: str) -> np.ndarray:
        return self._read(name)[: self.latitudes * self.longitudes]

    positions = property(lambda self: self._markers("positions"), doc="Shape (markers, 3).")
    velocity = property(lambda self: self._markers("velocity"), doc="Of the fluid at the markers, shape (markers, 3).")
    force = property(lambda self: self._markers("force"), doc="The membrane's own force per area, shape (markers, 3).")
    tension = property(lambda self: self._markers("tension"), doc="Shape (markers,).")
    mean_curvature = property(lambda self: self._markers("mean_curvature"), doc="Shape (markers,).")
    gaussian_curvature = property(lambda self: self._markers("gaussian_curvature"), doc="Shape (markers,).")
    local_area_error = property(lambda self: self._markers("local_area_error"), doc="Shape (markers,).")

    def surface(self):
        """A vesiflow.vesicle.Surface of the same markers."""
        from .vesicle import Surface

        return Surface(self.positions)


class Snapshot(_Snapshot):
    """The membranes at one time."""

    @property
    def time(self) -> float:
        """In 1/shear rate."""
        return float(self._run.membrane_times()[self.number])

    @property
    def membranes(self) -> list[MembraneRecord]:
        """By number."""
        with self._run._open("vesicle", "output.vesicle_every") as file:
            group = self._run._step("vesicle", file, self.number)
            shapes = [(name, int(group[name].attrs["latitudes"]), int(group[name].attrs["longitudes"])) for name in _vesicles_of(group)]
        return [MembraneRecord(self._reader(name), latitudes, longitudes) for name, latitudes, longitudes in shapes]

    def _reader(self, vesicle: str) -> Callable[[str], np.ndarray]:
        def read(name: str) -> np.ndarray:
            with self._run._open("vesicle", "output.vesicle_every") as file:
                return self._run._step("vesicle", file, self.number)[vesicle][name][:]

        return read


class FluidSnapshot(_Snapshot):
    """The fluid at one time, at the centres of the cells, in single precision."""

    def _array(self, name: str) -> np.ndarray:
        with self._run._open("fluid", "output.fluid_every") as file:
            return self._run._step("fluid", file, self.number)[name][:]

    @property
    def time(self) -> float:
        """In 1/shear rate."""
        return float(self._run.fluid_times()[self.number])

    @property
    def velocity(self) -> np.ndarray:
        """Shape (nx, ny, nz, 3)."""
        return self._array("velocity").transpose(2, 1, 0, 3)

    @property
    def pressure(self) -> np.ndarray:
        """Shape (nx, ny, nz)."""
        return self._array("pressure").transpose(2, 1, 0)

    @property
    def cell_centres(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Coordinates along x, y and z."""
        x, y, z = self._run.fluid(self.number)[0]
        return x, y, z


class Snapshots(Sequence):
    """Snapshots by number, the last is -1."""

    def __init__(self, run: Run, kind: type, times: Callable[[], np.ndarray]) -> None:
        self._run, self._kind, self._times = run, kind, times

    @property
    def times(self) -> np.ndarray:
        """Of each, shape (snapshots,)."""
        return self._times()

    def __len__(self) -> int:
        return len(self._times())

    def __getitem__(self, number):
        count = len(self)
        if isinstance(number, slice):
            return [self._kind(self._run, i) for i in range(*number.indices(count))]
        if not -count <= number < count:
            raise IndexError(f"there is no snapshot {number}: there are {count}")
        return self._kind(self._run, number % count)


class Run:
    """The folder of a run, under way or ended."""

    def __init__(self, folder: Union[str, "os.PathLike[str]"]) -> None:
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise MissingData(f"{self.folder} is not a folder")
        names = ("summary.json", "diagnostics.csv", "vesicle.h5")
        if not any((self.folder / name).exists() for name in names):
            raise MissingData(f"{self.folder} holds no run: none of {', '.join(names)} is there")
        self.summary = _read_json(self.folder / "summary.json")
        self._listed: dict[str, tuple[list[str], list[str]]] = {}

    @property
    def status(self) -> str:
        """As in summary.json: "running", "completed", "stopped" ...; "unknown" without a summary."""
        return self.summary.get("status", "unknown")

    @property
    def vesicles(self) -> list[dict[str, Any]]:
        """The last numbers of each vesicle, by the names of docs/results.md."""
        return self.summary.get("vesicles", [])

    @property
    def checkpoint(self) -> Path:
        """The file to go on from: vesiflow.Simulation.restart(run.checkpoint)."""
        path = self.folder / "checkpoint.h5"
        if not path.exists():
            raise MissingData(f"{path} is missing ({self._why('output.checkpoint_every')})")
        return path

    @property
    def scene(self) -> dict[str, Any]:
        """Every key of the scene with the value that was used, by its dotted name."""
        return dict(self.summary.get("parameters", {}))

    @property
    def snapshots(self) -> Snapshots:
        """Of the membranes."""
        return Snapshots(self, Snapshot, self.membrane_times)

    @property
    def fluid_snapshots(self) -> Snapshots:
        """Of the fluid."""
        return Snapshots(self, FluidSnapshot, self.fluid_times)

    def table(self) -> Table:
        """diagnostics.csv: a dictionary of arrays, a row for each vesicle at each time."""
        courses = self.diagnostics()
        stacked = {name: np.stack([course[name] for course in courses], axis=1).ravel() for name in courses[0]}
        return Table(stacked)

    def __repr__(self) -> str:
        return f"<Run {self.folder}: {self.status}>"

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
            try:
                table = np.genfromtxt(path, delimiter=",", names=True, ndmin=1, invalid_raise=False)
            except (OSError, ValueError) as error:  # bytes that are no text among them
                raise MissingData(f"{path} is not readable: {error}") from None
        if table.dtype.names is None or table.size == 0:
            raise MissingData(f"{path} has no rows yet")
        if "vesicle" not in table.dtype.names:
            raise MissingData(f"{path} is damaged: it has no column vesicle")
        courses = [table[table["vesicle"] == v] for v in np.unique(table["vesicle"])]
        rows = min(len(course) for course in courses)
        return [{name: course[name][:rows] for name in table.dtype.names} for course in courses]

    def membrane_times(self):
        """Of the snapshots of the membranes."""
        return self._times("vesicle", "output.vesicle_every")

    def membranes(self, number):
        """Snapshot by its number: for each vesicle points (count, 3), tension (count), and faces (count, 4), the cells between the markers."""
        with self._open("vesicle", "output.vesicle_every") as file:
            group = self._step("vesicle", file, number)
            return [_membrane(group[name]) for name in _vesicles_of(group)]

    def fluid_times(self):
        """Of the snapshots of the fluid."""
        return self._times("fluid", "output.fluid_every")

    def fluid(self, number):
        """Snapshot by its number: coordinates of the cell centres by axis, and the velocity (nz, ny, nx, 3), read when it is indexed."""
        file = self._open("fluid", "output.fluid_every")
        lower, upper, cells = (np.asarray(file.attrs[key]) for key in ("lower", "upper", "cells"))
        centres = [lower[d] + (np.arange(cells[d]) + 0.5) * (upper[d] - lower[d]) / cells[d] for d in range(3)]
        return centres, self._step("fluid", file, number)["velocity"]

    def _times(self, name, key):
        with self._open(name, key) as file:
            return np.array([float(file["steps"][step].attrs["time"]) for step in self._steps(name, file)])

    def _steps(self, name, file):
        """Names of the snapshots in the order of time, without those whose file is gone or cannot be read."""
        listed = sorted(file["steps"])
        if self._listed.get(name, ([], []))[0] != listed:
            self._listed[name] = listed, [step for step in listed if _is_readable(file["steps"], step)]
        return self._listed[name][1]

    def _step(self, name, file, number):
        """The group of a snapshot by its number."""
        path, readable = self.folder / f"{name}.h5", self._steps(name, file)
        if not readable:
            raise MissingData(f"{path} has no snapshot that can be read: its files in snapshots/ are gone or damaged")
        step = readable[number]
        try:
            return file["steps"][step]
        except (KeyError, OSError) as error:
            raise MissingData(f"snapshot {step} of {path} cannot be read: {error}") from None

    def _open(self, name, key):
        path = self.folder / f"{name}.h5"
        if not path.exists():
            raise MissingData(f"{path} is missing ({self._why(key)})")
        try:
            import h5py
        except ImportError:
            raise MissingData(f"{path} cannot be read without h5py (Debian: python3-h5py)") from None
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
        found = json.loads(path.read_text())
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


def _is_readable(steps, name):
    """Whether the file that a snapshot is in can be opened."""
    try:
        return steps[name] is not None
    except (KeyError, OSError):
        return False


def _vesicles_of(group):
    return sorted((name for name in group if name.startswith("vesicle_")), key=lambda name: int(name.split("_")[1]))


def _membrane(group):
    rows, columns = int(group.attrs["latitudes"]), int(group.attrs["longitudes"])
    marker = np.arange(rows * columns).reshape(rows, columns)
    # The poles follow the markers and close the first and the last row.
    marker = np.vstack([np.full(columns, rows * columns), marker, np.full(columns, rows * columns + 1)])
    east = np.roll(marker, -1, axis=1)
    faces = np.stack([marker[:-1], marker[1:], east[1:], east[:-1]], axis=-1).reshape(-1, 4)
    return group["positions"][:], group["tension"][:], faces
