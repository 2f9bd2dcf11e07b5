# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Vesicles in a box of fluid, one step at a time: libcoupling, which needs no file.

>>> from vesiflow import coupling
>>> simulation = coupling.Simulation({"domain": {"cells": 16, "lower": [-3, -3, -3], "upper": [3, 3, 3]}, "mesh": {"latitudes": 12},
...                                   "vesicles": [{"reduced_volume": 0.9}]}, coupling.shear_flow(rate=1.0))
>>> simulation.step()
>>> simulation.steps, round(simulation.time, 6)
(1, 0.020833)
>>> simulation.measure()[0]["reduced_volume"] < 1
True

Parameters have the names and the defaults of docs/scene.md, in dictionaries or with dots: {"time.step": 0.01}. What is wrong with them is said
at once:

>>> coupling.Simulation({"time.step": -1, "vesicles.0.radius": 0})
Traceback (most recent call last):
...
vesiflow.errors.ParameterError: 2 mistakes:
  1. time.step = -1: must be > 0
  2. vesicles.0.radius = 0: must be > 0

`vesiflow.Simulation` is the same from a scene: it has presets, and is saved and restarted.
"""
from __future__ import annotations

import contextlib
import math
import signal
import threading
import weakref
from typing import Any, Callable, Iterator, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .fluid import Grid, Velocity  # first: it says what is missing where nothing is built
from . import _coupling
from .progress import ProgressBar
from .table import Table

Array = NDArray[np.float64]
Point = tuple[float, float, float]
#: u(x, t): three numbers at a point x (a tuple of three) and time t. Of flows and of forces per volume of the fluid.
VectorFunction = Callable[[Point, float], Sequence[float]]

__all__ = ["Flow", "Fluid", "ForcedSurface", "Membrane", "Membranes", "Simulation", "custom_flow", "duct_flow", "extension_flow",
           "flow_at_rest", "oscillating_shear_flow", "plane_poiseuille_flow", "set_threads", "shear_flow", "threads"]


def threads() -> int:
    """Number of threads that computations take."""
    return _coupling.threads()


def set_threads(count: int) -> None:
    """Takes that many threads from now on, 1 to 1024. Results do not depend on their number, to the last bit."""
    if not 1 <= count <= 1024:
        raise ValueError(f"threads = {count}: must be from 1 to 1024")
    _coupling.set_threads(count)


# ---- flows ----


class Flow:
    """A flow without vesicles: what walls do and what drives it. Made by the functions below."""

    def __init__(self, make: Callable[[Any], Any], name: str) -> None:
        self._make, self._name = make, name

    def in_domain(self, parameters: Any) -> Any:
        """As the library has it, in the domain of parameters."""
        return self._make(parameters)

    def __repr__(self) -> str:
        return f"<{self._name}>"


def flow_at_rest() -> Flow:
    """u = 0."""
    return Flow(_coupling.flow_at_rest, "fluid at rest")


def shear_flow(rate: float = 1.0) -> Flow:
    """u = (rate z, 0, 0)."""
    return Flow(lambda p: _coupling.shear_flow(p, rate), f"shear flow of rate {rate:g}")


def oscillating_shear_flow(rate: float = 1.0, angular_frequency: float = 1.0) -> Flow:
    """u = (rate cos(omega t) z, 0, 0)."""
    return Flow(lambda p: _coupling.oscillating_shear_flow(p, rate, angular_frequency), f"shear flow of rate {rate:g} cos({angular_frequency:g} t)")


def extension_flow(rate: float = 1.0, kind: str = "planar") -> Flow:
    """Planar u = rate (x, 0, -z) or uniaxial u = rate (x, -y/2, -z/2)."""
    if kind not in ("planar", "uniaxial"):
        raise ValueError(f"kind = {kind!r}: allowed are planar, uniaxial")
    return Flow(lambda p: _coupling.extension_flow(p, rate, kind == "uniaxial"), f"{kind} extension of rate {rate:g}")


def plane_poiseuille_flow(peak_velocity: float = 1.0) -> Flow:
    """u = (peak (1 - (z/H)^2), 0, 0) between walls at z = -H and H from the middle of the box."""
    return Flow(lambda p: _coupling.plane_poiseuille_flow(p, peak_velocity), f"plane Poiseuille flow, at most {peak_velocity:g}")


def duct_flow(peak_velocity: float = 1.0) -> Flow:
    """Flow along x in a duct, between walls normal to y and z."""
    return Flow(lambda p: _coupling.duct_flow(p, peak_velocity), f"flow in a duct, at most {peak_velocity:g}")


def custom_flow(velocity: VectorFunction, *, unsteady: bool = False, may_be_periodic: Sequence[bool] = (False, False, False),
                driving_force: float = 0.0, greatest_gradient: float = 0.0) -> Flow:
    """A flow of one's own: u(x, t) gives three numbers at a point x, a tuple of three. It is called on the walls, at time 0 inside too, and
    again in each step where it is `unsteady`.

    - `may_be_periodic`: along which axes it repeats;
    - `driving_force`: force per volume along x in the place of a pressure drop, where x is periodic;
    - `greatest_gradient`: of a velocity component, for adaptive steps and advice; 0: not known.
    """
    if not callable(velocity):
        raise TypeError(f"a flow is a function u(x, t), not {velocity!r}")
    return Flow(lambda p: _coupling.custom_flow(velocity, unsteady, [bool(b) for b in may_be_periodic], driving_force, greatest_gradient),
                f"the flow {getattr(velocity, '__name__', 'of a function')}")


def as_flow(flow: Union[Flow, VectorFunction]) -> Flow:
    """A function as a steady flow."""
    return flow if isinstance(flow, Flow) else custom_flow(flow)


# ---- parameters ----


def _plain(value: Any) -> Any:
    """Numbers and arrays of NumPy as those of Python."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, tuple):
        return list(value)
    return value


