# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Closed membranes by spherical harmonics: libvesicle, which knows no fluid.

A surface is given by its markers on a grid of N Gauss-Legendre colatitudes by 2N longitudes. Marker `j * 2N + i` is at colatitude j, counted
from the north pole, and longitude i. Scalars at the markers have the shape (markers,), vectors (markers, 3). Lengths are in effective radii
unless you choose others; curvatures are in their inverse.

Coefficients f_n^m of a scalar are complex arrays [n, m] of the shape (degrees, degrees), zero for m > n; of several fields [n, m, field]. The
harmonics are fully normalised, without Condon-Shortley phase, and orders m < 0 follow as fields are real.

>>> from vesiflow import vesicle
>>> surface = vesicle.prolate(0.9, latitudes=24)
>>> round(surface.volume, 9), round(surface.reduced_volume, 9)
(4.188790205, 0.9)
>>> surface.mean_curvature.shape
(1152,)

Bad values raise ValueError with the value and what is allowed.
"""
from __future__ import annotations

import math
import os
from typing import NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import FileError, not_built

try:
    from . import _vesicle
except ImportError as error:
    raise not_built(error) from None

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

__all__ = ["Equilibrium", "MeshFit", "SphereGrid", "SphericalHarmonics", "Surface", "biconcave_disc", "ellipsoid", "equilibrium_shape", "evaluate", "excess_area", "fit_mesh",
           "from_coefficients", "from_mesh", "oblate", "perturbed_sphere", "prolate", "read_coefficients", "read_mesh", "reduced_volume",
           "sphere", "spheroid", "write_coefficients"]


def _latitudes_of(markers: int) -> int:
    latitudes = math.isqrt(max(markers, 0) // 2)
    if latitudes < 4 or 2 * latitudes**2 != markers:
        raise ValueError(f"positions have {markers} rows; there must be 2 N^2 markers for N latitudes, N from 4 to 512")
    return latitudes


class SphereGrid:
    """N Gauss-Legendre colatitudes by N_phi equispaced longitudes, 2N unless told; poles are not among the points.

    >>> grid = SphereGrid(16)
    >>> grid.latitudes, grid.longitudes, grid.size
    (16, 32, 512)
    """

    def __init__(self, latitudes: int, longitudes: Optional[int] = None) -> None:
        self._core = _vesicle.SphereGrid(latitudes) if longitudes is None else _vesicle.SphereGrid(latitudes, longitudes)

    @property
    def latitudes(self) -> int:
        """N."""
        return self._core.latitudes

    @property
    def longitudes(self) -> int:
        """N_phi."""
        return self._core.longitudes

    @property
    def size(self) -> int:
        """Number of markers."""
        return self._core.size

    @property
    def colatitude(self) -> Array:
        """theta, shape (latitudes,), radians from the north pole; read-only."""
        return self._core.colatitude

    @property
    def longitude(self) -> Array:
        """phi, shape (longitudes,), radians."""
        return 2 * np.pi / self.longitudes * np.arange(self.longitudes)

    @property
    def weight(self) -> Array:
        """Gauss weights, shape (latitudes,), which sum to 2; read-only."""
        return self._core.weight

    @property
    def angles(self) -> tuple[Array, Array]:
        """theta and phi of each marker, both of shape (markers,)."""
        theta, phi = np.meshgrid(self.colatitude, self.longitude, indexing="ij")
        return theta.ravel(), phi.ravel()

    @property
    def directions(self) -> Array:
        """Unit vectors of the markers on the sphere of parameters, shape (markers, 3)."""
        theta, phi = self.angles
        return np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)


def _with_fields(values: ArrayLike, axes: int, dtype: type) -> tuple[np.ndarray, bool]:
    """With an axis of fields at the end, and whether it was added."""
    array: np.ndarray = np.asarray(values, dtype=dtype)
    return (array[..., None], True) if array.ndim == axes else (array, False)


class SphericalHarmonics:
    """Transforms between values at the markers and coefficients, for degrees n < `degrees` (as many as latitudes unless told).

    >>> grid = SphereGrid(16)
    >>> harmonics = SphericalHarmonics(grid)
    >>> theta, phi = grid.angles
    >>> f = np.sin(theta) ** 2 * np.cos(2 * phi)
    >>> c = harmonics.analysis(f)
    >>> bool(np.abs(harmonics.synthesis(c) - f).max() < 1e-14)
    True
    >>> [(int(n), int(m)) for n, m in np.argwhere(np.abs(c) > 1e-14)]
    [(2, 2)]
    """

    def __init__(self, grid: Union[SphereGrid, int], degrees: Optional[int] = None) -> None:
        self.grid = grid if isinstance(grid, SphereGrid) else SphereGrid(grid)
        self._core = _vesicle.SphericalHarmonics(degrees or self.grid.latitudes, self.grid._core)

    @property
    def degrees(self) -> int:
        """Number of degrees."""
        return self._core.degrees

    def analysis(self, values: ArrayLike) -> Complex:
        """Coefficients of values of shape (markers,) or (markers, fields)."""
        array, alone = _with_fields(values, 1, float)
        coefficients = self._core.analysis(array)
        return coefficients[..., 0] if alone else coefficients

    def synthesis(self, coefficients: ArrayLike) -> Array:
        """Values at the markers of coefficients of shape (degrees, degrees) or (degrees, degrees, fields)."""
        array, alone = _with_fields(coefficients, 2, complex)
        values = self._core.synthesis(array)
        return values[:, 0] if alone else values

    def gradient(self, coefficients: ArrayLike) -> tuple[Array, Array]:
        """Partial derivatives by theta and by phi at the markers."""
        array, alone = _with_fields(coefficients, 2, complex)
        theta, phi = self._core.gradient(array)
        return (theta[:, 0], phi[:, 0]) if alone else (theta, phi)


def evaluate(coefficients: ArrayLike, directions: ArrayLike) -> Array:
    """Values of an expansion at any points of the unit sphere, poles included.

    `coefficients` has the shape (degrees, degrees) or (degrees, degrees, fields), `directions` (points, 3) with rows of length 1. The result
    has the shape (points,) or (points, fields).

    >>> ball = sphere(latitudes=8, radius=2)
    >>> evaluate(ball.coefficients, [[0, 0, 1]]).round(12) + 0.0
    array([[0., 0., 2.]])
    """
    array, alone = _with_fields(coefficients, 2, complex)
    values = _vesicle.evaluate(array, np.asarray(directions, dtype=float))
    return values[:, 0] if alone else values


class Surface:
    """A closed surface with its geometry, from the positions of its 2 N^2 markers.

    Arrays of a surface are views of the library's, read-only, and live as long as they are referred to. `update` changes them in place: copy
    what you want to keep.

    >>> ball = sphere(latitudes=16, radius=2)
    >>> bool(np.allclose(ball.mean_curvature, 1 / 2)), bool(np.allclose(ball.gaussian_curvature, 1 / 4))
    (True, True)
    """

    def __init__(self, positions: ArrayLike) -> None:
        positions = np.asarray(positions, dtype=float)
        if positions.ndim != 2 or positions.shape[1] != 3:
            raise ValueError(f"positions have the shape {positions.shape}; it must be (markers, 3)")
        self._core = _vesicle.Surface(_latitudes_of(len(positions)))
        self.update(positions)

    def update(self, positions: ArrayLike) -> None:
        """Takes other positions, shape (markers, 3), of as many markers. Raises ValueError for positions that are not finite, or a mesh that
        has folded or collapsed."""
        self._core.update(np.asarray(positions, dtype=float))

    @property
    def grid(self) -> SphereGrid:
        """Where the markers are on the sphere of parameters."""
        return SphereGrid(self.latitudes)

    @property
    def latitudes(self) -> int:
        """N."""
        return self._core.grid.latitudes

    @property
    def positions(self) -> Array:
        """X, shape (markers, 3); read-only view."""
        return self._core.field("positions")

    @property
    def normal(self) -> Array:
        """Outward unit normal, shape (markers, 3); read-only view."""
        return self._core.field("normal")

    @property
    def tangent_theta(self) -> Array:
        """dX/dtheta, shape (markers, 3); read-only view."""
        return self._core.field("tangent_theta")

    @property
    def tangent_phi(self) -> Array:
        """dX/dphi, shape (markers, 3); read-only view."""
        return self._core.field("tangent_phi")

    @property
    def area_weight(self) -> Array:
        """Area of each marker's cell, shape (markers,): the weights that integrate over the surface; read-only view."""
        return self._core.field("area_weight")

    @property
    def mean_curvature(self) -> Array:
        """H, the mean of the principal curvatures, +1 on the unit sphere, shape (markers,); read-only view."""
        return self._core.field("mean_curvature")

    @property
    def gaussian_curvature(self) -> Array:
        """K, the product of the principal curvatures, shape (markers,); read-only view."""
        return self._core.field("gaussian_curvature")

    @property
    def principal_curvatures(self) -> tuple[Array, Array]:
        """The larger and the smaller principal curvature, both of shape (markers,)."""
        root = np.sqrt(np.maximum(self.mean_curvature**2 - self.gaussian_curvature, 0.0))
        return self.mean_curvature + root, self.mean_curvature - root

    @property
    def coefficients(self) -> Complex:
        """Of the positions, shape (N, N, 3)."""
        return self._core.coefficients()

    @property
    def area(self) -> float:
        """A."""
        return self._core.area

    @property
    def volume(self) -> float:
        """Enclosed volume V."""
        return self._core.volume

    @property
    def reduced_volume(self) -> float:
        """6 sqrt(pi) V / A^(3/2): 1 for the sphere."""
        return reduced_volume(self.area, self.volume)

    @property
    def effective_radius(self) -> float:
        """(3V/4 pi)^(1/3)."""
        return (3 * self.volume / (4 * math.pi)) ** (1 / 3)

    def integral(self, field: ArrayLike) -> float:
        """Integral over the surface of a scalar of shape (markers,)."""
        return self._core.integral(np.asarray(field, dtype=float))

    def gradient(self, field: ArrayLike) -> Array:
        """Surface gradient (markers, 3) of a scalar (markers,)."""
        return self._core.gradient(np.asarray(field, dtype=float))

    def divergence(self, field: ArrayLike) -> Array:
        """Surface divergence (markers,) of vectors (markers, 3), tangent or not.

        >>> ball = sphere(latitudes=12)
        >>> bool(np.allclose(ball.divergence(ball.normal), 2 * ball.mean_curvature))
        True
        """
        return self._core.divergence(np.asarray(field, dtype=float))

    def laplacian(self, field: ArrayLike) -> Array:
        """Laplace-Beltrami operator of a scalar (markers,)."""
        return self._core.laplacian(np.asarray(field, dtype=float))

    def laplacian_of_mean_curvature(self) -> Array:
        """Laplace-Beltrami operator of H, from H on a finer grid: what the bending force is made of, shape (markers,)."""
        return self._core.laplacian_of_mean_curvature()

    def bending_force(self, capillary_number: float = 1.0, spontaneous_curvature: float = 0.0) -> Array:
        """Bending force per area, shape (markers, 3):

            (1/Ca) [(1/2) Lap H + (H - H0) (H^2 - K + H0 H)] n.

        >>> bool(np.abs(sphere(latitudes=16).bending_force()).max() < 1e-10)
        True
        """
        return self._core.bending_force(capillary_number, spontaneous_curvature)

    def bending_energy(self, spontaneous_curvature: float = 0.0) -> float:
        """(1/2) int (H - H0)^2 dA, to be multiplied by 1/Ca: 2 pi for every sphere."""
        return self._core.bending_energy(spontaneous_curvature)

    def tension_force(self, tension: ArrayLike) -> Array:
        """Force per area, shape (markers, 3), of a tension of shape (markers,): div(tension (I - n n)).

        >>> ball = sphere(latitudes=16, radius=2)
        >>> bool(np.allclose(ball.tension_force(np.ones(512)), -ball.normal))  # -2 H n, Laplace's law
        True
        """
        return self._core.tension_force(np.asarray(tension, dtype=float))

    def elastic_tension(self, target_areas: ArrayLike, sigma0: float) -> Array:
        """sigma0 ln(J)/J with J = dA/dA0, shape (markers,), of target areas dA0 of the markers' cells."""
        return self._core.elastic_tension(np.asarray(target_areas, dtype=float), sigma0)

    def moments(self) -> dict:
        """Of the enclosed volume: `volume`, `centroid` (3), `semi_axes` (3, longest first) of the ellipsoid with the same second moments, its
        `deformation` (L - S)/(L + S) and `inclination_angle` (radians, in the x-z plane)."""
        return self._core.moments()

    def resolution(self) -> dict:
        """How well the mesh resolves the bending force: `unresolved`, the share that lies beyond its degrees, `needed_latitudes` and a
        `warning`, which is empty where 5 % or less are unresolved."""
        return self._core.resolution()

    def on_grid(self, latitudes: int) -> Surface:
        """The same surface with other markers: exact for more latitudes, truncated for fewer."""
        coefficients = self.coefficients[:latitudes, :latitudes]
        return Surface(SphericalHarmonics(latitudes, len(coefficients)).synthesis(coefficients))

    def __repr__(self) -> str:
        return f"<Surface of {self.latitudes} latitudes, area {self.area:.6g}, volume {self.volume:.6g}>"


