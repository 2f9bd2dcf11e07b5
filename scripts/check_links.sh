#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Vesiflow authors
# SPDX-License-Identifier: BSD-3-Clause
# Checks that every relative link of the documents leads somewhere: the file exists, and so does the heading that an anchor names.
# Where sources and scripts name a page or a section of docs/, it exists too, and so does what they and the documents name of
# validation/ and bench/, unless a word in capitals stands for a part of the name.
# usage: scripts/check_links.sh
set -euo pipefail
. "$(dirname "$0")/lib.sh"
cd "$(dirname "$0")/.."
no_more_options "$@"

exec python3 - <<'CHECK'
import functools
import pathlib
import re
import sys

ROOT = pathlib.Path(".").resolve()
SOURCES = {".h", ".cpp", ".py", ".sh", ".txt", ".toml"}
PAGES_OF_DOCS = r"docs/[\w/]+\.md(?:#[\w-]+)?"
STUDIES = r"(?:validation|bench)/[a-z0-9_/]+\.(?:md|py|sh|json|toml|h|cpp)\b"


def files():
    folders = [p for p in ROOT.iterdir() if p.is_dir() and p.name not in ("build", "out") and not p.name.startswith(".")]
    yield from (p for p in ROOT.iterdir() if p.is_file())
    yield from (p for folder in folders for p in folder.rglob("*") if p.is_file() and "node_modules" not in p.parts)


def prose(page):
    """The text of a page without its code, which may look like links and headings."""
    text = re.sub(r"^(```|~~~).*?^\1", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"(?<=\n\n)(?: {4}.*\n)+", "", text)


@functools.cache
def anchors(page):
    """Of the headings, as GitHub makes them: lower case, no punctuation, hyphens for spaces, numbered where they repeat."""
    seen, names = {}, set()
    for title in re.findall(r"^#{1,6} +(.*?) *#*$", prose(page), flags=re.MULTILINE):
        title = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", title)
        name = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
        seen[name] = seen.get(name, -1) + 1
        names.add(f"{name}-{seen[name]}" if seen[name] else name)
    return names


def problem(source, target):
    path, _, anchor = target.partition("#")
    page = (source.parent / path).resolve() if path else source
    if not page.exists():
        return "no such file"
    if anchor and page.suffix == ".md" and anchor not in anchors(page):
        return "no such heading"
    return None


def links(page):
    text = re.sub(r"`[^`\n]*`", "", prose(page))
    for target in re.findall(r"\]\(<?([^)\s>]+)>?(?: \"[^\"]*\")?\)", text) + re.findall(r"^\[[^]]+\]: +(\S+)", text, flags=re.MULTILINE):
        if not re.match(r"[a-z]+:", target):
            yield target


def named(file, what):
    return [(target, problem(ROOT / "of the root", target)) for target in re.findall(rf"(?<![\w/.]){what}", file.read_text(errors="replace"))]


failed, count = False, 0
for file in sorted(files()):
    if file.suffix == ".md":
        found = [(target, problem(file, target)) for target in links(file)] + named(file, STUDIES)
    elif file.suffix in SOURCES:
        found = named(file, PAGES_OF_DOCS) + named(file, STUDIES)
    else:
        continue
    count += len(found)
    for target, wrong in found:
        if wrong:
            failed = True
            print(f"{file.relative_to(ROOT)}: {target}: {wrong}", file=sys.stderr)
if failed:
    sys.exit(1)
print(f"links of the documents: {count}, all lead somewhere")
CHECK
