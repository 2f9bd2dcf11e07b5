# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes, simulations of scenes, and runs with files: librun.

>>> import vesiflow
>>> scene = {"domain": {"cells": 16, "lower": [-3, -3, -3], "upper": [3, 3, 3]}, "mesh": {"latitudes": 12},
...          "time": {"step": "1/24", "end": 0.25}, "vesicles": {"reduced_volume": 0.9}}
>>> simulation = vesiflow.Simulation(scene).run()
>>> simulation.diagnostics["inclination_angle_deg"].shape
(6,)
>>> vesiflow.Simulation({"time": {"step": -1}, "vesicles": {"shape": "pear"}})
Traceback (most recent call last):
...
vesiflow.errors.SceneError: 2 mistakes:
  1. scene: time.step = -1: must be > 0
  2. scene: vesicles.0.shape = 'pear': allowed are sphere, prolate, oblate, ellipsoid, biconcave, harmonics, coefficients, mesh
"""
from __future__ import annotations

import concurrent.futures
import contextlib
import functools
import json
import os
import re
import signal
import subprocess
import sys
import threading
from fractions import Fraction
from pathlib import Path
from typing import Any, Callable, Iterator, Mapping, NamedTuple, Optional, Sequence, Union

from . import coupling  # first: it says what is missing where nothing is built
from . import _run
from .coupling import Flow, VectorFunction, as_flow, flattened, set_threads, threads
from .errors import MissingData, SceneError
from .results import Run

SceneSource = Union[str, "os.PathLike[str]", Mapping[str, Any], "Scene"]
#: Keys and values that override those of a scene: a dictionary, or words "key=value" as on the command line.
Overrides = Union[Mapping[str, Any], Sequence[str], None]

__all__ = ["Finished", "Scene", "Simulation", "built_with", "plan", "run", "run_all", "scene_keys", "set_threads", "threads", "version",
           "write_report"]

CHECKPOINT = "checkpoint.h5"


# ---- scenes ----


def _toml_value(key: str, value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, Fraction):
        return json.dumps(str(value)) if value.denominator > 1 else str(value.numerator)
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml_value(key, item) for item in value) + "]"
    raise SceneError(f"scene: {key} = {value!r}: must be a number, text, True or False, or a list of these")


def to_toml(values: Mapping[str, Any]) -> str:
    """A dictionary of keys as the text of a scene file.

    >>> print(to_toml({"time": {"end": 2.0, "step": Fraction(1, 96)}, "domain.cells": 32, "vesicles": [{"shape": "sphere"}]}))
    time.end = 2.0
    time.step = "1/96"
    domain.cells = 32
    [[vesicles]]
    shape = "sphere"
    """
    flat = flattened(values)
    vesicles: dict[int, dict[str, Any]] = {}
    lines = []
    for key, value in flat.items():
        of_vesicle = re.fullmatch(r"vesicles\.(\d+)\.(.+)", key)
        if of_vesicle:
            vesicles.setdefault(int(of_vesicle[1]), {})[of_vesicle[2]] = value
        else:
            lines.append(f"{_toml_key(key)} = {_toml_value(key, value)}")
    given = values.get("vesicles")
    count = max([*vesicles, -1]) + 1
    if isinstance(given, (list, tuple)):
        count = max(count, len(given))  # those that say nothing
    elif isinstance(given, Mapping):
        count = max(count, 1)
    for number in range(count):
        lines.append("[[vesicles]]")
        lines += [f"{_toml_key(key)} = {_toml_value(f'vesicles.{number}.{key}', value)}" for key, value in vesicles.get(number, {}).items()]
    return "\n".join(lines)


def _toml_key(key: str) -> str:
    return ".".join(part if re.fullmatch(r"[A-Za-z0-9_-]+", part) else json.dumps(part, ensure_ascii=False) for part in key.split("."))


def _overrides(given: Overrides) -> list[str]:
    if given is None:
        return []
    if isinstance(given, Mapping):
        return [f"{key}={_override_value(key, value)}" for key, value in flattened(given).items()]
    if isinstance(given, str):
        raise TypeError(f"overrides are a dictionary, or a list of words such as [{given!r}]")
    return list(given)


def _override_value(key: str, value: Any) -> str:
    """The command line takes text without quotes."""
    return os.fspath(value) if isinstance(value, (str, os.PathLike)) else _toml_value(key, value).strip('"')


class Scene:
    """A scene that has been read and checked, with every key. `source` is the path of a scene file or of a run's folder, the text of a scene
    file, or a dictionary; `overrides` change keys of it.

    >>> scene = Scene({"vesicles": {"reduced_volume": 0.9}}, overrides={"time.end": 2})
    >>> scene["time.end"], scene["mesh.latitudes"], scene["vesicles.0.shape"]
    (2.0, 32, 'prolate')
    >>> Scene('[[vesicles]]\\nreduced_volume = 0.25')
    Traceback (most recent call last):
    ...
    vesiflow.errors.SceneError: scene:2: vesicles.0.reduced_volume = 0.25: must be in [0.3, 1]
    """

    def __init__(self, source: SceneSource, overrides: Overrides = None) -> None:
        words = _overrides(overrides)
        self.name: str
        self._core: Any
        if isinstance(source, Scene):
            self.name = source.name
            self._core = source._core if not words else _run.parse_scene(source.to_toml(), source.name, words)
        elif isinstance(source, Mapping):
            self.name = "scene"
            self._core = _of_dictionary(source, words)
        elif isinstance(source, str) and _is_text(source):
            self.name = "scene"
            self._core = _run.parse_scene(source, "scene", words)
        elif isinstance(source, (str, os.PathLike)):
            self.name = os.fspath(source)
            self._core = _run.load_scene(self.name, words)
        else:
            raise TypeError(f"a scene is a path, the text of a scene file or a dictionary, not {source!r}")

    @classmethod
    def of_checkpoint(cls, checkpoint: Union[str, "os.PathLike[str]"], overrides: Overrides = None) -> Scene:
        """The scene that a checkpoint, or the one in a run's folder, was made with."""
        scene = cls.__new__(cls)
        scene.name = str(_checkpoint_file(checkpoint))
        scene._core = _run.read_checkpoint_scene(scene.name, _overrides(overrides))
        return scene

    def to_toml(self) -> str:
        """As a scene file with every key."""
        return self._core.to_toml()

    def to_dict(self) -> dict[str, Any]:
        """Every key by its dotted name."""
        return flattened(_parsed(self.to_toml()))

    def __getitem__(self, key: str) -> Any:
        try:
            return self.to_dict()[key]
        except KeyError:
            raise KeyError(f"{key}: not among the keys of this scene (docs/scene.md lists all)") from None

    def plan(self, directory: Union[str, "os.PathLike[str]"] = ".") -> str:
        """What a run will compute, in words, and what it will take. Nothing of the size of the grid is allocated."""
        return self._core.plan(threads(), os.fspath(directory))

    def memory_warning(self) -> str:
        """What to say of a scene that is planned to take more memory than the machine has free; empty if it fits."""
        return self._core.memory_warning()

    def __repr__(self) -> str:
        return f"<Scene {self.name}>"


