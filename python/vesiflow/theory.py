# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Theories of a vesicle in shear flow of rate 1.

Keller and Skalak's fluid ellipsoid (J. Fluid Mech. 120, 27, 1982), for prolates. Its shape is given and does not deform, and its membrane
velocity keeps areas only on the whole: a model at any reduced volume below 1.
The membrane moves as v = nu (-(a/b) z', (b/a) x') in the frame of the ellipsoid with semi-axes a (long) and b, which turns as
d theta/dt = -1/2 + C cos 2 theta. For C > 1/2 it tank-treads at cos 2 theta = 1/(2 C), otherwise it tumbles.
"""

import math

import numpy as np


def prolate_axes(reduced_volume):
    """Long and short semi-axis of the prolate of volume 4 pi/3, by bisection in the aspect ratio.

    Raises ValueError unless the reduced volume is in (0, 1).
    """
    if not 0 < reduced_volume < 1:
        raise ValueError(f"reduced_volume = {reduced_volume}: must be > 0 and < 1")

    def volume_ratio(aspect):
        e = math.sqrt(1 - aspect**-2)
        b = aspect ** (-1 / 3)
        area = 2 * math.pi * b * b * (1 + aspect * math.asin(e) / e)
        return (area / (4 * math.pi)) ** -1.5

    low, high = 1 + 1e-9, 100.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if volume_ratio(middle) > reduced_volume else (low, middle)
    return low ** (2 / 3), low ** (-1 / 3)


def excess_area(reduced_volume):
    return 4 * math.pi * (reduced_volume ** (-2 / 3) - 1)


def _shape_functions(a, b):
    """f1, f2, f3 of the article, in the notation of Abkarian et al. (Phys. Rev. Lett. 98, 188302, 2007)."""
    w, weight = np.polynomial.legendre.leggauss(80)
    w, weight = 0.5 * (w + 1), 0.5 * weight
    s = w**-2 - 1  # the integrand of g3' is smooth in w
    g3 = np.sum(weight * 2 * w**-3 * (a * a + s) ** -1.5 * (b * b + s) ** -2)
    z1 = 0.5 * (a / b - b / a)
    z2 = g3 * (a * a + b * b)
    return (b / a - a / b) ** 2, 4 * z1 * z1 * (1 - 2 / z2), -4 * z1 / z2


def turning(reduced_volume, ratio):
    """C of d theta/dt = -1/2 + C cos 2 theta."""
    a, b = prolate_axes(reduced_volume)
    f1, f2, f3 = _shape_functions(a, b)
    treading = -f3 / (f2 - ratio * f1)
    return 0.5 * (a * a - b * b) / (a * a + b * b) - 2 * a * b / (a * a + b * b) * treading


def inclination(reduced_volume, ratio):
    """Steady angle in degrees; nan where the ellipsoid tumbles."""
    c = turning(reduced_volume, ratio)
    return 0.5 * math.degrees(math.acos(0.5 / c)) if c >= 0.5 else math.nan


def half_period(reduced_volume, ratio):
    """Time of half a turn of a tumbling ellipsoid; nan where it tank-treads."""
    c = turning(reduced_volume, ratio)
    return math.pi / math.sqrt(0.25 - c * c) if abs(c) < 0.5 else math.nan


def phase_frequency(reduced_volume, ratio):
    """nu of the steady ellipsoid: Keller and Skalak's own frequency, that of the phase with which a point goes round."""
    a, b = prolate_axes(reduced_volume)
    c = turning(reduced_volume, ratio)
    f1, f2, f3 = _shape_functions(a, b)
    return abs(f3 / (f2 - ratio * f1)) * 0.5 / c if c >= 0.5 else math.nan  # times cos 2 theta


def frequency(reduced_volume, ratio):
    """Eq. (34) of the paper for the steady ellipsoid: the area mean of |r x v|/|r|^2 in the plane of the shear."""
    a, b = prolate_axes(reduced_volume)
    rate = phase_frequency(reduced_volume, ratio)
    mu, weight = np.polynomial.legendre.leggauss(200)  # cosine from the long axis
    phi = (np.arange(400) + 0.5) * math.pi / 200
    x = a * mu[:, None] * np.ones_like(phi)
    z = b * np.sqrt(1 - mu[:, None] ** 2) * np.cos(phi)
    area = weight[:, None] * b * np.sqrt(a * a * (1 - mu[:, None] ** 2) + b * b * mu[:, None] ** 2) * np.ones_like(phi)
    return float(rate * np.sum(area * (b / a * x * x + a / b * z * z) / (x * x + z * z)) / np.sum(area))


def quasi_spherical_inclination(reduced_volume, ratio):
    """Misbah (Phys. Rev. Lett. 96, 028104, 2006): an inextensible, deformable membrane to leading order in the excess area, so exact for a
    reduced volume near 1. Degrees; nan where it has no steady angle."""
    cosine = math.sqrt(excess_area(reduced_volume)) * (23 * ratio + 32) / (120 * math.sqrt(2 * math.pi / 15))
    return 0.5 * math.degrees(math.acos(cosine)) if cosine <= 1 else math.nan


def critical_ratio(reduced_volume):
    """Viscosity ratio at which the ellipsoid begins to tumble (C = 1/2)."""
    low, high = 0.1, 100.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if turning(reduced_volume, middle) > 0.5 else (low, middle)
    return low
