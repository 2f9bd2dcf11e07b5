# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""vesiflow plot on runs made here: what is drawn, what is said, what is left behind."""

import contextlib
import io
import json
import pathlib
import tempfile
import unittest

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402
from vesiflow import plot, plot_history, plot_membranes, plot_references, plot_smooth  # noqa: E402
from vesiflow.results import MissingData, Run  # noqa: E402

COLUMNS = ("step time vesicle inclination_angle_deg tank_treading_frequency area_error volume_error max_local_area_error max_label_area_error "
           "bending_energy reduced_volume deformation centroid_x centroid_y centroid_z min_distance").split()
LATITUDES = 8
plot.STYLE["savefig.dpi"] = 50
plot_membranes.ROWS = 24


def sphere(centre):
    """Markers of a sphere of radius 1, then its poles."""
    colatitude = np.arccos(np.polynomial.legendre.leggauss(LATITUDES)[0])[::-1]
    longitude = np.arange(2 * LATITUDES) * np.pi / LATITUDES
    t, p = np.meshgrid(colatitude, longitude, indexing="ij")
    points = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1).reshape(-1, 3)
    return np.concatenate([points, [[0, 0, 1], [0, 0, -1]]]) + centre


class Folder:
    """A run as docs/results.md describes it, of spheres that move along z with the velocity 0.5 each."""

    def __init__(self, folder, vesicles=1, times=(0.0, 0.5, 1.0), spacing=2.5, **parameters):
        self.folder, self.times = pathlib.Path(folder), times
        side = int(np.ceil(vesicles ** (1 / 3)))
        self.centres = [spacing * (np.array(np.unravel_index(v, (side,) * 3)) - (side - 1) / 2) for v in range(vesicles)]
        self.parameters = {"title": "A test", "flow.type": "shear", "flow.rate": 1.0, "domain.lower": [-4.0] * 3, "domain.upper": [4.0] * 3,
                           "domain.cells": [8] * 3, "domain.periodic": [False] * 3, "domain.mirror": [False] * 3, "time.step": 0.5, "time.end": 1.0,
                           "mesh.latitudes": LATITUDES, "fluid.viscosity_ratio": 1.0, "gravity.acceleration": [0.0, 0.0, 0.0]} | parameters

    def summary(self, status="completed", reason=None):
        summary = {"status": status, "stop_reason": reason, "time": self.times[-1], "parameters": self.parameters}
        self.folder.joinpath("summary.json").write_text(json.dumps(summary))
        return self

    def table(self, **columns):
        """Columns that are given are functions of time and vesicle; others are what an ellipsoid of reduced volume 0.9 may have."""
        usual = {"inclination_angle_deg": lambda t, v: 27 + v, "area_error": lambda t, v: 1e-15 * t, "volume_error": lambda t, v: -1e-14 * t,
                 "max_local_area_error": lambda t, v: 1e-3 * t, "reduced_volume": lambda t, v: 0.9, "centroid_z": lambda t, v: 0.5 * t}
        rows = [",".join(COLUMNS)]
        for step, t in enumerate(self.times):
            for v in range(len(self.centres)):
                of = {"step": lambda t, v: step, "time": lambda t, v: t, "vesicle": lambda t, v: v} | usual | columns
                values = [of.get(name, lambda t, v: 0.4)(t, v) for name in COLUMNS]
                rows.append(",".join("" if value is None else repr(value) for value in values))
        self.folder.joinpath("diagnostics.csv").write_text("\n".join(rows) + "\n")
        return self

    def membranes(self):
        with h5py.File(self.folder / "vesicle.h5", "w") as file:
            for step, t in enumerate(self.times):
                group = file.create_group(f"steps/{step:09d}")
                group.attrs["time"] = t
                for v, centre in enumerate(self.centres):
                    vesicle = group.create_group(f"vesicle_{v}")
                    vesicle.attrs["latitudes"], vesicle.attrs["longitudes"] = LATITUDES, 2 * LATITUDES
                    points = sphere(centre + [0, 0, 0.5 * t])
                    vesicle["positions"], vesicle["tension"] = points, t * (3 * points[:, 2] - 1)
        return self

    def fluid(self):
        with h5py.File(self.folder / "fluid.h5", "w") as file:
            for key in ("lower", "upper", "cells"):
                file.attrs[key] = self.parameters[f"domain.{key}"]
            nx, ny, nz = self.parameters["domain.cells"]
            z = np.linspace(-3.5, 3.5, nz)[:, None, None, None]
            group = file.create_group("steps/000000000")
            group.attrs["time"] = self.times[-1]
            group["velocity"] = (z * np.array([1.0, 0, 0]) * np.ones((nz, ny, nx, 1))).astype("float32")
        return self


