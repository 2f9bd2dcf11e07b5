# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Incompressible flow in a box: libfluid, which knows no vesicle.

Pressure and other scalars live at the centres of the cells, arrays [i, j, k] of the shape (nx, ny, nz). A velocity is three arrays x, y and z
at the centres of the faces normal to that axis, with one more point along it: x has the shape (nx + 1, ny, nz); the first and the last are on
walls, or on a periodic axis the same face twice.

>>> from vesiflow import fluid
>>> grid = fluid.Grid((0, 0, 0), (1, 1, 1), 16)
>>> flow = fluid.NavierStokes(grid, reynolds_number=1.0, boundary=lambda x, t: (1.0 if x[2] == 1 else 0.0, 0.0, 0.0))
>>> flow.step(0.01)
>>> flow.velocity.x.shape, flow.max_divergence() < 1e-11
((17, 16, 16), True)

Bad values raise ValueError with the value and what is allowed.
"""
from __future__ import annotations

from typing import Callable, NamedTuple, Optional, Sequence, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import not_built

try:
    from . import _fluid
except ImportError as error:
    raise not_built(error) from None

Array = NDArray[np.float64]
Point = tuple[float, float, float]
#: u(x, t): the velocity, three numbers, at a point x (a tuple of three) and time t.
VelocityFunction = Callable[[Point, float], Sequence[float]]

__all__ = ["EllipticSolver", "Grid", "NavierStokes", "Stokes", "Velocity", "max_divergence"]


class Velocity(NamedTuple):
    """The components of a vector at the faces, see the head of this module."""

    x: Array
    y: Array
    z: Array

    def at_cells(self) -> Array:
        """Means of the two faces of each cell: a new array of the shape (nx, ny, nz, 3)."""
        u, v, w = self
        return np.stack([(u[1:] + u[:-1]) / 2, (v[:, 1:] + v[:, :-1]) / 2, (w[:, :, 1:] + w[:, :, :-1]) / 2], axis=-1)


def _three(value, kind: type) -> list:
    return [kind(value)] * 3 if np.ndim(value) == 0 else [kind(v) for v in value]


T = TypeVar("T")


def _tuple_of(three: Sequence[T]) -> tuple[T, T, T]:
    x, y, z = three
    return x, y, z


class Grid:
    """A box cut into equal cells; axes end at walls, are periodic, or begin at a plane of symmetry (mirror).

    >>> grid = Grid((-1, -1, -1), (1, 1, 1), (8, 8, 16), periodic=(True, True, False))
    >>> grid.cells, grid.spacing
    ((8, 8, 16), (0.25, 0.25, 0.125))
    >>> x, y, z = grid.cell_centres()
    >>> x[0], z[-1]
    (-0.875, 0.9375)
    """

    def __init__(self, lower: Sequence[float], upper: Sequence[float], cells: Union[int, Sequence[int]],
                 periodic: Union[bool, Sequence[bool]] = False, mirror: Union[bool, Sequence[bool]] = False) -> None:
        self._core = _fluid.Grid(_three(lower, float), _three(upper, float), _three(cells, int), _three(periodic, bool), _three(mirror, bool))

    @property
    def lower(self) -> Point:
        """Lower corner."""
        return _tuple_of(self._core.lower)

    @property
    def upper(self) -> Point:
        """Upper corner."""
        return _tuple_of(self._core.upper)

    @property
    def cells(self) -> tuple[int, int, int]:
        """Number of cells along each axis."""
        return _tuple_of(self._core.cells)

    @property
    def periodic(self) -> tuple[bool, bool, bool]:
        """Which axes repeat."""
        return _tuple_of(self._core.periodic)

    @property
    def spacing(self) -> Point:
        """Mesh width along each axis."""
        return _tuple_of([(u - l) / n for l, u, n in zip(self.lower, self.upper, self.cells)])

    def cell_centres(self) -> tuple[Array, Array, Array]:
        """Coordinates of the centres of the cells along x, y and z."""
        return self._core.positions(0)

    def faces(self, axis: int) -> tuple[Array, Array, Array]:
        """Coordinates along x, y and z of the faces normal to an axis (0, 1 or 2), where that component of a velocity is."""
        if axis not in (0, 1, 2):
            raise ValueError(f"axis = {axis}: must be 0, 1 or 2")
        return self._core.positions(axis + 1)

    def velocity(self, function: Callable[[Array, Array, Array], Sequence[ArrayLike]]) -> Velocity:
        """Samples u(x, y, z) -> (ux, uy, uz), which takes arrays, at the faces.

        >>> u = Grid((0, 0, 0), (1, 1, 1), 4).velocity(lambda x, y, z: (z, 0 * y, 0 * z))
        >>> u.x[0, 0]
        array([0.125, 0.375, 0.625, 0.875])
        """
        components = []
        for axis in range(3):
            points = np.meshgrid(*self.faces(axis), indexing="ij")
            components.append(np.broadcast_to(np.asarray(function(*points)[axis], dtype=float), points[0].shape).copy(order="F"))
        return Velocity(*components)

    def __repr__(self) -> str:
        return f"<Grid of {' x '.join(map(str, self.cells))} cells, {self.lower} to {self.upper}>"


def max_divergence(grid: Grid, velocity: Sequence[ArrayLike]) -> float:
    """Greatest |div u| over the cells."""
    return _fluid.max_divergence(grid._core, [np.asarray(c, dtype=float) for c in velocity])


class EllipticSolver:
    """Solves alpha x - div(mu grad x) = b at the cells, homogeneous conditions on all walls.

    - `boundary`: "dirichlet" (x = 0) or "neumann" (no flux; with alpha = 0 the means of b and x are taken out);
    - `mu`: a number or an array (nx, ny, nz), > 0;
    - `solver`: "auto", "fft" (mu a number), "cholmod" (small grids) or "pcg".

    >>> grid = Grid((0, 0, 0), (1, 1, 1), 16)
    >>> b = np.random.default_rng(1).normal(size=(16, 16, 16))
    >>> x, report = EllipticSolver(grid, alpha=1.0, solver="fft").solve(b)
    >>> report["relative_residual"] < 1e-12
    True
    >>> y, _ = EllipticSolver(grid, alpha=1.0, solver="pcg").solve(b)
    >>> bool(np.abs(x - y).max() < 1e-9)
    True
    >>> EllipticSolver(grid, solver="jacobi")
    Traceback (most recent call last):
    ...
    ValueError: solver = "jacobi": allowed are auto, fft, cholmod, pcg
    """

    def __init__(self, grid: Grid, *, boundary: str = "neumann", alpha: float = 0.0, mu: Union[float, ArrayLike] = 1.0,
                 solver: str = "auto") -> None:
        self.grid = grid
        self._core = _fluid.ScalarSolver(grid._core, boundary, alpha, _coefficient(mu), solver)

    @property
    def name(self) -> str:
        """Of the solver that was taken, such as "fft" or "pcg+fft"."""
        return self._core.name()

    def solve(self, rhs: ArrayLike) -> tuple[Array, dict]:
        """x for b of the shape (nx, ny, nz), and a report: `iterations`, `converged`, `removed_mean` of b, `relative_residual` (largest)."""
        return self._core.solve(np.asarray(rhs, dtype=float))


def _coefficient(value):
    return float(value) if np.ndim(value) == 0 else np.asarray(value, dtype=float)


class Stokes:
    """The Stokes equations -div(mu (grad u + grad u^T)) + grad p = f, div u = 0, velocity and pressure together.

    `viscosity` is a number or an array (nx, ny, nz); `boundary` a function u(x, t) of the velocity of the walls (at t = 0), none where all axes
    are periodic.

    >>> grid = Grid((0, 0, 0), (1, 1, 1), 16, periodic=(True, True, False))
    >>> u, p, report = Stokes(grid, boundary=lambda x, t: (0.0, 0.0, 0.0)).solve(uniform_force=(8.0, 0, 0))
    >>> round(float(u.x[0, 0].max()), 2)  # 4 z (1 - z), a parabola of height 1
    1.0
    """

    def __init__(self, grid: Grid, viscosity: Union[float, ArrayLike] = 1.0, *, boundary: Optional[VelocityFunction] = None,
                 tolerance: float = 1e-8, max_iterations: int = 500) -> None:
        self.grid = grid
        self._core = _fluid.Stokes(grid._core, _coefficient(viscosity), boundary, tolerance, max_iterations)

    def solve(self, force: Optional[Sequence[ArrayLike]] = None, uniform_force: Sequence[float] = (0, 0, 0)) -> tuple[Velocity, Array, dict]:
        """Velocity, pressure (nx, ny, nz) of zero mean, and a report: `iterations`, `converged`, `residual`, `divergence`. The force is per
        volume: three arrays at the faces, and one that is the same everywhere."""
        arrays = None if force is None else [np.asarray(c, dtype=float) for c in force]
        velocity, pressure, report = self._core.solve(arrays, [float(f) for f in uniform_force])
        return Velocity(*velocity), pressure, report


class NavierStokes:
    """Re [du/dt + (u.grad)u] = -grad p + div(mu (grad u + grad u^T)) + f, div u = 0, by semi-implicit BDF2 and pressure correction.

    - `viscosity`: mu, a number or an array (nx, ny, nz);
    - `boundary`: u(x, t) on the walls, sampled once unless `unsteady`; none where all axes are periodic;
    - `inertia`: "full", "unsteady" (without convection) or "none" (Stokes flow in each step);
    - `viscous_treatment`: "explicit", "extrapolated" or "implicit", where mu is an array;
    - `velocity_solver`, `pressure_solver`: "auto", "fft", "cholmod", "pcg";
    - `precision`: "double", or "mixed" for a velocity solve in single precision, of what changes.

    `velocity` and `pressure` are views of the solver's arrays, read-only: they are of this time until the next step, after which they hold
    something else. Copy what you want to keep.
    """

    def __init__(self, grid: Grid, *, reynolds_number: float = 1.0, viscosity: Union[float, ArrayLike] = 1.0,
                 boundary: Optional[VelocityFunction] = None, unsteady: bool = False, inertia: str = "full",
                 viscous_treatment: str = "extrapolated", velocity_solver: str = "auto", pressure_solver: str = "fft",
                 precision: str = "double") -> None:
        self.grid = grid
        self._core = _fluid.NavierStokes(grid._core, reynolds_number, _coefficient(viscosity), inertia, viscous_treatment, velocity_solver,
                                         pressure_solver, precision, boundary, unsteady)

    def set_velocity(self, velocity: Union[VelocityFunction, Sequence[ArrayLike]]) -> None:
        """Starts anew at time zero from a function u(x, t), or three arrays at the faces (`Grid.velocity`). Of what is not free of divergence
        that part is taken which is."""
        if callable(velocity):
            self._core.set_velocity(velocity)
        else:
            self._core.start_from([np.asarray(c, dtype=float) for c in velocity])

    def set_force(self, force: Sequence[ArrayLike], uniform: Optional[Sequence[float]] = None) -> None:
        """Force per volume for the coming steps: three arrays at the faces, and one that is the same everywhere."""
        self._core.set_force([np.asarray(c, dtype=float) for c in force])
        if uniform is not None:
            self._core.set_uniform_force([float(f) for f in uniform])

    def step(self, dt: float) -> None:
        """Advances by dt. The interpreter's lock is released meanwhile."""
        self._core.step(dt)

    @property
    def velocity(self) -> Velocity:
        """u at the faces; read-only views, valid until the next step."""
        return Velocity(*self._core.velocity())

    @property
    def pressure(self) -> Array:
        """p at the cells, of zero mean; read-only view, valid until the next step."""
        return self._core.pressure()

    @property
    def time(self) -> float:
        """Time of the state."""
        return self._core.time

    @property
    def steps(self) -> int:
        """Number of steps since time zero."""
        return self._core.steps

    @property
    def solver_names(self) -> tuple[str, str]:
        """Of the velocity and of the pressure."""
        return self._core.solver_names()

    def max_divergence(self) -> float:
        """Greatest |div u|: round-off."""
        return self._core.max_divergence()
