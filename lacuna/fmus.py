"""Models for other tools, and other tools' models beside ours: the FMI standard."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, get_args

from lacuna.errors import UserError
from lacuna.models import load
from lacuna.notebook import page, table
from lacuna.sources import Units

FmiVersion = Literal["3.0", "2.0"]
FmuType = Literal["me", "cs", "both"]
FmuSolver = Literal["rodas4", "dopri5"]


@dataclass(frozen=True)
class ExportedFmu:
    """An FMU on disk: `path`, and what it offers."""

    path: Path
    model: str
    version: str
    types: tuple[str, ...]  # me: model exchange, cs: co-simulation
    states: int
    variables: int
    event_indicators: int

    def _repr_html_(self) -> str:
        rows = [
            ("file", str(self.path)), ("FMI", self.version), ("types", ", ".join(self.types)),
            ("states", self.states), ("variables", self.variables), ("event indicators", self.event_indicators),
        ]  # fmt: skip
        return page(self.model, table(("", ""), rows))


def export_fmu(
    model: str | Path,
    path: str | Path | None = None,
    *,
    class_name: str = "",
    libraries: Iterable[str | Path] = (),
    parameters: Mapping[str, float] | None = None,
    units: Units = "error",
    data: Iterable[str | Path] = (),
    allow_external: bool = False,
    version: FmiVersion = "3.0",
    type: FmuType = "both",
    solver: FmuSolver = "rodas4",
) -> ExportedFmu:
    """Write `model` as an FMU to `path` (default: out/fmu/NAME.fmu), for this machine's platform, with its C sources.

    `parameters` (as declared) become the FMU's start values; one that decides the structure is fixed in it. `type`: me
    (model exchange, with directional derivatives), cs (co-simulation by `solver`, which the FMU carries) or both.
    Raises what `load` raises, and a user's error with the reason for what FMI cannot carry.
    """
    from lacuna.fmi.export import FmuRequest
    from lacuna.fmi.export import export_fmu as export

    if type not in get_args(FmuType):
        raise UserError(f"an FMU is of type {' or '.join(get_args(FmuType))}, not {type!r}")
    loaded = load(
        model, class_name=class_name, libraries=libraries, parameters=parameters, units=units, data=data,
        allow_external=allow_external,
    )  # fmt: skip
    target = Path(path) if path else Path("out/fmu") / f"{loaded.name.rsplit('.', 1)[-1]}.fmu"
    source, fixed, values = loaded.request
    request = FmuRequest(source.name, source.path, source.units, fixed, values, version, type, solver, source.access)
    done = export(request, target)
    return ExportedFmu(
        done.path, done.model, done.version, done.kinds, done.states, done.variables, done.event_indicators
    )
