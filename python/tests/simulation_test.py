# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Simulations: views, their lives, steps, forces, flows, errors."""
import gc
import os
import signal
import sys
import threading
import time
import unittest
import weakref

import numpy as np
import vesiflow
from scenes import InScratch, small
from vesiflow import coupling

ARRAYS = ("positions", "velocity", "force", "tension", "mean_curvature", "gaussian_curvature", "normal", "area_weight")
#: Every way in which markers move and membranes meet the grid, by what differs from small().
VARIANTS = {
    "shape_following": {},
    "sharp": {"coupling.method": "sharp"},
    "sharp between two viscosities": {"coupling.method": "sharp", "fluid.viscosity_ratio": 2.0},
    "sharp with inertia": {"coupling.method": "sharp", "fluid.viscosity_ratio": 2.0, "fluid.reynolds_number": 1.0},
    "field of viscosity": {"coupling.method": "delta", "fluid.viscosity_ratio": 2.0},
    "euler": {"time.markers": "euler", "membrane.sigma0": 100.0},
    "adaptive": {"time.adaptive": True, "coupling.method": "delta"},
    "without inertia": {"fluid.inertia": "none", "coupling.method": "delta"},
}


def address(array):
    return array.__array_interface__["data"][0]


class Views(unittest.TestCase):
    def test_arrays_are_views_that_cannot_be_written(self):
        simulation = vesiflow.Simulation(small())
        simulation.step()
        membrane = simulation.membranes[0]
        arrays = {name: getattr(membrane, name) for name in ARRAYS}
        arrays |= {f"fluid {axis}": array for axis, array in zip("xyz", simulation.fluid.velocity)} | {"pressure": simulation.fluid.pressure}
        for name, array in arrays.items():
            self.assertFalse(array.flags.owndata, name)
            self.assertFalse(array.flags.writeable, name)
            with self.assertRaises(ValueError, msg=name):
                array[0] = 0.0
            with self.assertRaises(ValueError, msg=name):
                array.flags.writeable = True
            self.assertIs(array.base, simulation._core, name)
        for name in ARRAYS:
            self.assertEqual(address(arrays[name]), address(getattr(membrane, name)), name)

    def test_positions_stay_where_they_are_and_move(self):
        for name, keys in VARIANTS.items():
            with self.subTest(name):
                simulation = vesiflow.Simulation(small() | keys)
                simulation.step()
                membrane = simulation.membranes[0]
                places = {array: address(getattr(membrane, array)) for array in ARRAYS}
                positions = membrane.positions
                before = positions.copy()
                for _ in range(3):
                    simulation.step()
                self.assertEqual(places, {array: address(getattr(membrane, array)) for array in ARRAYS})
                self.assertGreater(np.abs(positions - before).max(), 1e-3)

    def test_shapes_and_values_are_those_of_the_state(self):
        simulation = vesiflow.Simulation(small(vesicles__0__centre=[0.25, 0, 0]))
        simulation.step()
        membrane, now = simulation.membranes[0], simulation.measure()[0]
        self.assertEqual(membrane.positions.shape, (512, 3))
        self.assertEqual(membrane.tension.shape, (512,))
        self.assertAlmostEqual(membrane.area_weight.sum(), now["area"], places=13)
        volume = np.sum(membrane.positions * membrane.normal * membrane.area_weight[:, None]) / 3
        self.assertAlmostEqual(volume, now["volume"], places=13)
        self.assertEqual(membrane.tension.max(), now["tension_max"])
        self.assertEqual(np.abs(membrane.local_area_error).max(), now["max_local_area_error"])
        u = simulation.fluid.velocity
        self.assertEqual([c.shape for c in u], [(17, 16, 16), (16, 17, 16), (16, 16, 17)])
        x, y, z = simulation.fluid.grid.faces(0)
        np.testing.assert_array_equal(u.x[0], np.broadcast_to(z, (16, 16)))  # the wall moves as the flow does
        divergence = np.diff(u.x, axis=0) + np.diff(u.y, axis=1) + np.diff(u.z, axis=2)
        self.assertLess(np.abs(divergence).max() / 0.375, 1e-11)  # round-off of numbers of size 3 over h

    def test_arrays_outlive_the_simulation(self):
        simulation = vesiflow.Simulation(small())
        simulation.step()
        arrays = [simulation.membranes[0].positions, simulation.fluid.velocity.x, simulation.fluid.pressure]
        copies = [array.copy() for array in arrays]
        gone = weakref.ref(simulation)
        del simulation
        gc.collect()
        self.assertIsNone(gone())
        rubbish = [np.full(array.shape, np.nan) for array in arrays for _ in range(20)]  # takes memory that would have been freed
        for array, copy in zip(arrays, copies):
            np.testing.assert_array_equal(array, copy)
        del rubbish

    def test_a_simulation_that_refers_to_itself_by_its_forces_goes(self):
        simulation = vesiflow.Simulation(small())
        simulation.add_force(lambda t, vesicle, surface: simulation.parameters and None)
        simulation.set_fluid_force(lambda x, t: (simulation.name, 0, 0))
        core, gone = weakref.ref(simulation._forces), weakref.ref(simulation)
        del simulation
        gc.collect()
        self.assertIsNone(gone())
        self.assertIsNone(core())

    def test_nothing_is_left_behind_by_a_thousand_views(self):
        simulation = vesiflow.Simulation(small())
        simulation.step()

        def look():
            for _ in range(200):
                for name in ARRAYS:
                    getattr(simulation.membranes[0], name)
                simulation.fluid.velocity, simulation.fluid.pressure, simulation.measure(), simulation.parameters
        look()
        gc.collect()
        references, blocks = sys.getrefcount(simulation._core), sys.getallocatedblocks()
        look()
        gc.collect()
        self.assertEqual(sys.getrefcount(simulation._core), references)
        self.assertLess(sys.getallocatedblocks() - blocks, 100)  # of 1600 views; a leak of one block each would be more