def reduced_volume(area: float, volume: float) -> float:
    """6 sqrt(pi) V / A^(3/2): 1 for the sphere.

    >>> round(reduced_volume(4 * math.pi, 4 * math.pi / 3), 12)
    1.0
    """
    return _vesicle.reduced_volume(area, volume)


def excess_area(area: float, volume: float) -> float:
    """A/R^2 - 4 pi with R = (3V/4 pi)^(1/3): 0 for the sphere."""
    return _vesicle.excess_area(area, volume)


# ---- shapes ----


def _placed(make, latitudes: int, *shape, radius: float, centre: Sequence[float], rotation: Optional[ArrayLike]) -> Surface:
    matrix = np.eye(3) if rotation is None else np.asarray(rotation, dtype=float)
    if matrix.shape != (3, 3):
        raise ValueError(f"rotation has the shape {matrix.shape}; it must be (3, 3)")
    return Surface(make(SphereGrid(latitudes)._core, *shape, radius, [float(x) for x in centre], list(matrix.ravel())))


def sphere(latitudes: int = 32, *, radius: float = 1.0, centre: Sequence[float] = (0, 0, 0), rotation: Optional[ArrayLike] = None) -> Surface:
    """A sphere. Of this and the shapes below, `radius` is the effective one, (3V/4 pi)^(1/3), and `rotation` a rotation matrix (3, 3)."""
    return _placed(_vesicle.sphere, latitudes, radius=radius, centre=centre, rotation=rotation)


