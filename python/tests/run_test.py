# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs with files: those of the programs to the last bit, results, the command, imports.

usage: run_test.py [APPS]        APPS: the folder of the programs; without it what compares with them is skipped
"""
import ast
import contextlib
import importlib
import io
import json
import os
import pathlib
import signal
import subprocess
import sys
import time
import unittest

import h5py
import numpy as np
import vesiflow
from scenes import InScratch, small
from vesiflow import run as runs
from vesiflow.__main__ import main

APPS = None  # the folder of the programs
VOLATILE = {"program", "scene", "git_revision", "threads", "wall_seconds", "seconds_per_step", "phase_seconds"}


def contents(file):
    """Every data set and attribute of an HDF5 file, links followed."""
    found = {}

    def visit(group, path):
        for name, value in group.attrs.items():
            found[f"{path}@{name}"] = np.asarray(value).tolist()
        if isinstance(group, h5py.Dataset):
            found[path] = (group.shape, str(group.dtype), group[()].tobytes())
        else:
            for name in group:
                visit(group[name], f"{path}/{name}")
    with h5py.File(file) as opened:
        visit(opened, "")
    return found


class AsTheProgramsDo(InScratch):
    def setUp(self):
        super().setUp()
        if APPS is None:
            self.skipTest("no programs were named")

    def test_files_are_those_of_the_program_to_the_last_bit(self):
        for name, keys in {"delta": {}, "sharp": {"coupling.method": "sharp", "fluid.viscosity_ratio": 2.0}, "adaptive": {"time.adaptive": True}}.items():
            with self.subTest(name):
                folder = self.scratch / name
                folder.mkdir()
                scene = folder / "scene.toml"
                scene.write_text(runs.to_toml(small() | keys))
                subprocess.run([APPS / "vesicles", scene, "--out", folder / "app", "--quiet"], check=True, timeout=120)
                ended = runs.run(scene, folder / "python")
                self.assertEqual((ended.status, ended.exit_code), ("completed", 0))
                app, mine = folder / "app", folder / "python"
                self.assertEqual(*({str(p.relative_to(d)) for p in d.rglob("*")} for d in (app, mine)))
                for text in ("diagnostics.csv", "scene.toml"):
                    self.assertEqual((app / text).read_bytes(), (mine / text).read_bytes(), text)
                self.assertEqual((app / "checkpoint.h5").read_bytes(), (mine / "checkpoint.h5").read_bytes())
                for file in ("vesicle.h5", "fluid.h5"):
                    self.assertEqual(contents(app / file), contents(mine / file), file)
                summaries = [json.loads((d / "summary.json").read_text()) for d in (app, mine)]
                for key in VOLATILE:
                    for summary in summaries:
                        summary.pop(key)
                self.assertEqual(*summaries)
                # And steps that are taken one by one, without files.
                stepped = vesiflow.Simulation(scene).run()
                stepped.save(folder / "stepped.h5")
                checksums = [contents(file)["@state_checksum"] for file in (app / "checkpoint.h5", folder / "stepped.h5")]
                self.assertEqual(*checksums)

    def test_the_program_goes_on_from_a_checkpoint_of_python_and_back(self):
        scene = self.scratch / "scene.toml"
        scene.write_text(runs.to_toml(small()))
        whole = runs.run(scene, self.scratch / "whole").results
        vesiflow.Simulation(scene).run(until=0.125).save(self.scratch / "checkpoint.h5")
        subprocess.run([APPS / "vesicles", "--restart", self.scratch / "checkpoint.h5", "--out", self.scratch / "app", "--quiet"], check=True, timeout=120)
        self.assertEqual(contents(self.scratch / "app/checkpoint.h5")["@state_checksum"], contents(whole.checkpoint)["@state_checksum"])


class Runs(InScratch):
    def test_results_are_read_as_they_were_written(self):
        simulation = vesiflow.Simulation(small(vesicles__1__centre=[0, 0, 1.4], vesicles__0__centre=[0, 0, -1.4], vesicles__0__radius=0.6,
                                               vesicles__1__radius=0.6, vesicles__1__reduced_volume=0.95))
        seen = []
        ended = runs.run(simulation, self.scratch / "out", after_step=lambda s: seen.append((s.steps, float(s.membranes[0].positions[0, 0]))),
                         diagnostics={"highest": lambda s, v: float(s.membranes[v].positions[:, 2].max())})
        self.assertEqual([step for step, _ in seen], list(range(1, 13)))
        results = vesiflow.open(self.scratch / "out")
        self.assertEqual(results.status, "completed")
        self.assertEqual(repr(results), repr(ended.results))
        table = results.table()
        self.assertEqual(table["vesicle"][:4].tolist(), [0, 1, 0, 1])
        np.testing.assert_allclose(table.of_vesicle(1)["highest"][-1], simulation.membranes[1].positions[:, 2].max(), rtol=1e-9)  # the digits of the file
        last = results.snapshots[-1]
        self.assertEqual(last.time, 0.25)
        np.testing.assert_array_equal(last.membranes[1].positions, simulation.membranes[1].positions)
        np.testing.assert_array_equal(last.membranes[1].tension, simulation.membranes[1].tension)
        self.assertEqual(len(results.snapshots), len(results.snapshots.times))
        fluid = results.fluid_snapshots[-1]
        np.testing.assert_allclose(fluid.velocity, simulation.fluid.velocity.at_cells(), rtol=1e-6, atol=1e-6)  # in single precision
        np.testing.assert_allclose(fluid.pressure, simulation.fluid.pressure, rtol=1e-6, atol=1e-5)
        with self.assertRaisesRegex(IndexError, "there is no snapshot 99"):
            results.snapshots[99]
        with self.assertRaisesRegex(vesiflow.MissingData, "is not a folder"):
            vesiflow.open(self.scratch / "none")

    def test_diagnostics_have_the_columns_and_rows_of_the_file(self):
        for keys in ({}, {"time.adaptive": True}):
            results = runs.run(small() | keys, self.scratch / "out").results
            simulation = vesiflow.Simulation(small() | keys).run()
            table = simulation.diagnostics
            self.assertEqual(list(table), (results.folder / "diagnostics.csv").read_text().splitlines()[0].split(","))
            for name, column in results.table().items():
                np.testing.assert_allclose(table[name], column, rtol=1e-9, err_msg=name)  # as many digits as the file has

    def test_what_is_called_back_ends_the_run_with_its_own_exception(self):
        def fail(simulation):
            raise KeyError("mine")
        with self.assertRaisesRegex(KeyError, "mine"):
            runs.run(small(), self.scratch / "out", after_step=fail)

    def test_ctrl_c_ends_a_run_with_a_checkpoint(self):
        def interrupt(simulation):
            if simulation.steps == 5:
                os.kill(os.getpid(), signal.SIGINT)
        with self.assertRaises(KeyboardInterrupt):
            runs.run(small(), self.scratch / "out", after_step=interrupt)
        results = vesiflow.open(self.scratch / "out")
        self.assertEqual(results.status, "interrupted")
        self.assertEqual(vesiflow.Simulation.restart(results.checkpoint).steps, 5)
        ended = runs.run(runs.Scene.of_checkpoint(results.folder), results.folder, restart=results.folder)
        whole = runs.run(small(), self.scratch / "whole").results
        self.assertEqual(contents(ended.results.checkpoint)["@state_checksum"], contents(whole.checkpoint)["@state_checksum"])
        self.assertEqual((results.folder / "diagnostics.csv").read_text().splitlines()[-1], (whole.folder / "diagnostics.csv").read_text().splitlines()[-1])

    def test_a_run_starts_from_another(self):
        first = runs.run(small(), self.scratch / "first").results
        next_one = vesiflow.Simulation(small(mesh__latitudes=20), start_from=first.folder)
        self.assertEqual(next_one.time, 0.0)
        self.assertAlmostEqual(next_one.measure()[0]["inclination_angle_deg"], first.vesicles[0]["inclination_angle_deg"], delta=0.1)


class Command(InScratch):
    def call(self, *words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = main([str(word) for word in words])
            except SystemExit as end:
                code = end.code
        return code, out.getvalue(), err.getvalue()

    def test_run_and_plot(self):
        scene = self.scratch / "scene.toml"
        scene.write_text(runs.to_toml(small()))
        code, out, err = self.call("run", scene, "--out", self.scratch / "out", "--set", "time.end=0.125", "--quiet")
        self.assertEqual((code, out, err), (0, "", ""))
        self.assertEqual(vesiflow.open(self.scratch / "out").scene["time.end"], 0.125)
        code, _, _ = self.call("run", "--restart", self.scratch / "out", "--set", "time.end=0.25", "--quiet")
        self.assertEqual(code, 0)
        self.assertEqual(vesiflow.open(self.scratch / "out").table()["time"][-1], 0.25)
        code, out, err = self.call("plot", self.scratch / "out")
        self.assertEqual((code, err), (0, ""))
        self.assertEqual(sorted(p.name for p in (self.scratch / "out/pictures").iterdir()), ["history.png", "membrane.png"])

    def test_exit_codes_are_those_of_the_programs(self):
        scene = self.scratch / "scene.toml"
        scene.write_text(runs.to_toml(small(limits__local_area_error=1e-9)))
        self.assertEqual(self.call("run", scene, "--out", self.scratch / "out", "--quiet")[0], 3)
        code, _, err = self.call("run", scene, "--set", "time.step=-1")
        self.assertEqual(code, 2)
        self.assertIn("time.step = -1: must be > 0", err)
        self.assertEqual(self.call("run", scene, "--out", "/proc/nowhere", "--quiet")[0], 4)
        self.assertEqual(self.call("run")[0], 2)
        self.assertEqual(self.call("fly")[0], 2)
        self.assertIn("run SCENE", self.call("--help")[1])
        code, out, _ = self.call("run", scene, "--plan")
        self.assertEqual(code, 0)
        self.assertIn("16", out)


class Modules(unittest.TestCase):
    def loaded_by(self, code):
        """The libraries of this package that a process has loaded."""
        script = code + "\nprint(sorted({l.split('/')[-1].strip() for l in open('/proc/self/maps') if 'vesiflow' in l.split('/')[-1]}))"
        return subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True).stdout

    def test_each_module_loads_what_it_needs_alone(self):
        self.assertEqual(self.loaded_by("import vesiflow").strip(), "[]")
        for module, without in (("vesicle", ("fluid", "coupling", "run")), ("fluid", ("vesicle", "coupling", "run")), ("coupling", ("run",))):
            loaded = self.loaded_by(f"import vesiflow.{module}")
            self.assertIn(f"libvesiflow_{module}.so", loaded)
            for other in without:
                self.assertNotIn(f"libvesiflow_{other}.so", loaded)

    def test_without_compiled_parts_what_to_do_is_said(self):
        source = pathlib.Path(__file__).resolve().parents[1]
        if not (source / "vesiflow").is_dir():
            self.skipTest("the sources are not beside the tests")
        for code in ("import vesiflow; vesiflow.Simulation", "import vesiflow.vesicle", "import vesiflow.coupling"):
            ended = subprocess.run([sys.executable, "-c", code], cwd=source, env={**os.environ, "PYTHONPATH": str(source)}, capture_output=True, text=True, check=False)
            self.assertEqual(ended.returncode, 1)
            self.assertIn("--target python_package", ended.stderr)

    def test_results_are_read_without_any_compiled_part(self):
        self.assertEqual(self.loaded_by("import vesiflow.results, vesiflow.plot_history, vesiflow.plot_membranes").strip(), "[]")

    def test_stubs_name_what_the_compiled_modules_have(self):
        for name in ("_vesicle", "_fluid", "_coupling", "_run"):
            module = importlib.import_module(f"vesiflow.{name}")
            stub = ast.parse((pathlib.Path(vesiflow.__file__).parent / f"{name}.pyi").read_text())
            said = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
            self.assertEqual(set(said), {member for member in vars(module) if not member.startswith("_")}, name)
            for kind, node in said.items():
                if not isinstance(node, ast.ClassDef):
                    continue
                members = {item.name if isinstance(item, ast.FunctionDef) else item.target.id for item in node.body}
                self.assertEqual(members - {"__init__"}, {m for m in vars(getattr(module, kind)) if not m.startswith("_")}, f"{name}.{kind}")

    def test_names_and_their_documentation(self):
        for name in vesiflow.__all__:
            self.assertIsNotNone(getattr(vesiflow, name).__doc__, name)
        for module in (vesiflow.vesicle, vesiflow.fluid, vesiflow.coupling, runs, vesiflow.results):
            for name in module.__all__:
                thing = getattr(module, name)
                self.assertTrue(thing.__doc__, f"{module.__name__}.{name}")
                for member, value in vars(thing).items() if isinstance(thing, type) else ():
                    if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                        self.assertTrue(value.__doc__, f"{module.__name__}.{name}.{member}")
        with self.assertRaises(AttributeError):
            vesiflow.nothing


class WhenSomethingFails(InScratch):
    def test_a_function_that_raises_leaves_a_folder_that_says_so_and_a_checkpoint_of_the_last_step(self):
        def boom(simulation):
            if simulation.steps == 7:
                raise KeyError("my analysis failed")

        folder = self.scratch / "boom"
        with self.assertRaisesRegex(KeyError, "my analysis failed"):
            runs.run(small(), folder, after_step=boom)
        stored = vesiflow.open(folder)
        self.assertEqual(stored.status, "stopped")
        self.assertIn("my analysis failed", stored.summary["stop_reason"])
        self.assertTrue((folder / "report.html").exists())
        self.assertEqual(vesiflow.Simulation.restart(stored.checkpoint).steps, 7)
        self.assertFalse((folder / "run.lock").exists())

    def test_a_force_that_raises_within_a_step_keeps_the_last_good_checkpoint(self):
        simulation = runs.Simulation(small())

        def boom(time, vesicle, surface):
            if time > 0.2:
                raise RuntimeError("my force failed")
            return np.zeros_like(surface.positions)

        simulation.add_force(boom)
        folder = self.scratch / "force"
        with self.assertRaisesRegex(RuntimeError, "my force failed"):
            runs.run(simulation, folder)
        stored = vesiflow.open(folder)
        self.assertEqual(stored.status, "stopped")
        self.assertEqual(vesiflow.Simulation.restart(stored.checkpoint).steps, 6)  # output.checkpoint_every = 0.125

    def test_snapshots_whose_files_are_gone_are_left_out(self):
        folder = self.scratch / "run"
        runs.run(small(), folder)
        times = vesiflow.open(folder).snapshots.times
        files = sorted((folder / "snapshots").glob("vesicle_*.h5"))
        files[1].unlink()
        files[2].write_bytes(files[2].read_bytes()[:100])
        left = vesiflow.open(folder).snapshots
        np.testing.assert_array_equal(left.times, np.delete(times, [1, 2]))
        self.assertEqual(left[-1].time, times[-1])
        self.assertEqual(left[-1].membranes[0].positions.shape, (16 * 32, 3))
        for file in (folder / "snapshots").glob("vesicle_*.h5"):
            file.unlink()
        self.assertEqual(len(vesiflow.open(folder).snapshots), 0)
        with self.assertRaisesRegex(vesiflow.MissingData, "gone or damaged"):
            vesiflow.open(folder).membranes(-1)

    def test_runs_side_by_side_stay_in_their_folder_and_say_which_did_not_start(self):
        with self.assertRaisesRegex(ValueError, "no other folder"):
            runs.run_all({"..": small()}, self.scratch / "all")
        (self.scratch / "all").mkdir(exist_ok=True)
        (self.scratch / "all" / "bad").write_text("in the way")
        with self.assertRaisesRegex(vesiflow.MissingData, "bad: .*bad.log"):
            runs.run_all({"good": small(), "bad": small()}, self.scratch / "all")
        self.assertEqual(vesiflow.open(self.scratch / "all" / "good").status, "completed")

    def test_an_interrupt_of_the_process_alone_ends_runs_side_by_side(self):
        script = self.scratch / "long.py"
        script.write_text("from scenes import small\nfrom vesiflow import run\n"
                          f"run.run_all({{'a': small(time__end=1000), 'b': small(time__end=1000)}}, {str(self.scratch / 'long')!r})\n")
        process = subprocess.Popen([sys.executable, script], env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}, stderr=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        summaries = [self.scratch / "long" / name / "summary.json" for name in "ab"]
        deadline = time.monotonic() + 60
        while not all(s.exists() and json.loads(s.read_text())["steps"] > 0 for s in summaries) and time.monotonic() < deadline:
            time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        process.wait(60)
        for summary in summaries:
            self.assertEqual(json.loads(summary.read_text())["status"], "interrupted")
            self.assertTrue((summary.parent / "checkpoint.h5").exists())

    def test_damaged_files_are_named(self):
        folder = self.scratch / "run"
        runs.run(small(), folder)
        (folder / "summary.json").write_text("[]")
        self.assertEqual(vesiflow.open(folder).status, "unknown")
        (folder / "diagnostics.csv").write_bytes(bytes(range(256)))
        with self.assertRaisesRegex(vesiflow.MissingData, "diagnostics.csv"):
            vesiflow.open(folder).table()

    def test_titles_may_have_any_characters(self):
        self.assertEqual(runs.Scene(small(title="run \U0001F600")).to_dict()["title"], "run \U0001F600")

    def test_theory_refuses_what_is_no_reduced_volume(self):
        self.assertGreater(vesiflow.theory.inclination(0.9, 1.0), 20.0)
        for volume in (-1.0, 0.0, 1.0, 1.2, float("nan")):
            with self.assertRaisesRegex(ValueError, f"reduced_volume = {volume}"):
                vesiflow.theory.inclination(volume, 1.0)


if __name__ == "__main__":
    if len(sys.argv) > 1 and pathlib.Path(sys.argv[1]).is_dir():
        APPS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
