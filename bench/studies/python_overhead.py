# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What it costs to take steps from Python, against the program: scenes/tank_treading_coarse.toml, 64^3 cells.

usage: scripts/python.sh bench/studies/python_overhead.py --apps build/release/apps [--steps 48] [--rounds 5] [--json FILE]

Two measurements, on one thread. Program and package take the same steps in turn, after twelve that do not count, and the least CPU seconds per
step of each are compared: noise of the machine is in that ratio. Without it: what a call of step() takes beside the step itself is timed with a step that does nothing, and
so is reading the arrays of a membrane, and run() with its progress bar; each is given as a share of the step.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

os.environ["OMP_NUM_THREADS"] = "1"  # before the libraries are loaded
import vesiflow  # noqa: E402

SCENE = Path(__file__).resolve().parents[2] / "scenes/tank_treading_coarse.toml"
QUIET = {"output.diagnostics_every": 0, "output.vesicle_every": 0, "output.fluid_every": 0, "output.checkpoint_every": 0}
WARM_UP = 12  # steps
ARRAYS = ("positions", "velocity", "tension", "mean_curvature")


class NoStep:
    """In the place of the library's simulation: all but the step."""

    def __init__(self, core):
        self._core = core

    def step(self):
        pass

    def __getattr__(self, name):
        return getattr(self._core, name)


def cpu_of_program(apps, steps):
    """CPU seconds of the program as a whole."""
    def spent():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime
    with tempfile.TemporaryDirectory() as folder:
        words = [f"{key}={value}" for key, value in {**QUIET, "time.end": f"{steps}/48"}.items()]
        settings = [word for setting in words for word in ("--set", setting)]
        before = spent()
        subprocess.run([apps / "vesicles", SCENE, "--out", folder, "--quiet", "--threads", "1", *settings], check=True)
        return spent() - before


def of_program(apps, steps):
    return (cpu_of_program(apps, WARM_UP + steps) - cpu_of_program(apps, WARM_UP)) / steps


def of_package(steps):
    simulation = vesiflow.Simulation(SCENE, overrides=QUIET)
    for _ in range(WARM_UP):
        simulation.step()
    begin = time.process_time()
    for _ in range(steps):
        simulation.step()
    return (time.process_time() - begin) / steps


def seconds_of(call, repeat=2000):
    """Of a call: the median of five times."""
    times = []
    for _ in range(5):
        begin = time.perf_counter()
        for _ in range(repeat):
            call()
        times.append((time.perf_counter() - begin) / repeat)
    return statistics.median(times)


def beside_the_step():
    simulation = vesiflow.Simulation(SCENE, overrides=QUIET)
    simulation.step()
    simulation._core = NoStep(simulation._core)
    membrane = simulation.membranes[0]

    def run():
        """1000 steps of nothing, which never end: the callback ends them."""
        left = [1000]

        def count(_):
            left[0] -= 1
            return left[0] == 0
        with open(os.devnull, "w") as nothing:
            kept, sys.stderr = sys.stderr, nothing
            try:
                simulation.run(until=1e6, progress=True, record_every=0, callback=count)
            finally:
                sys.stderr = kept
    return {
        "step()": seconds_of(simulation.step),
        "four arrays of a membrane": seconds_of(lambda: [getattr(membrane, name) for name in ARRAYS]),
        "run(), with progress and a callback": seconds_of(run, repeat=1) / 1000,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--apps", type=Path, required=True)
    parser.add_argument("--steps", type=int, default=96)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    program, package = [], []
    for _ in range(arguments.rounds):
        program.append(of_program(arguments.apps.resolve(), arguments.steps))
        package.append(of_package(arguments.steps))
    step, beside = min(program), beside_the_step()
    result = {
        "scene": SCENE.name, "steps": arguments.steps, "rounds": arguments.rounds,
        "package_over_program": min(package) / step, "each_package": [t / step for t in package], "each_program": [t / step for t in program],
        "share_of_a_step": {name: seconds / step for name, seconds in beside.items()},
    }
    print(f"CPU seconds per step, package over program: {result['package_over_program']:.4f}")
    for name, share in result["share_of_a_step"].items():
        print(f"{name}: {100 * share:.4f} % of a step ({1e6 * beside[name]:.1f} microseconds)")
    if arguments.json:
        arguments.json.write_text(json.dumps(result, indent=2) + "\n")


if __name__ == "__main__":
    main()