def prolate(reduced_volume: float, latitudes: int = 32, *, radius: float = 1.0, centre: Sequence[float] = (0, 0, 0),
            rotation: Optional[ArrayLike] = None) -> Surface:
    """Prolate spheroid of that reduced volume in (0, 1]; its axis is z.

    >>> prolate(1.2)
    Traceback (most recent call last):
    ...
    ValueError: reduced_volume = 1.2: must be in (0, 1]
    """
    return _placed(_vesicle.prolate, latitudes, reduced_volume, radius=radius, centre=centre, rotation=rotation)


def oblate(reduced_volume: float, latitudes: int = 32, *, radius: float = 1.0, centre: Sequence[float] = (0, 0, 0),
           rotation: Optional[ArrayLike] = None) -> Surface:
    """Oblate spheroid of that reduced volume in (0, 1]; its axis is z."""
    return _placed(_vesicle.oblate, latitudes, reduced_volume, radius=radius, centre=centre, rotation=rotation)


def spheroid(aspect_ratio: float, latitudes: int = 32, *, radius: float = 1.0, centre: Sequence[float] = (0, 0, 0),
             rotation: Optional[ArrayLike] = None) -> Surface:
    """Spheroid with that ratio of the semi-axis along z to the one across."""
    return _placed(_vesicle.spheroid, latitudes, aspect_ratio, radius=radius, centre=centre, rotation=rotation)