class Steps(InScratch):
    def test_parameters_scene_and_run_are_the_same_simulation(self):
        scene = small()
        of_scene = vesiflow.Simulation(scene)
        parameters = {key: value for key, value in of_scene.parameters.items()}
        alone = coupling.Simulation(parameters, coupling.shear_flow())
        for _ in range(3):
            of_scene.step()
            alone.step()
        np.testing.assert_array_equal(of_scene.membranes[0].positions, alone.membranes[0].positions)
        np.testing.assert_array_equal(of_scene.fluid.pressure, alone.fluid.pressure)

    def test_run_ends_where_it_is_told_and_records(self):
        seen = []
        simulation = vesiflow.Simulation(small()).run(until=0.125, callback=lambda s: seen.append(s.steps))
        self.assertEqual(simulation.steps, 6)
        self.assertEqual(seen, [1, 2, 3, 4, 5, 6])
        table = simulation.diagnostics
        self.assertEqual(table["step"].tolist(), [0, 2, 5, 6])  # the steps nearest to 0.05 and 0.1, and the ends
        simulation.run()
        self.assertTrue(simulation.finished)
        self.assertEqual(simulation.steps, 12)
        self.assertTrue(np.all(np.diff(simulation.diagnostics["step"]) > 0))
        stopped = vesiflow.Simulation(small()).run(callback=lambda s: s.steps == 2)
        self.assertEqual(stopped.steps, 2)

    def test_restart_repeats_the_run_to_the_last_bit(self):
        for name, keys in VARIANTS.items():
            with self.subTest(name):
                whole = vesiflow.Simulation(small() | keys).run(until=0.0625, record_every=0)
                file = self.scratch / "checkpoint.h5"
                whole.save(file)
                whole.run(until=0.125, record_every=0)
                again = vesiflow.Simulation.restart(file)
                again.run(until=0.125, record_every=0)
                self.assertEqual(again.steps, whole.steps)
                np.testing.assert_array_equal(again.membranes[0].positions, whole.membranes[0].positions)
                np.testing.assert_array_equal(again.fluid.velocity.x, whole.fluid.velocity.x)
                kept = whole.membranes[0].positions
                later = kept.copy()
                whole.restore(file)
                self.assertLess(whole.steps, again.steps)
                np.testing.assert_array_equal(kept, later)  # an array from before shows what it did
                whole.run(until=0.125, record_every=0)
                np.testing.assert_array_equal(again.membranes[0].positions, whole.membranes[0].positions)

    def test_the_number_of_threads_changes_no_bit(self):
        before, found = coupling.threads(), []
        try:
            for count in (1, 2):
                coupling.set_threads(count)
                self.assertEqual(coupling.threads(), count)
                simulation = vesiflow.Simulation(small(domain__cells=24))
                for _ in range(2):
                    simulation.step()
                found.append((simulation.membranes[0].positions, simulation.fluid.velocity.x, simulation.fluid.pressure))
        finally:
            coupling.set_threads(before)
        for one, two in zip(*found):
            np.testing.assert_array_equal(one, two)
        with self.assertRaisesRegex(ValueError, "threads = 0: must be from 1 to 1024"):
            coupling.set_threads(0)

    def test_the_lock_of_the_interpreter_is_released_in_steps(self):
        simulation = vesiflow.Simulation(small(domain__cells=32))
        simulation.step()
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0)
        other = threading.Thread(target=count)
        interval = sys.getswitchinterval()
        sys.setswitchinterval(60)  # no one is made to hand over the lock
        try:
            other.start()
            time.sleep(0.01)
            before, steps = counted[0], 0
            while counted[0] <= before + 10 and steps < 100:  # on a busy machine the other thread may have to wait for a processor
                simulation._core.step()
                steps += 1
            during = counted[0] - before
        finally:
            done.set()
            sys.setswitchinterval(interval)
            other.join()
        self.assertGreater(during, 10)

    def test_another_thread_is_refused_inside_a_step(self):
        simulation = vesiflow.Simulation(small())
        refused = []

        def look(t, vesicle, surface):
            for ask in (lambda: simulation.membranes[0].positions, simulation.measure, simulation.step, lambda: simulation.fluid.pressure):
                try:
                    ask()
                except RuntimeError as error:
                    refused.append(str(error))
        simulation.add_force(look)
        simulation.step()
        self.assertGreaterEqual(len(refused), 4)
        self.assertTrue(all("inside a step" in text for text in refused), refused)

    def test_ctrl_c_comes_between_two_steps(self):
        plain = vesiflow.Simulation(small()).run(until=1 / 12, record_every=0)

        def interrupt(t, vesicle, surface):  # in the middle of a step
            if abs(t - 3 / 48) < 1e-9 or simulation.steps_seen == 3:
                os.kill(os.getpid(), signal.SIGINT)
                simulation.steps_seen = -1

        for run in (lambda: simulation.run(until=1 / 12, record_every=0), lambda: [simulation.step() for _ in range(4)]):
            simulation = vesiflow.Simulation(small())
            simulation.steps_seen = 0
            simulation.add_force(interrupt)
            with self.assertRaises(KeyboardInterrupt):
                run()
            self.assertGreater(simulation.steps, 0)
            self.assertLess(simulation.steps, 5)
            self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
            simulation.run(until=1 / 12, record_every=0)
            np.testing.assert_array_equal(simulation.membranes[0].positions, plain.membranes[0].positions)


