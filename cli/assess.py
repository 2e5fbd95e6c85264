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
    recording: Annotated[
        Path, typer.Argument(help="The recorded test: time and phase currents, in any format that is read")
    ],
    map: Annotated[
        Path, typer.Option(help="Folder of the actuator's map, made by `lacuna maps --prepare` or `--with`")
    ] = Path("out/maps/paper"),
    current: Annotated[list[str] | None, typer.Option(help="Column of a phase current, once for each phase")] = None,
    unfiltered: Annotated[
        bool, typer.Option("--unfiltered", help="The currents did not pass the map's filters")
    ] = False,
    out: Annotated[Path | None, typer.Option(help="Folder of the results; default: out/assess/RECORDING")] = None,
    store: Annotated[
        str | None, typer.Option(help="Append to this history store: a .db file or a database URL")
    ] = None,
    actuator: Annotated[str | None, typer.Option(help="Whose test this is, for the store")] = None,
    cycles: Annotated[float | None, typer.Option(help="Flight cycles at this test, for the store")] = None,
    hours: Annotated[float | None, typer.Option(help="Flight hours at this test, for the store")] = None,
    replaced: Annotated[bool, typer.Option("--replaced", help="The part is new since the test before")] = False,
) -> Answer:
    """Say how far the fault has gone, with its interval and band, by the map of the actuator; or two faults.

    A recording that the map does not cover (too short, saturated, swapped phases, another command or actuator) is
    refused with the reason. Writes assessment.json, a figure of the features on the map, and report.html.
    """
    folder = out or Path("out/assess") / recording.stem
    done = lacuna.assess(recording, map, columns=current, unfiltered=unfiltered, out=folder)
    notes = [done.sentence]
    if store is not None:
        new = lacuna.remember(
            recording, map, store, actuator=actuator or "", cycles=cycles, hours=hours, replaced=replaced,
            columns=current, unfiltered=unfiltered,
        )  # fmt: skip
        notes.append(f"stored: {new} new" if new else "stored before")
    return Answer(asdict(done), notes, [folder], [f"warning: {text}" for text in done.warnings])
