# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What bench/studies/work_precision.py measures: distances of membranes, extrapolation, fronts and levels, against closed forms."""

import pathlib
import sys
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "validation"), str(ROOT / "bench" / "studies")]
from harness import spectral  # noqa: E402
from precision import cases, errors, study  # noqa: E402


def ellipsoid(latitudes, axes, turn=0.0, twist=0.0):
    """Markers, turned about y; twist: the mesh along its parallels, the surface unchanged where the first two axes agree."""
    cosine, _ = spectral.nodes(latitudes)
    sine, phi = np.sqrt(1 - cosine**2)[:, None], np.arange(2 * latitudes) * np.pi / latitudes + twist
    x = np.stack([axes[0] * sine * np.cos(phi), axes[1] * sine * np.sin(phi), axes[2] * (cosine[:, None] + 0 * phi)], axis=-1)
    c, s = np.cos(turn), np.sin(turn)
    return x @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def state(markers, angle, time=(0.0, 1.0, 2.0), **columns):
    course = {"time": np.array(time), "inclination_angle_deg": np.array(angle, dtype=float), "area_error": 0 * np.array(time),
              "volume_error": np.array([0, 0, -1e-7])[: len(time)]} | columns
    return {"membranes": {0.0: markers, 2.0: markers}, "course": course}


class Distance(unittest.TestCase):
    def test_the_mesh_does_not_count(self):
        axes = (0.8, 0.8, 1.55)
        surface = errors.Surface(ellipsoid(32, axes))
        self.assertLess(errors.position_error(ellipsoid(24, axes), surface), 1e-6)
        self.assertLess(errors.position_error(ellipsoid(24, axes, twist=0.3), surface), 1e-6)

    def test_a_larger_sphere_is_off_by_the_difference_of_radii(self):
        surface = errors.Surface(ellipsoid(16, (1, 1, 1)))
        for radius in (1.001, 0.98):
            off = abs(radius - 1)  # relative error: half the squared angle to the nearest mesh point, below (pi/96/2)^2
            self.assertAlmostEqual(errors.position_error(ellipsoid(16, [radius] * 3), surface), off, delta=1e-6 + 2.7e-4 * off)

    def test_a_small_turn_moves_points_by_their_lever_along_the_normal(self):
        a, b, turn = 0.8, 1.55, 1e-3
        x = ellipsoid(32, (a, a, b))
        cosine, weights = spectral.nodes(32)
        normal = x / [a * a, a * a, b * b]
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        sine = np.sqrt(1 - cosine**2)
        area = weights * a * np.sqrt((b * sine) ** 2 + (a * cosine) ** 2)  # of rings, over sin theta
        lever = np.mean((x[..., 2] * normal[..., 0] - x[..., 0] * normal[..., 2]) ** 2, axis=1)
        expected = turn * np.sqrt(np.sum(area * lever) / np.sum(area))
        self.assertAlmostEqual(errors.position_error(ellipsoid(32, (a, a, b), turn), errors.Surface(ellipsoid(32, (a, a, b)))), expected, delta=2e-6)


class References(unittest.TestCase):
    def test_angles_are_combined_and_compared_modulo_half_a_turn(self):
        sphere = ellipsoid(16, (1, 1, 1))
        found = errors.combination([(2.0, state(sphere, [89, -89, 10])), (-1.0, state(sphere, [88, 89, 12]))])
        np.testing.assert_allclose(errors.turned(found["course"]["inclination_angle_deg"] - np.array([90, -87, 8])), 0, atol=1e-9)
        reference = errors.Reference(state(sphere, [0, 90, 60]), {"angle": "inclination_angle_deg"}, 0.5)
        off = reference.errors(state(sphere, [45, -89, 62]))
        self.assertAlmostEqual(off["angle"], np.sqrt((1 + 4) / (90**2 + 60**2)), places=12)  # the first row is too early to count
        self.assertEqual(off["volume"], 1e-7)
        self.assertEqual(off["largest"], off["angle"])

    def test_runs_with_rows_at_other_times_are_compared_where_both_have_some(self):
        sphere = ellipsoid(16, (1, 1, 1))
        reference = errors.Reference(state(sphere, [0, 90, 60]), {"angle": "inclination_angle_deg"}, 0.5)
        other = state(sphere, [0, 7, 63], time=(0.0, 1.3, 2.0))
        self.assertAlmostEqual(reference.errors(other)["angle"], 3 / 60, places=12)


class Study(unittest.TestCase):
    points = {"slow and good": {"cpu_seconds": 9.0, "largest": 1e-4}, "fast": {"cpu_seconds": 1.0, "largest": 9e-3},
              "beaten": {"cpu_seconds": 2.0, "largest": 9e-3}, "middle": {"cpu_seconds": 3.0, "largest": 1.2e-3}, "stopped": {"cpu_seconds": 0.1}}

    def test_the_front_is_what_no_other_run_beats(self):
        self.assertEqual(study.pareto(self.points), ["fast", "middle", "slow and good"])

    def test_the_cheapest_within_a_level_with_the_doubt_of_the_reference_and_without(self):
        self.assertEqual(study.cheapest(self.points, 1e-2)["run"], "fast")
        self.assertEqual(study.cheapest(self.points, 1e-2, 5e-4)["run"], "fast")
        self.assertEqual(study.cheapest(self.points, 1e-2, 2e-3)["run"], "middle")
        self.assertEqual(study.cheapest(self.points, 1e-3)["run"], "slow and good")
        self.assertIsNone(study.cheapest(self.points, 1e-3, 1e-3))

    def test_every_run_has_a_name_of_its_own(self):
        for name in cases.BUILDERS:
            for quick in (True, False):
                case = cases.load(name, quick)
                keys = [k for _, _, k in case.sweeps] + [k for e in (case.reference, *case.others) for _, k in e.parts]
                wanted = case.runs()
                self.assertEqual(len({run.folder() for run in wanted.values()}), len(wanted))
                for k in keys:
                    name_of_it = case.label(k)
                    self.assertEqual(wanted[name_of_it], case.run(name_of_it, k))
                for e in (case.reference, *case.others):
                    self.assertAlmostEqual(sum(w for w, _ in e.parts), 1.0, places=12)


if __name__ == "__main__":
    unittest.main()
