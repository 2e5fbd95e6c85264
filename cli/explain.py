"""`lacuna explain`: what a recording knows and the model does not."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from rich.console import Console
import typer

from lacuna.cli.errors import reported


@reported
def explain(
    case: Annotated[Path, typer.Argument(metavar="CASE", help="Folder with case.toml and its recordings")],
    out: Annotated[Path | None, typer.Option(help="Folder of the results; default: out/explain/CASE")] = None,
    limit: Annotated[
        float, typer.Option(min=0, metavar="SECONDS", help="Stop searching after this time; what was found stands")
    ] = 600.0,
) -> None:
    """Say which physics the believed model of CASE lacks, or that it lacks none, or that the data cannot tell.

    Fits the believed model, locates the missing effort, ranks effects of the catalogue, writes the amended model and
    judges it on recordings that nothing was fitted to. Writes diagnosis.json, report.html and, where there is one, the
    amended model; prints the verdict. After an interruption, the same call takes up the fits that were finished.
    """
    from lacuna.discovery import cases, diagnosis, report
    from lacuna.discovery.explain import explain as explained
    from lacuna.discovery.explain import judge_written, write_amended
    from lacuna.discovery.store import kept

    loaded = cases.load(case)
    folder = out or Path("out/explain") / case.resolve().name
    with Console(stderr=True).status("reading the recordings") as status, kept(folder / ".unfinished"):
        result = explained(loaded, progress=status.update, limit=limit)
    amended = write_amended(result, folder)
    if amended is not None:
        judge_written(result, amended)
    written = [diagnosis.write(result, folder, amended), report.write(result, folder, amended), amended]
    typer.echo(diagnosis.sentence(result))
    for path in filter(None, written):
        typer.echo(f"written: {path}")
