# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""The command vesiflow, which is python -m vesiflow too."""
from __future__ import annotations

import argparse
import sys
from typing import Callable, Optional, Sequence

USAGE = """usage: vesiflow COMMAND ...

  run SCENE      computes a scene, as the program vesicles does; results go to out/NAME_OF_SCENE
  plot DIR       draws a run: pictures in DIR/pictures
  report DIR     writes one page of a run for any browser, DIR/report.html
  view DIR       shows a run, under way or ended, in a browser on this machine

vesiflow COMMAND --help says more; vesiflow --version says which version this is."""


def _run(argv: Sequence[str]) -> int:
    """vesiflow run: options and exit codes are those of the programs (docs/command_line.md)."""
    parser = argparse.ArgumentParser(prog="vesiflow run", description="Computes vesicles in a flow, both from a scene file.", allow_abbrev=False)
    parser.add_argument("scene", nargs="?", help="scene file (docs/scene.md), or a folder with a scene.toml; may be left out with --restart")
    parser.add_argument("--out", help="the results (default: out/NAME_OF_SCENE, with --restart the checkpoint's folder)")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="override a key of the scene (repeatable)")
    parser.add_argument("--restart", metavar="FILE", help="continue from this checkpoint.h5, or from that of a folder")
    parser.add_argument("--start-from", metavar="FILE", help="begin at t = 0 with vesicles and velocity of the end of this run")
    parser.add_argument("--plan", action="store_true", help="print what would be computed and written, then exit")
    parser.add_argument("--threads", type=int, help="threads (default: all cores)")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    arguments = parser.parse_args(argv)
    if arguments.scene is None and arguments.restart is None:
        parser.error("a scene file is needed, or --restart with a checkpoint")
    if arguments.restart and arguments.start_from:
        parser.error("--restart and --start-from exclude each other")
    return _carry_out(arguments)


def _carry_out(arguments: argparse.Namespace) -> int:
    import os
    from pathlib import Path

    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # results must not depend on their number; read when the libraries are loaded
    from . import run as runs
    from .errors import FileError, ParameterError, SimulationStopped

    try:
        if arguments.threads is not None:
            runs.set_threads(arguments.threads)
        scene = runs.Scene(arguments.scene, arguments.set) if arguments.scene else runs.Scene.of_checkpoint(arguments.restart, arguments.set)
        out = arguments.out
        if out is None and arguments.restart:
            checkpoint = runs._checkpoint_file(arguments.restart)
            out = checkpoint.parent if checkpoint.name == runs.CHECKPOINT else Path("out") / checkpoint.stem
        if arguments.plan:
            print(scene.plan(out or "."), end="")
            return 0
        if warning := scene.memory_warning():
            print(f"warning: {warning}", file=sys.stderr)
        words = ["vesiflow", "run"] + (["--threads", str(arguments.threads)] if arguments.threads else []) + ["--quiet"] * arguments.quiet
        ended = runs.run(scene, out, restart=arguments.restart, start_from=arguments.start_from, quiet=arguments.quiet, command=words)
    except KeyboardInterrupt:
        return 130
    except (ParameterError, ValueError) as error:
        return _failed(2, error)
    except SimulationStopped as error:
        return _failed(3, error)
    except FileError as error:
        return _failed(4, error)
    except MemoryError:
        return _failed(5, "out of memory: --plan says how much a scene takes")
    if not arguments.quiet:
        print(f"results in {ended.results.folder}")
    return ended.exit_code


def _failed(code: int, error: object) -> int:
    print(f"error: {error}", file=sys.stderr)
    return code


def _plot(argv: Sequence[str]) -> int:
    from . import plot

    try:
        return plot.main(argv)
    except OSError as error:  # a folder that cannot be written, a full disk
        return _failed(4, error)


def _of_view(name: str) -> Callable[[Sequence[str]], int]:
    def call(argv: Sequence[str]) -> int:
        try:
            from . import view
        except ImportError as error:
            return _failed(1, f"this installation has no reports: {error}")
        return getattr(view, f"{name}_main")(argv)

    return call


COMMANDS: dict[str, Callable[[Sequence[str]], int]] = {"run": _run, "plot": _plot, "report": _of_view("report"), "view": _of_view("view")}


def main(argv: Optional[Sequence[str]] = None) -> int:
    """The exit code of the command."""
    words = list(sys.argv[1:] if argv is None else argv)
    if not words or words[0] in ("-h", "--help"):
        print(USAGE)
        return 0 if words else 2
    if words[0] == "--version":
        from . import __version__

        print(f"vesiflow {__version__}")
        return 0
    if words[0] not in COMMANDS:
        return _failed(2, f"there is no command {words[0]!r}: there are {', '.join(COMMANDS)}")
    try:
        return COMMANDS[words[0]](words[1:])
    except ImportError as error:
        return _failed(1, error)


if __name__ == "__main__":
    sys.exit(main())
