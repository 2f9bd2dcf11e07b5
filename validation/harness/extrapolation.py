# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Limits of a spacing that goes to zero."""

import math


def weights_at_zero(spacings):
    """Of the polynomial through values at these spacings: its value at zero is the sum of weights times values."""
    return [math.prod(other / (other - h) for other in spacings if other != h) for h in spacings]


def at_zero(spacings, values):
    return sum(weight * value for weight, value in zip(weights_at_zero(spacings), values))
