"""The project's own source files, and what they import and include."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
import re

ROOT = Path(__file__).parents[2]
FOLDERS = ("model", "lacuna", "codegen", "runtime", "analysis", "discovery", "fmi", "lsp", "tests", "cli", "bench")

_INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def files(folder: str, *suffixes: str) -> list[Path]:
    """What we wrote below `folder`: no caches, no golden files, no headers of a standard."""
    found = (ROOT / folder).rglob("*")
    return sorted(p for p in found if p.suffix in suffixes and not {"__pycache__", "golden", "standard"} & set(p.parts))


def imports(path: Path) -> Iterator[tuple[int, str]]:
    """(line, absolute module name) of every import statement, lazy ones inside functions included."""
    package = path.relative_to(ROOT).parent.parts
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            module = ".".join([*base, *([node.module] if node.module else [])])
            # `from lacuna import runtime` is an import of lacuna.runtime
            yield from ((node.lineno, f"lacuna.{alias.name}" if module == "lacuna" else module) for alias in node.names)


def includes(path: Path) -> list[str]:
    return _INCLUDE.findall(path.read_text(encoding="utf-8"))
