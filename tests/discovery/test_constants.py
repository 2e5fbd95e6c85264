"""The numbers that decide: each says beside it what it stands for, and their count only falls."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2] / "discovery"
MOST = 193  # lower it where one goes


def _is_number(node: ast.expr) -> bool:
    try:
        value = ast.literal_eval(node)
    except ValueError:
        return isinstance(node, ast.BinOp) and all(_is_number(n) for n in (node.left, node.right))
    flat = value if isinstance(value, tuple) else (value,)
    return bool(flat) and all(isinstance(v, int | float | tuple) and not isinstance(v, bool) for v in flat)


def constants() -> Iterator[tuple[str, Path, ast.Assign]]:
    """(name, file, statement) of each number that a module of discovery sets."""
    for path in sorted(ROOT.rglob("*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.Assign) and len(node.targets) == 1:
                target = node.targets[0]
                names = target.elts if isinstance(target, ast.Tuple) else [target]
                values = node.value.elts if isinstance(target, ast.Tuple) else [node.value]
                for name, value in zip(names, values, strict=True):
                    if isinstance(name, ast.Name) and name.id.isupper() and _is_number(value):
                        yield name.id, path, node


def test_each_says_what_it_stands_for() -> None:
    bare = []
    for name, path, node in constants():
        own = path.read_text(encoding="utf-8").splitlines()[node.lineno - 1 : node.end_lineno]
        if not any("#" in line for line in own):
            bare.append(f"{path.relative_to(ROOT)}:{node.lineno}: {name}")
    assert bare == []


def test_there_are_no_more_of_them() -> None:
    assert len(list(constants())) <= MOST
