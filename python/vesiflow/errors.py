# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions. Those of the libraries come as these, with the same messages as those of the programs."""
from __future__ import annotations

import re
from typing import NamedTuple, Optional, Sequence


class VesiflowError(Exception):
    """All errors of this package that are not those of Python, such as ValueError for an argument."""


class Mistake(NamedTuple):
    """What is wrong with one parameter."""

    key: Optional[str]  #: its full name, such as "time.step", where one key is to blame
    value: Optional[str]  #: the value as text, where there is one
    allowed: str  #: what is allowed, or what is wrong
    text: str  #: all of it in a sentence


_ITEM = re.compile(r"^  +\d+\. ", re.MULTILINE)
_KEY = re.compile(r"(?:^|: )(?P<key>[a-z_]+(?:\.[a-z_0-9]+)+|\[\w+\]|title|vesicles)(?: = (?P<value>.*?))?: (?P<allowed>.*)$", re.DOTALL)


def _mistakes_in(message: str) -> list[Mistake]:
    """The items of a message with several, or its one."""
    items = _ITEM.split(message)[1:] if _ITEM.search(message) else [message]
    mistakes = []
    for item in (item.strip() for item in items):
        found = _KEY.search(item)
        mistakes.append(Mistake(found["key"].strip("[]"), found["value"], found["allowed"], item) if found else Mistake(None, None, item, item))
    return mistakes


class ParameterError(VesiflowError, ValueError):
    """Parameters ask for what cannot be done. The message says all mistakes, each with the parameter, its value and what is allowed;
    `mistakes` has them one by one."""

    def __init__(self, message: str, mistakes: Optional[Sequence[str]] = None) -> None:
        super().__init__(message)
        self.mistakes: list[Mistake] = [m for text in mistakes for m in _mistakes_in(text)] if mistakes else _mistakes_in(message)


class SceneError(ParameterError):
    """The same of a scene, an override or a checkpoint; the message names the file and the line too."""


class SimulationStopped(VesiflowError, RuntimeError):
    """The state stopped being usable: not finite, a limit passed, a marker at a wall. `advice` says what to change."""

    def __init__(self, message: str, advice: str = "") -> None:
        super().__init__(message)
        self.advice = advice


class FileError(VesiflowError, OSError):
    """A file of results could not be read or written, or another run has the folder."""


class MissingData(VesiflowError):
    """A run has not written what is asked for. The message says why."""


def not_built(error: ImportError) -> ImportError:
    """What to say where a compiled module is missing; other reasons stay as they are."""
    if "cannot import name" not in str(error):
        return error
    return ImportError("the compiled part of vesiflow is not there. In a source tree: cmake --preset release && cmake --build --preset release "
                       "--target python_package, then scripts/python.sh; or pip install . (docs/python.md)", name=error.name)
