# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tables of validation/studies/integrators.md and validation/studies/tumbling.md from the stored results, and the picture of the latter.

usage: scripts/python.sh validation/studies/integrators_table.py [--picture docs/images/validation/tumbling.png]
"""

import json
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line  # noqa: E402
from harness.runs import ROOT  # noqa: E402

RESULTS = ROOT / "validation" / "results"


def stored(name):
    file = RESULTS / f"{name}.json"
    return json.loads(file.read_text()) if file.exists() else {}


def unwrapped(result):
    """Times and inclination / pi, without the jumps by pi."""
    series = result["series"]
    angle = np.array([np.nan if a is None else a for a in series["inclination"]], dtype=float)
    return np.array(series["t"]), np.unwrap(2 * angle) / (2 * np.pi)


def crossings(t, angle, level):
    """Times at which the angle falls through the level, by cubics through four records."""
    found = []
    for i in range(1, len(t) - 2):
        if angle[i] > level >= angle[i + 1]:
            x = np.linspace(t[i], t[i + 1], 401)
            c = np.polyfit(t[i - 1:i + 3] - t[i], angle[i - 1:i + 3], 3)
            found.append(float(np.interp(-level, -np.polyval(c, x - t[i]), x)))
    return found


def e(value):
    return f"{value:.1e}"


def integrators(results, names, reference, title):
    at_reference = results.get(reference)
    print(f"\n{title}\n")
    print("| markers, dt, sigma0 | g | inclination / pi (error) | frequency (error) | largest error of area, volume | "
          "local area | max surface divergence at the end | CPU s, ms per step |")
    print("|---|---|---|---|---|---|---|---|")
    for name in names:
        r = results[name]
        label = name.split(" ", 2)[-1] if "v=" in name else name
        s, per_step = r["series"], 1e3 * r["cpu_seconds"] / r["steps"]
        if not s:
            print(f"| {label} | {r['g']:.3g} | {r['steps']} steps only | | | | | {r['cpu_seconds']:.1f}, {per_step:.0f} |")
            continue
        angle, frequency = s["inclination"][-1] / np.pi, s["frequency"][-1]
        errors = ("", "")
        if at_reference:
            errors = (f" ({angle - at_reference['series']['inclination'][-1] / np.pi:+.5f})",
                      f" ({frequency - at_reference['series']['frequency'][-1]:+.4f})")
        big = r["largest"]
        ended = "" if r["status"] == "completed" else f" (stopped at t = {r['time']:.2f})"
        print(f"| {label}{ended} | {r['g']:.3g} | {angle:.5f}{errors[0]} | {frequency:.4f}{errors[1]} | "
              f"{e(big['area_error'])}, {e(big['volume_error'])} | {e(big['local_area_error'])} | "
              f"{e(s['surface_divergence'][-1])} | {r['cpu_seconds']:.1f}, {per_step:.0f} |")


def transient(results):
    runs = {r["step"]: r["series"]["inclination"][-1] / np.pi for r in results.values()
            if r["set"] == "transient_64" and r["keys"]["time.markers"] == "shape_following"}
    print("\n| dt | inclination / pi at t = 1 | change on halving dt | order |\n|---|---|---|---|")
    steps = sorted(runs, reverse=True)
    changes = [runs[a] - runs[b] for a, b in zip(steps, steps[1:])]
    for i, step in enumerate(steps):
        change = f"{changes[i]:.2e}" if i < len(changes) else ""
        order = f"{np.log2(abs(changes[i] / changes[i + 1])):.2f}" if i + 1 < len(changes) else ""
        print(f"| 1/{round(1 / step)} | {runs[step]:.6f} | {change} | {order} |")


def turning(results):
    print("\n| case | ended | first time along the flow | half periods | largest error of area, volume, local area | "
          "max surface divergence | redistributions | CPU s |\n|---|---|---|---|---|---|---|---|")
    for name, r in results.items():
        if not name.startswith("ratio 20"):
            continue
        t, angle = unwrapped(r)
        times = [x for level in np.arange(np.floor(np.nanmax(angle)), np.nanmin(angle) - 1, -1)
                 for x in crossings(t, angle, level)]
        halves = ", ".join(f"{b - a:.2f}" for a, b in zip(times, times[1:]))
        big = r["largest"]
        print(f"| {name} | {r['status']}, t = {r['time']:.2f} | {times[0] if times else float('nan'):.3f} | {halves} | "
              f"{e(big['area_error'])}, {e(big['volume_error'])}, {e(big['local_area_error'])} | "
              f"{max(r['series']['surface_divergence']):.2e} | {r['redistributions']} | {r['cpu_seconds']:.0f} |")


def steady(results, prefix):
    print("\n| case | ended | inclination / pi at t = 1, 2, 4, end | frequency at the end | "
          "largest error of area, volume, local area | max surface divergence | redistributions | CPU s |")
    print("|---|---|---|---|---|---|---|---|")
    for name, r in results.items():
        if not name.startswith(prefix):
            continue
        t, angle = unwrapped(r)
        at = [f"{angle[np.argmin(abs(t - x))]:.5f}" for x in (1, 2, 4) if x <= t[-1] + 0.01] + [f"{angle[-1]:.5f}"]
        big = r["largest"]
        print(f"| {name} | {r['status']}, t = {r['time']:.2f} | {', '.join(at)} | {r['series']['frequency'][-1]:.4f} | "
              f"{e(big['area_error'])}, {e(big['volume_error'])}, {e(big['local_area_error'])} | "
              f"{max(r['series']['surface_divergence']):.2e} | {r['redistributions']} | {r['cpu_seconds']:.0f} |")


def draw(results, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(2, 1, figsize=(8, 6), sharex=True, layout="constrained")
    for name, r in results.items():
        if not name.startswith("ratio 20"):
            continue
        t, angle = unwrapped(r)
        is_long = r["time"] > 20
        axes[0].plot(t, angle, lw=1.8 if is_long else 1, ls="-" if is_long else "--", label=name)
        if is_long:
            axes[1].semilogy(t, r["series"]["local_area_error"], label="local area error")
            axes[1].semilogy(t, np.abs(r["series"]["volume_error"]) + 1e-17, label="|volume error|")
            axes[1].semilogy(t, np.abs(r["series"]["area_error"]) + 1e-17, label="|area error|")
            axes[1].semilogy(t, r["series"]["surface_divergence"], label="max surface divergence")
    axes[0].set_ylabel("inclination / pi")
    axes[0].legend(fontsize=7)
    axes[0].grid(alpha=0.3)
    axes[1].set_xlabel("t")
    axes[1].legend(fontsize=7, ncols=2)
    axes[1].grid(alpha=0.3)
    pathlib.Path(file).parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, dpi=110)


def main():
    parser = command_line.parser(__doc__, apps=False)
    parser.add_argument("--picture", help="file to draw the tumbling into")
    options = parser.parse_args()
    treading, turned = stored("integrators"), stored("tumbling")
    of = lambda *sets: [k for k, r in treading.items() if r["set"] in sets]
    integrators(treading, of("treading_64", "arkode_64"), "64^3 v=0.9 shape_following 1/48 sigma0=60000", "64^3, 32 latitudes")
    for volume in ("0.9", "0.8"):
        names = [k for k in of("treading_128", "treading_128_small_step", "paper_128") if f"v={volume}" in k]
        integrators(treading, names, None, f"128^3, 64 latitudes, reduced volume {volume}")
    transient(treading)
    turning(turned)
    steady(turned, "ratio 5")
    steady(turned, "64^3 v=0.7")
    if options.picture:
        draw(turned, options.picture)


if __name__ == "__main__":
    main()