def _parsed(text: str) -> dict[str, Any]:
    try:
        import tomllib
    except ImportError:  # before Python 3.11
        import tomli as tomllib  # type: ignore
    return tomllib.loads(text)


def _is_text(source: str) -> bool:
    return "\n" in source or "=" in source and not Path(source).exists()


def _of_dictionary(values: Mapping[str, Any], words: list[str]) -> Any:
    try:
        return _run.parse_scene(to_toml(values), "scene", words)
    except SceneError as error:
        # Lines of a text that nobody has seen say nothing.
        raise SceneError(re.sub(r"(?m)^((?:  +\d+\. )?scene):\d+:", r"\1:", str(error))) from None


def _checkpoint_file(path: Union[str, "os.PathLike[str]"]) -> Path:
    path = Path(path)
    return path / CHECKPOINT if path.is_dir() else path


def scene_keys() -> list[tuple[str, str, str]]:
    """Every key of a scene: its dotted name, its default and what is allowed."""
    return _run.scene_keys()


def plan(scene: SceneSource, overrides: Overrides = None) -> str:
    """What a run of the scene will compute, in words, and what it will take."""
    return Scene(scene, overrides).plan()


def write_report(folder: Union[str, "os.PathLike[str]"], file: Union[str, "os.PathLike[str]", None] = None, *, frames: int = 200,
                 live: bool = False) -> Path:
    """Writes the report of a run, under way or ended, and returns its path: one page of HTML that needs nothing else (docs/report.md).

    file: the page; report.html in the folder unless given.
    frames: snapshots of the membranes that the page holds at most, evenly chosen; 1 or more.
    live: a page for a server on this machine, which it asks for news (`vesiflow view`).
    Raises FileError when the folder holds no run or the file cannot be written, ValueError for frames below 1.
    """
    page = Path(folder) / "report.html" if file is None else Path(file)
    _run.write_report(os.fspath(folder), os.fspath(page), frames, live)
    return page


