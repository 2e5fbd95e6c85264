"""Dependencies point one way: cli -> lacuna -> discovery -> (codegen, runtime, analysis); fmi -> (codegen, runtime);
analysis -> runtime; runtime -> the ABI; codegen -> nothing. The bench stands on top, too, and nobody
stands on it or on the command line."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import lacuna
from tests.architecture.sources import ROOT, files, imports, includes

STAGES = ("codegen", "runtime", "analysis", "discovery", "fmi", "lsp")
PYTHON_MAY_IMPORT = {
    "codegen": set(),
    "runtime": set(),
    "analysis": {"runtime"},
    "discovery": {"codegen", "runtime", "analysis"},
    "fmi": {"codegen", "runtime"},
    "lsp": {"codegen"},
    "lacuna": set(STAGES),  # the public face
    "cli": set(),  # `import lacuna`, and nothing else: what the command line can do, a script can
    "bench": set(STAGES),
    # The proof conceals physics with code of its own; it shares none with what it judges.
    "tests/proof": set(),
}
PROJECT = {*STAGES, "lacuna", "cli", "bench", "tests"}
# What every stage may know of the package: its name, where its libraries are, what an extra brings, units of measure,
# what becomes of texts, rows of tables, names that may be meant, figures as files, programs that end with us, files
# that are written whole, files that users give.
FACE = {
    "lacuna",
    "lacuna.native",
    "lacuna.extras",
    "lacuna.units",
    "lacuna.recorded_units",
    "lacuna.texts",
    "lacuna.rows",
    "lacuna.suggest",
    "lacuna.drawn",
    "lacuna.children",
    "lacuna.written",
    "lacuna.given",
}

C_MAY_INCLUDE = {
    "runtime": ("runtime", ("idas/", "nvector/", "sunmatrix/", "sunlinsol/", "sundials/")),
    "analysis": ("analysis", ("Eigen/", "unsupported/Eigen/", "fftw3.h")),
    "fmi": ("fmi", ()),
    "bench": ("bench", ("ida/", "idas/", "nvector/", "sunmatrix/", "sunlinsol/", "sundials/")),
    "tests/proof": ("tests/proof", ()),
}
C_SUFFIXES = (".c", ".h", ".cpp", ".hpp")


def stage(module: str) -> str:
    """The folder of a module: lacuna.codegen.flat is in codegen, lacuna.models in lacuna, tests.models in tests."""
    first, _, rest = module.partition(".")
    inner = rest.split(".")[0]
    return inner if first == "lacuna" and inner in PROJECT else first


def forbidden_imports(folder: str) -> list[str]:
    allowed = PYTHON_MAY_IMPORT[folder] | {folder.split("/")[0]}
    return [
        f"{path.relative_to(ROOT)}:{line}: imports {module}"
        for path in files(folder, ".py")
        if not path.name.startswith("test_")  # a test may hold two independent paths against each other
        for line, module in imports(path)
        if module not in FACE and (package := stage(module)) in PROJECT and package not in allowed
    ]


@pytest.mark.parametrize("folder", PYTHON_MAY_IMPORT)
def test_python_imports_point_one_way(folder: str) -> None:
    assert forbidden_imports(folder) == []


def test_the_command_line_uses_public_names_only() -> None:
    used = {
        node.attr
        for path in files("cli", ".py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "lacuna"
    }
    assert used
    assert used - {*lacuna.__all__, "__version__"} == set()


# The FMU's interface is the standard's own headers; inside it is the runtime.
STANDARD = {path.name for path in (ROOT / "fmi/standard").glob("*.h")}


def own_headers(folder: str) -> set[str]:
    return {path.name for path in files(folder, ".h", ".hpp")}


def is_standard(header: str) -> bool:
    """<math.h>, <vector>, <sys/stat.h>: nothing of ours and no third-party library."""
    return "/" not in header.removeprefix("sys/") and header not in ALL_OWN_HEADERS and header != "fftw3.h"


ALL_OWN_HEADERS = {name for folder in ("runtime", "analysis", "fmi", "bench", "tests") for name in own_headers(folder)}


@pytest.mark.parametrize("folder", C_MAY_INCLUDE)
def test_c_includes_point_one_way(folder: str) -> None:
    home, libraries = C_MAY_INCLUDE[folder]
    own = own_headers(home) | (own_headers("runtime") | STANDARD if folder == "fmi" else set())
    found = [
        f"{path.relative_to(ROOT)}: includes {header}"
        for path in files(folder, *C_SUFFIXES)
        for header in includes(path)
        if not (Path(header).name in own or header.startswith(libraries) or is_standard(header))
    ]
    assert found == []


def test_generator_knows_the_runtime_only_as_the_abi_header() -> None:
    text = {path: path.read_text(encoding="utf-8") for path in files("codegen", ".py")}
    assert [str(p.relative_to(ROOT)) for p, source in text.items() if "lacuna_runtime" in source] == []
    assert any("mdl_abi.h" in source for source in text.values())


def test_abi_header_stands_alone() -> None:
    assert includes(ROOT / "runtime/include/mdl_abi.h") == []


def test_top_level_folders_are_those_that_were_decided() -> None:
    product = {"model", "lacuna", "codegen", "runtime", "analysis", "discovery", "fmi", "lsp", "cli"}
    decided = product | {"tests", "docs", "bench", "editors"}
    made = {"build", "out"}
    present = {p.name for p in ROOT.iterdir() if p.is_dir() and not p.name.startswith((".", "__"))}
    unexpected = {name for name in present - decided - made if not name.endswith(".egg-info")}
    assert unexpected == set(), "a new top-level folder needs a reason in docs/decisions/"
