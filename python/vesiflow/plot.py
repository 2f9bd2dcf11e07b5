# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a run: history.png and membrane.png from the files that docs/results.md describes.

Draws what the folder has, of runs under way or stopped too. A run without snapshots gives the history alone; without fluid snapshots
the membranes alone.
"""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Optional, Sequence

from .results import MissingData, Run

STYLE = {
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "savefig.dpi": 160,
}


def main(argv: Optional[Sequence[str]] = None) -> int:
    """vesiflow plot."""
    parser = argparse.ArgumentParser(prog="vesiflow plot", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="the folder of the run")
    parser.add_argument("--out", type=Path, help="where the pictures go (default: FOLDER/pictures)")
    parser.add_argument("--format", choices=("png", "pdf"), default="png", help="of the pictures; lines and text of a pdf are vectors")
    parser.add_argument("--animation", action="store_true", help="membrane.mp4 of all snapshots too, or membrane.gif where there is no ffmpeg")
    arguments = parser.parse_args(argv)
    try:
        run = Run(arguments.folder)
    except MissingData as missing:
        parser.error(str(missing))
    try:
        import matplotlib

        matplotlib.use("Agg")
        from . import plot_history, plot_membranes
    except ImportError as error:
        parser.exit(1, f"error: {error}; pictures need matplotlib and h5py (Debian: python3-matplotlib, python3-h5py)\n")
    import matplotlib.pyplot as plt

    out = arguments.out or arguments.folder / "pictures"
    plt.rcParams.update(STYLE)
    drawn = 0
    for stem, draw in [("history", plot_history.draw), ("membrane", plot_membranes.draw)]:
        name = f"{stem}.{arguments.format}"
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
    if arguments.animation:
        try:
            print(plot_membranes.animate(run, out))
            drawn += 1
        except MissingData as missing:
            print(f"no animation: {missing}", file=sys.stderr)
    return 0 if drawn else 1
