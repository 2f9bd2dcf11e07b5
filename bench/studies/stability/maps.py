# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The maps: which runs, where theory has its limits, and what the documents recommend."""

import dataclasses
import math
from collections.abc import Callable

from harness.runs import ROOT, Run, number

SCENE = "scenes/paper/half_box.toml"
ACROSS = "bench/studies/stability/start.toml"
STORE = ROOT / "out" / "stability"


def box(half_width, cells):
    """A whole one: in a half box what is not symmetric about its plane cannot grow."""
    return {"domain.lower": [-half_width] * 3, "domain.upper": [half_width] * 3, "domain.cells": [cells] * 3, "domain.mirror": [False] * 3}


def half_of(keys):
    (x, y, z), (nx, ny, nz) = keys["domain.lower"], keys["domain.cells"]
    return {"domain.lower": [x, 0, z], "domain.cells": [nx, ny // 2, nz], "domain.mirror": [False, True, False]}


# [-3,3]^3 with 32^3 cells, h = 3/16: the least grid on which tank-treading is within some per cent of fine ones. The vesicle starts across the flow.
SMALL = box(3, 32) | {"mesh.latitudes": 24, "vesicles.0.rotation_deg": 0, "output.vesicle_every": 0, "output.checkpoint_every": 0}
SPACING = 6 / 32


@dataclasses.dataclass(frozen=True)
class Axis:
    label: str
    values: tuple
    quick: tuple

    def at(self, quick):
        return self.quick if quick else self.values


@dataclasses.dataclass(frozen=True)
class Map:
    """keys(panel, x, y): what differs from the scene. same_problem(panel, x, y): runs of one physical problem, of which the quietest tells how
    quiet it can be; None where there are too few to tell. recommended(panel, x, y, convection): whether documents recommend it, `source` says
    which; convection: the longest step at which the program's plan calls the explicit convection stable. limits(panel): lines (label, x, y)."""

    name: str
    title: str
    panels: tuple
    x: Axis
    y: Axis
    end: float
    keys: Callable
    same_problem: Callable
    recommended: Callable
    source: str
    limits: Callable = lambda panel: []
    quick_panels: tuple | None = None
    scene: str = SCENE

    def cells(self, quick):
        for panel in (self.quick_panels or self.panels) if quick else self.panels:
            for y in self.y.at(quick):
                for x in self.x.at(quick):
                    yield panel, x, y

    def run(self, panel, x, y, quick):
        base = SMALL if self.scene == SCENE else {}
        keys = base | {"time.end": self.end} | self.keys(panel, x, y)
        keys = {key: value for key, value in keys.items() if value is not None}
        keys |= {"output.diagnostics_every": _every(keys["time.step"])}
        return Run(f"{panel}, {self.x.label} {x}, {self.y.label} {y}", self.scene, keys, store=STORE)


def _every(step):
    """Rows at least every 1/24: of every step, or of every third, fifth ... : an odd number, so that what alternates from step to step does so from
    row to row."""
    count = int(1 / 24 / number(step) + 1e-9)
    return step if count < 3 else f"{count - 1 + count % 2}/{int(round(1 / number(step)))}"


def _g_line(g):
    """(dt, sigma0) of g = dt sigma0/(4 h)."""
    return lambda steps: [g * 4 * SPACING / dt for dt in steps]


STEPS = Axis("dt", ("1/6", "1/12", "1/24", "1/48", "1/96", "1/192", "1/384"), ("1/12", "1/24", "1/96", "1/192"))
WIDE = [1 / 800, 1 / 3]
STABLE_G = {"euler": (7, 8), "arkode": (7, 8), "ab2": (3, 4), "strain_relaxation": (49,)}


def _integrator_limits(panel):
    return [(f"g = {g}", WIDE, _g_line(g)(WIDE)) for g in STABLE_G.get(panel, ())]


def _integrator_recommended(panel, dt, sigma0, convection):
    g = number(dt) * sigma0 / (4 * SPACING)
    if panel in ("shape_following", "implicit"):
        return number(dt) <= 1 / 12
    return sigma0 >= 600 and g < STABLE_G[panel][0]  # softer tension lets areas change by more than a per cent


INTEGRATORS = Map(
    "integrators", "marker integrators", ("shape_following", "implicit", "euler", "ab2", "arkode", "strain_relaxation"), STEPS,
    Axis("sigma0", (60, 200, 600, 2000, 6000, 20000, 60000), (60, 600, 6000, 60000)), 4,
    lambda markers, dt, sigma0: {"time.markers": markers, "time.step": dt, "membrane.sigma0": sigma0},
    # Explicit markers keep the area by the tension alone: with a soft one they have another problem.
    lambda markers, dt, sigma0: (sigma0, markers in ("shape_following", "implicit")), _integrator_recommended,
    "docs/time_integration.md, first table", _integrator_limits)

# Long shapes need room; 32 latitudes are the default.
ROOMY = box(4, 40) | {"mesh.latitudes": 32}
SHAPES = Map(
    "shapes", "reduced volume and capillary number", ("from across the flow", "from near rest"),
    Axis("reduced volume", (0.6, 0.65, 0.7, 0.8, 0.9, 0.95, 0.99), (0.6, 0.7, 0.9, 0.99)),
    Axis("Ca", (0.05, 0.2, 1, 2.5, 10, 30, 100), (0.05, 2.5, 100)), 8,
    lambda start, volume, ca: ROOMY | {"vesicles.0.reduced_volume": volume, "membrane.capillary_number": ca, "time.step": "1/24",
                                       "membrane.sigma0": 2000,
                                       "vesicles.0.rotation_deg": 0 if start == "from across the flow" else 63},
    lambda start, volume, ca: None,
    lambda start, volume, ca, convection: volume >= 0.7 and 1 / 24 <= ca / 2 and (ca < 10 or volume >= 0.9),
    "docs/time_integration.md: to a reduced volume of 0.7, steps of at most Ca/2, below Ca = 10 where the reduced volume is below 0.9")


def _contrast_keys(how, dt, ratio):
    keys = {"time.step": dt, "fluid.viscosity_ratio": ratio, "membrane.sigma0": 2000}
    dear = half_of(SMALL) | {"time.end": 2}
    if how == "no inertia":  # the dearest: 48 steps at most
        return keys | {"fluid.inertia": "none"} | dear | {"time.end": min(2.0, 48 * number(dt))}
    treatment, _, markers = how.partition(", ")
    keys["fluid.viscous_treatment"] = treatment
    return keys | ({"time.markers": "implicit"} if markers else {}) | (dear if treatment == "implicit" else {})


def _contrast_recommended(how, dt, ratio, convection):
    spread = max(ratio, 1 / ratio)
    if how == "no inertia":
        return number(dt) <= 1 / 12
    if how == "implicit, implicit markers":
        return number(dt) <= 1 / 24
    if how.startswith("extrapolated"):
        return number(dt) <= 0.1 / math.sqrt(spread)
    return False


CONTRAST = Map(
    "contrast", "viscosity ratio and time step",
    ("extrapolated", "explicit", "implicit", "extrapolated, implicit markers", "implicit, implicit markers", "no inertia"),
    Axis("dt", ("1/6", "1/12", "1/24", "1/48", "1/96", "1/192"), ("1/12", "1/24", "1/48")),
    Axis("viscosity ratio", (0.05, 0.2, 1, 2, 5, 10, 20, 50, 100), (0.05, 5, 20, 100)), 6, _contrast_keys,
    lambda how, dt, ratio: ratio, _contrast_recommended, "docs/viscosity_contrast.md: steps up to 1/(10 sqrt(ratio))",
    lambda how: [("1/(10 sqrt(ratio))", [0.1 / math.sqrt(r) for r in (1, 150)], [1, 150]), ("", [0.1 / math.sqrt(r) for r in (1, 150)], [1, 1 / 150])]
    if how.startswith("extrapolated") else [], quick_panels=("extrapolated", "implicit", "no inertia"))


def _inertia_keys(how, dt, reynolds):
    markers, _, stiffness = how.partition(", ")
    name, value = stiffness.split(" = ")
    sigma0 = float(value) if name == "sigma0" else float(value) * 4 * SPACING / number(dt)
    return {"time.markers": markers, "time.step": dt, "membrane.sigma0": round(sigma0, 6), "fluid.reynolds_number": reynolds}


def _inertia_recommended(how, dt, reynolds, convection):
    if number(dt) > min(convection, 1 / 12) or reynolds > 10:
        return False
    if how.startswith("euler"):
        return 4 * 4 * SPACING / number(dt) >= 600  # its sigma0: softer tension lets areas change by more than a per cent
    if not how.startswith("shape_following") or reynolds <= 0.1:
        return True
    g = number(dt) * 2000 / (4 * SPACING) if "sigma0" in how else 80
    return g <= (111.5 if reynolds <= 1 else 80)


INERTIA = Map(
    "inertia", "Reynolds number and time step",
    ("shape_following, sigma0 = 2000", "shape_following, g = 80", "implicit, sigma0 = 2000", "euler, g = 4"),
    Axis("dt", ("1/12", "1/24", "1/48", "1/96", "1/192"), ("1/12", "1/24", "1/48")),
    Axis("Re", (1e-4, 1e-3, 1e-2, 0.1, 1, 3, 10, 30, 100), (1e-4, 0.1, 1, 10, 100)), 6, _inertia_keys,
    lambda how, dt, reynolds: reynolds, _inertia_recommended, "docs/time_integration.md, shape_following and Convection",
    quick_panels=("shape_following, sigma0 = 2000", "implicit, sigma0 = 2000"))


def _mesh_keys(markers, latitudes, cells):
    h = 6 / cells
    step, g = ("1/24", 100) if markers == "shape_following" else ("1/192", 4)
    keys = {"mesh.latitudes": latitudes, "time.markers": markers, "time.step": step, "membrane.sigma0": round(g * 4 * h / number(step), 6)}
    return box(3, cells) | keys | ({"mesh.tangential_degrees": latitudes} if latitudes < 15 else {})


def _mesh_recommended(markers, latitudes, cells, convection):
    return 0.4 <= math.pi / latitudes * cells / 6 <= 1


MESH = Map(
    "mesh", "latitudes and grid", ("shape_following", "euler"), Axis("latitudes", (8, 12, 16, 20, 24, 32, 48, 64), (8, 16, 32, 64)),
    Axis("cells along [-3, 3]", (16, 24, 32, 40), (16, 32)), 4, _mesh_keys, lambda markers, latitudes, cells: cells, _mesh_recommended,
    "docs/scene.md, mesh.latitudes: pi/N about half of h, no more than h",
    lambda markers: [("pi/N = h", [math.pi * c / 6 for c in (15, 42)], [15, 42]), ("h/2", [2 * math.pi * c / 6 for c in (15, 42)], [15, 42])])

FORMULAS = {
    "standard": {}, "components filter": {"mesh.filter": "components"}, "interpolated slip": {"mesh.slip": "interpolated"},
    "non-divergence tension": {"membrane.tension_form": "non_divergence"}, "linear tension": {"membrane.tension_law": "linear"},
    "Lap H: christoffel": {"membrane.laplacian": "christoffel"}, "Lap H: paper": {"membrane.laplacian": "paper"},
    "Lap H: not upsampled": {"membrane.upsampling": 1}, "volume penalty": {"membrane.volume": "penalty"}, "preset paper": {"method.preset": "paper"}}
ADVISED = ("standard", "interpolated slip", "linear tension", "Lap H: christoffel", "volume penalty", "preset paper")


def _formula_keys(how, volume, formula):
    markers, latitudes = how.split(", ")
    step, sigma0 = ("1/24", 2000) if markers == "shape_following" else ("1/192", 600)
    room = ROOMY if volume < 0.75 else {}  # it reaches the walls of the small box
    return room | {"time.markers": markers, "mesh.latitudes": int(latitudes.split()[0]), "time.step": step, "membrane.sigma0": sigma0,
                   "vesicles.0.reduced_volume": volume} | FORMULAS[formula]


FORMULA_MAP = Map(
    "formulas", "filters, tension forms, Laplacians", ("euler, 24 latitudes", "euler, 48 latitudes", "shape_following, 32 latitudes"),
    Axis("reduced volume", (0.7, 0.8, 0.9, 0.975), (0.8,)), Axis("formula", tuple(FORMULAS), tuple(FORMULAS)), 4, _formula_keys,
    lambda how, volume, formula: volume,
    lambda how, volume, formula, convection: formula in ADVISED and not (how.startswith("shape") and formula in ("volume penalty", "preset paper")),
    "docs/scene.md, membrane and mesh",
    quick_panels=("euler, 24 latitudes", "shape_following, 32 latitudes"))

# Every start that the documents recommend, on grids up to h = R/21, with as few latitudes as they recommend: pi/N about h.
# The ellipsoids of these reduced volumes have axes 1, s, s^2.
MIDDLE_AXIS = {0.7: 2.0144, 0.8: 1.7234, 0.85: 1.5853, 0.9: 1.445, 0.95: 1.2905, 0.99: 1.1188}
START_CAPILLARY_NUMBERS = (2.5, 0.5, 10.0)


def _start_keys(panel, volume, cells_per_radius):
    shape, _, ca = panel.partition(", Ca = ")
    half_width = 4 if volume < 0.75 else 3  # a long one needs room
    cells = 2 * round(half_width * cells_per_radius)
    keys = box(half_width, cells) | {"mesh.latitudes": 8 * round(math.pi * cells_per_radius / 8), "membrane.capillary_number": float(ca),
                                     "membrane.sigma0": 600, "time.step": "1/24", "vesicles.0.shape": shape}
    if shape != "ellipsoid":
        return keys | {"vesicles.0.reduced_volume": volume}
    middle = MIDDLE_AXIS[volume]
    return keys | {"vesicles.0.axes": [1, middle, round(middle**2, 4)]}


STARTS = Map(
    "starts", "starts across the flow, reduced volume and grid",
    tuple(f"{shape}, Ca = {ca:g}" for ca in START_CAPILLARY_NUMBERS for shape in ("prolate", "oblate", "ellipsoid")),
    Axis("reduced volume", tuple(MIDDLE_AXIS), (0.85,)), Axis("R/h", (5.33, 8, 10.67, 16, 21.33), (5.33, 8)), 1, _start_keys,
    lambda panel, volume, cells: None,
    lambda panel, volume, cells, convection: volume >= 0.9 or not panel.endswith("= 10"), "docs/stability.md, Recommended region",
    quick_panels=("oblate, Ca = 2.5",), scene=ACROSS)

# Stiffer ones, where bending would make another shape within a step: their first steps are taken in parts.
STIFF_STARTS = Map(
    "stiff_starts", "stiff starts across the flow", ("prolate", "oblate", "ellipsoid"), Axis("reduced volume", (0.7, 0.8, 0.9, 0.95), (0.7, 0.9)),
    Axis("Ca", (0.01, 0.02, 0.05, 0.1, 0.2, 0.5), (0.01, 0.1)), 1,
    lambda shape, volume, ca: _start_keys(f"{shape}, Ca = {ca}", volume, 5.33), lambda shape, volume, ca: None,
    lambda shape, volume, ca, convection: 1 / 24 <= ca / 2, "docs/stability.md, Recommended region", scene=ACROSS)

# The same without thickness. Nothing is recommended beyond what the delta function is recommended for.
SHARP = {"coupling.method": "sharp"}
SHARP_SHAPES = dataclasses.replace(
    SHAPES, name="sharp_shapes", title="sharp membranes: reduced volume and capillary number",
    keys=lambda *cell: SHAPES.keys(*cell) | SHARP)
SHARP_INERTIA = Map(
    "sharp_inertia", "sharp membranes: Reynolds number and time step", ("sigma0 = 2000", "sigma0 = 20000"), INERTIA.x, INERTIA.y, 6,
    lambda panel, dt, reynolds: {"time.step": dt, "fluid.reynolds_number": reynolds, "membrane.sigma0": int(panel.split()[-1])} | SHARP,
    lambda panel, dt, reynolds: reynolds,
    # Not g beyond what is recommended.
    lambda panel, dt, reynolds, convection: number(dt) <= min(convection, 1 / 12) and reynolds <= 10
    and (reynolds < 1 or panel == "sigma0 = 2000"),
    "docs/time_integration.md, shape_following and Convection", quick_panels=("sigma0 = 2000",))
SHARP_CONTRAST = Map(
    "sharp_contrast", "sharp membranes: viscosity ratio and time step", ("no inertia",), CONTRAST.x, CONTRAST.y, 4,
    lambda panel, dt, ratio: {"time.step": dt, "fluid.viscosity_ratio": ratio, "fluid.inertia": "none", "membrane.sigma0": 2000} | SHARP,
    lambda panel, dt, ratio: ratio, lambda panel, dt, ratio, convection: number(dt) <= 1 / 12, "docs/viscosity_contrast.md")
SHARP_STIFFNESS = dataclasses.replace(
    INTEGRATORS, name="sharp_stiffness", title="sharp membranes: time step and sigma0", panels=("no inertia",), quick_panels=None,
    x=Axis("dt", ("1/6", "1/12", "1/24", "1/48", "1/96"), ("1/12", "1/24", "1/96")),
    keys=lambda panel, dt, sigma0: {"time.step": dt, "membrane.sigma0": sigma0, "fluid.inertia": "none"} | SHARP,
    same_problem=lambda panel, dt, sigma0: sigma0, recommended=lambda panel, dt, sigma0, convection: number(dt) <= 1 / 12,
    limits=lambda panel: [])


def _phases_recommended(panel, reynolds, ratio, convection):
    dt = number(panel.split()[-1])
    return (ratio >= 0.5 or reynolds <= (1 if ratio >= 0.2 else 0.1 * ratio)) and dt <= min(convection, 1 / 12)


SHARP_PHASES = Map(
    "sharp_phases", "sharp membranes: Reynolds number and viscosity ratio", ("dt = 1/24", "dt = 1/48"),
    Axis("Re", (1e-3, 0.1, 1, 3, 10), (0.1, 10)), Axis("viscosity ratio", (0.05, 0.2, 0.5, 1, 2, 5, 20, 100), (0.2, 5)), 4,
    lambda panel, reynolds, ratio: {"time.step": panel.split()[-1], "fluid.reynolds_number": reynolds, "fluid.viscosity_ratio": ratio,
                                    "membrane.sigma0": 2000} | SHARP,
    lambda panel, reynolds, ratio: (reynolds, ratio), _phases_recommended,
    "docs/coupling.md: ratios from 0.5 on, from 0.2 on to Re = 1, below to Re = ratio/10; docs/time_integration.md, Convection")

ALL = {each.name: each for each in (INTEGRATORS, SHAPES, CONTRAST, INERTIA, MESH, FORMULA_MAP, STARTS, STIFF_STARTS, SHARP_SHAPES, SHARP_INERTIA,
                                    SHARP_CONTRAST, SHARP_STIFFNESS, SHARP_PHASES)}
