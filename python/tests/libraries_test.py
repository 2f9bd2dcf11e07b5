# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""vesiflow.vesicle and vesiflow.fluid: that arrays come in and out as they are said to, against what NumPy computes from them."""
import gc
import math
import unittest
import weakref

import numpy as np
from scenes import InScratch
from vesiflow import FileError, fluid, vesicle
from vesiflow.table import Table


class Vesicles(InScratch):
    def test_coefficients_are_those_of_the_harmonics(self):
        grid = vesicle.SphereGrid(12)
        theta, phi = grid.angles
        # Y_2^1 = sqrt(15/8 pi) sin cos e^(i phi), without the phase of Condon and Shortley: f = 2 Re(c Y).
        harmonic = math.sqrt(15 / (8 * math.pi)) * np.sin(theta) * np.cos(theta)
        f = 2 * harmonic * (0.3 * np.cos(phi) - 0.7 * np.sin(phi))
        c = vesicle.SphericalHarmonics(grid).analysis(f)
        self.assertAlmostEqual(c[2, 1], 0.3 + 0.7j, places=13)
        c[2, 1] = 0
        self.assertLess(np.abs(c).max(), 1e-13)

    def test_several_fields_keep_their_places(self):
        harmonics = vesicle.SphericalHarmonics(10)
        rng = np.random.default_rng(3)
        c = rng.normal(size=(10, 10, 2)) + 1j * rng.normal(size=(10, 10, 2))
        c[:, 0].imag = 0
        c[np.triu_indices(10, 1)] = 0
        values = harmonics.synthesis(c)
        np.testing.assert_allclose(harmonics.analysis(values), c, atol=1e-12)
        np.testing.assert_allclose(harmonics.synthesis(c[..., 1]), values[:, 1], atol=1e-12)
        np.testing.assert_allclose(vesicle.evaluate(c, harmonics.grid.directions), values, atol=1e-12)
        step = 1e-6  # central differences are right to its square times a third derivative of size 10^3
        theta, phi = harmonics.grid.angles
        for part, (dt, dp) in zip(harmonics.gradient(c), ((step, 0), (0, step))):
            ends = []
            for sign in (1, -1):
                t, p = theta + sign * dt, phi + sign * dp
                ends.append(vesicle.evaluate(c, np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1)))
            np.testing.assert_allclose((ends[0] - ends[1]) / (2 * step), part, atol=1e-6)

    def test_an_ellipsoid_has_the_curvatures_of_the_formula(self):
        a, b, c = 1.0, 1.5, 2.0
        surface = vesicle.ellipsoid((a, b, c), latitudes=48, radius=(a * b * c) ** (1 / 3))
        x, y, z = surface.positions.T
        h = x**2 / a**4 + y**2 / b**4 + z**2 / c**4
        gauss = 1 / (a * b * c * h) ** 2
        mean = np.abs(x**2 + y**2 + z**2 - a**2 - b**2 - c**2) / (2 * (a * b * c) ** 2 * h**1.5)
        np.testing.assert_allclose(surface.gaussian_curvature, gauss, rtol=1e-9)
        np.testing.assert_allclose(surface.mean_curvature, mean, rtol=1e-9)
        normal = surface.positions / np.array([a, b, c]) ** 2
        np.testing.assert_allclose(surface.normal, normal / np.linalg.norm(normal, axis=1, keepdims=True), atol=1e-11)
        larger, smaller = surface.principal_curvatures
        np.testing.assert_allclose(larger * smaller, gauss, rtol=1e-8)
        np.testing.assert_allclose(surface.moments()["semi_axes"], (c, b, a), rtol=1e-10)
        self.assertAlmostEqual(surface.volume, 4 / 3 * math.pi * a * b * c, places=10)

    def test_calculus_obeys_gauss(self):
        surface = vesicle.biconcave_disc(latitudes=40)
        f, g = surface.positions[:, 0] * surface.positions[:, 2], surface.positions[:, 1] ** 2
        left = surface.integral(f * surface.laplacian(g))
        right = -surface.integral(np.sum(surface.gradient(f) * surface.gradient(g), axis=1))
        self.assertAlmostEqual(left, right, places=8)
        self.assertAlmostEqual(surface.integral(surface.gaussian_curvature), 4 * math.pi, places=8)

    def test_the_bending_force_is_the_derivative_of_the_energy(self):
        surface = vesicle.ellipsoid((1, 1.2, 1.6), latitudes=24)
        shift = 1e-5 * np.cos(surface.positions[:, [2]]) * surface.normal
        energy = [vesicle.Surface(surface.positions + sign * shift).bending_energy() for sign in (1, -1)]
        work = surface.integral(np.sum(surface.bending_force() * shift, axis=1))
        self.assertAlmostEqual((energy[0] - energy[1]) / 2 / -work, 1.0, delta=1e-4)  # by the mesh: the force has the error of Lap H

    def test_placed_turned_and_on_another_mesh(self):
        turn = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])  # x to y, y to z, z to x
        plain = vesicle.prolate(0.8, latitudes=16)
        placed = vesicle.prolate(0.8, latitudes=16, radius=2, centre=(1, 2, 3), rotation=turn)
        np.testing.assert_allclose(placed.positions, 2 * plain.positions @ turn.T + [1, 2, 3], atol=1e-12)
        np.testing.assert_allclose(placed.on_grid(24).area, placed.area, rtol=1e-7)  # of the quadrature on the coarser mesh
        with self.assertRaisesRegex(ValueError, r"rotation has the shape \(2, 2\)"):
            vesicle.sphere(rotation=np.eye(2))

    def test_views_show_what_an_update_changes_and_stay_alive(self):
        surface = vesicle.sphere(12)
        positions, curvature = surface.positions, surface.mean_curvature
        self.assertFalse(positions.flags.writeable or positions.flags.owndata)
        surface.update(2 * np.array(positions))
        np.testing.assert_allclose(np.linalg.norm(positions, axis=1), 2.0)
        np.testing.assert_allclose(surface.mean_curvature, 0.5)
        gone = weakref.ref(surface)
        del surface
        gc.collect()
        self.assertIsNone(gone())
        np.testing.assert_allclose(np.linalg.norm(positions, axis=1), 2.0)
        self.assertTrue(np.all(np.isfinite(curvature)))

    def test_files(self):
        coefficients = vesicle.oblate(0.7, latitudes=8).coefficients
        vesicle.write_coefficients(self.scratch / "shape.txt", coefficients)
        np.testing.assert_array_equal(vesicle.read_coefficients(self.scratch / "shape.txt"), coefficients)
        (self.scratch / "mesh.off").write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
        vertices, triangles = vesicle.read_mesh(self.scratch / "mesh.off")
        np.testing.assert_array_equal(vertices, [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        np.testing.assert_array_equal(triangles, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
        (self.scratch / "mesh.off").write_text("OFF\n4 4 0\n0 0 zero\n")
        with self.assertRaisesRegex(FileError, r"mesh\.off:3"):
            vesicle.read_mesh(self.scratch / "mesh.off")
        with self.assertRaisesRegex(ValueError, "open edge|edge"):
            vesicle.fit_mesh(vertices, triangles[:3], degrees=2)
        with self.assertRaisesRegex(ValueError, r"positions have 7 rows"):
            vesicle.Surface(np.zeros((7, 3)))
        with self.assertRaisesRegex(ValueError, r"field has the shape \(2, 2\)"):
            vesicle.sphere(8).integral(np.zeros((2, 2)))


class Fluids(unittest.TestCase):
    def test_an_elliptic_solution_has_the_right_hand_side(self):
        # The operator by NumPy: fluxes through faces, mu between cells as their mean, none through the walls.
        grid = fluid.Grid((0, 0, 0), (1, 2, 1.5), (8, 10, 12))
        rng = np.random.default_rng(5)
        b, mu = rng.normal(size=grid.cells), rng.uniform(1, 5, size=grid.cells)
        for solver in ("auto", "pcg", "cholmod"):
            x, report = fluid.EllipticSolver(grid, alpha=2.0, mu=mu, solver=solver).solve(b)
            applied = 2.0 * x
            for axis, h in enumerate(grid.spacing):
                along = lambda a, s: a[tuple(s if d == axis else slice(None) for d in range(3))]  # noqa: E731
                first, last = slice(None, -1), slice(1, None)
                flux = (along(mu, first) + along(mu, last)) / 2 * (along(x, last) - along(x, first)) / h
                walls = [(1, 1) if d == axis else (0, 0) for d in range(3)]
                applied -= np.diff(np.pad(flux, walls), axis=axis) / h
            np.testing.assert_allclose(applied, b, atol=1e-7, err_msg=solver)  # pcg stops at 1e-10 of |b| in the mean
            self.assertTrue(report["converged"])
        with self.assertRaisesRegex(ValueError, "fft"):
            fluid.EllipticSolver(grid, mu=mu, solver="fft")
        with self.assertRaisesRegex(ValueError, r"rhs has the shape \(8, 10\).*it must be \(8, 10, 12\)"):
            fluid.EllipticSolver(grid).solve(b[..., 0])

    def test_a_vortex_decays_at_its_rate(self):
        # Taylor and Green's: u = (sin x cos y, -cos x sin y) e^(-2 t / Re), to which convection does nothing but change the pressure.
        errors = []
        for cells in (16, 32):
            grid = fluid.Grid((0, 0, 0), (2 * np.pi,) * 3, (cells, cells, 4), periodic=True)
            flow = fluid.NavierStokes(grid, reynolds_number=4.0)
            flow.set_velocity(grid.velocity(lambda x, y, z: (np.sin(x) * np.cos(y), -np.cos(x) * np.sin(y), 0 * z)))
            for _ in range(cells):
                flow.step(1 / cells)
            exact = grid.velocity(lambda x, y, z: (np.sin(x) * np.cos(y), -np.cos(x) * np.sin(y), 0 * z))
            errors.append(np.abs(flow.velocity.x - np.exp(-2 * flow.time / 4.0) * exact.x).max())
            self.assertAlmostEqual(flow.time, 1.0)
            self.assertLess(flow.max_divergence(), 1e-12)
        self.assertAlmostEqual(errors[0] / errors[1], 4.0, delta=0.6)  # of second order in spacing and step

    def test_a_force_and_a_viscosity_of_arrays(self):
        # A layer of viscosity 4 beside one of 1, sheared by walls: the stress is the same, 1 / (1/4 + 1) = 0.8 of twice the height.
        grid = fluid.Grid((0, 0, 0), (1, 1, 1), (4, 4, 16), periodic=(True, True, False))
        z = grid.cell_centres()[2]
        mu = np.broadcast_to(np.where(z < 0.5, 4.0, 1.0), grid.cells)
        wall = lambda x, t: (1.0 if x[2] > 0.5 else 0.0, 0.0, 0.0)  # noqa: E731
        u, p, report = fluid.Stokes(grid, mu, boundary=wall).solve()
        profile = u.x[0, 0]
        # The face between the layers has their mean viscosity, 2.5: a little stress more.
        resistance = 7.5 / 16 / 4 + 1 / 16 / 2.5 + 7.5 / 16 / 1
        np.testing.assert_allclose(np.diff(profile)[:7], 1 / resistance / 4 / 16, rtol=1e-6)
        np.testing.assert_allclose(np.diff(profile)[8:], 1 / resistance / 16, rtol=1e-6)
        self.assertTrue(report["converged"])
        flow = fluid.NavierStokes(grid, boundary=lambda x, t: (0.0, 0.0, 0.0), inertia="none")
        flow.set_force([np.ones(c.shape) for c in grid.velocity(lambda x, y, z: (x, y, z))])
        flow.step(1.0)
        zf = grid.faces(0)[2]
        np.testing.assert_allclose(flow.velocity.x[0, 0], (zf * (1 - zf)) / 2, atol=2e-3)  # by the wall half a cell away: h^2 / 8
        with self.assertRaisesRegex(ValueError, "inertia = \"some\": allowed are full, unsteady, none"):
            fluid.NavierStokes(grid, inertia="some")

    def test_views_of_the_fluid_are_read_only(self):
        grid = fluid.Grid((0, 0, 0), (1, 1, 1), 8, periodic=True)
        flow = fluid.NavierStokes(grid)
        for array in (*flow.velocity, flow.pressure):
            self.assertFalse(array.flags.writeable or array.flags.owndata)
            self.assertIs(array.base, flow._core)


class Tables(unittest.TestCase):
    def test_a_frame_where_pandas_is(self):
        table = Table(time=np.array([0.0, 1.0]), vesicle=np.array([0, 0]))
        self.assertIn("<td>1</td>", table._repr_html_())
        with self.assertRaisesRegex(IndexError, "no vesicle 3"):
            table.of_vesicle(3)
        try:
            import pandas
        except ImportError:
            with self.assertRaisesRegex(ImportError, "python3-pandas"):
                table.to_pandas()
        else:
            self.assertEqual(table.to_pandas().shape, (2, 2))
            self.assertIsInstance(table.to_pandas(), pandas.DataFrame)


if __name__ == "__main__":
    unittest.main()
