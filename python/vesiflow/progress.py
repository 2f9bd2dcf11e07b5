# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""A bar of progress in one line of a terminal or a notebook."""
from __future__ import annotations

import sys
import time
from typing import Optional, TextIO


class ProgressBar:
    """Shows t of its end, steps and the time that is left. Writes at most ten times a second.

    >>> import io
    >>> out = io.StringIO()
    >>> with ProgressBar(2.0, stream=out) as bar:
    ...     bar.show(1.0, steps=48)
    ...     bar.show(2.0, steps=96)
    >>> for line in out.getvalue().rstrip().split("\\r")[1:]:
    ...     print(line)
    [##########..........] t = 1 of 2, 48 steps
    [####################] t = 2 of 2, 96 steps
    """

    width = 20

    def __init__(self, end: float, begin: float = 0.0, stream: Optional[TextIO] = None) -> None:
        self.begin, self.end, self.stream = begin, end, stream or sys.stderr
        self._start, self._shown, self._length = time.monotonic(), float("-inf"), 0
        self._waiting: Optional[tuple[float, int]] = None

    def __enter__(self) -> ProgressBar:
        return self

    def __exit__(self, *error) -> None:
        if self._waiting:
            self._write(*self._waiting)
        if self._length:
            self.stream.write("\n")
            self.stream.flush()

    def show(self, now: float, steps: int) -> None:
        """Of a state at time `now`."""
        if time.monotonic() - self._shown < 0.1:
            self._waiting = now, steps  # the last one is written at the end
        else:
            self._write(now, steps)

    def _write(self, now: float, steps: int) -> None:
        share = min(max((now - self.begin) / (self.end - self.begin), 0.0), 1.0) if self.end > self.begin else 1.0
        self._shown, self._waiting = time.monotonic(), None
        spent = self._shown - self._start
        left = f", {spent * (1 / share - 1):.0f} s left" if 0.0 < share < 1.0 and spent > 1.0 else ""
        filled = round(self.width * share)
        text = f"[{'#' * filled}{'.' * (self.width - filled)}] t = {now:.4g} of {self.end:.4g}, {steps} steps{left}"
        self.stream.write("\r" + text.ljust(self._length))
        self.stream.flush()
        self._length = len(text)
