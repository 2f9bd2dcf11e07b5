# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Forces that are functions of users, and how a simulation of vesiflow.coupling holds them."""
from __future__ import annotations

import weakref
from typing import Any, Callable, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


class ForcedSurface:
    """The membrane that a force is asked for: its arrays are new ones, of the geometry that the force is of. It can be read while the force is
    called."""

    def __init__(self, core: Any) -> None:
        self._core = core

    positions = property(lambda self: self._core.field("positions"), doc="Of the markers, shape (markers, 3).")
    normal = property(lambda self: self._core.field("normal"), doc="Outward unit normal, shape (markers, 3).")
    area_weight = property(lambda self: self._core.field("area_weight"), doc="Areas of the markers' cells, shape (markers,).")
    mean_curvature = property(lambda self: self._core.field("mean_curvature"), doc="Shape (markers,).")
    gaussian_curvature = property(lambda self: self._core.field("gaussian_curvature"), doc="Shape (markers,).")
    area = property(lambda self: self._core.area(), doc="Of the membrane.")
    volume = property(lambda self: self._core.volume(), doc="That it encloses.")


#: f(t, vesicle, surface): a force on the fluid per area of the membrane, (markers, 3), or three numbers for all markers, or None.
MembraneForce = Callable[[float, int, ForcedSurface], Optional[ArrayLike]]


class Forces:
    """The functions that a simulation calls. The library refers to this by weak references, so that a function may refer to the simulation and
    both go when nothing else does."""

    def __init__(self) -> None:
        self.on_membranes: list[MembraneForce] = []
        self.on_fluid: Optional[Callable] = None
        self.of_arrays = False

    def attach_membranes(self, core: Any) -> None:
        this = weakref.ref(self)

        def on_membrane(t: float, vesicle: int, surface: Any) -> Optional[Array]:
            forces = this()
            total = None
            for force in forces.on_membranes if forces else ():
                added = force(t, vesicle, ForcedSurface(surface))
                if added is not None:
                    total = np.asarray(added, dtype=float) if total is None else total + np.asarray(added, dtype=float)
            return total

        core.add_force(on_membrane)

    def attach_fluid(self, core: Any) -> None:
        this = weakref.ref(self)

        def on_fluid(*place: Any) -> Any:
            forces = this()
            return forces.on_fluid(*place) if forces and forces.on_fluid else (0.0, 0.0, 0.0)

        core.set_fluid_force(on_fluid if self.on_fluid else None, self.of_arrays)
