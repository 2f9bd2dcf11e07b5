# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tables as they are stored, printed and put into pages of docs/."""

import math
import re
import textwrap

WIDTH = 150  # of lines of a page that are not a table's


def table(title, columns, rows):
    return {"title": title, "columns": list(columns), "rows": [list(row) for row in rows]}


def number(value, digits=4):
    """Enough digits to compare, no more."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    if isinstance(value, str):
        return value
    if value == 0:
        return "0"
    if abs(value) < 1e-3 or abs(value) >= 1e5:
        return f"{value:.2e}"
    return f"{value:.{digits}g}"


def percent(ours, reference):
    return f"{100 * (ours / reference - 1):+.1f} %" if reference and not math.isnan(ours / reference) else ""


def signed(difference):
    return "" if math.isnan(difference) else f"{difference:+.2f}"


def markdown(stored):
    lines = [stored["title"], ""] if stored["title"] else []
    lines += ["| " + " | ".join(stored["columns"]) + " |", "|" + "---|" * len(stored["columns"])]
    lines += ["| " + " | ".join(number(cell) for cell in row) + " |" for row in stored["rows"]]
    return "\n".join(lines)


def text(stored):
    cells = [stored["columns"]] + [[number(cell) for cell in row] for row in stored["rows"]]
    widths = [max(len(row[i]) for row in cells) for i in range(len(stored["columns"]))]
    return "\n".join([stored["title"]] + ["  " + "  ".join(c.rjust(w) for c, w in zip(row, widths)) for row in cells])


def block(stored, source=""):
    """Tables and the line that says where they come from, as they stand in a page."""
    lines = textwrap.fill(source, WIDTH, break_long_words=False, break_on_hyphens=False)
    return "\n" + "\n\n".join(markdown(one) for one in stored) + "\n" + (f"\n{lines}\n" if source else "")


def write_into(page, blocks):
    """insert() into the file of a page."""
    page.write_text(insert(page.read_text(), blocks))


def insert(document, blocks):
    """Replaces what is between <!-- results NAME --> and <!-- end -->; blocks: text by name."""

    def filled(match):
        name = match.group(1)
        return f"<!-- results {name} -->\n{blocks[name]}\n<!-- end -->" if name in blocks else match.group(0)

    return re.sub(r"<!-- results (\S+) -->\n.*?<!-- end -->", filled, document, flags=re.DOTALL)
