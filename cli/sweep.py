"""`lacuna sweep`: thousands of simulated tests over fault and nuisances, here or on a Dask cluster."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.complete import models
from lacuna.cli.options import ClassName, Libraries
from lacuna.cli.progress import progress


@answered
def sweep(
    model: Annotated[
        str | None,
        typer.Argument(metavar="[ACTUATOR]", help="Model; default: that of the settings' tests", autocompletion=models),
    ] = None,
    class_name: ClassName = "",
    library: Libraries = None,
    points: Annotated[int, typer.Option(min=1, help="Simulated tests, by a low-discrepancy design")] = 1000,
    settings: Annotated[Path | None, typer.Option(help="Test, fault axis and nuisances, a TOML file")] = None,
    solver: Annotated[str, typer.Option(help="Solver of every test")] = "dopri5",
    scheduler: Annotated[
        str | None, typer.Option(help="Dask scheduler, tcp://host:port; default: this machine")
    ] = None,
    chunk: Annotated[int, typer.Option(min=1, help="Tests a task")] = 16,
    out: Annotated[Path | None, typer.Option(help="Folder; default: out/sweeps/NAME of the settings")] = None,
) -> Answer:
    """Simulate and analyse many tests with fault and nuisances drawn together; results.parquet has one row a test.

    Goes on where it stopped, whatever was lost: a worker, the connection, this process.

    [bold]Example[/bold]: lacuna sweep --points 5000 --scheduler tcp://10.0.0.1:8786
    """
    with progress() as tell:
        done = lacuna.sweep(
            model, class_name=class_name, libraries=library or [], points=points, settings=settings, solver=solver,
            scheduler=scheduler, chunk=chunk, out=out, progress=tell,
        )  # fmt: skip
    data = {"tests": len(done), "failed": len(done.failures), "columns": done.names}
    failure = f"no test succeeded; the first: {done.failures[0]}" if len(done.failures) == len(done) else ""
    return Answer(data, [f"{len(done)} tests, {len(done.failures)} failed"], [done.path, done.report], failure=failure)
