# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Where stored results come from, and how they are written."""

import json
import os
import platform
import subprocess

from .runs import ROOT


def processor():
    model = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), platform.processor())
    return f"{platform.machine()}, {model}, {os.cpu_count()} cores"


def machine():
    return f"{processor()}, one thread a run"


def revision():
    command = ["git", "describe", "--always", "--dirty", "--abbrev=12"]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True).stdout.strip()


def compact(result):
    """A line for each run and each value."""
    lines = []
    for key, value in result.items():
        if isinstance(value, dict):
            inner = ",\n".join(f"  {json.dumps(k)}: {json.dumps(v)}" for k, v in value.items())
            lines.append(f" {json.dumps(key)}: {{\n{inner}\n }}")
        else:
            lines.append(f" {json.dumps(key)}: {json.dumps(value)}")
    return "{\n" + ",\n".join(lines) + "\n}"


def write(file, result):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(compact(result) + "\n")


def seconds(value):
    if value is None:
        return "not run"
    return f"{value:.0f} s" if value < 120 else f"{value / 60:.0f} min"
