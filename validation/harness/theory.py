# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Theories of a vesicle in shear flow: those of the package, python/vesiflow/theory.py, which is found without a build too."""
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "python"))
from vesiflow.theory import (  # noqa: E402, F401
    critical_ratio,
    excess_area,
    frequency,
    half_period,
    inclination,
    phase_frequency,
    prolate_axes,
    quasi_spherical_inclination,
    turning,
)
