# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs of scenes: done once, continued from their checkpoints after a kill, shared by the cases that need the same.

A run is a scene and the keys that differ from it. Its folder under out/validation is named after both, so that a changed scene is
run anew (comments do not count) and an unchanged one never twice.
"""

import dataclasses
import hashlib
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

from . import outputs

ROOT = pathlib.Path(__file__).resolve().parents[2]
STORE = ROOT / "out" / "validation"


@dataclasses.dataclass(frozen=True)
class Run:
    """name: within its case. keys: as for --set. Checkpoints (the whole state in double precision) are large and kept where asked for.
    store: where its folder is."""

    name: str
    scene: str
    keys: dict
    keep_checkpoint: bool = False
    store: pathlib.Path = STORE

    def settings(self):
        return [f"{key}={_text(value)}" for key, value in sorted(self.keys.items())]

    def folder(self):
        lines = (line.split("#")[0].strip() for line in (ROOT / self.scene).read_text().splitlines())
        identity = "\n".join([*filter(None, lines), *self.settings()])
        digest = hashlib.sha1(identity.encode()).hexdigest()[:10]
        return self.store / f"{pathlib.Path(self.scene).stem}-{digest}"

    def command(self, program):
        """What a user types."""
        return " ".join([program, self.scene] + [f"--set {s}" for s in self.settings()])


def _text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_text(v) for v in value) + "]"
    return str(value)


def number(value):
    """Of a key that a scene may have as a fraction in quotes: 0.25, "1/4"."""
    above, _, below = str(value).partition("/")
    return float(above) / float(below or 1)


def environment(threads=1):
    """Of a program whose threads do not keep those of others waiting."""
    return os.environ | {"OMP_NUM_THREADS": str(threads), "OMP_WAIT_POLICY": "passive"}


def children_seconds():
    """Of the processor, of all programs that were run and waited for."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def say(line):
    """At once, also into a file."""
    print(line, flush=True)


def finished(run):
    """A run that stopped by itself (a blow-up) is a result too."""
    summary = outputs.summary(run.folder())
    done = summary is not None and summary["status"] in ("completed", "stopped")
    return done and not (run.keep_checkpoint and not (run.folder() / "checkpoint.h5").exists())


_under_way = set()


def stop():
    """Ends the runs under way: each writes a checkpoint."""
    for process in list(_under_way):
        process.terminate()


def stop_when_told():
    """SIGTERM ends the program after the runs under way have been ended."""
    signal.signal(signal.SIGTERM, lambda *_: (stop(), sys.exit(143)))


def execute(run, program, report):
    """Runs to the end; True if it is there. The seconds of all attempts are added up in run.json."""
    folder = run.folder()
    folder.mkdir(parents=True, exist_ok=True)
    checkpoint = folder / "checkpoint.h5"
    resumed = outputs.summary(folder) is not None and checkpoint.exists()
    if not resumed:
        shutil.rmtree(folder)
        folder.mkdir()
    command = [str(program), run.scene, "--out", str(folder), "--threads", "1", "--quiet"]
    for setting in run.settings():
        command += ["--set", setting]
    if resumed:
        command += ["--restart", str(checkpoint)]
    start = time.monotonic()
    with open(folder / "log.txt", "a") as log:
        process = subprocess.Popen(command, cwd=ROOT, env=environment(), stdout=log, stderr=log)
        _under_way.add(process)
        try:
            cpu = _wait(process, lambda: report(run, outputs.last_time(folder), time.monotonic() - start))
        finally:
            if process.returncode is None:
                process.terminate()  # writes a checkpoint
                cpu = _wait(process, lambda: None)
            _under_way.discard(process)
    record = _record(folder)
    record["cpu_seconds"] = record.get("cpu_seconds", 0.0) + cpu
    record["wall_seconds"] = record.get("wall_seconds", 0.0) + time.monotonic() - start
    record["attempts"] = record.get("attempts", 0) + 1
    (folder / "run.json").write_text(json.dumps(record))
    if process.returncode in (130, 143):
        raise KeyboardInterrupt
    if process.returncode not in (0, 3):
        raise SystemExit(f"{run.name}: exit code {process.returncode}, see {folder / 'log.txt'}\n" + (folder / "log.txt").read_text()[-600:])
    if finished(run) and not run.keep_checkpoint:
        checkpoint.unlink(missing_ok=True)
    return finished(run)


def _wait(process, tick):
    """Until the process ends; its processor seconds. Short runs are looked at often."""
    pause = 0.01
    while True:
        ended, status, usage = os.wait4(process.pid, os.WNOHANG)
        if ended:
            process.returncode = os.waitstatus_to_exitcode(status)
            return usage.ru_utime + usage.ru_stime
        tick()
        time.sleep(pause)
        pause = min(0.2, 1.2 * pause)


def _record(folder):
    file = folder / "run.json"
    return json.loads(file.read_text()) if file.exists() else {}


def execute_all(runs, program, jobs):
    """Runs what is not done yet, `jobs` at a time, each with one thread."""
    missing = [run for run in runs if not finished(run)]
    seen = set()
    missing = [run for run in missing if not (run.folder() in seen or seen.add(run.folder()))]
    say(f"{len(runs)} runs, {len(missing)} to do")

    def report(run, reached, seconds):
        if sys.stderr.isatty():
            print(f"\r  {run.name:50.50s} t = {reached:8.3f}  {seconds:7.0f} s", end="", file=sys.stderr, flush=True)

    def one(run):
        start = time.monotonic()
        execute(run, program, report)
        summary = outputs.summary(run.folder())
        say(f"  {run.name}: {summary['status']} at t = {summary['time']:.4g}, {summary['steps']} steps, {time.monotonic() - start:.0f} s")

    if jobs == 1:
        for run in missing:
            one(run)
    else:
        with ThreadPoolExecutor(jobs) as pool:
            list(pool.map(one, missing))


def cpu_seconds(run):
    """Of all attempts."""
    return _record(run.folder())["cpu_seconds"]


def provenance(run):
    """What is stored of a run beside its values."""
    summary = outputs.summary(run.folder())
    return {
        "scene": run.scene,
        "set": {key: value if isinstance(value, (int, float, str, bool)) else _text(value) for key, value in sorted(run.keys.items())},
        "status": summary["status"],
        "stop_reason": (summary["stop_reason"] or "")[:160] or None,
        "time": round(summary["time"], 6),
        "steps": summary["steps"],
        "wall_seconds": round(_record(run.folder())["wall_seconds"], 1),
        "cpu_seconds": round(cpu_seconds(run), 1),
        "git_revision": summary["git_revision"],
    }