def ellipsoid(axes: Sequence[float], latitudes: int = 32, *, radius: float = 1.0, centre: Sequence[float] = (0, 0, 0),
              rotation: Optional[ArrayLike] = None) -> Surface:
    """Ellipsoid with semi-axes along x, y and z in these proportions."""
    return _placed(_vesicle.ellipsoid, latitudes, [float(x) for x in axes], radius=radius, centre=centre, rotation=rotation)


def biconcave_disc(latitudes: int = 32, *, radius: float = 1.0, centre: Sequence[float] = (0, 0, 0),
                   rotation: Optional[ArrayLike] = None) -> Surface:
    """Red cell of Evans and Fung (Microvasc. Res. 4, 335, 1972), reduced volume 0.644."""
    return _placed(_vesicle.biconcave_disc, latitudes, radius=radius, centre=centre, rotation=rotation)


def perturbed_sphere(terms: Sequence[tuple[int, int, float]], latitudes: int = 32, *, radius: float = 1.0,
                     centre: Sequence[float] = (0, 0, 0), rotation: Optional[ArrayLike] = None) -> Surface:
    """The sphere r = 1 + sum of (degree, order, amplitude), amplitude * Re Y_n^m or, for order < 0, Im Y_n^|m|."""
    return _placed(_vesicle.perturbed_sphere, latitudes, list(terms), radius=radius, centre=centre, rotation=rotation)