def flattened(values: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested dictionaries as one with dotted names; vesicles by number.

    >>> flattened({"time": {"step": 1}, "vesicles": [{"radius": 2}, {"radius": 3}]})
    {'time.step': 1, 'vesicles.0.radius': 2, 'vesicles.1.radius': 3}
    """
    flat: dict[str, Any] = {}
    for name, value in values.items():
        name = prefix + str(name)
        if name == "vesicles" and isinstance(value, Mapping) and not all(str(key).isdigit() for key in value):
            value = [value]
        if name == "vesicles" and isinstance(value, (list, tuple)):
            value = {str(number): vesicle for number, vesicle in enumerate(value)}
        if isinstance(value, Mapping):
            flat.update(flattened(value, name + "."))
        elif value is not None:
            flat[name] = _plain(value)
    return flat


# ---- what a simulation has ----


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


class _Forces:
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


@contextlib.contextmanager
def _deferred_interrupt() -> Iterator[Callable[[], bool]]:
    """While this lasts Ctrl-C is noted, and raised at the end; the function says whether it has come. Only where Ctrl-C would raise
    KeyboardInterrupt here: in the main thread, with Python's own handler."""
    came: list[int] = []
    mine = threading.current_thread() is threading.main_thread() and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if mine:
        signal.signal(signal.SIGINT, lambda number, frame: came.append(number))
    try:
        yield lambda: bool(came)
    finally:
        if mine:
            signal.signal(signal.SIGINT, signal.default_int_handler)
    if came:
        raise KeyboardInterrupt


class Simulation:
    """Vesicles in a box of fluid, from parameters and a flow.

    `parameters` is a dictionary as in the head of this module; `flow` one of the flows of this module or a function u(x, t), shear flow of rate
    1 unless told. Raises ParameterError with all mistakes.

    A simulation is used by one thread at a time. While it takes a step the interpreter's lock is released, so that other threads run; asking
    the same simulation for something meanwhile raises RuntimeError.
    """

    def __init__(self, parameters: Mapping[str, Any], flow: Union[Flow, VectorFunction, None] = None) -> None:
        core_parameters = _coupling.Parameters(flattened(parameters))
        chosen = shear_flow() if flow is None else as_flow(flow)
        self._prepare()
        self._core: Any = _coupling.Simulation(core_parameters, chosen.in_domain(core_parameters))

    def _prepare(self) -> None:
        self._busy = threading.Lock()
        self._failed: Optional[str] = None
        self._forces = _Forces()
        self._rows: list[dict] = []

    # -- steps --

    def _core_at_rest(self) -> Any:
        if self._busy.locked():
            raise RuntimeError("the simulation is inside a step: what it has can be read when the step is done")
        return self._core

    @contextlib.contextmanager
    def _in_use(self) -> Iterator[None]:
        if self._failed:
            raise RuntimeError(f"{self._failed}; the state is lost: restore a checkpoint, or make the simulation anew")
        if not self._busy.acquire(blocking=False):
            raise RuntimeError("the simulation is inside a step already")
        try:
            yield
        finally:
            self._busy.release()

    def step(self) -> None:
        """Takes one time step, of length time.step or, if time.adaptive, as long as its errors allow.

        Raises SimulationStopped when the state stops being usable. Ctrl-C is raised after the step, so that the state is whole. What a function
        of yours raises comes through, and then the step was cut short: the simulation takes no more steps until it is restored.
        """
        with self._in_use():
            with _deferred_interrupt():
                self._step()

    def _step(self) -> None:
        try:
            self._core.step()
        except Exception as error:
            from .errors import SimulationStopped

            if not isinstance(error, SimulationStopped):
                self._failed = f"the step that began at t = {self._core.time():.6g} was cut short by {type(error).__name__}: {error}"
            raise

    def run(self, until: Optional[float] = None, *, progress: bool = False, record_every: Optional[float] = None,
            callback: Optional[Callable[[Simulation], Optional[bool]]] = None) -> Simulation:
        """Takes steps to the time `until`, or to time.end. Returns the simulation.

        - `progress`: shows a bar on standard error;
        - `record_every`: adds a row for each vesicle to `diagnostics` at these intervals, at the start and at the end; 0: never, unless told
          the scene's output.diagnostics_every;
        - `callback`: is called with the simulation after each step; where it returns True the run ends there.

        Ctrl-C ends the run between two steps with KeyboardInterrupt: the state is whole and can go on or be saved.
        """
        parameters = self.parameters
        begin, end = self.time, parameters["time.end"] if until is None else float(until)
        if not math.isfinite(end):
            raise ValueError(f"until = {until}: must be finite")
        every = self._usual_interval() if record_every is None else record_every
        if not every >= 0:
            raise ValueError(f"record_every = {record_every}: must be >= 0")
        bar = ProgressBar(end, begin) if progress else None
        with _deferred_interrupt() as interrupted, bar or contextlib.nullcontext():
            if every and not self._rows:
                self.record()
            while not self._has_reached(until, end) and not interrupted():
                with self._in_use():
                    self._step()
                if every and self._is_due(every, parameters["time.adaptive"]):
                    self.record()
                if bar:
                    bar.show(self.time, self.steps)
                if callback is not None and callback(self) is True:
                    break
            if every and self._rows[-1]["step"] != self.steps:
                self.record()
        return self

    def _is_due(self, every: float, adaptive: bool) -> bool:
        """Whether this is the step for a multiple of `every`: of equal steps the nearest, of adaptive ones the first at or beyond it. The
        programs take the same."""
        time, dt = self.time, self.time_step
        if adaptive:
            return math.floor(time / every + 1e-9) > math.floor((time - dt) / every + 1e-9)
        return math.floor((time + 0.5 * dt) / every) > math.floor((time - 0.5 * dt) / every)

    def _usual_interval(self) -> float:
        return 0.05

    def _has_reached(self, until: Optional[float], end: float) -> bool:
        if until is None:
            return self.finished
        return self.time >= end - 1e-6 * self.time_step

    @property
    def time(self) -> float:
        """Of the state, in 1/shear rate."""
        return self._core_at_rest().time()

    @property
    def steps(self) -> int:
        """Number of steps since t = 0."""
        return self._core_at_rest().steps()

    @property
    def time_step(self) -> float:
        """Length of the last step; before the first step, of that one."""
        return self._core_at_rest().time_step()

    @time_step.setter
    def time_step(self, dt: float) -> None:
        self._core_at_rest().set_time_step(dt)

    @property
    def finished(self) -> bool:
        """Whether time.end is reached."""
        return self._core_at_rest().finished()

    @property
    def parameters(self) -> dict[str, Any]:
        """All of them by their full names, with the values that are used."""
        return self._core_at_rest().parameters()

    # -- what there is --

    @property
    def membranes(self) -> Membranes:
        """By number."""
        return Membranes(self)

    @property
    def fluid(self) -> Fluid:
        """Velocity and pressure."""
        return Fluid(self)

    # -- forces --

    def add_force(self, force: MembraneForce) -> MembraneForce:
        """Adds a force on the membranes from the next step on: `force(t, vesicle, surface)` gives a force on the fluid per area of the membrane,
        of the shape (markers, 3) or three numbers for all markers, or None for none. It is called in each step, and in each evaluation of an
        implicit one. It is no part of checkpoints. Returns the force, so that this serves as a decorator."""
        if not callable(force):
            raise TypeError(f"a force is a function force(t, vesicle, surface), not {force!r}")
        with self._in_use():
            self._forces.on_membranes.append(force)
            if len(self._forces.on_membranes) == 1:
                self._forces.attach_membranes(self._core)
        return force

    def set_fluid_force(self, force: Optional[Callable], *, arrays: bool = False) -> None:
        """Sets the force on the fluid per volume from the next step on, or none (None).

        It is `force(x, t)` with x a tuple of three, which gives three numbers and is called at each face of the grid in each step: about a
        microsecond for each. With `arrays` it is `force(x, y, z, t)`, which is called three times in a step with arrays of all faces, and
        gives three numbers or arrays of their shape. It is no part of checkpoints.
        """
        if force is not None and not callable(force):
            raise TypeError(f"a force is a function force(x, t), not {force!r}")
        with self._in_use():
            self._forces.on_fluid, self._forces.of_arrays = force, arrays
            self._forces.attach_fluid(self._core)

    # -- numbers --

    def measure(self) -> list[dict[str, float]]:
        """Numbers of each vesicle now, by the names of docs/results.md; what is not defined is nan."""
        with self._in_use():
            return self._core.measure()

    def record(self) -> None:
        """Adds what `measure` gives to `diagnostics`."""
        step, time = self.steps, self.time
        for vesicle, numbers in enumerate(self.measure()):
            self._rows.append({"step": step, "time": time, "vesicle": vesicle, **numbers})

    @property
    def diagnostics(self) -> Table:
        """What `run` and `record` have gathered: a dictionary of arrays with the columns of diagnostics.csv, a row for each vesicle at each
        time. `to_pandas` makes a DataFrame of it."""
        return Table.of_rows(self._rows)

    @property
    def phase_seconds(self) -> dict[str, float]:
        """What the phases of the steps have taken, by the names of docs/results.md."""
        return self._core_at_rest().phases()

    def __repr__(self) -> str:
        if self._busy.locked():
            return f"<{type(self).__name__} inside a step>"
        return f"<{type(self).__name__} of {len(self.membranes)} vesicle{'s' * (len(self.membranes) != 1)} at t = {self.time:.6g}>"
