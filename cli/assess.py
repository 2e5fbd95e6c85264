"""`lacuna assess`: the severity that a recorded pre-flight test shows."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

import lacuna
from lacuna.cli.answer import Answer, answered


@answered
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
) -> Answer:
    """Say how far the fault has gone, with its interval and band, by the map of the actuator; or two faults.

    A recording that the map does not cover (too short, saturated, swapped phases, another command or actuator) is
    refused with the reason. Writes assessment.json and a figure of the features on the map.
    """
    folder = out or Path("out/assess") / recording.stem
    done = lacuna.assess(recording, map, columns=current, unfiltered=unfiltered, out=folder)
    return Answer(asdict(done), [done.sentence], [folder], [f"warning: {text}" for text in done.warnings])
