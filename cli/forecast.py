"""`lacuna forecast`: the flights that remain, from a history of pre-flight tests."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.options import assignments, number
from lacuna.cli.progress import progress


@answered
def forecast(
    history: Annotated[
        str, typer.Argument(help="Folder with history.csv or .parquet, such a file, or a history store")
    ],
    map: Annotated[
        Path | None, typer.Option(help="Folder of the actuator's map: its bands, and what assesses recordings")
    ] = None,
    laws: Annotated[
        list[Path] | None, typer.Option(help="More degradation laws: a .mo file or a folder; repeat")
    ] = None,
    risk: Annotated[float, typer.Option(help="Greatest probability of the last limit at an advised test")] = 0.001,
    horizon: Annotated[
        float | None, typer.Option(help="How far ahead to look; default: ten times what was watched")
    ] = None,
    unit: Annotated[
        Literal["cycles", "hours"] | None, typer.Option(help="Count by this column, where there are both")
    ] = None,
    current: Annotated[list[str] | None, typer.Option(help="Column of a phase current in the recordings")] = None,
    unfiltered: Annotated[
        bool, typer.Option("--unfiltered", help="The currents did not pass the map's filters")
    ] = False,
    limit: Annotated[
        list[str] | None,
        typer.Option(help="NAME=VALUE: where a quantity of diagnoses (`lacuna explain`) has its limit; repeat"),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Folder of the results; default: out/forecast/HISTORY")] = None,
) -> Answer:
    """Say when each actuator reaches the bands of its map, how sure that is, and its last advisable test.

    history.csv has the columns actuator, cycles (or hours), then severity, low, high (fractions, 95 %) or recording (a
    file beside it), and event (empty or replaced). Writes forecast.json, report.html and fan charts. "Too early to
    say" is an answer; a history that contradicts itself is refused with the row.
    """
    limits = {name: number(name, text) for name, text in assignments(limit, "--limit").items()}
    folder = out or Path("out/forecast") / _name(history)
    with progress() as tell:
        found = lacuna.forecast(
            history, map, folder, laws=laws or (), risk=risk, horizon=horizon, unit=unit, columns=current,
            unfiltered=unfiltered, limits=limits, progress=tell,
        )  # fmt: skip
    sentences = found.sentences
    more = [f"... and {len(sentences) - SHOWN} more actuators"] if len(sentences) > SHOWN else []
    parts: list = [*sentences[:SHOWN], *more]
    return Answer(found.content, parts, [folder], [f"warning: {text}" for text in found.warnings])


def _name(history: str) -> str:
    if "://" in history:
        return "store"
    path = Path(history)
    return path.stem if path.is_file() else path.resolve().name


SHOWN = 20  # sentences that are printed
