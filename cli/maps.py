"""`lacuna maps`: operating maps of an actuator."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Annotated, Any

from rich.table import Table
import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.complete import models
from lacuna.cli.options import ClassName, Libraries
from lacuna.cli.progress import progress
from lacuna.cli.watch import Port, Watch, watched


@answered
def maps(
    model: Annotated[
        str | None,
        typer.Argument(metavar="[ACTUATOR]", help="Model; default: that of the settings", autocompletion=models),
    ] = None,
    class_name: ClassName = "",
    library: Libraries = None,
    settings: Annotated[Path | None, typer.Option(help="Sampling, spectra, fault axis and bands, a TOML file")] = None,
    out: Annotated[Path | None, typer.Option(help="Folder of the map; default: out/maps/NAME of the settings")] = None,
    jobs: Annotated[int | None, typer.Option(min=1, help="Simulations at once; default: one a core")] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Compute every row again, also those already there")] = False,
    figures: Annotated[bool, typer.Option(help="Draw the figures and report.html")] = True,
    prepare: Annotated[bool, typer.Option("--prepare", help="Add what `lacuna assess` needs: a minute or two")] = False,
    combined: Annotated[
        str | None, typer.Option("--with", help="Map over two faults: one of those that the settings combine")
    ] = None,
    watch: Watch = False,
    port: Port = 0,
) -> Answer:
    """Simulate a pre-flight test at every severity of a fault and write the map, its figures and a report.

    Without arguments: the paper's actuator over its eccentricity, into out/maps/paper. An interrupted map goes on
    where it stopped; a map whose model and settings are unchanged is there at once.

    With --with friction, a map of two faults at once for `lacuna assess`, into out/maps/paper-with-friction.
    """
    libraries = library or []
    asked: dict[str, Any] = {
        "class_name": class_name,
        "libraries": libraries,
        "settings": settings,
        "out": out,
        "jobs": jobs,
    }
    if watch:
        return watched(partial(_drawn, model, asked), model or "operating map", [*libraries, *_file(settings)], port)
    with progress() as tell:
        if combined:
            both = lacuna.combined_maps(combined, model, **asked, progress=tell)
            return Answer({"first": both.first, "second": both.second}, [both.sentence], [both.folder])
        done = lacuna.maps(model, **asked, fresh=fresh, figures=figures, prepare=prepare, progress=tell)
    split = ", ".join(f"{name.replace('_cpu', ' (all cores)')} {s:.2f} s" for name, s in done.seconds.items())
    data = {"title": done.title, "severities": done.severities.tolist(),
            "features": {n: done[n].tolist() for n in done.features}, "comparison": done.comparison}  # fmt: skip
    return Answer(data, [*_comparison(done), f"{len(done)} severities: {split}"], [done.folder])


def _drawn(model: str | None, asked: dict[str, Any]) -> Iterator[Any]:
    """The RMS of the phase currents over the fault, at some severities and then at all, of the map as it is now."""
    for done in lacuna.growing_map(model, **asked):
        yield done.plot(*(name for name in done.features if name.startswith("rms")))


def _file(path: Path | None) -> list[Path]:
    return [] if path is None else [path]


def _comparison(done: lacuna.OperatingMap) -> list[Table]:
    table = Table(title=done.title, title_justify="left")
    table.add_column("quantity")
    for column in ("published", "reproduced"):
        table.add_column(column, justify="right")
    table.add_column("unit")
    for row in done.comparison:
        table.add_row(row["quantity"], _text(row["published"]), _text(row["reproduced"]), row["unit"])
    return [table] if table.rows else []


def _text(value: object) -> str:
    if value is None:
        return "none"
    return f"{value:.5g}" if isinstance(value, float) else str(value)
