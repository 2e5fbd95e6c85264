"""What an FMU is compiled from: the model, the runtime without SUNDIALS, and the interface around both."""

from __future__ import annotations

import hashlib
from pathlib import Path
import re

from lacuna.children import run
from lacuna.codegen.cache import Cache, CompilerError, compiler
from lacuna.fmi.errors import FmuError
from lacuna.written import whole_files

_HERE = Path(__file__).resolve().parent
_RUNTIME = _HERE.parent / "runtime"
_OTHERS = {
    "ida.c",
    "ida_dense.c",
    "ida_failure.c",
    "ida_matrix.c",
    "ida_start.c",
    "ida_tangent.c",
    "ida.h",
    "newton.c",
    "vector.c",
    "dense_solver.c",
    "sparse.c",
    "vector.h",
    "sundials_compat.h",
}  # of the runtime: what needs SUNDIALS or KLU
OPTIONS = (
    "-std=c11", "-O2", "-fPIC", "-ffp-contract=off", "-fvisibility=hidden", "-D_POSIX_C_SOURCE=200809L",
    "-DRT_OWN_METHODS",
)  # fmt: skip
OWN = ("generated.c", "fmu_config.c")  # what differs from FMU to FMU
_WARNINGS = ("-Wall", "-Wextra", "-Werror")


def collect(folder: Path, model: str, configuration: str, version: str) -> tuple[str, ...]:
    """Write every source and header into `folder`; the names of the C files among them."""
    folder.mkdir(parents=True)
    other = {"2.0": "fmi3", "3.0": "fmi2"}[version]
    paths = [*_RUNTIME.glob("src/*.[ch]"), *_RUNTIME.glob("include/*.h"), *_HERE.glob("src/*.[ch]"),
             *_HERE.glob("standard/*.h")]  # fmt: skip
    for path in paths:
        if path.name not in _OTHERS and not path.name.startswith(other):
            (folder / path.name).write_bytes(path.read_bytes())
    (folder / "generated.c").write_text(model, encoding="utf-8")
    (folder / "fmu_config.c").write_text(configuration, encoding="utf-8")
    return tuple(sorted(path.name for path in folder.glob("*.c")))


def configuration(
    token: str, solver: str, rtol: float, start: float, stop: float, values: dict[int, float], arrays: dict[int, int],
    starting: list[int],
) -> str:  # fmt: skip
    """fmu_config.c: `values` replace declared parameters, by their index; `arrays` have more values than one, by their
    value references, ascending; `starting` are rows of states that start at a number."""
    tables = {
        "parameter": ("int", values), "value": ("double", map(repr, values.values())),
        "array": ("fmu_array", (f"{{{first}, {n}}}" for first, n in arrays.items())),
        "starting": ("int", starting),
    }  # fmt: skip
    written = {name: (kind, ", ".join(map(str, numbers))) for name, (kind, numbers) in tables.items()}
    return (
        '/* What this FMU alone has. */\n#include "fmu.h"\n\n'
        + "".join(f"static const {kind} {name}[] = {{{text}}};\n" for name, (kind, text) in written.items() if text)
        + f'\nconst fmu_config fmu_configuration = {{\n    .token = "{token}",\n    .solver = "{solver}",\n'
        f"    .rtol = {rtol!r},\n    .start_time = {start!r},\n    .stop_time = {stop!r},\n"
        f"    .n_parameters = {len(values)},\n    .n_arrays = {len(arrays)},\n"
        f"    .n_starting = {len(starting)},\n"
        + "".join(f"    .{name} = {name},\n" for name, (_, text) in written.items() if text)
        + "};\n"
    )


def compile_sources(folder: Path, files: tuple[str, ...], output: Path, foreign: bool = False) -> None:
    """One shared library of C `files` in `folder`, with `foreign` C of others in it. Raises CompilerError.

    What is the same in every FMU is compiled once and kept beside the compiled models."""
    output.parent.mkdir(parents=True, exist_ok=True)
    own = [name for name in files if name in OWN]
    common = _common(folder, [name for name in files if name not in OWN])
    warnings = () if foreign else _WARNINGS
    _run("cc", *OPTIONS, *warnings, "-shared", "-I.", "-o", output.resolve(), *own, *common, "-lm", folder=folder)


def _common(folder: Path, files: list[str]) -> list[Path]:
    """Objects of `files`, from the cache where nothing in `folder` but the model has changed."""
    digest = hashlib.sha256(" ".join((*OPTIONS, compiler())).encode())
    for path in sorted(folder.glob("*.[ch]")):
        if path.name not in OWN:
            digest.update(path.name.encode() + b"\0" + path.read_bytes())
    kept = Cache().private() / f"fmi-{digest.hexdigest()[:32]}"
    objects = [kept / f"{name}.o" for name in files]
    if not all(path.exists() for path in objects):
        with whole_files(kept) as scratch:
            for name in files:
                _run("cc", *OPTIONS, *_WARNINGS, "-c", "-I.", "-o", scratch / f"{name}.o", name, folder=folder)
    return objects


def _run(*command: str | Path, folder: Path) -> None:
    try:
        done = run(command, folder)
    except FileNotFoundError:
        raise CompilerError("no C compiler: install one that is called as `cc` (Debian: apt install gcc)") from None
    if done.returncode:
        lines = "\n".join(done.stderr.splitlines()[:20])
        raise CompilerError(f"the compiler refused the sources of the FMU, a fault of ours:\n{lines}")


def identifier_of(name: str) -> str:
    """A C identifier and file name from a model's name."""
    found = re.sub(r"\W", "_", name.rsplit(".", 1)[-1])
    if not re.fullmatch(r"[A-Za-z_]\w*", found, re.ASCII):
        raise FmuError(f"{name} gives no name for files: {found!r} is no identifier of C")
    return found
