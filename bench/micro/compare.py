#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Compares two stored runs of a benchmark program and says what became slower.

usage: bench/micro/compare.py BASE.json NEW.json [--threshold 0.1] [--time cpu|real] [--filter REGEX] [--anyway]

The files are Google Benchmark's own JSON (CONTRIBUTING.md has the command that makes them). Prints, per benchmark, both times, their
ratio new/base and a verdict. The time of a benchmark is the median of its repetitions, if it has some; what the program's own
median is, where only aggregates were written.
Exit code: 0, nothing is slower by more than the threshold; 1, something is, or fails now; 2, the files cannot be compared: not such JSON, nothing in
common, or of another machine or build (--anyway compares those too).
"""

import argparse
import json
import re
import statistics
import sys

NANOSECONDS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
# Custom keys of the context (--benchmark_context=build=...) count if either file has them.
MACHINE, BUILD = ("host_name", "num_cpus", "caches"), ("library_build_type", "build")


class Unusable(Exception):
    """The files cannot be compared."""


def load(path):
    try:
        with open(path) as file:
            stored = json.load(file)
    except (OSError, ValueError) as error:
        raise Unusable(f"{path}: {error}") from error
    if not isinstance(stored, dict) or not isinstance(stored.get("context"), dict) or not isinstance(stored.get("benchmarks"), list):
        raise Unusable(f"{path}: is not JSON of Google Benchmark (--benchmark_out=FILE --benchmark_out_format=json)")
    return stored


def times(stored, clock):
    """Nanoseconds by name, and messages of those that failed."""
    repeated, medians, failed = {}, {}, {}
    for entry in stored["benchmarks"]:
        name = entry.get("run_name", entry["name"])
        if entry.get("error_occurred"):
            failed[name] = entry.get("error_message", "")
            continue
        if entry.get("aggregate_unit", "time") != "time" or f"{clock}_time" not in entry:
            continue  # a complexity or a percentage
        value = entry[f"{clock}_time"] * NANOSECONDS[entry.get("time_unit", "ns")]
        if entry.get("run_type", "iteration") == "iteration":
            repeated.setdefault(name, []).append(value)
        elif entry.get("aggregate_name") == "median":
            medians[name] = value
    found = medians | {name: statistics.median(values) for name, values in repeated.items()}
    return {name: value for name, value in found.items() if name not in failed}, failed


def differences(base, new):
    """What makes the files incomparable, in words."""
    found = []
    for kind, keys in (("machine", MACHINE), ("build", BUILD)):
        for key in keys:
            ours, theirs = base["context"].get(key), new["context"].get(key)
            if ours != theirs:
                shown = "" if key == "caches" else f" ({ours} and {theirs})"
                found.append(f"another {kind}: {key} differs{shown}")
    return found


def compare(base, new, threshold, clock, pattern):
    """Rows (name, base, new, ratio, verdict) in the order of the new file, and whether all is well."""
    before, _ = times(base, clock)
    after, failed = times(new, clock)
    chosen = [name for name in (*after, *failed, *before) if re.search(pattern, name)]
    rows, well, common = [], True, 0
    for name in dict.fromkeys(chosen):
        if name in failed:
            rows.append((name, before.get(name), None, None, f"FAILS: {failed[name]}"))
            well = False
        elif name not in before or name not in after:
            rows.append((name, before.get(name), after.get(name), None, "new" if name in after else "gone"))
        else:
            ratio = after[name] / before[name]
            verdict = "SLOWER" if ratio > 1 + threshold else "faster" if ratio < 1 / (1 + threshold) else ""
            rows.append((name, before[name], after[name], ratio, verdict))
            well = well and verdict != "SLOWER"
            common += 1
    if common == 0 and well:
        raise Unusable("the files have no benchmark in common" + (f" that matches {pattern}" if pattern else ""))
    return rows, well


def show(nanoseconds):
    if nanoseconds is None:
        return ""
    unit = next((u for u in ("s", "ms", "us") if nanoseconds >= NANOSECONDS[u]), "ns")
    return f"{nanoseconds / NANOSECONDS[unit]:.4g} {unit}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("base")
    parser.add_argument("new")
    parser.add_argument("--threshold", type=float, default=0.1, help="slower by more than this fraction is a regression (default 0.1)")
    parser.add_argument("--time", choices=["cpu", "real"], default="cpu", help="which clock (default cpu; real for threads)")
    parser.add_argument("--filter", default="", metavar="REGEX", help="only benchmarks whose name matches")
    parser.add_argument("--anyway", action="store_true", help="compare files of different machines or builds too")
    options = parser.parse_args()
    if not options.threshold > 0:
        parser.error(f"--threshold {options.threshold}: must be > 0")
    try:
        base, new = load(options.base), load(options.new)
        unlike = differences(base, new)
        if unlike and not options.anyway:
            raise Unusable("\n".join([*unlike, "ratios would say nothing about the code; --anyway compares nevertheless"]))
        rows, well = compare(base, new, options.threshold, options.time, options.filter)
    except Unusable as error:
        print(error, file=sys.stderr)
        return 2
    for line in unlike:
        print(f"warning: {line}", file=sys.stderr)
    width = max(len(row[0]) for row in rows)
    for name, before, after, ratio, verdict in rows:
        print(f"{name:{width}}  {show(before):>9}  {show(after):>9}  {'' if ratio is None else f'{ratio:.3f}':>6}  {verdict}".rstrip())
    worse = sum(row[4].startswith(("SLOWER", "FAILS")) for row in rows)
    print(f"{len(rows)} benchmarks, {worse} slower by more than {100 * options.threshold:g} % or failing")
    return 0 if well else 1


if __name__ == "__main__":
    sys.exit(main())
