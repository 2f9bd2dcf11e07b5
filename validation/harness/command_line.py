# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the programs of validation/ and bench/ are asked, in the same words."""

import argparse
import pathlib

from .runs import ROOT


def parser(description, apps=True, jobs=False):
    """description: the program's own, as it stands at its top."""
    made = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    if jobs:
        made.add_argument("--jobs", type=int, default=1, help="runs at a time (default 1)")
    if apps:
        made.add_argument("--apps", default="build/release/apps", help="folder of the programs (default build/release/apps)")
    return made


def program(options, name="vesicles"):
    """One of the folder --apps, which is relative to the tree."""
    return (ROOT / options.apps).resolve() / name


def chosen(of_parser, names, known, what):
    """Names of cases, maps ...: those that were given, or all that are known if `all` is among them."""
    unknown = [name for name in names if name != "all" and name not in known]
    if unknown:
        of_parser.error(f"unknown {what} {unknown[0]}: one of all, {', '.join(known)}")
    return list(known) if "all" in names else names


def folder_of_runs(description):
    """The one argument of a program that makes tables of runs."""
    made = parser(description, apps=False)
    made.add_argument("folder", type=pathlib.Path, help="folder of the runs")
    return made.parse_args().folder
