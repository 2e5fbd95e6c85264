"""`lacuna explain`: what a recording knows and the model does not."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.options import Libraries
from lacuna.cli.progress import progress
from lacuna.cli.steps import doubts


@answered
def explain(
    case: Annotated[Path, typer.Argument(metavar="CASE", help="Folder with case.toml and its recordings")],
    library: Libraries = None,
    out: Annotated[Path | None, typer.Option(help="Folder of the results; default: out/explain/CASE")] = None,
    limit: Annotated[
        float, typer.Option(min=0, metavar="SECONDS", help="Stop searching after this time; what was found stands")
    ] = 600.0,
) -> Answer:
    """Say which physics the believed model of CASE lacks, or that it lacks none, or that the data cannot tell.

    Fits the believed model, locates the missing effort, ranks effects of the catalogue, writes the amended model and
    judges it on recordings that nothing was fitted to. Writes diagnosis.json, trace.json (why each hypothesis was given
    up), report.html and, where there is one, the amended model; prints the verdict. After an interruption, the same
    call takes up the fits that were finished.
    """
    with progress(limit) as tell:
        found = lacuna.explain(case, libraries=library or [], out=out, limit=limit, progress=tell)
    return Answer(found.diagnosis, [found.sentence], list(found.written), doubts(found.problems))