def version() -> str:
    """Of the library."""
    return _run.version()


def built_with() -> str:
    """What the library was built with."""
    return _run.built_with()


# ---- simulations ----


class Simulation(coupling.Simulation):
    """The simulation of a scene: a path, the text of a scene file or a dictionary.

    - `overrides`: keys that differ from the scene's, {"time.end": 2};
    - `flow`: one of vesiflow.coupling or a function u(x, t), in the place of the scene's;
    - `start_from`: folder or checkpoint of another run, from the end of which this one starts.

    Raises SceneError with all mistakes: its `mistakes` have key, value and what is allowed. Steps and runs are those of
    `vesiflow.coupling.Simulation`, and equal to those of the programs to the last bit.
    """

    def __init__(self, scene: SceneSource, *, overrides: Overrides = None, flow: Union[Flow, VectorFunction, None] = None,
                 start_from: Union[str, "os.PathLike[str]", None] = None) -> None:
        self._prepare()
        self._given = Scene(scene, overrides)
        self._flow = None if flow is None else as_flow(flow)
        self._core = self._made()
        if start_from is not None:
            self._core.start_from(os.fspath(start_from))

    @classmethod
    def restart(cls, checkpoint: Union[str, "os.PathLike[str]"], *, overrides: Overrides = None,
                flow: Union[Flow, VectorFunction, None] = None) -> Simulation:
        """Goes on from a checkpoint, or from that of a run's folder, to the last bit. `overrides` may change time.end, limits and output. A flow
        or forces of your own are no part of a checkpoint: give them again."""
        simulation = cls.__new__(cls)
        simulation._prepare()
        simulation._given = Scene.of_checkpoint(checkpoint, overrides)
        simulation._flow = None if flow is None else as_flow(flow)
        simulation._core = simulation._made()
        simulation._core.restore_checkpoint(str(_checkpoint_file(checkpoint)))
        return simulation

    def _made(self) -> Any:
        scene = self._given._core
        return _run.SceneSimulation(scene) if self._flow is None else _run.SceneSimulation(scene, self._flow.in_domain(scene))

    @property
    def scene(self) -> Scene:
        """With the values that are used."""
        scene = Scene.__new__(Scene)
        scene.name, scene._core = self._given.name, self._core_at_rest().scene()
        return scene

    def _usual_interval(self) -> float:
        return self.scene["output.diagnostics_every"]

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a checkpoint, from which `restart` goes on and the programs do. It appears complete or not at all. Raises FileError."""
        with self._in_use():
            self._core.write_checkpoint(os.fspath(path))

    def restore(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Takes the state of a checkpoint of the same scene. Arrays that were taken before keep the state that they show."""
        if not self._busy.acquire(blocking=False):
            raise RuntimeError("the simulation is inside a step already")
        try:
            core = self._made()
            core.restore_checkpoint(str(_checkpoint_file(path)))
            if self._forces.on_membranes:
                self._forces.attach_membranes(core)
            if self._forces.on_fluid:
                self._forces.attach_fluid(core)
            self._core, self._failed = core, None
            self._rows = [row for row in self._rows if row["step"] <= core.steps()]
        finally:
            self._busy.release()

    @contextlib.contextmanager
    def _between_steps(self) -> Iterator[None]:
        """What a run calls back may ask the simulation."""
        self._busy.release()
        try:
            yield
        finally:
            self._busy.acquire()


# ---- runs ----


class Finished(NamedTuple):
    """How a run has ended."""

    status: str  #: "completed", "out of time", "terminated" ..., as in summary.json
    exit_code: int  #: that of the programs
    results: Run  #: what it has written


