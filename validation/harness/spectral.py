# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Spherical harmonics on the marker mesh, in plain numpy: independent of the library, for what is read from files.

Fields have the shape (latitudes, longitudes, ...), latitudes from north to south at Gauss nodes; coefficients (order, degree, ...).
"""

import functools

import numpy as np


def legendre(degrees, cosine):
    """Fully normalised P_n^m (int |Y|^2 = 1, no Condon-Shortley phase): (order, degree, node)."""
    sine = np.sqrt(1 - cosine**2)
    p = np.zeros((degrees, degrees, len(cosine)))
    p[0, 0] = np.sqrt(1 / (4 * np.pi))
    for m in range(1, degrees):
        p[m, m] = np.sqrt((2 * m + 1) / (2 * m)) * sine * p[m - 1, m - 1]
    for m in range(degrees - 1):
        p[m, m + 1] = np.sqrt(2 * m + 3) * cosine * p[m, m]
        for n in range(m + 2, degrees):
            a, b = (np.sqrt((4 * k * k - 1) / (k * k - m * m)) for k in (n, n - 1))
            p[m, n] = a * (cosine * p[m, n - 1] - p[m, n - 2] / b)
    return p


def legendre_theta(p):
    """Derivatives with respect to theta, without dividing by sin theta."""
    degrees = p.shape[0]
    derivative = np.zeros_like(p)
    m, n = np.meshgrid(np.arange(degrees), np.arange(degrees), indexing="ij")
    below = np.sqrt(np.maximum((n + m) * (n - m + 1), 0))[..., None]
    above = np.sqrt(np.maximum((n - m) * (n + m + 1), 0))[..., None]
    derivative[1:] += 0.5 * below[1:] * p[:-1]
    derivative[:-1] -= 0.5 * above[:-1] * p[1:]
    derivative[0] = -above[0] * p[1] if degrees > 1 else 0  # P_n^{-1} = -P_n^1
    return derivative


def nodes(latitudes):
    cosine, weights = np.polynomial.legendre.leggauss(latitudes)
    return cosine[::-1], weights[::-1]


@functools.lru_cache(maxsize=32)
def table(degrees, latitudes, derivative=False):
    """P_n^m, or its derivative with respect to theta, at the nodes: (order, node, degree)."""
    p = legendre(degrees, nodes(latitudes)[0])
    return np.ascontiguousarray((legendre_theta(p) if derivative else p).transpose(0, 2, 1))


def analysis(values):
    latitudes, longitudes = values.shape[:2]
    flat = values.reshape(latitudes, longitudes, -1)
    by_order = np.fft.fft(flat, axis=1)[:, :latitudes].transpose(1, 0, 2) * (2 * np.pi / longitudes)
    weighted = table(latitudes, latitudes).transpose(0, 2, 1) * nodes(latitudes)[1]
    return (weighted @ by_order).reshape(latitudes, latitudes, *values.shape[2:])


def synthesis(coefficients, latitudes, derivative=None):
    """At the nodes of a mesh of so many latitudes; derivative: None, "theta" or "phi"."""
    degrees = coefficients.shape[0]
    order = np.arange(degrees)
    factor = np.where(order == 0, 1.0, 2.0) * (1j * order if derivative == "phi" else 1.0)
    flat = coefficients.reshape(degrees, degrees, -1) * factor[:, None, None]
    by_order = (table(degrees, latitudes, derivative == "theta") @ flat).transpose(1, 2, 0)
    angle = np.arange(2 * latitudes) * np.pi / latitudes
    values = (by_order @ np.exp(1j * order[:, None] * angle)).real
    return np.moveaxis(values, 1, 2).reshape(latitudes, 2 * latitudes, *coefficients.shape[2:])


def cut(coefficients, degrees):
    """Without the degrees from `degrees` on."""
    kept = coefficients.copy()
    kept[:, degrees:] = 0
    return kept


def on_mesh(points, latitudes):
    """Values at markers (and poles, dropped) as (latitudes, longitudes, components)."""
    return np.asarray(points)[: 2 * latitudes**2].reshape(latitudes, 2 * latitudes, -1)


def kept(velocity, degrees):
    return synthesis(cut(analysis(velocity), degrees), velocity.shape[0])


def tangents(positions):
    x = analysis(positions)
    return synthesis(x, positions.shape[0], "theta"), synthesis(x, positions.shape[0], "phi")


def paper_filter(positions, velocity):
    """Step 4 of the paper: U cut to 2/3 of the degrees along the normal, to 15 along the surface."""
    latitudes = positions.shape[0]
    normal = np.cross(*tangents(positions))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    shaping, along = kept(velocity, 2 * latitudes // 3), kept(velocity, min(15, latitudes))
    return along + np.sum((shaping - along) * normal, axis=-1, keepdims=True) * normal


def surface_divergence(positions, velocity):
    (x_theta, x_phi), (w_theta, w_phi) = tangents(positions), tangents(velocity)
    dot = lambda a, b: np.sum(a * b, axis=-1)  # noqa: E731
    e, f, g = dot(x_theta, x_theta), dot(x_theta, x_phi), dot(x_phi, x_phi)
    return (g * dot(x_theta, w_theta) - f * (dot(x_theta, w_phi) + dot(x_phi, w_theta)) + e * dot(x_phi, w_phi)) / (e * g - f * f)
