# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The examples in the documentation of the package, as they stand there."""
import doctest
import importlib
import unittest

MODULES = ["vesiflow"] + [f"vesiflow.{name}" for name in ("coupling", "errors", "flows", "fluid", "forces", "parts", "plot_smooth", "progress",
                                                          "results", "run", "table", "vesicle")]


def load_tests(loader, tests, pattern):
    for name in MODULES:
        module = importlib.import_module(name)
        tests.addTests(doctest.DocTestSuite(module))
    return tests


if __name__ == "__main__":
    unittest.main()
