# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Membranes on finer meshes, for pictures: their spherical-harmonic expansions at more points, in NumPy alone.

What is drawn between the markers is then the surface that was computed, and not a plane facet. Where the compiled modules are there,
vesiflow.vesicle.evaluate gives the same values; pictures do without, as they are drawn where only a program was built.
"""
from __future__ import annotations

import math

import numpy as np


def legendre(degrees, x):
    """P_n^m(x), normalised to 1 over [-1, 1], as a list over m of arrays (degrees - m, points)."""
    sine = np.sqrt(1 - x * x)
    table, diagonal = [], np.full_like(x, math.sqrt(0.5))
    for m in range(degrees):
        if m > 0:
            diagonal = math.sqrt((2 * m + 1) / (2 * m)) * sine * diagonal
        rows = [diagonal]
        for n in range(m + 1, degrees):
            a = math.sqrt((4 * n * n - 1) / (n * n - m * m))
            b = math.sqrt(((n - 1) ** 2 - m * m) / (4 * (n - 1) ** 2 - 1)) if n > m + 1 else 0.0
            rows.append(a * (x * rows[-1] - b * (rows[-2] if n > m + 1 else 0.0)))
        table.append(np.array(rows))
    return table


def refined(values, colatitudes, longitudes):
    """Values (N, 2N, fields) at the markers as values (colatitudes, longitudes, fields): those of the expansion of N degrees at these
    colatitudes, poles included, and at so many equispaced longitudes, an even number >= 2N.

    >>> nodes = np.arccos(np.polynomial.legendre.leggauss(8)[0])[::-1]
    >>> f = np.cos(nodes)[:, None] ** 3 * np.ones(16)
    >>> refined(f[..., None], np.array([0.0, 1.0]), 16)[:, 0, 0] - np.cos([0.0, 1.0]) ** 3 < 1e-14
    array([ True,  True])
    """
    rows, columns = values.shape[:2]
    x, weight = np.polynomial.legendre.leggauss(rows)
    at_markers, at_points = legendre(rows, x[::-1]), legendre(rows, np.cos(colatitudes))
    spectrum = np.fft.rfft(values, axis=1)
    fine = np.zeros((len(colatitudes), longitudes // 2 + 1, values.shape[2]), complex)
    for m in range(rows):
        coefficients = np.einsum("nj,j,jf->nf", at_markers[m], weight[::-1], spectrum[:, m])
        fine[:, m] = np.einsum("nj,nf->jf", at_points[m], coefficients)
    return np.fft.irfft(fine, n=longitudes, axis=1) * (longitudes / columns)


def smooth(membrane, rows):
    """A membrane as results.Run.membranes has it (points with the poles, tension, faces) on a mesh of that many rows from pole to pole;
    as it is where that would be no finer."""
    points, tension, faces = membrane
    latitudes = math.isqrt((len(points) - 2) // 2)
    if 2 * latitudes**2 + 2 != len(points) or rows <= latitudes:
        return membrane
    columns = 2 * rows
    markers = np.concatenate([points, tension[:, None]], axis=1)[:-2].reshape(latitudes, 2 * latitudes, 4)
    colatitudes = np.linspace(0, math.pi, rows + 1)
    values = refined(markers, colatitudes, columns)
    values[0], values[-1] = values[0].mean(axis=0), values[-1].mean(axis=0)  # a pole is one point, but for round-off
    flat = values.reshape(-1, 4)
    number = np.arange(len(flat)).reshape(rows + 1, columns)
    east = np.roll(number, -1, axis=1)
    faces = np.stack([number[:-1], number[1:], east[1:], east[:-1]], axis=-1).reshape(-1, 4)
    return flat[:, :3], flat[:, 3], faces
