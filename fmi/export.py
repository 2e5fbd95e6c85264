"""From a model to an .fmu: description, sources, binary, in one zip of fixed bytes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
import hashlib
from pathlib import Path
import platform
import tempfile
from typing import Literal
import zipfile

import lacuna
from lacuna.codegen.compile import CompiledModel, compile_model, translate
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.library.access import NONE, Access
from lacuna.codegen.symbolic.expr import own_table
from lacuna.fmi.arrays import extents
from lacuna.fmi.description import Header, build_description, describe
from lacuna.fmi.errors import FmuError
from lacuna.fmi.sources import OPTIONS, collect, compile_sources, configuration, identifier_of
from lacuna.fmi.variables import FmiVariables
import lacuna.runtime as runtime
from lacuna.written import whole_file

Version = Literal["3.0", "2.0"]
Kind = Literal["me", "cs", "both"]
SOLVERS = ("rodas4", "dopri5", "rk4", "euler")  # what co-simulation can carry as source
_ADAPTIVE = ("rodas4", "dopri5")
_MOMENT = (1980, 1, 1, 0, 0, 0)  # of every file in the zip: equal models give equal bytes


@dataclass(frozen=True)
class FmuRequest:
    """What to export. `fixed` are parameters that decide the structure, `values` others (SI units)."""

    name: str
    search_path: tuple[str, ...]
    units: str = "error"
    fixed: Mapping[str, float] = field(default_factory=dict)
    values: Mapping[str, float] = field(default_factory=dict)
    version: Version = "3.0"
    kind: Kind = "both"
    solver: str = "rodas4"
    access: Access = NONE


@dataclass(frozen=True)
class Fmu:
    """What was exported: `path`, and how much is in it."""

    path: Path
    model: str
    version: str
    kinds: tuple[str, ...]
    states: int
    variables: int
    event_indicators: int
    derivatives: bool


def export_fmu(request: FmuRequest, path: Path) -> Fmu:
    """Translate, describe, compile, pack. Raises FmuError for what FMI cannot carry, Diagnostic and CompilerError as
    any translation does."""
    _check(request, path)
    given = {
        "search_path": list(request.search_path), "modifications": dict(request.fixed), "units": request.units,
        "access": request.access,
    }  # fmt: skip
    with own_table():
        prepared, _ = translate(request.name, **given)
        if prepared.transports:
            raise FmuError(
                f"{request.name}: spatialDistribution() is not exported: what the pipe holds is no part of the state "
                "that an FMU can save"
            )
        if prepared.delays and request.kind != "cs":
            raise FmuError(
                f"{request.name}: delay() is exported for co-simulation only (--type cs): in model exchange the past "
                "would be that of a solver that is not the FMU's own, which tells neither its steps' inside nor that "
                "they end where a delay does"
            )
        compiled = compile_model(request.name, sensitivities=not prepared.delays, **given)
        return _pack(request, compiled, prepared, path)


def _check(request: FmuRequest, path: Path) -> None:
    if request.version not in ("2.0", "3.0"):
        raise FmuError(f"FMI is exported in versions 2.0 and 3.0, not {request.version}")
    if request.solver not in _ADAPTIVE:
        reason = "IDA belongs to SUNDIALS, and an FMU carries its solver as source" if request.solver == "ida" else (
            "it has no step size control" if request.solver in SOLVERS else "there is none of that name"
        )  # fmt: skip
        raise FmuError(f"no co-simulation by solver {request.solver}: {reason}; there are {', '.join(_ADAPTIVE)}")
    if path.suffix != ".fmu":
        raise FmuError(f"{path}: the name of an FMU ends with .fmu")


def _configuration(
    request: FmuRequest, model: runtime.Model, variables: FmiVariables, token: str, tolerance: float
) -> str:
    values = {model.parameters[n].index: model.parameters[n].sign * float(v) for n, v in request.values.items()}
    arrays, starting = extents(variables.all), variables.starting
    return configuration(token, request.solver, tolerance, model.start_time, model.stop_time, values, arrays, starting)


def _pack(request: FmuRequest, compiled: CompiledModel, prepared: Prepared, path: Path) -> Fmu:
    foreign = prepared.declared.foreign
    if foreign.libraries:
        reason = f"its external C needs {' '.join(foreign.libraries)}, and an FMU carries sources; name them by Include"
        raise FmuError(f"{prepared.declared.name}: {reason}")
    model = runtime.Model(compiled.path)
    # what no run takes, no FMU starts with
    runtime.Session(model, solver=request.solver).set_parameters(request.values)
    variables = FmiVariables(model, prepared, dict(request.values), arrays=request.version == "3.0")
    identifier = identifier_of(model.name)
    source = Path(compiled.path).with_suffix(".c").read_text(encoding="utf-8")
    token = _token(request, source)
    kinds = ("me", "cs") if request.kind == "both" else (request.kind,)
    tolerance = model.tolerance if model.tolerance > 0 else 1e-6
    settings = _configuration(request, model, variables, token, tolerance)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as scratch:
        root = Path(scratch) / "fmu"
        files = collect(root / "sources", source, settings, request.version)
        compile_sources(
            root / "sources",
            files,
            root / "binaries" / _platform(request.version) / f"{identifier}.so",
            bool(foreign.spans),
        )
        header = Header(
            model.name, identifier, token, prepared.declared.description, f"Lacuna {lacuna.__version__}", kinds,
            not prepared.delays,
            model.start_time, model.stop_time, tolerance, model.interval, files,
        )  # fmt: skip
        (root / "modelDescription.xml").write_bytes(describe(header, variables, request.version))
        if request.version == "3.0":
            build = build_description(identifier, files, OPTIONS)
            (root / "sources" / "buildDescription.xml").write_bytes(build)
        _zip(root, path)
    return Fmu(
        path,
        model.name,
        request.version,
        kinds,
        model.n_states,
        len(variables.all),
        len(variables.indicators),
        not prepared.delays,
    )


def _token(request: FmuRequest, source: str) -> str:
    """Of the C, the parameters and the settings: an FMU made again from the same has the same."""
    said = (source, lacuna.__version__, sorted(request.values.items()), request.version, request.kind, request.solver)
    digest = hashlib.sha256(repr(said).encode()).hexdigest()
    return f"{{{digest[:8]}-{digest[8:12]}-{digest[12:16]}-{digest[16:20]}-{digest[20:32]}}}"


def _platform(version: str) -> str:
    """The folder of this machine's binaries. Raises FmuError where FMI has no name for it."""
    machine = {"x86_64": "x86_64", "aarch64": "aarch64"}.get(platform.machine())
    if platform.system() != "Linux" or machine is None or (version == "2.0" and machine != "x86_64"):
        raise FmuError(f"no binaries of FMI {version} for {platform.system()} on {platform.machine()}")
    return f"{machine}-linux" if version == "3.0" else "linux64"


def _zip(root: Path, path: Path) -> None:
    """Everything below `root`, in the order of names."""
    with whole_file(path) as partial, zipfile.ZipFile(partial, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(p for p in root.rglob("*") if p.is_file()):
            entry = zipfile.ZipInfo(file.relative_to(root).as_posix(), _MOMENT)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            archive.writestr(entry, file.read_bytes())
