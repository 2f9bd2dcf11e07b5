#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The table of validation/studies/foundation.sh: what the runs found beside what is expected, and with what tolerance."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line, outputs  # noqa: E402

TABLE_3 = {  # the paper's Table 3: surface divergence, local area, area, volume
    32: (8.710e-3, 8.218e-3, 2.112e-3, 7.928e-5),
    64: (2.013e-3, 1.466e-3, 9.486e-4, 2.631e-5),
}


def row(case, quantity, found, expected, good):
    print(f"| {case} | {quantity} | {found} | {expected} | {'yes' if good else '**no**'} |")


def tank_treading(case, run):
    v = run["vesicles"][0]
    angle, frequency = v["inclination_angle_deg"], v["tank_treading_frequency"]
    row(case, "inclination, degrees", f"{angle:.3f}", "27.85 +- 0.6", abs(angle - 27.85) <= 0.6)
    row(case, "frequency", f"{frequency:.4f}", "0.387 +- 0.01", abs(frequency - 0.387) <= 0.01)
    row(case, "volume error", f"{v['volume_error']:.2e}", "below 1e-4", abs(v["volume_error"]) < 1e-4)
    row(case, "largest local area error", f"{v['max_local_area_error']:.2e}", "below 2e-2", v["max_local_area_error"] < 2e-2)


def sphere(run):
    v = run["vesicles"][0]
    frequency = v["tank_treading_frequency"]
    row("sphere in shear", "angular velocity", f"{frequency:.4f}", "0.5 +- 2 %", abs(frequency - 0.5) <= 0.01)
    row("sphere in shear", "reduced volume", f"{v['reduced_volume']:.4f}", "1 to 1 %", v["reduced_volume"] > 0.99)


def oblate(n, run):
    v = run["vesicles"][0]
    keys = ("surface_divergence_max", "max_label_area_error", "area_error", "volume_error")
    names = ("surface divergence", "local area", "area", "volume")
    for key, name, paper, allowed in zip(keys, names, TABLE_3[n], (1.25, 1.25, 1.05, 1.05)):
        ratio = abs(v[key]) / paper
        row(f"oblate 3:3:1, N = {n}", f"{name} error", f"{abs(v[key]):.3e}", f"Table 3: {paper:.3e} (ratio {ratio:.2f}, "
            f"up to {allowed})", ratio <= allowed)


def main():
    runs = {folder.name: outputs.summary(folder) for folder in outputs.folders(command_line.folder_of_runs(__doc__))}
    print(f"Revision {runs['tank_treading']['git_revision']}, made by `validation/studies/foundation.sh`.\n")
    print("| case | quantity | found | expected | met |\n|---|---|---|---|---|")
    tank_treading("tank-treading, 64^3", runs["tank_treading"])
    tank_treading("the same, `paper` preset", runs["tank_treading_paper"])
    sphere(runs["sphere"])
    oblate(32, runs["oblate_32"])
    oblate(64, runs["oblate_64"])


if __name__ == "__main__":
    main()
