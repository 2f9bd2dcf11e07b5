# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What validation/harness/plans.py reads off the plans of the program itself.

usage: scripts/python.sh tests/validation/plans_test.py VESICLES
"""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "validation"))
from harness import plans  # noqa: E402

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else None
SCENE = "scenes/paper/half_box.toml"


@unittest.skipUnless(PROGRAM, "needs the program vesicles")
class Plans(unittest.TestCase):
    def test_memory_and_time_grow_with_the_grid(self):
        small, large = (plans.plan(PROGRAM, SCENE, [f"domain.cells=[{2 * n}, {n}, {2 * n}]"]) for n in (32, 64))
        self.assertIsNone(small.refused)
        self.assertGreater(small.memory_mb, 1)
        self.assertGreater(large.memory_mb, 2 * small.memory_mb)
        self.assertGreater(large.seconds_per_step, 4 * small.seconds_per_step)

    def test_the_limit_of_convection_is_there_where_it_holds(self):
        inertia = plans.plan(PROGRAM, SCENE, ["fluid.reynolds_number=100"])
        self.assertGreater(inertia.longest_step, 0)
        self.assertIsNone(plans.plan(PROGRAM, SCENE, ["fluid.inertia=none"]).longest_step)

    def test_warnings_are_found(self):
        of = lambda sigma0: plans.plan(PROGRAM, SCENE, ["time.markers=euler", "time.step=1/192", f"membrane.sigma0={sigma0}"])  # noqa: E731
        beyond, within = of(1500).warnings, of(600).warnings  # g = 9.8 and 3.9: stable below about 7
        self.assertEqual(within, [])
        self.assertEqual(len(beyond), 1)
        self.assertTrue(beyond[0].startswith("tension number g 9.77"))

    def test_a_refusal_says_why(self):
        refused = plans.plan(PROGRAM, SCENE, ["time.step=0.3"])
        self.assertIn("must be <= 0.25", refused.refused)
        self.assertFalse(refused.refused.startswith("error"))
        self.assertEqual(refused.warnings, [])


if __name__ == "__main__":
    unittest.main()
