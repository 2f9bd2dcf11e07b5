# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The cases: what is computed, the sweeps around good settings, and the reference.

Boxes are halves, or eighths, by mirror symmetry, and 8 wide rather than the paper's 12: what walls change is the same in all runs of a
case, the error of the box is not the subject.
"""

import dataclasses

from harness import extrapolation
from harness.runs import Run

LEVELS = (1e-2, 1e-3, 1e-4)


@dataclasses.dataclass(frozen=True)
class Estimate:
    """An answer as a linear combination of runs: [(weight, keys)]."""

    name: str
    parts: list


@dataclasses.dataclass(frozen=True)
class Case:
    """sweeps: [(family, knob, keys)], keys as for --set beside those of the case, `cells` for the cells across the box.
    reference: the estimate that errors are taken against; others: what stands beside it, whose distance from it is its own error.
    doubts: pairs of keys at a lower resolution whose difference is the reference's error of another kind (of its step, say).
    recipes: estimates that a user could take instead of one run, in the sweeps with the seconds of all their runs."""

    name: str
    title: str
    scene: str
    keys: dict
    sweeps: list
    reference: Estimate
    others: list
    doubts: list
    columns: dict
    since: float
    width: float  # of the box, in effective radii
    shape: tuple  # of the box that is computed, over its width
    recipes: tuple = ()

    def run(self, label, keys):
        keys = self.keys | keys
        cells = keys.pop("cells")
        return Run(label, self.scene, keys | {"domain.cells": [round(cells * part) for part in self.shape]})

    def spacing(self, keys):
        return self.width / keys["cells"]

    def label(self, keys):
        """A run's name: cells across, latitudes, step, and what differs from the usual."""
        usual = USUAL | self.keys
        words = [form.format(keys[key]) for key, form in SHORT.items() if key in keys and keys[key] != usual.get(key)]
        return ", ".join([str(keys["cells"]), *words] + ["corrected"] * bool(keys.get("coupling.thickness_correction")))

    def runs(self):
        """Every run by its label: of the sweeps, the reference, and what stands beside it."""
        found = {}
        for _, _, keys in self.sweeps:
            found[self.label(keys)] = self.run(self.label(keys), keys)
        for estimate in (self.reference, *self.others, *self.recipes):
            for _, keys in estimate.parts:
                found[self.label(keys)] = self.run(self.label(keys), keys)
        for _, *pair in self.doubts:
            for keys in pair:
                found[self.label(keys)] = self.run(self.label(keys), keys)
        return found


SHORT = {"coupling.method": "{}", "mesh.latitudes": "{} lat", "time.step": "dt {}", "time.markers": "{}",
         "membrane.sigma0": "sigma0 {}", "fluid.viscous_treatment": "{} viscosity", "fluid.inertia": "inertia {}", "coupling.kernel": "{}",
         "fluid.velocity_solver": "{}", "membrane.integral_rate": "r {}", "time.tolerance": "tol {}", "time.implicit_tolerance": "to {}",
         "method.preset": "{} preset",
         "method.accuracy": "accuracy {}"}


USUAL = {"time.markers": "shape_following", "fluid.viscous_treatment": "extrapolated", "coupling.kernel": "smoothed4",
         "coupling.method": "delta"}
CORRECTED, PLAIN = {"coupling.thickness_correction": True}, {"coupling.thickness_correction": False, "coupling.method": "delta"}
SHARP = PLAIN | {"coupling.method": "sharp"}
SHARP_SLOW = SHARP | {"fluid.inertia": "none"}


def estimate(name, width, grids, common):
    """The polynomial in the spacing through runs on these grids, at zero."""
    weights = extrapolation.weights_at_zero([width / n for n in grids])
    return Estimate(name, [(w, common | {"cells": n}) for w, n in zip(weights, grids)])


def estimate_of_second_order(name, width, grids, common):
    """The polynomial in the square of the spacing through runs on these grids, at zero."""
    weights = extrapolation.weights_at_zero([(width / n) ** 2 for n in grids])
    return Estimate(name, [(w, common | {"cells": n}) for w, n in zip(weights, grids)])


