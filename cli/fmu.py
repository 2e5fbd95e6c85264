"""`lacuna fmu`: a model for other tools."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Literal

import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.options import AllowExternal, ClassName, Data, Libraries, Model, Parameters, parameters

Version = Annotated[Literal["3.0", "2.0"], typer.Option("--fmi", help="Version of the standard")]
Type = Annotated[
    Literal["me", "cs", "both"],
    typer.Option("--type", help="Model exchange, co-simulation (its solver inside), or both"),
]
Solver = Annotated[Literal["rodas4", "dopri5"], typer.Option(help="Of co-simulation; rodas4 is for stiff models, too")]


@answered
def fmu(
    model: Model,
    class_name: ClassName = "",
    library: Libraries = None,
    parameter: Parameters = None,
    data: Data = None,
    allow_external: AllowExternal = False,
    fmi: Version = "3.0",
    type: Type = "both",
    solver: Solver = "rodas4",
    out: Annotated[Path | None, typer.Option(help="File to write; default out/fmu/NAME.fmu")] = None,
) -> Answer:
    """Export MODEL as an FMU: for this platform, with the C sources inside.

    Events, directional derivatives, tunable parameters, units, and a state that can be kept and restored. Parameters
    given with -p become its start values.
    """
    done = lacuna.export_fmu(
        model, out, class_name=class_name, libraries=library or [], parameters=parameters(parameter), version=fmi,
        type=type, solver=solver, data=data or [], allow_external=allow_external,
    )  # fmt: skip
    said = (
        f"{done.model}: FMI {done.version}, {' and '.join(done.types)}; {done.states} states, "
        f"{done.variables} variables, {done.event_indicators} event indicators"
    )
    return Answer(asdict(done) | {"path": str(done.path)}, [said], [done.path])
