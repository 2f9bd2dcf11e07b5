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
from typing import Any, Callable, Iterator, Mapping, Optional, Union

import numpy as np

from .parts import Fluid, Membrane, Membranes  # first: it says what is missing where nothing is built
from . import _coupling
from .flows import (
    Flow,
    VectorFunction,
    as_flow,
    custom_flow,
    duct_flow,
    extension_flow,
    flow_at_rest,
    oscillating_shear_flow,
    plane_poiseuille_flow,
    shear_flow,
)
from .forces import ForcedSurface, Forces, MembraneForce
from .progress import ProgressBar
from .table import Table

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


# ---- simulations ----


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
        self._forces = Forces()
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
