# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The flows of vesiflow.coupling, where users find them."""
from __future__ import annotations

from typing import Any, Callable, Sequence, Union

from . import _coupling

#: u(x, t): three numbers at a point x (a tuple of three) and time t. Of flows and of forces per volume of the fluid.
VectorFunction = Callable[[tuple[float, float, float], float], Sequence[float]]


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
