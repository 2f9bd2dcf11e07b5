#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Whether two builds compute the same: final states of all scenes, bit for bit.

usage: scripts/python.sh validation/robustness/bits.py --apps FOLDER [--before FOLDER] [--steps N] [--scenes NAME ...] [--threads N]

Runs each scene of scenes/ for a few steps with the app `vesicles` of --apps and prints a checksum (SHA-256) of all numbers of its final
checkpoint and of diagnostics.csv. With --before the same with the apps of another build, for the same processor: exit code 1 if a scene
differs. Bits depend on the processor that is compiled for, so checksums are compared between builds and not stored. Scenes are cut to small
grids unless --full: what is compared is the code, not the physics.
"""

import hashlib
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line, runs  # noqa: E402
from harness.runs import ROOT  # noqa: E402


def scenes(names):
    found = {str(file.relative_to(ROOT / "scenes").with_suffix("")): file for file in sorted((ROOT / "scenes").rglob("*.toml"))}
    for name in names:
        if name not in found:
            sys.exit(f"bits.py: no scene {name}: there are {', '.join(found)}")
    return {name: found[name] for name in names or found}


def step_of(scene):
    """time.step of a scene; the default of docs/scene.md where it has none."""
    return runs.number(scene.get("time", {}).get("step", "1/192" if scene.get("method", {}).get("preset") == "paper" else "1/48"))


def checksum(folder):
    """Of every number of the checkpoint, by the names of its data sets, and of the table."""
    total = hashlib.sha256()
    with h5py.File(folder / "checkpoint.h5") as file:
        names = []
        file.visit(names.append)
        for name in sorted(names):
            data = file[name]
            if isinstance(data, h5py.Dataset) and data.dtype.kind in "fiu":
                total.update(name.encode())
                total.update(data[()].tobytes())
    total.update((folder / "diagnostics.csv").read_bytes())
    return total.hexdigest()[:16]


def state_after(apps, file, steps, threads, full):
    with open(file, "rb") as stream:
        scene = tomllib.load(stream)
    step = step_of(scene)
    settings = [f"time.end={steps * step!r}", f"output.diagnostics_every={step!r}", "output.vesicle_every=0", "output.fluid_every=0",
                "output.checkpoint_every=1e9"]
    cells = scene.get("domain", {}).get("cells", 64)
    if not full and "accuracy" not in scene.get("method", {}):
        cells = cells if isinstance(cells, list) else [cells] * 3
        if max(cells) > 64:
            settings.append(f"domain.cells={[max(16, n // 2) for n in cells]}")
    with tempfile.TemporaryDirectory() as folder:
        command = [str(apps / "vesicles"), str(file), "--quiet", "--out", folder, "--threads", str(threads)]
        for setting in settings:
            command += ["--set", setting]
        run = subprocess.run(command, capture_output=True, text=True, env=runs.environment(threads))
        if run.returncode != 0:
            return f"exit code {run.returncode}: {(run.stderr.strip().splitlines() or [''])[-1]}"
        return checksum(pathlib.Path(folder))


def main():
    parser = command_line.parser(__doc__, apps=False)
    parser.add_argument("--apps", type=pathlib.Path, required=True, help="folder of the built apps")
    parser.add_argument("--before", type=pathlib.Path, help="folder of the apps of another build to compare with")
    parser.add_argument("--steps", type=int, default=12)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--full", action="store_true", help="the grids of the scenes as they are")
    parser.add_argument("--scenes", nargs="+", default=[])
    arguments = parser.parse_args()
    different = []
    for name, file in scenes(arguments.scenes).items():
        sums = [state_after(apps, file, arguments.steps, arguments.threads, arguments.full) for apps in (arguments.before, arguments.apps) if apps]
        same = len(set(sums)) == 1 and not sums[0].startswith("exit code")
        if not same:
            different.append(name)
        print(f"{name:32} {sums[-1]}{'' if len(sums) == 1 else '  same' if same else f'  DIFFERS, was {sums[0]}'}", flush=True)
    if different:
        sys.exit(f"bits.py: not the same: {', '.join(different)}")


if __name__ == "__main__":
    main()