def finest(name, cells, common):
    return Estimate(name, [(1.0, common | {"cells": cells})])


def latitudes(width, cells):
    """Spacing of the markers about 0.8 h: a multiple of 8."""
    return max(16, 8 * round(4 * cells / width / 8))


def explicit_tension(markers, cells, width, g=4.0, **keys):
    """A step that is stable with an explicit tension: that of the paper's g."""
    sigma0 = 600
    steps = max(48, 24 * -(-round(sigma0 * cells / (4 * g * width)) // 24))
    return {"cells": cells, "mesh.latitudes": latitudes(width, cells), "time.markers": markers, "membrane.sigma0": sigma0,
            "time.step": f"1/{steps}", **PLAIN, **keys}


def family(keys):
    if keys.get("coupling.method") == "sharp":
        return "sharp, no inertia" if "fluid.inertia" in keys else "sharp"
    return "corrected" if keys is CORRECTED else "plain"


def grid_sweep(width, grids, step, *methods):
    for keys in methods:
        for n in grids:
            yield family(keys), "grid", {
                "cells": n, "mesh.latitudes": latitudes(width, n), "time.step": f"1/{step}"} | keys


def shear_case(quick):
    width = 8.0
    base = {"cells": 64, "mesh.latitudes": 32, "time.step": "1/24"} | CORRECTED
    coarse = {"cells": 32, "mesh.latitudes": 16, "time.step": "1/24"} | CORRECTED
    sweeps = [*grid_sweep(width, (24, 32, 48) if quick else (20, 24, 32, 48, 64, 96, 128), 24, CORRECTED, PLAIN)]
    for at in (coarse,) if quick else (coarse, base):
        for n in (12, 16, 24) if at is coarse else (20, 24, 32, 40, 48, 64):
            sweeps.append(("latitudes", "latitudes", at | {"mesh.latitudes": n}))
        for step in (8, 12, 48) if quick else (8, 12, 48, 96, 192):
            sweeps.append(("step", "time step", at | {"time.step": f"1/{step}"}))
    n = 32
    sweeps += [("euler", "integrator", explicit_tension("euler", n, width)),
               ("euler", "integrator", explicit_tension("euler", n, width, **{"membrane.integral_rate": 5})),
               ("ab2", "integrator", explicit_tension("ab2", n, width, g=2.0)),
               ("strain_relaxation", "integrator", explicit_tension("strain_relaxation", n, width, g=16.0)),
               ("arkode", "integrator", explicit_tension("arkode", n, width)),
               ("implicit", "integrator", coarse | {"time.markers": "implicit"}),
               ("implicit", "integrator", coarse | {"time.markers": "implicit", "time.step": "1/12"})]
    sweeps += [("solver", "solver backend", coarse | {"fluid.velocity_solver": s, "fluid.pressure_solver": s}) for s in ("pcg", "cholmod")]
    sweeps += [("inertia", "inertia", coarse | {"fluid.inertia": inertia}) for inertia in ("unsteady", "none")]
    if not quick:
        for n in (64,):
            sweeps += [("euler", "integrator", explicit_tension("euler", n, width)),
                       ("euler", "integrator", explicit_tension("euler", n, width, **{"membrane.integral_rate": 5})),
                       ("ab2", "integrator", explicit_tension("ab2", n, width, g=2.0)),
                       ("implicit", "integrator", base | {"time.markers": "implicit"})]
        sweeps += [("grid and step", "grid and step", {"cells": n, "mesh.latitudes": latitudes(width, n), "time.step": f"1/{step}"} | CORRECTED)
                   for n, step in ((20, 12), (24, 12), (48, 12), (48, 48), (96, 12), (96, 48), (128, 48))]
        sweeps += [("stiffness", "sigma0", base | {"membrane.sigma0": s}) for s in (600, 2000, 60000)]
        sweeps += [("kernel", "kernel", base | {"coupling.kernel": k} | c) for k in ("bspline43", "bspline54", "peskin4") for c in (PLAIN, CORRECTED)]
        sweeps += [("adaptive", "adaptive step", base | {"time.adaptive": True, "time.tolerance": t}) for t in ("1e-4", "2e-5", "4e-6")]
    fine = {"mesh.latitudes": 32 if quick else 80, "time.step": "1/48" if quick else "1/96"}
    grids = (64, 48, 32) if quick else (192, 128, 96)
    plain = (64, 48, 32) if quick else (128, 96, 64)
    return Case(
        "tank_treading", "tank-treading from a start across the flow to t = 4: reduced volume 0.9, ratio 1, Re = 1e-3", "scenes/paper/half_box.toml",
        {"domain.lower": [-4, 0, -4], "domain.upper": [4, 4, 4], "vesicles.0.rotation_deg": 0, "time.end": 4, "membrane.sigma0": 9000,
         "output.diagnostics_every": 0.25, "output.vesicle_every": 1, "output.checkpoint_every": 2},
        sweeps, finest("finest grid, corrected", grids[0], fine | CORRECTED),
        [finest("next finest, corrected", grids[1], fine | CORRECTED),
         estimate("extrapolated, corrected", width, grids[:2], fine | CORRECTED),
         estimate("extrapolated from three grids, plain", width, plain, fine | PLAIN)],
        [("time step", {"cells": 64} | fine | CORRECTED | {"mesh.latitudes": 32},
          {"cells": 64} | fine | CORRECTED | {"mesh.latitudes": 32, "time.step": "1/384"}),
         ("sigma0", base | {"time.step": "1/48"}, base | {"time.step": "1/48", "membrane.sigma0": 60000})][:1 if quick else 2],
        {"angle": "inclination_angle_deg", "frequency": "tank_treading_frequency"}, 3.0, width, (1, 0.5, 1))


def contrast_case(name, ratio, rotation, end, since, quick, title):
    width = 8.0
    slow = 48
    base = {"cells": 64, "mesh.latitudes": 32, "time.step": f"1/{slow}"} | CORRECTED
    coarse = {"cells": 32, "mesh.latitudes": 16, "time.step": f"1/{slow}"} | CORRECTED
    sweeps = [*grid_sweep(width, (24, 32, 48) if quick else (24, 32, 48, 64, 96, 128), slow, CORRECTED, PLAIN)]
    sharp_grids = (24, 32, 48) if quick else (24, 32, 48, 64, 80)
    for step in (24, 48):
        sweeps += grid_sweep(width, sharp_grids, step, SHARP)
    sweeps += grid_sweep(width, sharp_grids[:3], 24, SHARP_SLOW)
    for at in (coarse,) if quick else (coarse, base):
        for n in (16, 24) if at is coarse else (24, 32, 48):
            sweeps.append(("latitudes", "latitudes", at | {"mesh.latitudes": n}))
        for step in (24, 96) if quick else (12, 24, 96, 192):
            sweeps.append(("step", "time step", at | {"time.step": f"1/{step}"}))
    for step in (48,) if quick else (24, 48, 96):
        sweeps += [("explicit", "viscous treatment", coarse | {"fluid.viscous_treatment": "explicit", "time.step": f"1/{step}"}),
                   ("implicit viscosity", "viscous treatment", coarse | {"fluid.viscous_treatment": "implicit", "time.step": f"1/{step}"})]
    if not quick:
        sweeps += [("no inertia", "inertia", coarse | {"fluid.inertia": "none", "time.step": f"1/{step}"}) for step in (12, 24)]
        sweeps += [("implicit", "integrator", coarse | {"time.markers": "implicit", "time.step": f"1/{step}"}) for step in (24, 48)]
        sweeps += [("euler", "integrator", explicit_tension("euler", n, width, **{"membrane.integral_rate": 5})) for n in (32, 64)]
        sweeps += [("grid and step", "grid and step", {"cells": n, "mesh.latitudes": latitudes(width, n), "time.step": f"1/{step}"} | CORRECTED)
                   for n, step in ((24, 24), (48, 24), (96, 24), (128, 96))]
    fine = {"mesh.latitudes": 32 if quick else 64, "time.step": "1/48" if quick else "1/96"}
    grids = (64, 48, 32) if quick else (160, 128, 96)
    # The error is of first order in h: a line through two grids.
    pairs = ((48, 32),) if quick else ((48, 32), (64, 48), (96, 64), (128, 96))
    recipes = tuple(estimate(f"{coarse} and {n} to h = 0, {latitudes(width, n)} lat", width, (n, coarse),
                             {"mesh.latitudes": latitudes(width, n), "time.step": f"1/{slow}"} | CORRECTED) for n, coarse in pairs)
    sharp = (48, 32) if quick else (96, 64)
    # Of second order for the sharp membrane.
    sharp_recipes = tuple(
        estimate_of_second_order(f"sharp, {coarse} and {n} to h = 0, {latitudes(width, n)} lat", width, (n, coarse),
                                 {"mesh.latitudes": latitudes(width, n), "time.step": f"1/{slow}"} | SHARP) for n, coarse in pairs[:2])
    fine_sharp = {"mesh.latitudes": 32 if quick else 48, "time.step": f"1/{slow}"} | SHARP
    return Case(
        name, title, "scenes/paper/half_box.toml",
        {"domain.lower": [-4, 0, -4], "domain.upper": [4, 4, 4], "vesicles.0.rotation_deg": rotation, "time.end": end,
         "fluid.viscosity_ratio": ratio, "membrane.sigma0": 9000 if ratio < 10 else 2000,
         "output.diagnostics_every": 0.25, "output.vesicle_every": 1, "output.checkpoint_every": 2},
        sweeps, estimate_of_second_order("sharp, extrapolated from two grids", width, sharp, fine_sharp),
        [finest("sharp, the finest grid", sharp[0], fine_sharp),
         estimate("extrapolated from three grids, corrected", width, grids, fine | CORRECTED),
         estimate("extrapolated from three grids, plain", width, grids, fine | PLAIN)],
        [("time step", {"cells": 64} | fine | CORRECTED | {"mesh.latitudes": 32},
          {"cells": 64} | fine | CORRECTED | {"mesh.latitudes": 32, "time.step": "1/384"})],
        {"angle": "inclination_angle_deg", "frequency": "tank_treading_frequency"}, since, width, (1, 0.5, 1),
        recipes + sharp_recipes)


def relaxation_case(quick):
    """With inertia. The reference is of another integrator than most runs: implicit."""
    width = 6.0
    fit = lambda n: max(24, 8 * round(0.5 * n / 8))  # noqa: E731
    following = lambda n, step, **keys: {"cells": n, "mesh.latitudes": fit(n), "time.step": f"1/{step}"} | PLAIN | keys  # noqa: E731
    implicit = lambda n, step, **keys: following(n, step, **{"time.markers": "implicit"}) | keys  # noqa: E731
    sweeps = [("implicit", "grid", implicit(n, 96)) for n in ((24, 32, 48) if quick else (24, 32, 48, 64, 96, 128))]
    for n, steps in ((32, (24, 48, 192)),) if quick else ((32, (24, 48, 192)), (64, (48, 192, 384))):
        sweeps += [("implicit", "time step", implicit(n, step)) for step in steps]
    sweeps += [("implicit", "tolerance", implicit(32, 96, **{"time.implicit_tolerance": t})) for t in ("1e-4", "1e-7")]
    for n, steps in ((24, (48,)), (32, (12, 24, 48, 96, 192))) if quick else ((24, (48,)), (32, (12, 24, 48, 96, 192)), (64, (12, 24, 48, 192, 384))):
        sweeps += [("shape following", "time step", following(n, step)) for step in steps]
    sweeps += [("shape following", "latitudes", following(32, 96, **{"mesh.latitudes": n})) for n in (16, 32)]
    for n in (32,) if quick else (32, 64, 128):
        paper = {"cells": n, "mesh.latitudes": max(16, n // 2), "method.preset": "paper", "time.markers": "euler", "membrane.volume": "none",
                 "membrane.sigma0": 9.375 * n, "time.step": f"1/{6 * n}"} | PLAIN
        sweeps.append(("euler", "the paper's scheme", paper))
    sweeps.append(("ab2", "integrator", following(32, 384, **{"time.markers": "ab2", "membrane.sigma0": 300})))
    sweeps.append(("inertia", "inertia", following(32, 96, **{"fluid.inertia": "unsteady"})))
    if not quick:
        sweeps += [("kernel", "kernel", implicit(64, 96, **{"coupling.kernel": k})) for k in ("bspline43", "bspline54")]
        sweeps += [("stiffness", "sigma0", implicit(64, 96, **{"membrane.sigma0": s})) for s in (600, 9000)]
    fine = {"mesh.latitudes": 32 if quick else 64, "time.markers": "implicit", "time.step": "1/96" if quick else "1/384",
            "time.implicit_tolerance": "1e-6" if quick else "1e-7"} | PLAIN
    grids = (64, 48, 32) if quick else (128, 96, 64)
    return Case(
        "relaxation", "relaxation of an oblate 3:3:1 to t = 0.5 in fluid at rest, Re = 1", "scenes/paper/relaxation_oblate.toml",
        {"domain.lower": [0, 0, 0], "domain.mirror": [True, True, True], "method.preset": "standard", "time.markers": "shape_following",
         "membrane.volume": "projection", "membrane.sigma0": 2000, "time.end": 0.5, "output.diagnostics_every": "1/12",
         "output.vesicle_every": "1/4", "output.fluid_every": 0, "output.checkpoint_every": 0.25},
        sweeps, estimate("extrapolated from three grids", width, grids, fine),
        [estimate("extrapolated from two grids", width, grids[:2], fine), finest("finest grid", grids[0], fine)],
        [("time step", {"cells": 64} | fine | {"mesh.latitudes": 32},
          {"cells": 64} | fine | {"mesh.latitudes": 32, "time.step": "1/192" if quick else "1/768"})],
        {"bending energy": "bending_energy"}, 1 / 12, width, (0.5, 0.5, 0.5))


def duct_case(quick):
    width = 5.0
    base = {"cells": 40, "mesh.latitudes": 32, "time.step": "1/24"} | CORRECTED
    coarse = {"cells": 20, "mesh.latitudes": 16, "time.step": "1/24"} | CORRECTED
    sweeps = [*grid_sweep(width, (20, 30) if quick else (20, 30, 40, 60, 80), 24, CORRECTED, PLAIN)]
    for at in (coarse,) if quick else (coarse, base):
        for n in (16, 24) if at is coarse else (24, 48):
            sweeps.append(("latitudes", "latitudes", at | {"mesh.latitudes": n}))
        for step in (12, 48) if quick else (12, 48, 96):
            sweeps.append(("step", "time step", at | {"time.step": f"1/{step}"}))
    sweeps += [("euler", "integrator", explicit_tension("euler", 20, width)),
               ("implicit", "integrator", coarse | {"time.markers": "implicit"})]
    if not quick:
        sweeps += [("euler", "integrator", explicit_tension("euler", n, width, **{"membrane.integral_rate": 5})) for n in (20, 40)]
        sweeps += [("solver", "solver backend", coarse | {"fluid.velocity_solver": s, "fluid.pressure_solver": s}) for s in ("pcg", "cholmod")]
        sweeps += [("grid and step", "grid and step", {"cells": n, "mesh.latitudes": latitudes(width, n), "time.step": f"1/{step}"} | CORRECTED)
                   for n, step in ((20, 12), (30, 12), (60, 48), (80, 48))]
    fine = {"mesh.latitudes": 32 if quick else 64, "time.step": "1/48" if quick else "1/96"}
    grids = (40, 30, 20) if quick else (100, 80, 60)
    return Case(
        "duct", "off the axis of a square duct to t = 4: reduced volume 0.9, peak velocity 2, periodic", "scenes/duct.toml",
        {"domain.lower": [-4, 0, -2.5], "domain.upper": [4, 2.5, 2.5], "domain.mirror": [False, True, False], "time.markers": "shape_following",
         "membrane.sigma0": 9000, "time.end": 4, "output.diagnostics_every": 0.25, "output.vesicle_every": 1, "output.fluid_every": 0,
         "output.checkpoint_every": 2},
        sweeps, finest("finest grid, corrected", grids[0], fine | CORRECTED),
        [finest("next finest, corrected", grids[1], fine | CORRECTED),
         estimate("extrapolated, corrected", width, grids[:2], fine | CORRECTED),
         estimate("extrapolated from three grids, plain", width, grids, fine | PLAIN)],
        [("time step", {"cells": 40} | fine | CORRECTED | {"mesh.latitudes": 32},
          {"cells": 40} | fine | CORRECTED | {"mesh.latitudes": 32, "time.step": "1/384"})],
        {"angle": "inclination_angle_deg", "frequency": "tank_treading_frequency"}, 0.25, width, (1.6, 0.5, 1))


def extension_case(quick):
    """Not a sweep: the settings that the others recommend, and shorter steps. It set those of method.accuracy."""
    width = 8.0
    sweeps = [("recommended", "level", {"cells": n, "mesh.latitudes": lat, "time.step": f"1/{step}"} | CORRECTED)
              for n, lat, step in ((32, 16, 24), (32, 24, 24), (48, 24, 24), (64, 32, 24), (64, 40, 48), (64, 40, 96), (96, 48, 48), (96, 64, 96),
                                   (96, 64, 192))]
    sweeps += [("plain", "grid", {"cells": n, "mesh.latitudes": latitudes(width, n), "time.step": "1/24"} | PLAIN) for n in (32, 64)]
    fine = {"mesh.latitudes": 40 if quick else 64, "time.step": "1/48" if quick else "1/96"}
    grids = (96, 64, 48) if quick else (160, 128, 96)
    return Case(
        "extension", "reduced volume 0.85 turned by planar extension, to t = 3, Re = 1e-3", "scenes/extension.toml",
        {"domain.lower": [-4, 0, -4], "domain.mirror": [False, True, False], "vesicles.0.reduced_volume": 0.85, "time.markers": "shape_following",
         "membrane.sigma0": 9000, "time.end": 3, "output.diagnostics_every": 0.25, "output.vesicle_every": 1, "output.fluid_every": 0,
         "output.checkpoint_every": 2},
        sweeps, finest("finest grid, corrected", grids[0], fine | CORRECTED),
        [finest("next finest, corrected", grids[1], fine | CORRECTED),
         estimate("extrapolated from three grids, plain", width, grids, fine | PLAIN)],
        [("time step", {"cells": 48, "mesh.latitudes": 24, "time.step": fine["time.step"]} | CORRECTED,
          {"cells": 48, "mesh.latitudes": 24, "time.step": "1/192"} | CORRECTED)],
        {"angle": "inclination_angle_deg", "deformation": "deformation"}, 0.25, width, (1, 0.5, 1))


def preset_case(name, title, scene, keys, shape, columns, quick):
    """What method.accuracy chooses, on a scene that was not used to choose it."""
    width = 8.0
    sweeps = [(f"accuracy {level}", "level", {"cells": n, "method.accuracy": level}) for n, level in ((64, "1e-2"), (96, "1e-3"))[:1 if quick else 2]]
    sweeps += [("plain", "grid", {"cells": n, "mesh.latitudes": latitudes(width, n), "time.step": "1/24"} | PLAIN) for n in (32, 64)]
    step = "1/48" if quick else "1/96"
    fine = {"mesh.latitudes": 40 if quick else 64, "time.step": "1/48" if quick else "1/192"}
    grids = (96, 64, 48) if quick else (160, 128, 96)
    small = {"cells": 48, "mesh.latitudes": 24} | CORRECTED
    return Case(
        name, f"not used in the choice: {title}", scene,
        {"output.diagnostics_every": 0.25, "output.vesicle_every": 1, "output.checkpoint_every": 2} | keys,
        sweeps, finest("finest grid, corrected", grids[0], fine | CORRECTED),
        [finest("next finest, corrected", grids[1], fine | CORRECTED),
         estimate("extrapolated from three grids, plain", width, grids, fine | PLAIN | {"time.step": step})],
        [("time step", small | {"time.step": fine["time.step"]}, small | {"time.step": "1/192" if quick else "1/768"})], columns, 0.25, width, shape)


def unseen_case(quick):
    return preset_case("unseen", "reduced volume 0.8, Ca = 1, off the axis of plane Poiseuille flow, to t = 6", "scenes/poiseuille_off_axis.toml",
                       {"time.end": 6}, (1, 0.5, 1),
                       {"angle": "inclination_angle_deg", "frequency": "tank_treading_frequency", "deformation": "deformation"}, quick)


def tilted_case(quick):
    """No symmetry but that of a point; it had no say in any of the settings."""
    return preset_case("unseen_tilted", "reduced volume 0.87, Ca = 1.5, tilted out of the plane of a shear flow, to t = 3",
                       "scenes/poiseuille_off_axis.toml",
                       {"domain.lower": [-4, -4, -4], "domain.periodic": [False] * 3, "domain.mirror": [False] * 3, "flow.type": "shear",
                        "membrane.capillary_number": 1.5, "vesicles.0.reduced_volume": 0.87, "vesicles.0.centre": [0, 0, 0],
                        "vesicles.0.rotation_axis": [1, 1, 0], "vesicles.0.rotation_deg": 50, "time.end": 3}, (1, 1, 1),
                       {"angle": "inclination_angle_deg", "deformation": "deformation"}, quick)


def sharp_preset_case(name, title, keys, columns, quick, steps=96, cells=128, grids=(128, 96), mesh=64):
    """What method.accuracy chooses where it takes sharp membranes, on a scene that was not used to choose it."""
    width = 8.0
    levels = ((64, "1e-2"), (cells, "1e-3"))[:1 if quick else 2]
    sweeps = [(f"accuracy {level}", "level", {"cells": n, "method.accuracy": level}) for n, level in levels]
    fine = SHARP | {"mesh.latitudes": 40 if quick else mesh, "time.step": f"1/{steps}"}
    grids = (64, 48) if quick else grids
    sweeps += [("sharp", "grid", {"cells": n, "mesh.latitudes": latitudes(width, n), "time.step": "1/96"} | SHARP) for n in (32, 40, 48)]
    step = SHARP | ({"cells": 48, "mesh.latitudes": 24} if steps > 96 else {"cells": 40, "mesh.latitudes": 32})
    return Case(
        name, f"not used in the choice: {title}", "scenes/poiseuille_off_axis.toml",
        {"output.diagnostics_every": 0.25, "output.vesicle_every": 1, "output.checkpoint_every": 2} | keys,
        sweeps, estimate_of_second_order("sharp, extrapolated from two grids", width, grids, fine), [finest("finest grid", grids[0], fine)],
        [(f"time step, on {step['cells']} cells", step | {"time.step": f"1/{steps}"}, step | {"time.step": f"1/{4 * steps}"})], columns, 0.25, width, (1, 0.5, 1))


def unseen_contrast_case(quick):
    return sharp_preset_case("unseen_contrast", "reduced volume 0.85, ratio 3, Ca = 1.5, off the axis of plane Poiseuille flow, to t = 3",
                             {"fluid.viscosity_ratio": 3, "membrane.capillary_number": 1.5, "vesicles.0.reduced_volume": 0.85, "time.end": 3},
                             {"angle": "inclination_angle_deg", "frequency": "tank_treading_frequency", "deformation": "deformation"}, quick)


def unseen_inertia_case(quick):
    return sharp_preset_case("unseen_inertia", "reduced volume 0.92, ratio 1.7, Re = 5, Ca = 2, in shear flow from 65 degrees, to t = 3",
                             {"fluid.viscosity_ratio": 1.7, "fluid.reynolds_number": 5, "membrane.capillary_number": 2, "flow.type": "shear",
                              "domain.periodic": [False] * 3, "vesicles.0.reduced_volume": 0.92, "vesicles.0.centre": [0, 0, 0],
                              "vesicles.0.rotation_deg": 25, "time.end": 3},
                             {"angle": "inclination_angle_deg", "frequency": "tank_treading_frequency", "deformation": "deformation"}, quick, 192, 144)


def unseen_thin_inertia_case(quick):
    # 96 cells carry noise: docs/coupling.md, Fine grids and inertia.
    return sharp_preset_case("unseen_thin_inertia", "reduced volume 0.85, ratio 0.6, Re = 4, Ca = 1.2, off the axis of plane Poiseuille flow, to t = 3",
                             {"fluid.viscosity_ratio": 0.6, "fluid.reynolds_number": 4, "membrane.capillary_number": 1.2, "vesicles.0.reduced_volume": 0.85,
                              "time.end": 3},
                             {"angle": "inclination_angle_deg", "frequency": "tank_treading_frequency", "deformation": "deformation"}, quick, 192, 144, (128, 64), 40)


def sharp_contrast_case(quick):
    """Only sharp membranes, in half the box: ratio_5 has them beside the delta function."""
    width = 8.0
    fine = SHARP | {"mesh.latitudes": 32 if quick else 48, "time.step": "1/48"}
    grids = (64, 48) if quick else (128, 96)
    sweeps = [*grid_sweep(width, (32, 40, 48) if quick else (24, 32, 40, 48, 56, 64, 80, 96, 112), 24, SHARP)]
    sweeps += [("step", "time step", {"cells": n, "mesh.latitudes": latitudes(width, n), "time.step": f"1/{step}"} | SHARP)
               for step in (12, 16) for n in ((32, 40, 48) if quick else (32, 40, 48, 50, 54, 56, 80, 96, 112))]
    at = SHARP | {"cells": 40, "mesh.latitudes": 32}
    return Case(
        "ratio_5_sharp", "sharp membranes, tank-treading from 20 degrees: reduced volume 0.9, ratio 5, Re = 1e-3, half a box", "scenes/paper/half_box.toml",
        {"domain.lower": [-4, 0, -4], "domain.upper": [4, 4, 4], "vesicles.0.rotation_deg": 70, "time.end": 6, "fluid.viscosity_ratio": 5,
         "membrane.sigma0": 9000, "output.diagnostics_every": 0.25, "output.vesicle_every": 1, "output.checkpoint_every": 2},
        sweeps, estimate_of_second_order("sharp, extrapolated from two grids", width, grids, fine), [finest("finest grid", grids[0], fine)],
        [("time step, on 40 cells", at | {"time.step": "1/24"}, at | {"time.step": "1/192"})],
        {"angle": "inclination_angle_deg", "frequency": "tank_treading_frequency"}, 5.0, width, (1, 0.5, 1))


BUILDERS = {
    "tank_treading": shear_case,
    "ratio_5": lambda quick: contrast_case("ratio_5", 5, 70, 4 if quick else 6, 3.0 if quick else 5.0, quick,
                                           "tank-treading from 20 degrees: reduced volume 0.9, ratio 5, Re = 1e-3"),
    "ratio_20": lambda quick: contrast_case("ratio_20", 20, 0, 3 if quick else 6, 0.25, quick,
                                            "from across the flow towards tumbling: reduced volume 0.9, ratio 20, Re = 1e-3"),
    "ratio_5_sharp": sharp_contrast_case,
    "relaxation": relaxation_case,
    "duct": duct_case,
    "extension": extension_case,
    "unseen": unseen_case,
    "unseen_tilted": tilted_case,
    "unseen_contrast": unseen_contrast_case,
    "unseen_inertia": unseen_inertia_case,
    "unseen_thin_inertia": unseen_thin_inertia_case,
}


def load(name, quick):
    return BUILDERS[name](quick)
