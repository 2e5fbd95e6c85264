"""No circles: the modules of a folder can be put in an order in which each imports only what comes before it.

Imports for type checking only and lazy ones inside functions count, because what a file must know of another to be
understood is the same; a submodule imported from its package counts as itself.
"""

from __future__ import annotations

import ast
from graphlib import CycleError, TopologicalSorter
import re

import pytest

from tests.architecture.sources import ROOT, files

_DEFINED = re.compile(r"^(?!static)\w[\w *]*?\b(rt_\w+)\([^;]*?\) \{$", re.MULTILINE)
_CALLED = re.compile(r"\b(rt_\w+)\(")


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


def call_graph() -> dict[str, set[str]]:
    """Files of the runtime, with those whose functions each calls."""
    text = {path.name: path.read_text(encoding="utf-8") for path in files("runtime/src", ".c")}
    home = {name: file for file, source in text.items() for name in _DEFINED.findall(source)}
    return {file: {home[n] for n in _CALLED.findall(source) if n in home} - {file} for file, source in text.items()}


def test_files_of_the_runtime_call_each_other_in_no_circle() -> None:
    graph = call_graph()
    assert {"events.c", "initialise.c", "record.c"} <= graph["simulate.c"]
    try:
        list(TopologicalSorter(graph).static_order())
    except CycleError as circle:
        pytest.fail(" -> ".join(circle.args[1]))


def test_the_imports_are_found() -> None:
    graph = import_graph("codegen")
    assert {"lacuna.codegen.flatten", "lacuna.codegen.emit.source"} <= graph["lacuna.codegen.compile"]
    assert "lacuna.codegen.flatten.functions.calls" in graph["lacuna.codegen.flatten.language"]
