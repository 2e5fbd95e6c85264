"""`lacuna sweep`: thousands of simulated tests over fault and nuisances, here or on a Dask cluster."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lacuna.cli.errors import reported


@reported
def sweep(
    actuator: Annotated[
        str | None, typer.Argument(metavar="[ACTUATOR]", help="Model; default: that of the settings' tests")
    ] = None,
    points: Annotated[int, typer.Option(min=1, help="Simulated tests, by a low-discrepancy design")] = 1000,
    settings: Annotated[Path | None, typer.Option(help="Test, fault axis and nuisances, a TOML file")] = None,
    solver: Annotated[str, typer.Option(help="Solver of every test")] = "dopri5",
    scheduler: Annotated[
        str | None, typer.Option(help="Dask scheduler, tcp://host:port; default: this machine")
    ] = None,
    chunk: Annotated[int, typer.Option(min=1, help="Tests a task")] = 16,
    out: Annotated[Path | None, typer.Option(help="Folder; default: out/sweeps/NAME of the settings")] = None,
) -> None:
    """Simulate and analyse many tests with fault and nuisances drawn together; results.parquet has one row a test.

    Goes on where it stopped, whatever was lost: a worker, the connection, this process.

    [bold]Example[/bold]: lacuna sweep --points 5000 --scheduler tcp://10.0.0.1:8786
    """
    from lacuna.analysis.campaign.points import sobol_points
    from lacuna.analysis.campaign.run import run_campaign
    from lacuna.analysis.campaign.work import Work
    from lacuna.analysis.map.plant import ModelPlant
    from lacuna.analysis.progress import progress_bar
    from lacuna.analysis.settings import PAPER, load_settings
    from lacuna.codegen.compile import compile_model

    chosen = load_settings(settings or PAPER)
    compiled = compile_model(actuator or chosen.disturbed_model)
    plant = ModelPlant.of(compiled, chosen)
    work = Work(compiled.name, Path(compiled.path).read_bytes(), compiled.hash, chosen.text, solver)
    folder = out or Path("out/sweeps") / (settings or PAPER).stem
    with progress_bar(f"sweep of {compiled.name}") as progress:
        results = run_campaign(
            work,
            sobol_points(chosen, points, plant),
            folder,
            scheduler=scheduler,
            chunk=chunk,
            progress=progress,
        )
    typer.echo(f"written: {results}")
