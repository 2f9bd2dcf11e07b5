# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""bench/micro/compare.py on files made here: medians, ratios, exit codes, refusals."""

import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench" / "micro"))
import compare  # noqa: E402

CONTEXT = {"host_name": "a", "num_cpus": 2, "caches": [{"type": "Data", "level": 1, "size": 32768}], "library_build_type": "release"}


def iteration(name, *cpu, unit="us", **more):
    return [{"name": name, "run_name": name, "run_type": "iteration", "repetition_index": i, "real_time": 2 * t, "cpu_time": t, "time_unit": unit} | more
            for i, t in enumerate(cpu)]


def aggregate(name, kind, cpu, **more):
    return [{"name": f"{name}_{kind}", "run_name": name, "run_type": "aggregate", "aggregate_name": kind, "real_time": 2 * cpu, "cpu_time": cpu,
             "time_unit": "us"} | more]


class Compare(unittest.TestCase):
    def run_on(self, base, new, *options, new_context=None):
        """Exit code, output and errors of the program."""
        with tempfile.TemporaryDirectory() as folder:
            files = [pathlib.Path(folder) / name for name in ("base.json", "new.json")]
            for file, context, entries in zip(files, (CONTEXT, CONTEXT | (new_context or {})), (base, new)):
                file.write_text(entries if isinstance(entries, str) else json.dumps({"context": context, "benchmarks": entries}))
            out, err = io.StringIO(), io.StringIO()
            with mock.patch.object(sys, "argv", ["compare.py", *map(str, files), *options]), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                return compare.main(), out.getvalue(), err.getvalue()

    def test_median_of_repetitions_decides_and_not_the_mean(self):
        base = iteration("f", 10, 10, 10) + aggregate("f", "mean", 99) + aggregate("f", "cv", 0.5, aggregate_unit="percentage")
        code, out, _ = self.run_on(base, iteration("f", 10.5, 10.9, 500))
        self.assertEqual(code, 0)
        self.assertIn("1.090", out)
        code, out, _ = self.run_on(base, iteration("f", 1, 11.1, 500))
        self.assertEqual(code, 1)
        self.assertIn("1.110  SLOWER", out)

    def test_aggregates_alone_and_other_units(self):
        code, out, _ = self.run_on(aggregate("f", "mean", 1) + aggregate("f", "median", 10), iteration("f", 0.0195, unit="ms"))
        self.assertEqual(code, 1)
        self.assertIn("1.950", out)

    def test_threshold_and_clock_and_filter(self):
        base, new = iteration("f/64", 10) + iteration("g", 10), iteration("f/64", 12) + iteration("g", 30)
        self.assertEqual(self.run_on(base, new, "--filter", "^f")[0], 1)
        self.assertEqual(self.run_on(base, new, "--filter", "^f", "--threshold", "0.25")[0], 0)
        slow_wall = [entry | {"real_time": 50} for entry in iteration("g", 10)]
        self.assertEqual(self.run_on(base, slow_wall)[0], 0)
        self.assertEqual(self.run_on(base, slow_wall, "--time", "real")[0], 1)

    def test_gone_and_new_are_named_and_failures_count(self):
        code, out, _ = self.run_on(iteration("f", 10) + iteration("old", 1), iteration("f", 4) + iteration("young", 1))
        self.assertEqual(code, 0)
        for word in ("gone", "new", "faster", "0.400"):
            self.assertIn(word, out)
        broken = iteration("f", 0, error_occurred=True, error_message="no convergence")
        code, out, _ = self.run_on(iteration("f", 10), broken)
        self.assertEqual(code, 1)
        self.assertIn("FAILS: no convergence", out)

    def test_other_machines_and_builds_are_refused_unless_told(self):
        for key, value in (("num_cpus", 8), ("host_name", "b"), ("caches", []), ("library_build_type", "debug"), ("build", "dev")):
            code, out, err = self.run_on(iteration("f", 10), iteration("f", 10), new_context={key: value})
            self.assertEqual((code, out), (2, ""), key)
            self.assertIn(f"{key} differs", err)
            code, _, err = self.run_on(iteration("f", 10), iteration("f", 10), "--anyway", new_context={key: value})
            self.assertEqual(code, 0)
            self.assertIn(f"warning: another {'build' if 'build' in key else 'machine'}", err)
        self.assertEqual(self.run_on(iteration("f", 10), iteration("f", 10), new_context={"date": "later", "load_avg": [9]})[0], 0)

    def test_unusable_files_are_refused(self):
        for bad in ("", "[]", "{}", json.dumps({"context": {}, "benchmarks": 3})):
            self.assertEqual(self.run_on(bad, iteration("f", 1))[0], 2, bad)
        code, _, err = self.run_on(iteration("f", 1), iteration("g", 1))
        self.assertEqual(code, 2)
        self.assertIn("no benchmark in common", err)


if __name__ == "__main__":
    unittest.main()
