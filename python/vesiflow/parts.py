# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a simulation of vesiflow.coupling has: its membranes and its fluid, as views."""
from __future__ import annotations

from typing import TYPE_CHECKING, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from .fluid import Grid, Velocity

if TYPE_CHECKING:
    from .coupling import Simulation

Array = NDArray[np.float64]


class Membrane:
    """A membrane of a simulation. Its arrays are views of the simulation's memory, read-only: they are of the present time until the next step,
    and live as long as they are referred to. Copy what you want to keep: `membrane.positions.copy()`."""

    def __init__(self, simulation: Simulation, index: int) -> None:
        self._simulation, self.index = simulation, index

    def _array(self, name: str) -> Array:
        return self._simulation._core_at_rest().membrane_array(self.index, name)

    @property
    def latitudes(self) -> int:
        """N, of 2 N^2 markers."""
        return self._simulation._core_at_rest().latitudes(self.index)

    @property
    def positions(self) -> Array:
        """Of the markers, shape (markers, 3), in effective radii."""
        return self._array("positions")

    @property
    def velocity(self) -> Array:
        """Of the fluid at the markers in the last step, shape (markers, 3)."""
        return self._array("velocity")

    @property
    def force(self) -> Array:
        """The membrane's own force on the fluid per area in the last step, shape (markers, 3), without gravity and repulsion. Zero before
        the first step."""
        return self._array("force")

    @property
    def tension(self) -> Array:
        """Shape (markers,), of the last step; zero before the first."""
        return self._array("tension")

    @property
    def mean_curvature(self) -> Array:
        """Mean of the principal curvatures, shape (markers,)."""
        return self._array("mean_curvature")

    @property
    def gaussian_curvature(self) -> Array:
        """Product of the principal curvatures, shape (markers,)."""
        return self._array("gaussian_curvature")

    @property
    def normal(self) -> Array:
        """Outward unit normal, shape (markers, 3)."""
        return self._array("normal")

    @property
    def area_weight(self) -> Array:
        """Areas of the markers' cells, shape (markers,): weights of integrals over the membrane."""
        return self._array("area_weight")

    @property
    def local_area_error(self) -> Array:
        """dA/dA0 - 1 against the target areas, shape (markers,): a new array."""
        return self._array("area_weight") / self._array("target_areas") - 1

    def surface(self):
        """A vesiflow.vesicle.Surface of its own with the same markers, which stays as it is."""
        from .vesicle import Surface

        return Surface(self.positions)

    def __repr__(self) -> str:
        return f"<Membrane {self.index} of {self._simulation!r}>"


class Membranes(Sequence[Membrane]):
    """The membranes of a simulation, by number."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation

    def __len__(self) -> int:
        return self._simulation._core.vesicle_count()

    def __getitem__(self, index):
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        if not -len(self) <= index < len(self):
            raise IndexError(f"there is no membrane {index}: there are {len(self)}")
        return Membrane(self._simulation, index % len(self))


class Fluid:
    """The fluid of a simulation. Its arrays are views, as those of `Membrane`."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation

    @property
    def velocity(self) -> Velocity:
        """Three arrays at the faces of the grid."""
        return Velocity(*self._simulation._core_at_rest().velocity())

    @property
    def pressure(self) -> Array:
        """At the centres of the cells, shape (nx, ny, nz), of zero mean, in mu_o times shear rate."""
        return self._simulation._core_at_rest().pressure()

    @property
    def viscosity(self) -> Optional[Array]:
        """The field of viscosity of the last step, shape (nx, ny, nz); None where there is none: 1 everywhere, or sharp membranes."""
        return self._simulation._core_at_rest().viscosity()

    @property
    def grid(self) -> Grid:
        """With the coordinates of the points."""
        p = self._simulation.parameters
        return Grid(p["domain.lower"], p["domain.upper"], p["domain.cells"], p["domain.periodic"], p["domain.mirror"])

    def max_divergence(self) -> float:
        """Greatest |div u|: round-off when all is well, but for sharp membranes."""
        return self._simulation._core_at_rest().max_divergence()