def run(scene: Union[SceneSource, Simulation], out: Union[str, "os.PathLike[str]", None] = None, *, overrides: Overrides = None,
        restart: Union[str, "os.PathLike[str]", None] = None, start_from: Union[str, "os.PathLike[str]", None] = None,
        flow: Union[Flow, VectorFunction, None] = None, quiet: bool = True, after_step: Optional[Callable[[Simulation], None]] = None,
        before_output: Optional[Callable[[Simulation, str], None]] = None,
        diagnostics: Optional[Mapping[str, Callable[[Simulation, int], float]]] = None, command: Sequence[str] = ()) -> Finished:
    """Runs a scene, or a simulation to which you have added forces, to its end, and writes what the programs write into the folder `out`
    (docs/results.md; unless told out/NAME_OF_SCENE).

    - `restart`: a checkpoint, or a run's folder, to go on from;
    - `start_from`: the run from the end of which this one starts;
    - `after_step(simulation)` is called after each step, `before_output(simulation, what)` before each output, where `what` is "diagnostics",
      "vesicle_snapshot", "fluid_snapshot" or "checkpoint". What they raise ends the run;
    - `diagnostics`: {name: function(simulation, vesicle)}: columns of your own in diagnostics.csv.

    Ctrl-C ends the run after the step under way, with a checkpoint, and raises KeyboardInterrupt. Raises SceneError, SimulationStopped and
    FileError.
    """
    if isinstance(scene, Simulation):
        if overrides or flow is not None:
            raise TypeError("overrides and flow belong to the simulation: give them when it is made")
        simulation = scene
    else:
        simulation = Simulation(scene, overrides=overrides, flow=flow)
    name = simulation._given.name
    folder = Path(out) if out is not None else Path("out") / (Path(name).stem if Path(name).suffix else Path(name).resolve().name)

    def between(function: Callable, *arguments: Any) -> Any:
        with simulation._between_steps():
            return function(simulation, *arguments)

    options = {
        "program": "vesiflow",
        "scene_file": name,
        "directory": str(folder),
        "checkpoint": None if restart is None else str(_checkpoint_file(restart)),
        "start_from": None if start_from is None else os.fspath(start_from),
        "quiet": quiet,
        "command": list(command),
        "after_step": None if after_step is None else functools.partial(between, after_step),
        "before_output": None if before_output is None else functools.partial(between, before_output),
        "diagnostics": {column: (lambda vesicle, of=of: between(of, vesicle)) for column, of in (diagnostics or {}).items()},
    }
    with simulation._in_use():
        status, code = _run.run(simulation._core, options)
    if status == "interrupted":
        raise KeyboardInterrupt
    return Finished(status, code, Run(folder))


def run_all(scenes: Mapping[str, SceneSource], out: Union[str, "os.PathLike[str]"], *, processes: Optional[int] = None) -> dict[str, Run]:
    """Runs several scenes side by side, each in a process of its own, into the folders `out`/NAME, and returns their results by name.

    All scenes are checked before any is run. `processes` run at once, as many as there are cores unless told, and share the cores. A run that
    ends early has the status that says so; what it said is in `out`/NAME.log. Ctrl-C ends all of them, each with a checkpoint.
    """
    cores = len(os.sched_getaffinity(0))
    at_once = min(processes or cores, max(len(scenes), 1))
    if at_once < 1:
        raise ValueError(f"processes = {processes}: must be >= 1")
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    files = {}
    for name, source in scenes.items():
        if not re.fullmatch(r"[\w.+-]+", name) or name in (".", ".."):
            raise ValueError(f"{name!r}: a name of a run may have letters, digits, and . _ + -, and names no other folder")
        try:
            text = Scene(source).to_toml()
        except SceneError as error:
            raise SceneError(f"{name}: {error}") from None
        files[name] = folder / f"{name}.toml"
        files[name].write_text(text)
    environment = os.environ | {"OMP_NUM_THREADS": str(max(cores // at_once, 1)), "PYTHONPATH": os.pathsep.join(sys.path)}

    def carry_out(name: str) -> None:
        command = [sys.executable, "-m", "vesiflow", "run", str(files[name]), "--out", str(folder / name), "--quiet"]
        with open(folder / f"{name}.log", "w") as log:
            if interrupted.is_set():
                return
            with subprocess.Popen(command, stdout=log, stderr=log, stdin=subprocess.DEVNULL, env=environment) as process:
                under_way[name] = process
                process.wait()

    under_way: dict[str, subprocess.Popen] = {}
    interrupted = threading.Event()
    with concurrent.futures.ThreadPoolExecutor(at_once) as pool:
        try:
            list(pool.map(carry_out, files))
        except KeyboardInterrupt:  # at a terminal the runs have been told, too; where a notebook stops its process alone they have not
            interrupted.set()
            for process in list(under_way.values()):
                if process.poll() is None:
                    process.send_signal(signal.SIGINT)  # twice within a second is once
            raise
    found, missing = {}, []
    for name in files:
        try:
            found[name] = Run(folder / name)
        except MissingData:
            missing.append(name)
    if missing:
        said = "; ".join(f"{name}: {_last_line(folder / f'{name}.log')} ({folder / f'{name}.log'})" for name in missing)
        raise MissingData(f"of {len(files)} runs {len(missing)} did not start, the others are in {folder}: {said}")
    return found


def _last_line(log: Path) -> str:
    lines = log.read_text(errors="replace").strip().splitlines()
    return lines[-1] if lines else "it said nothing"
