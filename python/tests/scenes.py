# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that tests compute in a fraction of a second, and folders for what they write."""
import pathlib
import tempfile
import unittest


def small(**keys):
    """A vesicle in shear flow on 16^3 cells; keys with dots differ from it."""
    scene = {"domain.lower": [-3, -3, -3], "domain.upper": [3, 3, 3], "domain.cells": 16, "mesh.latitudes": 16, "time.step": "1/48",
             "time.end": 0.25, "output.diagnostics_every": 0.05, "output.vesicle_every": 0.1, "output.fluid_every": 0.25,
             "output.checkpoint_every": 0.125, "vesicles.0.reduced_volume": 0.9}
    return scene | {name.replace("__", "."): value for name, value in keys.items()}


class InScratch(unittest.TestCase):
    """Has a folder of its own, self.scratch."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.scratch = pathlib.Path(folder.name)