class Functions(unittest.TestCase):
    def test_a_flow_of_a_function_is_the_flow(self):
        named = vesiflow.Simulation(small())
        own = vesiflow.Simulation(small(), flow=lambda x, t: (x[2], 0.0, 0.0))
        for _ in range(3):
            named.step()
            own.step()
        np.testing.assert_array_equal(named.membranes[0].positions, own.membranes[0].positions)

    def test_an_unsteady_flow_is_asked_at_each_time(self):
        times = set()

        def swing(x, t):
            times.add(round(t * 48, 6))
            return np.cos(t) * x[2], 0.0, 0.0
        simulation = vesiflow.Simulation(small(), flow=coupling.custom_flow(swing, unsteady=True))
        simulation.step()
        simulation.step()
        self.assertLessEqual({0.0, 1.0, 2.0}, times)

    def test_a_uniform_force_on_a_membrane_moves_the_fluid_by_its_sum(self):
        # By linearity of Stokes flow twice the force moves the vesicle twice as far, and by symmetry straight along it.
        moved = []
        for force in (0.5, 1.0):
            simulation = vesiflow.Simulation(small(fluid__inertia="none", coupling__method="delta", vesicles__0__reduced_volume=1.0),
                                             flow=coupling.flow_at_rest())
            simulation.add_force(lambda t, vesicle, surface: (0.0, 0.0, force))
            simulation.step()
            moved.append(simulation.measure()[0]["centroid_z"])
            self.assertLess(abs(simulation.measure()[0]["centroid_x"]), 1e-10)
        self.assertGreater(moved[0], 1e-4)
        self.assertAlmostEqual(moved[1] / moved[0], 2.0, delta=2e-3)  # markers follow the shape, by second order of the displacement

    def test_an_array_of_forces_is_added_and_the_surface_is_of_the_time(self):
        surfaces = []

        def press(t, vesicle, surface):
            surfaces.append(surface)
            self.assertEqual(vesicle, 0)
            self.assertAlmostEqual(surface.area_weight.sum(), surface.area, places=12)
            return -0.1 * surface.normal
        pressed, free = vesiflow.Simulation(small()), vesiflow.Simulation(small())
        self.assertIs(pressed.add_force(press), press)
        for _ in range(2):
            pressed.step()
            free.step()
        # A uniform pressure on a closed membrane moves nothing but the pressure inside.
        self.assertLess(np.abs(pressed.membranes[0].positions - free.membranes[0].positions).max(), 1e-4)
        self.assertGreater(np.abs(pressed.fluid.pressure - free.fluid.pressure).max(), 0.05)
        with self.assertRaisesRegex(RuntimeError, "while the force is called"):
            surfaces[0].positions

    def test_a_force_on_the_fluid_drives_it(self):
        simulation = vesiflow.Simulation(small(fluid__inertia="none", coupling__method="delta"), flow=coupling.flow_at_rest())
        simulation.set_fluid_force(lambda x, t: (0.0, np.sin(np.pi * x[0] / 3), 0.0))
        simulation.step()
        driven = np.abs(simulation.fluid.velocity.y).max()
        self.assertGreater(driven, 0.1)
        simulation.set_fluid_force(None)
        simulation.step()
        self.assertLess(np.abs(simulation.fluid.velocity.y).max(), driven / 10)

    def test_a_force_of_arrays_is_the_same_as_of_points(self):
        forces = {False: lambda x, t: (np.sin(x[1]) + t, x[0] * x[2], np.cos(x[1]) * x[0]),
                  True: lambda x, y, z, t: (np.sin(y) + t, x * z, np.cos(y) * x)}
        for box in ({}, {"domain.periodic": [False, True, False]}):
            found = []
            for arrays, force in forces.items():
                simulation = vesiflow.Simulation(small(**{"domain.cells": [16, 12, 20]} | box))
                simulation.set_fluid_force(force, arrays=arrays)
                simulation.step()
                simulation.step()
                found.append(simulation.fluid.velocity)
            for one, other in zip(*found):
                np.testing.assert_allclose(one, other, rtol=0, atol=1e-14)  # sines of one number and of many may differ in the last bit
        simulation.set_fluid_force(lambda x, y, z, t: (1.0, 0.0, 0.0), arrays=True)
        simulation.step()
        simulation.set_fluid_force(lambda x, y, z, t: (np.zeros(7), 0.0, 0.0), arrays=True)
        with self.assertRaisesRegex(ValueError, "broadcast"):
            simulation.step()

    def test_what_a_function_raises_comes_through_and_ends_the_simulation(self):
        for bad, error in ((lambda t, v, s: 1 / 0, ZeroDivisionError), (lambda t, v, s: np.zeros((5, 3)), ValueError),
                           (lambda t, v, s: "force", ValueError)):
            simulation = vesiflow.Simulation(small())
            simulation.add_force(bad)
            with self.assertRaises(error):
                simulation.step()
            with self.assertRaisesRegex(RuntimeError, "cut short by " + error.__name__):
                simulation.step()
        with self.assertRaisesRegex(TypeError, "a flow must return three numbers, and has returned 1"):
            vesiflow.Simulation(small(), flow=lambda x, t: 1)
        with self.assertRaisesRegex(TypeError, "a force is a function"):
            vesiflow.Simulation(small()).add_force(3)