def from_coefficients(coefficients: ArrayLike, latitudes: int = 32, *, radius: float = 1.0, centre: Sequence[float] = (0, 0, 0),
                      rotation: Optional[ArrayLike] = None) -> Surface:
    """The surface of coefficients (degrees, degrees, 3), scaled to the effective radius, its centroid at the centre."""
    return _placed(_vesicle.shape_from_coefficients, latitudes, np.asarray(coefficients, dtype=complex), radius=radius, centre=centre,
                   rotation=rotation)


class Equilibrium(NamedTuple):
    """A shape of least bending energy with given area and volume. Lengths in effective radii r, energy (1/2) int H^2 dA in c_b."""

    surface: Surface  #: of volume 4 pi/3, its axis is z
    energy: float
    tension: float  #: in c_b / r^2; nan for the sphere
    pressure: float  #: inside minus outside, in c_b / r^3; nan for the sphere
    residual: float  #: of the method: the energy's error is about its square
    resolved: bool  #: whether the mesh resolves the shape, to about 1e-6 in the energy
    iterations: int


def equilibrium_shape(reduced_volume: float, branch: str = "prolate", latitudes: int = 32, tolerance: float = 1e-9) -> Equilibrium:
    """The axisymmetric shape that is stationary at a reduced volume, on the branch that goes over into long ("prolate") or flat ("oblate")
    ellipsoids near the sphere (docs/equilibrium_shapes.md). Raises ValueError for bad values, RuntimeError where none is found.

    >>> shape = equilibrium_shape(0.9, latitudes=16)
    >>> round(shape.energy, 3), round(shape.surface.reduced_volume, 9)
    (7.475, 0.9)
    """
    if branch not in ("prolate", "oblate"):
        raise ValueError(f"branch = {branch!r}: allowed are prolate, oblate")
    found = _vesicle.equilibrium_shape(reduced_volume, branch == "oblate", latitudes, tolerance)
    return Equilibrium(Surface(found.pop("positions")), **found)


# ---- files ----

Path = Union[str, "os.PathLike[str]"]


def _of_file(function, path: Path, *arguments):
    try:
        return function(os.fspath(path), *arguments)
    except RuntimeError as error:
        raise FileError(str(error)) from None


def read_coefficients(path: Path) -> Complex:
    """Coefficients (degrees, degrees, 3) of a surface from a text file, a line `n m re_x im_x re_y im_y re_z im_z` each. Raises FileError with
    file and line."""
    return _of_file(_vesicle.read_surface_coefficients, path)


def write_coefficients(path: Path, coefficients: ArrayLike) -> None:
    """Writes a file for read_coefficients, with all digits."""
    _of_file(_vesicle.write_surface_coefficients, path, np.asarray(coefficients, dtype=complex))


def read_mesh(path: Path) -> tuple[Array, NDArray[np.int32]]:
    """Vertices (vertices, 3) and triangles (triangles, 3) of an OBJ, OFF, PLY or STL file. Raises FileError with file and line."""
    return _of_file(_vesicle.read_mesh, path)


class MeshFit(NamedTuple):
    """A smooth surface fitted to a triangle mesh. Distances are over `radius`."""

    surface: Surface  #: where and as large as the mesh is
    radius: float  #: effective radius of the mesh
    rms_distance: float  #: of the vertices to the surface, root mean square
    max_distance: float  #: the largest of them
    mesh_area: float  #: of the triangles as they are
    mesh_volume: float  #: the same
    description: str  #: one sentence for people


def fit_mesh(vertices: ArrayLike, triangles: ArrayLike, latitudes: int = 32, degrees: Optional[int] = None) -> MeshFit:
    """Fits spherical harmonics of degree n < `degrees` (as many as the vertices determine unless told, up to 32) to a closed mesh of genus
    zero, star-shaped or not. Raises ValueError for a mesh that is not closed, or whose fit is another shape."""
    fit = _vesicle.fit_mesh(np.asarray(vertices, dtype=float), np.asarray(triangles), degrees, latitudes)
    coefficients = fit["coefficients"]
    if len(coefficients) > latitudes:
        raise ValueError(f"degrees = {len(coefficients)}: a surface of {latitudes} latitudes holds as many degrees at most")
    surface = Surface(SphericalHarmonics(latitudes, len(coefficients)).synthesis(coefficients))
    return MeshFit(surface, fit["radius"], fit["rms_distance"], fit["max_distance"], fit["mesh_area"], fit["mesh_volume"], fit["description"])


def from_mesh(path: Path, latitudes: int = 32, degrees: Optional[int] = None) -> MeshFit:
    """read_mesh and fit_mesh in one."""
    return fit_mesh(*read_mesh(path), latitudes=latitudes, degrees=degrees)
