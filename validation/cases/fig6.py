# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 6: steady angle and frequency against reduced volume, beside Keller and Skalak's ellipsoid."""

import numpy as np

from harness import drawing, outputs, shear, theory
from harness.tables import percent, table

TITLE = "steady angle and frequency against reduced volume (figure 6)"
VOLUMES = [0.7, 0.75, 0.8, 0.85, 0.9, 0.925, 0.95, 0.975, 0.99]
SCHEMES = ["shape following", "corrected"]


def run_of(context, scheme, volume):
    """Slender vesicles have tips that need more latitudes."""
    latitudes = {} if volume >= 0.8 else {"mesh.latitudes": 80 if context.paper else 48}
    keys = shear.corrected(context) if scheme == "corrected" else {}
    return shear.treading(f"{scheme}, {volume}", context, volume, **shear.HALF, **keys, **latitudes)


def compute(context):
    folders = context.run([run_of(context, scheme, volume) for scheme in SCHEMES for volume in VOLUMES])
    values = {"reduced_volumes": VOLUMES, "steady": {}}
    rows = []
    for volume in VOLUMES:
        cells = [volume]
        for scheme in SCHEMES:
            folder = folders[f"{scheme}, {volume}"]
            if outputs.summary(folder)["status"] != "completed":
                values["steady"][f"{scheme}, {volume}"] = None
                cells += ["stopped", ""]
                continue
            state = shear.steady(folder)
            values["steady"][f"{scheme}, {volume}"] = state
            cells += [state["angle_deg"], state["frequency"]]
        angle, frequency = theory.inclination(volume, 1), theory.frequency(volume, 1)
        corrected = values["steady"][f"corrected, {volume}"]
        difference = [f"{corrected['angle_deg'] - angle:+.2f}", percent(corrected["frequency"], frequency)] if corrected else ["", ""]
        rows.append([*cells, angle, frequency, theory.phase_frequency(volume, 1), *difference, theory.quasi_spherical_inclination(volume, 1)])
    values["tables"] = [table(
        "Angle in degrees and frequency of Eq. (34) at t = 15",
        ["reduced volume", "angle", "frequency", "angle, corrected", "frequency, corrected", "Keller & Skalak: angle", "Eq. (34)", "their frequency",
         "corrected less theory: degrees", "frequency", "angle of the quasi-spherical theory"], rows)]
    return values


def draw(context, values, path):
    figure, panels = drawing.figure(1, 2, figsize=(9, 3.6))
    fine = np.linspace(0.66, 0.998, 80)
    for axes, key, of_theory, label in zip(panels, ("angle_deg", "frequency"), (theory.inclination, theory.frequency),
                                           ("inclination, degrees", "frequency, Eq. (34)")):
        axes.plot(fine, [of_theory(v, 1) for v in fine], color="0.5", label="Keller & Skalak")
        if key == "frequency":
            axes.plot(fine, [theory.phase_frequency(v, 1) for v in fine], color="0.5", linestyle=":", label="their own frequency")
            axes.legend()
        if key == "angle_deg":
            axes.plot(fine, [theory.quasi_spherical_inclination(v, 1) for v in fine], color="0.5", linestyle="--", label="quasi-spherical theory")
        for scheme, mark, colour in zip(SCHEMES, "os", drawing.COLOURS):
            known = [v for v in VOLUMES if values["steady"][f"{scheme}, {v}"]]
            axes.plot(known, [values["steady"][f"{scheme}, {v}"][key] for v in known], mark, color=colour, markersize=5,
                      label=scheme if scheme != "corrected" else "thickness corrected")
        axes.set(xlabel="reduced volume", ylabel=label)
    panels[0].set_ylim(10, 46)
    panels[0].legend()
    drawing.save(figure, path)
