"""Where the numbers of a page come from.

A page whose numbers a command wrote begins with

    ---
    command: make robustness     what writes or measures it
    version: 0.1.0               of Lacuna, when that was last done
    state: f09486d0314f0536b924  of the code and models that the numbers depend on, where the command knows it
    ---

and its site page says by itself when that is not the version (or state) at hand. A page that repeats such numbers marks
the paragraph with the page and the version or state that it has them from,

    <!-- numbers: proof.md f09486d0314f0536b924 -->

on the line before it. A mark is wrong where that page has since been written by another version, or does not hold one
of the paragraph's numbers: `make docs` fails then.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
import posixpath
import re

_FRONT = re.compile(r"\A---\n(.*?)\n---\n", re.DOTALL)
_MARK = re.compile(r"<!-- numbers: (\S+) (\S+) -->\n(.*?)(?=\n\s*\n|\Z)", re.DOTALL)
_WRITTEN = re.compile(r"\bWritten by `(?:make|python -m (?:tests|bench))\b|`make [\w-]+` (?:writes|solves)\b")
_NUMBER = re.compile(r"(?<![\w.])\d+(?:[.,]\d+)*")


@dataclass(frozen=True)
class Origin:
    """What a page's first lines say; `state` is "" where they do not."""

    command: str
    version: str
    state: str = ""


def split(text: str) -> tuple[dict[str, str], str]:
    """The entries of a page's first lines, and the rest."""
    found = _FRONT.match(text)
    if found is None:
        return {}, text
    entries = dict(line.split(": ", 1) for line in found[1].splitlines() if ": " in line)
    return entries, text[found.end() :]


def origin(text: str) -> Origin | None:
    """None for a page that no command wrote. Raises ValueError where an entry is missing or unknown."""
    entries, _ = split(text)
    if "command" not in entries:
        return None
    try:
        return Origin(**entries)
    except TypeError as wrong:
        raise ValueError(f"first lines: {wrong}") from None


def banner(found: Origin, version: str, state: Callable[[], str]) -> str:
    """What the site says above a page: where it is from, as a warning where that is not what is at hand."""
    written = f"Written by `{found.command}` of version {found.version}"
    if found.version != version:
        return _warning(
            f"{written}. This is the documentation of version {version}: the numbers were not measured again."
        )
    if found.state and found.state != state():
        return _warning(f"{written}, by code and models that have changed since: the numbers were not measured again.")
    return f'<p class="provenance">Written by <code>{found.command}</code> of version {found.version}.</p>\n\n'


def _warning(text: str) -> str:
    return f'!!! warning "Older numbers"\n\n    {text}\n\n'


def faults(pages: Mapping[str, str]) -> list[str]:
    """What is wrong with the pages, by their path from the root of the repository: a sentence each."""
    said: list[str] = []
    for name, text in pages.items():
        try:
            found = origin(text)
        except ValueError as wrong:
            said.append(f"{name}: {wrong}")
            continue
        if found is None and _WRITTEN.search(text):
            said.append(f"{name}: says that a command wrote it, but not in its first lines, by which version")
        said += [f"{name}: {fault}" for mark in _MARK.findall(text) for fault in _faults(name, pages, *mark)]
    return said


def _faults(name: str, pages: Mapping[str, str], page: str, version: str, paragraph: str) -> list[str]:
    source = pages.get(posixpath.normpath(posixpath.join(posixpath.dirname(name), page)))
    found = origin(source) if source else None
    if found is None:
        return [f"numbers of {page}, which is no page that a command wrote"]
    if version not in (found.version, found.state) or (found.state and version != found.state):
        return [f"numbers of {page} by {version}, which is now by {found.state or found.version}: write them anew"]
    known = set(_NUMBER.findall(split(source)[1]))
    missing = [number for number in _NUMBER.findall(re.sub(r"\]\([^)]*\)", "]", paragraph)) if number not in known]
    return [f"{number} is not on {page}" for number in dict.fromkeys(missing)]
