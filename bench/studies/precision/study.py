# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""From runs to errors, the front, and the settings for each level of error."""

from harness import outputs, runs

from . import errors
from .cases import LEVELS


def evaluate(case, wanted):
    """All of a case that is stored. wanted: its runs by label, done."""
    stopped = {name for name, run in wanted.items() if outputs.summary(run.folder())["status"] != "completed"}
    states = {}

    def state(keys):
        name = case.label(keys)
        if name not in states:
            states[name] = errors.read(wanted[name].folder())
        return states[name]

    def combined(estimate):
        if any(case.label(keys) in stopped for _, keys in estimate.parts):
            return None
        return errors.combination([(weight, state(keys)) for weight, keys in estimate.parts])

    # A run of the reference that stopped takes its estimate away: the next one stands in.
    estimates = {e.name: (e, combined(e)) for e in (case.reference, *case.others)}
    estimates = {name: pair for name, pair in estimates.items() if pair[1] is not None}
    if len(estimates) < 2:
        raise SystemExit(f"{case.name}: no reference: these runs stopped: {', '.join(sorted(stopped))}")
    taken, values = next(iter(estimates.values()))
    reference = errors.Reference(values, case.columns, case.since)
    doubts = {name: reference.errors(found) for name, (_, found) in estimates.items() if name != taken.name}
    for name, rough, fine in case.doubts:
        if case.label(rough) not in stopped and case.label(fine) not in stopped:
            doubts[f"{name}, on {rough['cells']} cells"] = errors.Reference(state(fine), case.columns, case.since).errors(state(rough))
    points = {}
    for family, knob, keys in case.sweeps:
        name = case.label(keys)
        if name in points:
            continue
        found = {} if name in stopped else reference.errors(state(keys))
        points[name] = {"family": family, "knob": knob, "h": case.spacing(keys), "cpu_seconds": runs.cpu_seconds(wanted[name])} | found | {
            "angle_end_deg": None if name in stopped else float(state(keys)["course"]["inclination_angle_deg"][-1]),
            "run": runs.provenance(wanted[name])}
    for estimate in case.recipes:
        names = [case.label(keys) for _, keys in estimate.parts]
        if not stopped.intersection(names):
            points[estimate.name] = {
                "family": "two grids", "knob": "extrapolation", "h": min(case.spacing(keys) for _, keys in estimate.parts),
                "cpu_seconds": sum(runs.cpu_seconds(wanted[n]) for n in names)} | reference.errors(combined(estimate)) | {"parts": names}
    own = {key: max(found[key] for found in doubts.values()) for key in next(iter(doubts.values()))}
    front = pareto(points)
    course = reference.state["course"]
    return {"columns": case.columns, "since": case.since,
            "reference": {"name": taken.name, "parts": [[w, case.label(keys)] for w, keys in taken.parts],
                          "own_error": own, "doubts": doubts,
                          "runs": {name: runs.provenance(wanted[name]) for name in reference_runs(case)},
                          "cpu_seconds": sum(runs.provenance(wanted[name])["cpu_seconds"] for name in reference_runs(case)),
                          "end": {key: float(course[key][-1]) for key in ("time", *case.columns.values())}},
            "cpu_seconds": sum(point["cpu_seconds"] for point in points.values()),
            "front": front,
            "levels": {f"{level:g}": {"within": cheapest(points, level), "beyond doubt": cheapest(points, level, own["largest"])}
                       for level in LEVELS},
            "points": points}


def reference_runs(case):
    keys = [k for estimate in (case.reference, *case.others) for _, k in estimate.parts] + [k for _, *pair in case.doubts for k in pair]
    return list(dict.fromkeys(case.label(k) for k in keys))


def pareto(points):
    """Labels of the runs that no other beats in both time and error, by time."""
    front, least = [], float("inf")
    for name in sorted((n for n in points if "largest" in points[n]), key=lambda n: (points[n]["cpu_seconds"], points[n]["largest"])):
        if points[name]["largest"] < least:
            front.append(name)
            least = points[name]["largest"]
    return front


def cheapest(points, level, doubt=0.0):
    """The fastest run within the level, whatever the doubt of the reference; None if there is none."""
    within = [n for n in points if points[n].get("largest", 1) + doubt <= level]
    if not within:
        return None
    name = min(within, key=lambda n: points[n]["cpu_seconds"])
    return {"run": name, "cpu_seconds": points[name]["cpu_seconds"], "largest": points[name]["largest"]}
