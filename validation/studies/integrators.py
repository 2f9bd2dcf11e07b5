# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the cases of validation/studies/integrators.md and validation/studies/tumbling.md one after the other, each with one thread.

usage: scripts/python.sh validation/studies/integrators.py SET... [--program build/release/bench/integrators]

A case that is stored already in validation/results/integrators.json (or tumbling.json) is not run again.
validation/studies/integrators_table.py prints the tables.
"""

import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line, runs  # noqa: E402
from harness.outputs import rounded  # noqa: E402
from harness.runs import ROOT  # noqa: E402

TREADING, TUMBLING = "scenes/paper/tank_treading_64.toml", "scenes/tumbling.toml"
FOLLOW = {"coupling.method": "delta", "time.markers": "shape_following"}


def case(name, scene, step, sigma0, end, every=0.25, steps=None, **more):
    keys = {"time.step": f"1/{step}", "membrane.sigma0": sigma0, "time.end": end}
    keys.update(more.pop("keys", {}))
    return name, {"scene": scene, "every": every, "steps": steps, "keys": keys}


def treading(cells, latitudes, markers, step, sigma0, volume=0.9, end=9, steps=None, label="", **keys):
    all_keys = {"domain.cells": cells, "mesh.latitudes": latitudes, "time.markers": markers,
                "vesicles.0.reduced_volume": volume} | {k.replace("__", "."): v for k, v in keys.items()}
    return case(f"{cells}^3 v={volume} {markers}{label} 1/{step} sigma0={sigma0}", TREADING, step, sigma0, end,
                steps=steps, keys=all_keys)


def treading_64():
    yield treading(64, 32, "shape_following", 24, 6000)
    yield treading(64, 32, "euler", 192, 600)
    yield treading(64, 32, "euler", 192, 600, label=", paper preset", method__preset="paper")
    yield treading(64, 32, "ab2", 384, 600)
    yield treading(64, 32, "strain_relaxation", 48, 600)
    yield treading(64, 32, "euler", 192, 600, label=", integral rate 5", membrane__integral_rate=5)
    for sigma0, steps in ((6000, (8, 12, 24, 48)), (60000, (8, 12, 24, 48)), (600, (8, 12, 24, 48))):
        for step in steps:
            yield treading(64, 32, "shape_following", step, sigma0)


def arkode_64():
    yield treading(64, 32, "arkode", 192, 600)


def transient_64():
    for step in (12, 24, 48, 96, 192):
        yield treading(64, 32, "shape_following", step, 6000, end=1, label=", t = 1")


def treading_128():
    for volume in (0.9, 0.8):
        for step in (24, 12, 8):
            yield treading(128, 64, "shape_following", step, 9000, volume=volume)


def treading_128_small_step():
    yield treading(128, 64, "shape_following", 48, 9000)


def paper_128():
    yield treading(128, 64, "euler", 384, 600, steps=30, label=", 30 steps")
    yield treading(128, 64, "euler", 384, 600, steps=30, label=", paper preset, 30 steps", method__preset="paper")


def tumbling():
    def of(treatment, step, end, sigma0=2000, every=0.25, **keys):
        extra = {"fluid.inertia": "none"} if treatment == "none" else {"fluid.viscous_treatment": treatment}
        return case(f"ratio 20 {treatment} 1/{step} t={end}", TUMBLING, step, sigma0, end, every=every,
                    keys=FOLLOW | extra | keys)

    yield of("extrapolated", 48, 50)
    yield of("extrapolated", 24, 10)
    yield of("extrapolated", 96, 10)
    yield of("explicit", 48, 10)
    yield of("explicit", 96, 8)


def tumbling_stokes():
    yield case("ratio 20 none 1/24 t=8", TUMBLING, 24, 2000, 8,
               keys=FOLLOW | {"fluid.inertia": "none"})


def ratio_5():
    for treatment, steps in (("extrapolated", (12, 24, 48, 96)), ("explicit", (24, 48, 96))):
        for step in steps:
            yield case(f"ratio 5 {treatment} 1/{step}", TUMBLING, step, 2000, 6,
                       keys=FOLLOW | {"fluid.viscosity_ratio": 5, "fluid.viscous_treatment": treatment})


def ratio_5_stokes():
    yield case("ratio 5 none 1/24 t=4", TUMBLING, 24, 2000, 4,
               keys=FOLLOW | {"fluid.viscosity_ratio": 5, "fluid.inertia": "none"})


def deflated():
    for step, end in ((24, 20), (48, 5)):
        yield treading(64, 48, "shape_following", step, 4000, volume=0.7, end=end, label=", 48 latitudes")


SETS = {each.__name__: each for each in (treading_64, arkode_64, transient_64, treading_128, treading_128_small_step, paper_128, tumbling,
                                         tumbling_stokes, ratio_5, ratio_5_stokes, deflated)}
STORED_IN = {name: "tumbling" if name.startswith(("tumbling", "ratio", "deflated")) else "integrators" for name in SETS}


def run(program, what):
    command = [program, what["scene"], "--every", str(runs.number(what["every"]))]
    if what["steps"]:
        command += ["--steps", str(what["steps"])]
    for key, value in what["keys"].items():
        command += ["--set", f"{key}={value}"]
    output = subprocess.run(command, cwd=ROOT, env=runs.environment(), stdout=subprocess.PIPE, check=True, text=True).stdout
    return rounded(json.loads(output), digits=8)


def main():
    parser = command_line.parser(__doc__, apps=False)
    parser.add_argument("sets", nargs="+", choices=SETS)
    parser.add_argument("--program", default="build/release/bench/integrators")
    options = parser.parse_args()
    for name in options.sets:
        file = ROOT / "validation" / "results" / f"{STORED_IN[name]}.json"
        stored = json.loads(file.read_text()) if file.exists() else {}
        for label, what in SETS[name]():
            if label in stored:
                continue
            result = run(str(ROOT / options.program), what)
            stored[label] = {"set": name, **what, **result}
            lines = ",\n".join(f" {json.dumps(k)}: {json.dumps(v)}" for k, v in stored.items())
            file.write_text("{\n" + lines + "\n}\n")
            last = {k: v[-1] for k, v in result["series"].items()} if result["series"] else {}
            print(f"{label:60s} {result['status']:9s} t={result['time']:6.2f} cpu={result['cpu_seconds']:7.1f} "
                  f"inclination={(last.get('inclination') or 0) / 3.141592653589793:.5f} pi "
                  f"frequency={last.get('frequency') or 0:.4f} "
                  + " ".join(f"{k}={v:.1e}" for k, v in (result["largest"] or {}).items())
                  + f" div={last.get('surface_divergence') or 0:.2e} redist={result['redistributions']}", flush=True)


if __name__ == "__main__":
    main()
