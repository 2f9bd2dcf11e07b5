# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Rows of numbers against time, as a dictionary of arrays."""
from __future__ import annotations

from typing import Any, Iterable, Mapping

import numpy as np


class Table(dict):
    """A dictionary from column names to arrays of one length; a row is a vesicle at a time.

    >>> table = Table.of_rows([{"time": 0.0, "vesicle": 0, "area": 1.0}, {"time": 0.5, "vesicle": 0, "area": 2.0}])
    >>> table["area"]
    array([1., 2.])
    >>> table
    <Table of 2 rows: time, vesicle, area>
    """

    @classmethod
    def of_rows(cls, rows: Iterable[Mapping[str, Any]]) -> Table:
        """Of dictionaries with the keys of the first."""
        rows = list(rows)
        return cls({name: np.array([row[name] for row in rows]) for name in (rows[0] if rows else ())})

    def of_vesicle(self, vesicle: int = 0) -> Table:
        """The rows of one vesicle.

        >>> Table(vesicle=np.array([0, 1, 0]), area=np.array([1.0, 2.0, 3.0])).of_vesicle(0)["area"]
        array([1., 3.])
        """
        chosen = self["vesicle"] == vesicle
        if not np.any(chosen):
            raise IndexError(f"there is no vesicle {vesicle}")
        return Table({name: column[chosen] for name, column in self.items()})

    def to_pandas(self):
        """The same as a pandas.DataFrame, where pandas is installed."""
        try:
            import pandas
        except ImportError:
            raise ImportError("pandas is not installed (Debian: python3-pandas); the table is a dictionary of arrays without it") from None
        return pandas.DataFrame(dict(self))

    def _repr_html_(self) -> str:
        """What a notebook shows."""
        count = len(self)
        length = len(next(iter(self.values()))) if count else 0
        shown = range(length) if length <= 10 else [*range(5), *range(length - 5, length)]
        head = "".join(f"<th>{name}</th>" for name in self)
        body = "".join("<tr>" + "".join(f"<td>{column[i]:.6g}</td>" for column in self.values()) + "</tr>" for i in shown)
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table><p>{length} rows</p>"

    def __repr__(self) -> str:
        length = len(next(iter(self.values()))) if self else 0
        return f"<Table of {length} rows: {', '.join(self)}>"
