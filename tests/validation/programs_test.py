# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every program of validation/ and bench/ finds what it is made of, and says how it is called.

usage: scripts/python.sh tests/validation/programs_test.py
"""

import pathlib
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Programs(unittest.TestCase):
    def test_all_answer_help_from_any_folder(self):
        programs = [file for room in ("validation", "bench") for file in sorted((ROOT / room).rglob("*.py")) if "__main__" in file.read_text()]
        self.assertGreater(len(programs), 10)
        for program in programs:
            with self.subTest(program.relative_to(ROOT)):
                answer = subprocess.run([sys.executable, str(program), "--help"], cwd="/", capture_output=True, text=True)
                self.assertEqual((answer.returncode, answer.stderr), (0, ""))
                self.assertIn(f"usage: {program.name}", answer.stdout)


if __name__ == "__main__":
    unittest.main()
