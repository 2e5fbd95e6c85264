"""`lacuna assess`: the severity that a recorded pre-flight test shows."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lacuna.cli.errors import reported


@reported
def assess(
    recording: Annotated[Path, typer.Argument(help="CSV or MAT file of the recorded test: time first, SI units")],
    map: Annotated[
        Path, typer.Option(help="Folder of the actuator's map, made by `lacuna maps --prepare` or `--with`")
    ] = Path("out/maps/paper"),
    current: Annotated[list[str] | None, typer.Option(help="Column of a phase current, once for each phase")] = None,
    unfiltered: Annotated[
        bool, typer.Option("--unfiltered", help="The currents did not pass the map's filters")
    ] = False,
    out: Annotated[Path | None, typer.Option(help="Folder of the results; default: out/assess/RECORDING")] = None,
) -> None:
    """Say how far the fault has gone, with its interval and band, by the map of the actuator; or two faults.

    A recording that the map does not cover (too short, saturated, swapped phases, another command or actuator) is
    refused with the reason. Writes assessment.json and a figure of the features on the map.
    """
    from lacuna.analysis.severity.assessment import assess as assessed
    from lacuna.analysis.severity.combined.assessment import assess_both
    from lacuna.analysis.severity.combined.grid import GRID_FILE

    folder = out or Path("out/assess") / recording.stem
    read = assess_both if (map / GRID_FILE).exists() else assessed
    done = read(recording, map, folder, columns=current or None, unfiltered=unfiltered)
    typer.echo(done.sentence)
    for warning in done.warnings:
        typer.echo(f"warning: {warning}", err=True)
    typer.echo(f"written: {folder}")
