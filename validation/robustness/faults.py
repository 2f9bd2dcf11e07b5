#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Takes away what a run needs: disk, permission, file descriptors, memory; and looks at what it says and leaves.

usage: scripts/python.sh validation/robustness/faults.py [--apps FOLDER] [--short] [--store]

Each time: a clear error that names the file or what ran out, the documented exit code (docs/results.md), files that are whole, a last
checkpoint from which the run goes on to the same bits once the fault is gone. Full disks and read-only folders are mounted, which takes
root; without it they are skipped, with a message, and a limit of the size of files stands in for a full disk. Exit code 1 if anything is
wrong. --store writes validation/results/faults.json.
"""

import collections
import contextlib
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import kills

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from harness import command_line, plans, store, written  # noqa: E402
from harness.runs import ROOT  # noqa: E402

RESULT = ROOT / "validation" / "results" / "faults.json"

DONE, BAD_INPUT, FILE_ERROR, OUT_OF_MEMORY = 0, 2, 4, 5
VARIANT = "equal steps"


class Study:
    def __init__(self, program, work):
        self.program, self.work, self.scene = program, work, work / "scene.toml"
        self.scene.write_text(kills.SCENE)
        self.reference = work / "reference"
        self.problems, self.seen, self.messages = [], collections.Counter(), {}
        self.execute(kills.start_command(program, self.scene, VARIANT, self.reference))

    def execute(self, command, limits=()):
        """Exit code and message of a program under limits of resources."""
        def limit():
            for kind, value in limits:
                resource.setrlimit(kind, (value, value))
        try:
            result = subprocess.run(list(map(str, command)), preexec_fn=limit, stderr=subprocess.PIPE, text=True, timeout=300)
        except subprocess.TimeoutExpired:
            return None, "did not end"
        lines = [line for line in result.stderr.splitlines() if "warning: vesicle 0" not in line]
        return result.returncode, "\n".join(lines)

    def note(self, fault, code, message, allowed, words):
        """allowed: exit codes beside 0. words: of which the message has one if the code is not 0."""
        outcome = {DONE: "no fault", FILE_ERROR: "file error", OUT_OF_MEMORY: "out of memory", BAD_INPUT: "refused"}.get(code, f"code {code}")
        self.seen[f"{fault}: {outcome}"] += 1
        if code == DONE:
            return
        self.messages.setdefault(f"{fault}: {outcome}", message)
        if code not in allowed or "internal error" in message or not any(word in message for word in words):
            self.problems.append(f"{fault}: exit code {code}: {message or 'no message'}")

    def recover(self, fault, folder):
        """After the fault: files are whole, and the run goes on to the bits of one that had none."""
        self.problems += [f"{fault}: {p}" for p in written.problems(folder)]
        if not (folder / "checkpoint.h5").exists():
            return
        self.seen[f"{fault}: gone on"] += 1
        code, message = self.execute([self.program, "--restart", folder / "checkpoint.h5", "--quiet", "--threads", "1"])
        if code != DONE:
            self.problems.append(f"{fault}: restart: exit code {code}: {message}")
        else:
            self.problems += [f"{fault}: {d}" for d in written.differences(self.reference, folder)]

    def start(self, folder):
        return kills.start_command(self.program, self.scene, VARIANT, folder)


def between(least, most, count):
    return [round(least + (most - least) * i / max(1, count - 1)) for i in range(count)]


def full_disk(study, count):
    needed = written.size(study.reference)
    for size in between(300_000, needed + 200_000, count):
        with mounted(study.work / "disk", f"size={size // 4096 * 4096}") as disk:
            if disk is None:
                return study.seen.update(["full disk: skipped, as mounting takes root"])
            code, message = study.execute(study.start(disk / "run"))
            study.note("full disk", code, message, [FILE_ERROR], ["No space left on device"])
            subprocess.run(["mount", "-o", "remount,size=100m", disk], check=True)
            if code != DONE:
                study.recover("full disk", disk / "run")


def limited_files(study, count):
    largest = max(file.stat().st_size for file in study.reference.rglob("*") if file.is_file())
    for number, size in enumerate(between(2_000, largest, count)):
        folder = study.work / f"limited_{number}"
        code, message = study.execute(study.start(folder), [(resource.RLIMIT_FSIZE, size)])
        study.note("limited size of files", code, message, [FILE_ERROR], ["File too large"])
        if code != DONE:
            study.recover("limited size of files", folder)


def read_only(study):
    with mounted(study.work / "protected", "size=10m") as disk:
        if disk is None:
            study.seen.update(["read-only folder: skipped, as mounting takes root"])
        else:
            folder = disk / "run"
            study.execute([*study.start(folder), "--set", "time.end=0.25"])
            subprocess.run(["mount", "-o", "remount,ro", disk], check=True)
            for command in (study.start(folder), study.start(disk / "other"),
                            [*study.start(folder), "--restart", folder / "checkpoint.h5"]):
                code, message = study.execute(command)
                study.note("read-only folder", code, message, [FILE_ERROR], ["Read-only file system; choose another folder with --out"])
            subprocess.run(["mount", "-o", "remount,rw", disk], check=True)
            # Also: the end of the scene is given anew, as that of the checkpoint is the early one.
            code, message = study.execute([*study.start(folder), "--restart", folder / "checkpoint.h5"])
            study.problems += [f"read-only folder: {message}"] if code else []
            study.problems += [f"read-only folder: {d}" for d in written.differences(study.reference, folder)]
    code, message = study.execute(study.start(study.scene / "run"))
    study.note("folder below a file", code, message, [FILE_ERROR], ["Not a directory; choose another folder with --out"])


def few_descriptors(study):
    for limit in (4, 5, 6, 8):
        folder = study.work / f"descriptors_{limit}"
        code, message = study.execute(study.start(folder), [(resource.RLIMIT_NOFILE, limit)])
        study.note("few file descriptors", code, message, [FILE_ERROR, BAD_INPUT], ["Too many open files"])
        if code == FILE_ERROR:
            study.recover("few file descriptors", folder)


def little_memory(study, count):
    """From what the libraries alone need to what the run takes."""
    settings = ["domain.cells=64", "mesh.latitudes=24", "time.end=2/32"]
    planned = plans.plan(study.program, study.scene, settings).memory_mb
    for number, megabytes in enumerate(between(95, 90 + planned, count)):
        folder = study.work / f"memory_{number}"
        more = [word for setting in settings for word in ("--set", setting)]
        code, message = study.execute([*study.start(folder), *more], [(resource.RLIMIT_AS, megabytes << 20)])
        study.note("little memory", code, message, [OUT_OF_MEMORY, FILE_ERROR], ["out of memory", "Cannot allocate memory"])
        study.problems += [f"little memory: {p}" for p in written.problems(folder)] if folder.exists() else []


@contextlib.contextmanager
def mounted(folder, options):
    """A file system in memory; None where it cannot be had."""
    folder.mkdir(exist_ok=True)
    done = os.geteuid() == 0 and subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", folder], stderr=subprocess.DEVNULL).returncode == 0
    try:
        yield folder if done else None
    finally:
        if done:
            subprocess.run(["umount", folder], check=True)


def main():
    parser = command_line.parser(__doc__)
    parser.add_argument("--short", action="store_true", help="three of each, without mounting")
    parser.add_argument("--store", action="store_true", help="write validation/results/faults.json")
    options = parser.parse_args()
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as name:
        study = Study(command_line.program(options), pathlib.Path(name))
        few_descriptors(study)
        limited_files(study, 3 if options.short else 15)
        if not options.short:
            read_only(study)
            full_disk(study, 20)
            little_memory(study, 12)
    for fault, number in sorted(study.seen.items()):
        print(f"  {number:4d} {fault}")
    for fault, message in study.messages.items():
        print(f"{fault}:\n    " + message.replace("\n", "\n    "))
    print("\n".join(study.problems) or "every fault was named, nothing good was lost")
    if options.store:
        result = {
            "case": "faults", "title": "disk, permission, file descriptors and memory taken away",
            "command": "scripts/python.sh validation/robustness/faults.py --store",
            "git_revision": store.revision(), "machine": store.machine(), "wall_seconds": round(time.monotonic() - start),
            "values": {"seen": dict(sorted(study.seen.items())), "problems": study.problems},
        }
        store.write(RESULT, result)
    sys.exit(1 if study.problems else 0)


if __name__ == "__main__":
    main()
