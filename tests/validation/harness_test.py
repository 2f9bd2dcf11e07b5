# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the programs of validation/ and bench/ read off their runs and write into pages, against closed forms and independent values."""

import math
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "validation"))
from harness import extrapolation, outputs, runs, shear, spectral, tables, theory  # noqa: E402


class Theory(unittest.TestCase):
    def test_keller_and_skalak_as_computed_independently(self):
        # angle, Eq. (34) over the ellipsoid, critical ratio
        for volume, angle, frequency, critical in ((0.8, 19.70980472552289, 0.35064508845393927, 4.10522),
                                                   (0.9, 27.005129002014876, 0.42728479769286465, 5.26893),
                                                   (0.975, 36.06012105293019, 0.4829750579158279, 9.33101)):
            self.assertAlmostEqual(theory.inclination(volume, 1), angle, places=9)
            self.assertAlmostEqual(theory.frequency(volume, 1), frequency, places=9)
            self.assertAlmostEqual(theory.critical_ratio(volume), critical, places=5)
        self.assertAlmostEqual(theory.phase_frequency(0.9, 1), 0.40456110804821255, places=9)

    def test_quasi_spherical_theory_as_computed_independently(self):
        self.assertAlmostEqual(theory.quasi_spherical_inclination(0.975, 1), 35.44068505433924, places=9)
        self.assertTrue(math.isnan(theory.quasi_spherical_inclination(0.975, 5.92)))  # beyond its critical ratio, 5.90983

    def test_half_period_is_that_of_the_equation_of_motion(self):
        c, angle, time, step = theory.turning(0.9, 20), 0.0, 0.0, 1e-3
        rate = lambda x: -0.5 + c * math.cos(2 * x)  # noqa: E731
        while angle > -math.pi:  # midpoint rule
            angle += step * rate(angle + 0.5 * step * rate(angle))
            time += step
        self.assertAlmostEqual(time, theory.half_period(0.9, 20), delta=2 * step)


class Spectral(unittest.TestCase):
    def setUp(self):
        n = 16
        cosine, _ = spectral.nodes(n)
        theta, phi = np.meshgrid(np.arccos(cosine), np.arange(2 * n) * np.pi / n, indexing="ij")
        self.sphere = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)

    def test_transforms_are_inverse_and_evaluate_on_other_meshes(self):
        x, y, z = np.moveaxis(self.sphere, -1, 0)
        field = x * y * z + z**4 - 2 * x
        self.assertLess(np.abs(spectral.synthesis(spectral.analysis(field), 16) - field).max(), 1e-13)
        coarse = spectral.synthesis(spectral.analysis(self.sphere), 8)
        self.assertLess(np.abs(np.linalg.norm(coarse, axis=-1) - 1).max(), 1e-13)

    def test_surface_divergence(self):
        axes = self.sphere * [1.0, 1.5, 0.7]
        x = self.sphere
        normal = x / [1.0, 1.5, 0.7]
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        gradient = np.array([[0.3, 1.0, 0.0], [0.2, -0.1, 0.5], [0.0, 0.4, 0.6]])
        expected = np.trace(gradient) - np.einsum("...i,ij,...j", normal, gradient, normal)
        self.assertLess(np.abs(spectral.surface_divergence(axes, axes @ gradient.T) - expected).max(), 1e-11)
        self.assertLess(np.abs(spectral.paper_filter(axes, axes @ gradient.T) - axes @ gradient.T).max(), 1e-12)


class Extrapolation(unittest.TestCase):
    def test_polynomials_in_the_spacing_have_their_value_at_zero(self):
        for spacings in ((0.1, 0.2), (0.0625, 0.0833, 0.125)):
            polynomial = np.polynomial.Polynomial([1.7, -3.0, 5.0][: len(spacings)])
            self.assertAlmostEqual(extrapolation.at_zero(spacings, [polynomial(h) for h in spacings]), 1.7, places=12)
            self.assertAlmostEqual(sum(extrapolation.weights_at_zero(spacings)), 1.0, places=12)


class Keys(unittest.TestCase):
    def test_numbers_and_fractions_of_scenes(self):
        for text, value in (("1/48", 1 / 48), (0.25, 0.25), ("3", 3.0), (1e-9, 1e-9), ("5/6", 5 / 6)):
            self.assertEqual(runs.number(text), value)


class Courses(unittest.TestCase):
    def test_differences_of_inclinations_count_modulo_half_a_turn(self):
        np.testing.assert_allclose(outputs.turned(np.array([0.0, 90.0, -90.0, 91.0, -179.0, 540.0])), [0, 90, 90, -89, 1, 0], atol=1e-12)

    def test_half_turns_of_a_steady_rotation(self):
        time = np.linspace(0, 20, 401)
        angle = 90 - 25 * time
        wrapped = 90 - (90 - angle) % 180
        crossings = shear.half_turns({"time": time, "inclination_angle_deg": wrapped})
        np.testing.assert_allclose(crossings, [3.6, 10.8, 18.0], atol=1e-9)

    def test_sections_of_a_sphere_are_circles(self):
        n = 16
        cosine, _ = spectral.nodes(n)
        sine, phi = np.sqrt(1 - cosine**2)[:, None], np.arange(2 * n) * np.pi / n
        markers = np.stack([sine * np.cos(phi), sine * np.sin(phi), cosine[:, None] + 0 * phi], axis=-1).reshape(-1, 3)
        membrane = {"points": np.vstack([markers, [0, 0, 1], [0, 0, -1]]), "faces": outputs._faces(n, 2 * n)}
        ends = outputs.section(membrane, normal=2, position=0.05).reshape(-1, 2)
        self.assertLess(np.abs(np.hypot(*ends.T) - math.sqrt(1 - 0.05**2)).max(), 0.01)


class Tables(unittest.TestCase):
    def test_blocks_are_replaced_and_others_left(self):
        page = "a\n<!-- results one -->\nold\n<!-- end -->\nb\n<!-- results two -->\nkept\n<!-- end -->\n"
        filled = tables.insert(page, {"one": "new"})
        self.assertEqual(filled, page.replace("old", "new"))
        self.assertEqual(tables.insert(filled, {"one": "new"}), filled)

    def test_a_block_has_its_tables_and_its_source_between_empty_lines(self):
        one = tables.table("One", ["a", "b"], [[1, 0.123456]])
        text = "One\n\n| a | b |\n|---|---|\n| 1 | 0.1235 |"
        self.assertEqual(tables.block([one]), f"\n{text}\n")
        self.assertEqual(tables.block([one, one], "`made so`"), f"\n{text}\n\n{text}\n\n`made so`\n")


if __name__ == "__main__":
    unittest.main()