class Errors(unittest.TestCase):
    def test_mistakes_have_key_value_and_what_is_allowed(self):
        with self.assertRaises(vesiflow.SceneError) as caught:
            vesiflow.Simulation(small(time__step=-1, vesicles__0__shape="pear", tim__end=1))
        error = caught.exception
        self.assertEqual([(m.key, m.value) for m in error.mistakes], [("time.step", "-1"), ("tim", None), ("vesicles.0.shape", "'pear'")])
        self.assertEqual(error.mistakes[0].allowed, "must be > 0")
        self.assertIn("did you mean [time]", error.mistakes[1].allowed)
        self.assertNotRegex(str(error), r"scene:\d")
        self.assertIsInstance(error, ValueError)

    def test_text_keeps_its_lines_and_files_their_names(self):
        with self.assertRaisesRegex(vesiflow.SceneError, r"^scene:2: fluid\.viscosity_ratio = 0: must be in \[0\.05, 100\]$"):
            vesiflow.Simulation("[fluid]\nviscosity_ratio = 0\n[[vesicles]]\n")
        with self.assertRaisesRegex(vesiflow.SceneError, "nowhere.toml: cannot be read"):
            vesiflow.Simulation("nowhere.toml")
        with self.assertRaisesRegex(vesiflow.SceneError, "time.end = -2: must be > 0"):
            vesiflow.Simulation(small(), overrides={"time.end": -2})
        with self.assertRaisesRegex(vesiflow.SceneError, r"vesicles.0.centre = <object.*must be a number"):
            vesiflow.Simulation(small(vesicles__0__centre=object()))
        with self.assertRaisesRegex(TypeError, "a scene is a path"):
            vesiflow.Simulation(3)

    def test_parameters_without_a_scene_are_checked_alike(self):
        with self.assertRaises(vesiflow.ParameterError) as caught:
            coupling.Simulation({"time": {"step": "soon"}, "mesh": {"latitude": 3}, "vesicles": [{"radius": 1}]})
        self.assertEqual([m.key for m in caught.exception.mistakes], ["time.step", "mesh.latitude"])

    def test_a_state_that_is_lost_says_why_and_what_to_do(self):
        simulation = vesiflow.Simulation(small(limits__local_area_error=1e-9))
        with self.assertRaises(vesiflow.SimulationStopped) as caught:
            simulation.run(record_every=0)
        self.assertTrue(caught.exception.advice)
        self.assertIsInstance(caught.exception, RuntimeError)

    def test_files_that_cannot_be_written_or_read(self):
        simulation = vesiflow.Simulation(small())
        with self.assertRaisesRegex(vesiflow.FileError, "/nowhere/checkpoint.h5"):
            simulation.save("/nowhere/checkpoint.h5")
        with self.assertRaisesRegex(vesiflow.SceneError, "/nowhere/checkpoint.h5"):
            simulation.restore("/nowhere/checkpoint.h5")


if __name__ == "__main__":
    unittest.main()
