# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the programs say of a run before they make it: --plan (docs/plan.md)."""

import dataclasses
import re
import subprocess

from .runs import ROOT

BAD_INPUT = 2  # exit code (docs/architecture.md#errors)


@dataclasses.dataclass(frozen=True)
class Plan:
    """text, errors: what is written on standard output and standard error."""

    text: str
    errors: str
    code: int

    @property
    def refused(self):
        """Why the scene is, or None."""
        return self.errors.strip().removeprefix("error: ") if self.code == BAD_INPUT else None

    @property
    def warnings(self):
        return [" ".join(line.split()) for line in self.text.splitlines() if "WARNING" in line]

    @property
    def longest_step(self):
        """At which the explicit convection is stable; None where the plan has no such limit."""
        found = re.search(r"time\.step below about (\S+)", self.text)
        return float(found.group(1)) if found else None

    @property
    def memory_mb(self):
        return float(re.search(r"memory +about (\d+) MB", self.text).group(1))

    @property
    def seconds_per_step(self):
        return float(re.search(r"estimate: (\S+) s per step", self.text).group(1))


def plan(program, scene, settings=(), threads=1):
    """settings: as for --set."""
    command = [str(program), str(scene), "--plan", "--threads", str(threads)] + [word for s in settings for word in ("--set", s)]
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if result.returncode != BAD_INPUT:
        result.check_returncode()
    return Plan(result.stdout, result.stderr, result.returncode)
