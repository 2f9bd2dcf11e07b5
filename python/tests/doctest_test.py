# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The examples in the documentation of the package, as they stand there."""
import doctest
import importlib
import unittest

MODULES = ["vesiflow", "vesiflow.coupling", "vesiflow.errors", "vesiflow.fluid", "vesiflow.plot_smooth", "vesiflow.progress", "vesiflow.results", "vesiflow.run",
           "vesiflow.table", "vesiflow.vesicle"]


def load_tests(loader, tests, pattern):
    for name in MODULES:
        module = importlib.import_module(name)
        tests.addTests(doctest.DocTestSuite(module))
    return tests


if __name__ == "__main__":
    unittest.main()
