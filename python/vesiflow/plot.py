#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a run: history.png and membrane.png from the files that docs/results.md describes.

Draws what the folder has, of runs under way or stopped too. A run without snapshots gives the history alone; without fluid snapshots
the membranes alone.
"""
import argparse
import sys
from pathlib import Path

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    import run_history
    import run_membranes
    from run_results import MissingData, Run
except ImportError as error:
    sys.exit(f"{error}. A python that has what this needs is found by: scripts/python.sh {' '.join(sys.argv)}")

STYLE = {
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "savefig.dpi": 160,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="the folder of the run")
    parser.add_argument("--out", type=Path, help="where the pictures go (default: FOLDER/pictures)")
    arguments = parser.parse_args()
    try:
        run = Run(arguments.folder)
    except MissingData as missing:
        parser.error(str(missing))
    out = arguments.out or arguments.folder / "pictures"

    plt.rcParams.update(STYLE)
    drawn = 0
    for name, draw in [("history.png", run_history.draw), ("membrane.png", run_membranes.draw)]:
        try:
            figure, note = draw(run)
        except MissingData as missing:
            print(f"{name} not drawn: {missing}", file=sys.stderr)
            continue
        out.mkdir(parents=True, exist_ok=True)
        figure.savefig(out / name)
        plt.close(figure)
        drawn += 1
        print(f"{out / name}" + (f" ({note})" if note else ""))
    return 0 if drawn else 1


if __name__ == "__main__":
    sys.exit(main())
