# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Lipid vesicles in viscous flow, in three dimensions: the libraries of Vesiflow as a package.

>>> import vesiflow
>>> simulation = vesiflow.Simulation({"domain": {"cells": 16, "lower": [-3, -3, -3], "upper": [3, 3, 3]},
...                                   "mesh": {"latitudes": 12}, "vesicles": {"reduced_volume": 0.9}})
>>> simulation.step()
>>> simulation.membranes[0].positions.shape
(288, 3)

- `vesiflow.vesicle`: spherical harmonics, surfaces, curvatures, forces, shapes. It knows no fluid.
- `vesiflow.fluid`: grid, elliptic solvers, Navier-Stokes and Stokes equations. It knows no vesicle.
- `vesiflow.coupling`: vesicles in a fluid, one step at a time, from parameters.
- `vesiflow.run`: scenes, runs with files, restart.
- `vesiflow.results`: what a run has written.

Each of them is loaded when it is first used, and can be imported alone. Lengths are in units of the effective radius r = (3V/4 pi)^(1/3),
times in 1/shear rate, stresses in mu_o times shear rate.
"""
from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from .errors import FileError, MissingData, ParameterError, SceneError, SimulationStopped, VesiflowError

if TYPE_CHECKING:
    from . import coupling, fluid, results, run, vesicle
    from .results import open
    from .run import Scene, Simulation

__all__ = ["FileError", "MissingData", "ParameterError", "Scene", "SceneError", "Simulation", "SimulationStopped", "VesiflowError",
           "coupling", "fluid", "results", "run", "theory", "vesicle"]  # and open, which "from vesiflow import *" must not put in the place of Python's

_MODULES = ("coupling", "fluid", "results", "run", "theory", "vesicle", "view")
_ELSEWHERE = {"Simulation": "run", "Scene": "run", "open": "results"}


def __getattr__(name: str) -> Any:
    """Modules and what comes from them are loaded when they are asked for."""
    if name in _MODULES:
        return importlib.import_module(f"{__name__}.{name}")
    if name in _ELSEWHERE:
        return getattr(importlib.import_module(f"{__name__}.{_ELSEWHERE[name]}"), name)
    if name == "__version__":
        return _version()
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__, "open"})


def _version() -> str:
    from . import _vesicle

    return _vesicle.version()