class PlotRun(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.path = pathlib.Path(self.scratch.name) / "run"
        self.path.mkdir()

    def run_of(self, **of):
        return Folder(self.path, **of)

    def plot(self, *options):
        """Exit code, output and errors of the program."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = plot.main([str(self.path), *options])
            except SystemExit as end:
                code = end.code
        return code, out.getvalue(), err.getvalue()

    def assert_drawn(self, *names):
        """The pictures are there, no others, and none is blank."""
        self.assertEqual(sorted(p.name for p in self.path.glob("pictures/*")), sorted(names))
        for name in names:
            pixels = plt.imread(self.path / "pictures" / name)[..., :3]
            self.assertGreater(pixels.shape[0], 100)
            self.assertGreater(np.mean(np.any(np.abs(pixels - pixels[0, 0]) > 0.05, axis=-1)), 0.02, name)

    def titles(self):
        figure, _ = plot_history.draw(Run(self.path))
        self.addCleanup(plt.close, figure)
        return [axes.get_title(loc="left") for axes in figure.axes], figure

    def test_whole_run_gives_both_pictures(self):
        self.run_of().summary().table().membranes().fluid()
        code, out, err = self.plot()
        self.assertEqual((code, err), (0, ""))
        self.assert_drawn("history.png", "membrane.png")

    def test_an_animation_and_a_vector_file(self):
        self.run_of(times=(0.0, 1.0)).summary().table().membranes()
        code, out, err = self.plot("--format", "pdf", "--animation")
        self.assertEqual((code, err), (0, ""))
        names = sorted(p.name for p in self.path.glob("pictures/*"))
        self.assertEqual([names[0], names[2]], ["history.pdf", "membrane.pdf"])
        movie = self.path / "pictures" / names[1]
        self.assertIn(movie.suffix, (".mp4", ".gif"))
        self.assertGreater(movie.stat().st_size, 5000)  # two frames that are not blank
        self.assertTrue((self.path / "pictures/history.pdf").read_bytes().startswith(b"%PDF"))

    def test_a_folder_without_a_run_and_a_run_without_anything_leave_nothing_behind(self):
        code, _, err = self.plot()
        self.assertEqual(code, 2)
        self.assertIn("holds no run", err)
        self.run_of().summary("running")
        code, out, err = self.plot()
        self.assertEqual((code, out), (1, ""))
        self.assertIn("nothing is written yet", err)
        self.assertFalse((self.path / "pictures").exists())

    def test_a_table_without_rows_and_one_whose_last_row_is_being_written(self):
        run = Run(self.run_of().summary("running").table().folder)
        table = self.path / "diagnostics.csv"
        lines = table.read_text().splitlines()
        table.write_text("\n".join(lines)[:-20])
        self.assertEqual([len(course["time"]) for course in run.diagnostics()], [2])
        table.write_text(lines[0] + "\n")
        with self.assertRaisesRegex(MissingData, "no rows yet"):
            run.diagnostics()

    def test_snapshots_that_are_off_are_named_by_their_key(self):
        self.run_of(**{"output.vesicle_every": 0}).summary().table()
        code, out, err = self.plot()
        self.assertEqual(code, 0)
        self.assertIn("membrane.png not drawn", err)
        self.assertIn("output.vesicle_every = 0", err)
        self.assert_drawn("history.png")

    def test_one_row_and_one_snapshot_of_a_run_that_stopped_without_a_summary(self):
        self.run_of(times=(0.0,)).table().membranes()
        code, _, err = self.plot()
        self.assertEqual((code, err), (0, ""))
        self.assert_drawn("history.png", "membrane.png")

    def test_eight_and_64_vesicles_in_a_periodic_box(self):
        for count, legends in ((8, True), (64, False)):
            box = {"domain.periodic": [True, True, False], "domain.lower": [-6.0] * 3, "domain.upper": [6.0] * 3}
            self.run_of(vesicles=count, times=(0.0, 1.0), **box).summary().table().membranes()
            code, _, err = self.plot()
            self.assertEqual((code, err), (0, ""))
            self.assert_drawn("history.png", "membrane.png")
            titles, figure = self.titles()
            self.assertEqual(figure.axes[0].get_legend() is not None, legends)
            self.assertIn(f"27.0 to {26 + count}.0° at the end", titles[0])

    def test_half_boxes_and_gravity(self):
        self.run_of(**{"domain.mirror": [False, True, False], "domain.lower": [-4.0, 0.0, -4.0], "domain.cells": [8, 4, 8], "flow.type": "rest",
                       "gravity.acceleration": [0.0, 0.0, -3.0], "vesicles.0.density_difference": 1.0}).summary().table().membranes().fluid()
        code, _, err = self.plot()
        self.assertEqual((code, err), (0, ""))
        titles, _ = self.titles()
        self.assertIn("velocity along gravity: -0.500 at the end; a solid sphere without walls 0.667", titles[0])

    def test_round_off_is_said_and_not_drawn(self):
        self.run_of().summary().table()
        titles, figure = self.titles()
        self.assertIn("area and volume: round-off", titles[-1])
        self.assertEqual(len(figure.axes[-1].lines), 1)
        self.assertGreaterEqual(np.ptp(figure.axes[0].get_ylim()), plot_history.INCLINATION.span)
        self.run_of().summary().table(max_local_area_error=lambda t, v: 0.0)
        titles, figure = self.titles()
        self.assertIn("local area, largest and area and volume: round-off", titles[-1])
        self.assertEqual(len(figure.axes[-1].lines), 0)

    def test_what_is_not_defined_has_no_panel(self):
        self.run_of().summary().table(inclination_angle_deg=lambda t, v: None, reduced_volume=lambda t, v: 1.0)
        titles, _ = self.titles()
        self.assertEqual([t.split(":")[0] for t in titles], ["tank-treading frequency", "relative errors; area and volume"])
        self.assertIn("a solid sphere 0.5", titles[0])

    def test_theory_is_that_of_the_scene(self):
        run = Run(self.run_of().summary().table().folder)
        references = plot_references.of(run, run.diagnostics())
        self.assertAlmostEqual(references["inclination"][0][0], 27.0, delta=0.05)  # Keller & Skalak, reduced volume 0.9, ratio 1
        self.assertAlmostEqual(references["frequency"][0][0], 0.427, delta=5e-4)
        run = Run(self.run_of(**{"fluid.viscosity_ratio": 20.0}).summary().folder)
        self.assertEqual(plot_references.of(run, run.diagnostics())["inclination"], [(None, "Keller & Skalak's ellipsoid: 9.02")])  # it tumbles
        least = dict((label, value) for value, label in plot_references.of(Run(self.run_of(**{"flow.type": "rest"}).summary().folder), run.diagnostics())["energy"])
        self.assertEqual(set(least), {"least of prolates", "least of oblates"})
        self.assertGreater(least["least of oblates"], least["least of prolates"])

    def test_the_state_of_a_run_is_said(self):
        for status, reason, said in (("completed", None, "completed at t = 1"), ("running", None, "under way, or killed: t = 1 of 1"),
                                     ("interrupted", None, "interrupted at t = 1 of 1"), ("stopped", "stopped in step 3: why\n  advice", "stopped in step 3: why")):
            self.assertTrue(plot_history.state(Run(self.run_of().summary(status, reason).folder)).startswith(said))

    def test_a_tumbling_vesicle_has_a_half_turn_and_a_tank_treading_one_none(self):
        time = np.linspace(0, 20, 201)
        self.assertAlmostEqual(plot_history.half_turn(time, (90 - 20 * time + 90) % 180 - 90), 9.0)
        self.assertIsNone(plot_history.half_turn(time, 27 + 60 * np.exp(-time)))

    def test_mean_of_angles_knows_that_they_turn_over(self):
        mean, least, largest = plot_history.mean_and_range(np.array([[89.0], [-89.0], [88.0]]), angle=True)
        self.assertAlmostEqual(mean[0], 89.33, delta=0.01)
        self.assertAlmostEqual(least[0], 88.0)
        self.assertAlmostEqual(largest[0], 91.0)

    def test_vesicles_are_whole_and_in_the_box(self):
        self.run_of(**{"domain.periodic": [True, False, False]}).summary()
        box = Run(self.path).box()
        points = sphere(np.array([4 + 8 + 0.5, 0, 0]))
        (placed, _, _), = plot_membranes.place([(points, points[:, 0], None)], box)
        np.testing.assert_allclose(placed, points - [16, 0, 0])

    def test_the_mirror_image_joins_unless_the_vesicle_lies_across(self):
        faces = np.array([[0, 1, 2, 3]])
        self.run_of(**{"domain.mirror": [False, True, False], "domain.lower": [-4.0, 0.0, -4.0]}).summary()
        box = Run(self.path).box()
        for y, count in ((0.0, 1), (2.0, 2)):
            placed = plot_membranes.place([(sphere(np.array([0, y, 0])), None, faces)], box)
            self.assertEqual(len(placed), count)
        np.testing.assert_allclose(placed[1][0].mean(axis=0), [0, -2, 0], atol=1e-12)

    def test_no_tension_is_white_and_its_sign_is_told(self):
        self.run_of().summary().membranes()
        run = Run(self.path)
        colours, low, high = plot_membranes.tension_colours([run.membranes(2)])
        self.assertLess(low, 0)
        self.assertGreater(high, 0)
        red, _, blue = colours.to_rgba([high, 0.0, low])[:, :3], colours.to_rgba(0.0)[:3], None
        self.assertGreater(red[0][0], red[0][2])
        self.assertLess(red[2][0], red[2][2])
        np.testing.assert_allclose(red[1], red[1][0], atol=0.02)

    def test_all_panels_have_one_scale_and_hold_every_vesicle(self):
        for keys in ({}, {"gravity.acceleration": [0.0, 0.0, -1.0]}):
            run = Run(self.run_of(vesicles=3, times=(0.0, 20.0), **keys).summary().membranes().folder)
            snapshots = [run.membranes(n) for n in (0, 1)]
            centres, reach, _ = plot_membranes.frames(run, snapshots, run.box())
            for centre, membranes in zip(centres, snapshots):
                for points, _, _ in membranes:
                    self.assertTrue(np.all(np.abs(points @ plot_membranes.VIEW.T[:, :2] - centre) <= reach))


class Smooth(unittest.TestCase):
    def test_a_finer_mesh_lies_on_the_surface_of_the_markers(self):
        points = sphere(np.zeros(3)) * [1.0, 1.0, 2.0]  # an ellipsoid, of degree 1: exact
        tension = points[:, 2] ** 2
        fine, values, faces = plot_smooth.smooth((points, tension, None), 40)
        self.assertEqual((fine.shape, faces.shape), ((41 * 80, 3), (40 * 80, 4)))
        np.testing.assert_allclose(np.sum((fine / [1, 1, 2]) ** 2, axis=1), 1.0, atol=1e-13)
        np.testing.assert_allclose(values, fine[:, 2] ** 2, atol=1e-12)
        corners = fine[faces]
        area = 0.5 * np.linalg.norm(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), axis=1).sum()
        exact = 2 * np.pi * (1 + 4 / np.sqrt(3) * np.arcsin(np.sqrt(3) / 2))  # of semi-axes 1, 1 and 2; flat cells have less, by (pi/40)^2/4
        self.assertAlmostEqual(area / exact, 1.0, delta=2e-3)
        self.assertTrue(np.all(np.sum(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]) * corners.mean(axis=1), axis=1) > 0))

    def test_what_would_be_no_finer_stays(self):
        membrane = (sphere(np.zeros(3)), None, None)
        self.assertIs(plot_smooth.smooth(membrane, LATITUDES), membrane)


if __name__ == "__main__":
    unittest.main()
