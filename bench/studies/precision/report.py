# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tables and the picture of a stored study."""

from harness import drawing
from harness.store import seconds
from harness.tables import table


def percent(value):
    return f"{100 * value:.2g} %"


def tables_of(stored):
    columns = list(stored["columns"])
    names = ["position", *columns, "area", "volume"]
    reference = stored["reference"]
    levels = [row for level in stored["levels"] for row in level_rows(stored, level)]
    doubts = [[name, *(percent(found[key]) for key in names)] for name, found in reference["doubts"].items()]
    rows = [[name, point["family"], point["h"], point["cpu_seconds"], *(percent(point[key]) for key in names),
             "front" if name in stored["front"] else ""]
            for name, point in sorted(stored["points"].items(), key=lambda item: item[1].get("largest", 9.0)) if "largest" in point]
    rows += [[name, point["family"], point["h"], point["cpu_seconds"], *[""] * len(names), f"stopped at t = {point['run']['time']:.3g}"]
             for name, point in stored["points"].items() if "largest" not in point]
    end = ", ".join(f"{name} {reference['end'][column]:.5g}" for name, column in stored["columns"].items())
    return [table("The fastest run within an error (the largest of those below)", ["error", "run", "its error", "CPU seconds"], levels),
            table(f"How far other estimates are from the reference ({reference['name']}; at t = {reference['end']['time']:g}: {end})",
                  ["estimate", *names], doubts),
            table("Runs by error", ["run", "family", "h", "CPU s", *names, ""], rows)]


def level_rows(stored, level):
    rows = []
    for how, found in stored["levels"][level].items():
        meaning = f"{100 * float(level):g} %" + (" with the reference's doubt added" if how == "beyond doubt" else "")
        if found is None:
            rows.append([meaning, "none", "", ""])
        else:
            rows.append([meaning, found["run"], percent(found["largest"]), found["cpu_seconds"]])
    return rows


def source(stored, command):
    count = len(stored["points"]) + len(stored["reference"]["runs"])
    return (f"`{command}`, {count} runs, {seconds(stored['cpu_seconds'] + stored['reference']['cpu_seconds'])} of one core, of which the "
            f"reference and what it is held against took {seconds(stored['reference']['cpu_seconds'])}.")


def draw(stored, path):
    figure, (axes, side) = drawing.figure(1, 2, figsize=(10, 6.4), width_ratios=[2.2, 1])
    points = {n: p for n, p in stored["points"].items() if "largest" in p}
    families = list(dict.fromkeys(p["family"] for p in points.values()))
    markers = "os^vD<>Ph*Xd"
    for index, family in enumerate(families):
        chosen = [p for p in points.values() if p["family"] == family]
        axes.loglog([p["cpu_seconds"] for p in chosen], [p["largest"] for p in chosen], markers[index % len(markers)], linestyle="none",
                    color=drawing.COLOURS[index % len(drawing.COLOURS)], markersize=5, label=family)
    front = [(points[n]["cpu_seconds"], points[n]["largest"]) for n in stored["front"]]
    axes.loglog(*zip(*front), color="0.2", linewidth=1.0, zorder=0, label="Pareto front")
    for number, (x, y) in enumerate(front, 1):
        axes.annotate(str(number), (x, y), textcoords="offset points", xytext=(-7, -9), fontsize=8, weight="bold")
    own = stored["reference"]["own_error"]["largest"]
    bottom = min(min(p["largest"] for p in points.values()), own) / 2
    axes.axhspan(bottom, own, color="0.93", zorder=-1)
    axes.text(0.99, own, "doubt of the reference", transform=axes.get_yaxis_transform(), fontsize=7, color="0.4", ha="right", va="top")
    for level in map(float, stored["levels"]):
        if level > bottom:
            axes.axhline(level, color="0.6", linewidth=0.7, linestyle=":")
    axes.set(xlabel="CPU seconds of the run", ylabel="largest error", ylim=(bottom, None))
    axes.set_title(stored["title"])
    side.axis("off")
    side.legend(*axes.get_legend_handles_labels(), fontsize=7, ncol=2, loc="lower left", borderaxespad=0)
    lines = [f"{number:2d}  {percent(points[name]['largest'])} in {points[name]['cpu_seconds']:.2g} s: {name}"
             for number, name in enumerate(stored["front"], 1)]
    side.text(0, 1, "Pareto front (cells across, ...)\n\n" + "\n".join(lines), va="top", fontsize=6.5, linespacing=1.6)
    drawing.save(figure, path)


