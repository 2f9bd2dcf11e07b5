# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a run has written (docs/results.md): numbers, courses, membranes."""

import csv
import json
import math

import numpy as np


def summary(folder):
    file = folder / "summary.json"
    return json.loads(file.read_text()) if file.exists() else None


def folders(of):
    """Those in a folder that hold a run, by name."""
    return sorted(file.parent for file in of.glob("*/summary.json"))


def course(folder):
    """diagnostics.csv as arrays by column; what is not defined is nan."""
    with open(folder / "diagnostics.csv") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) if row[key] else math.nan for row in rows]) for key in rows[0]}


def last_time(folder):
    """Time of the last row, or 0."""
    file = folder / "diagnostics.csv"
    if not file.exists():
        return 0.0
    lines = file.read_text().splitlines()
    try:
        return float(lines[-1].split(",")[1])
    except (IndexError, ValueError):
        return 0.0


def membranes(folder, times=None):
    """Snapshots nearest to the times (all if none are given): list of dictionaries with time, points, faces."""
    import h5py

    result = []
    with h5py.File(folder / "vesicle.h5", "r") as file:
        steps = sorted(file["steps"])
        at = np.array([file["steps"][s].attrs["time"] for s in steps])
        chosen = range(len(steps)) if times is None else [int(np.argmin(abs(at - t))) for t in times]
        for index in chosen:
            group = file["steps"][steps[index]]["vesicle_0"]
            rows, columns = int(group.attrs["latitudes"]), int(group.attrs["longitudes"])
            result.append({"time": float(at[index]), "points": group["positions"][:], "tension": group["tension"][:],
                           "mean_curvature": group["mean_curvature"][:],
                           "latitudes": rows, "longitudes": columns, "faces": _faces(rows, columns)})
    return result


def _faces(rows, columns):
    """Cells between the markers; the two poles, which follow the markers, close the first and the last row."""
    marker = np.arange(rows * columns).reshape(rows, columns)
    marker = np.vstack([np.full(columns, rows * columns), marker, np.full(columns, rows * columns + 1)])
    east = np.roll(marker, -1, axis=1)
    return np.stack([marker[:-1], marker[1:], east[1:], east[:-1]], axis=-1).reshape(-1, 4)


def section(membrane, normal, position=0.0):
    """Where the membrane crosses a plane: segments (count, 2 ends, the two other coordinates)."""
    points, faces = membrane["points"], membrane["faces"]
    other = [d for d in range(3) if d != normal]
    segments = []
    for triangles in (points[faces[:, [0, 1, 2]]], points[faces[:, [0, 2, 3]]]):
        start, end = triangles, np.roll(triangles, -1, axis=1)
        cuts = (start[:, :, normal] >= position) != (end[:, :, normal] >= position)
        start, end = start[cuts], end[cuts]
        fraction = (start[:, normal] - position) / (start[:, normal] - end[:, normal])
        segments.append((start + fraction[:, None] * (end - start))[:, other].reshape(-1, 2, 2))
    return np.concatenate(segments)


def unwrapped(angle_deg):
    """Inclinations in (-90, 90] as a continuous angle, starting where they do."""
    valid = np.where(np.isnan(angle_deg), 0.0, angle_deg)
    return np.unwrap(valid, period=180.0)


def turned(degrees):
    """A difference of inclinations, in (-90, 90]."""
    return -((-degrees + 90.0) % 180.0 - 90.0)


def thinned(times, *columns, count=61):
    """At most `count` rows, equally spaced in time, rounded for storage."""
    chosen = np.unique(np.searchsorted(times, np.linspace(times[0], times[-1], count) - 1e-9).clip(0, len(times) - 1))
    return [[rounded(float(v)) for v in column[chosen]] for column in (times, *columns)]


def rounded(value, digits=6):
    if isinstance(value, float):
        return float(f"{value:.{digits}g}") if math.isfinite(value) else None
    if isinstance(value, np.ndarray):
        return rounded(value.tolist(), digits)
    if isinstance(value, np.floating):
        return rounded(float(value), digits)
    if isinstance(value, np.integer):
        return int(value)
    if isinstance(value, (list, tuple)):
        return [rounded(v, digits) for v in value]
    if isinstance(value, dict):
        return {k: rounded(v, digits) for k, v in value.items()}
    return value
