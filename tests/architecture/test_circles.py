"""No circles: the modules of a folder can be put in an order in which each imports only what comes before it.

Imports for type checking only and lazy ones inside functions count, because what a file must know of another to be
understood is the same; a submodule imported from its package counts as itself.
"""

from __future__ import annotations

import ast
from graphlib import CycleError, TopologicalSorter

import pytest

from tests.architecture.sources import ROOT, files


def import_graph(folder: str) -> dict[str, set[str]]:
    """Modules below `folder` by their full names, with those of them that each imports."""
    paths = {}
    for path in files(folder, ".py"):
        parts = path.relative_to(ROOT).with_suffix("").parts
        name = ".".join(parts if parts[0] == "lacuna" else ("lacuna", *parts))
        paths[name.removesuffix(".__init__")] = path
    graph: dict[str, set[str]] = {name: set() for name in paths}
    for name, path in paths.items():
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                found = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom) and node.module:
                inside = [f"{node.module}.{alias.name}" for alias in node.names]
                found = [full if full in paths else node.module for full in inside]
            else:
                continue
            graph[name] |= {target for target in found if target in paths and target != name}
    return graph


@pytest.mark.parametrize("folder", ["lacuna", "codegen", "runtime", "analysis", "discovery", "fmi", "lsp", "cli"])
def test_modules_import_in_no_circle(folder: str) -> None:
    graph = import_graph(folder)
    try:
        list(TopologicalSorter(graph).static_order())
    except CycleError as circle:
        pytest.fail(" -> ".join(circle.args[1]))


def test_the_imports_are_found() -> None:
    graph = import_graph("codegen")
    assert {"lacuna.codegen.flatten", "lacuna.codegen.emit.source"} <= graph["lacuna.codegen.compile"]
    assert "lacuna.codegen.flatten.functions.calls" in graph["lacuna.codegen.flatten.language"]
