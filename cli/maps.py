"""`lacuna maps`: operating maps of an actuator."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from rich.table import Table
import typer

from lacuna.cli.errors import reported
from lacuna.cli.output import console

if TYPE_CHECKING:
    from lacuna.analysis.map.maps import Map
    from lacuna.analysis.settings import Settings


@reported
def maps(
    actuator: Annotated[
        str | None, typer.Argument(metavar="[ACTUATOR]", help="Model; default: that of the settings")
    ] = None,
    settings: Annotated[Path | None, typer.Option(help="Sampling, spectra, fault axis and bands, a TOML file")] = None,
    out: Annotated[Path | None, typer.Option(help="Folder of the map; default: out/maps/NAME of the settings")] = None,
    jobs: Annotated[int | None, typer.Option(min=1, help="Simulations at once; default: one a core")] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Compute every row again, also those already there")] = False,
    figures: Annotated[bool, typer.Option(help="Draw the figures and report.html")] = True,
    prepare: Annotated[bool, typer.Option("--prepare", help="Add what `lacuna assess` needs: a minute or two")] = False,
    combined: Annotated[
        str | None, typer.Option("--with", help="Map over two faults: one of those that the settings combine")
    ] = None,
) -> None:
    """Simulate a pre-flight test at every severity of a fault and write the map, its figures and a report.

    Without arguments: the paper's actuator over its eccentricity, into out/maps/paper. An interrupted map goes on
    where it stopped; a map whose model and settings are unchanged is there at once.

    With --with friction, a map of two faults at once for `lacuna assess`, into out/maps/paper-with-friction.
    """
    from lacuna.analysis.map.maps import build_map
    from lacuna.analysis.map.plant import ModelPlant
    from lacuna.analysis.progress import progress_bar
    from lacuna.analysis.settings import PAPER, load_settings
    from lacuna.analysis.severity.preparation import prepare_assessment
    from lacuna.codegen.compile import compile_model

    chosen = load_settings(settings or PAPER)
    if combined:
        _combined(chosen, actuator, combined, out, jobs)
        return
    compiled = compile_model(actuator or chosen.model)
    plant = ModelPlant.of(compiled, chosen)
    folder = out or Path("out/maps") / (settings or PAPER).stem
    with progress_bar(f"map of {compiled.name}") as progress:
        finished = build_map(plant, chosen, folder, jobs=jobs, progress=progress, resume=not fresh, figures=figures)
        if prepare:
            disturbed = plant if actuator else ModelPlant.of(compile_model(chosen.disturbed_model), chosen)
            prepare_assessment(disturbed, chosen, finished, jobs=jobs)
    _report(finished)


def _combined(settings: Settings, actuator: str | None, symbol: str, out: Path | None, jobs: int | None) -> None:
    from lacuna.analysis.map.plant import ModelPlant
    from lacuna.analysis.progress import progress_bar
    from lacuna.analysis.severity.combined.grid import build_grid, other_fault
    from lacuna.codegen.compile import compile_model

    other = other_fault(settings, symbol)
    folder = out or Path("out/maps") / f"{settings.path.stem}-with-{symbol}"
    plant = ModelPlant.of(compile_model(actuator or settings.disturbed_model), settings)
    with progress_bar(f"map of {settings.fault.name} with {other.name}") as progress:
        grid = build_grid(plant, settings, other, folder, jobs=jobs, progress=progress)
    typer.echo(f"{len(grid.x)} severities of {settings.fault.name}, {len(grid.y)} of {other.name}")
    typer.echo(f"written: {folder}")


def _report(finished: Map) -> None:
    out = console()
    table = Table(title=finished.summary["title"], title_justify="left")
    table.add_column("quantity")
    for column in ("published", "reproduced"):
        table.add_column(column, justify="right")
    table.add_column("unit")
    for row in finished.summary["comparison"]:
        table.add_row(row["quantity"], _text(row["published"]), _text(row["reproduced"]), row["unit"])
    if table.rows:
        out.print(table)
    split = ", ".join(f"{name.replace('_cpu', ' (all cores)')} {s:.2f} s" for name, s in finished.seconds.items())
    out.print(f"{len(finished.rows)} severities: {split}")
    out.print(f"written: {finished.folder}")


def _text(value: object) -> str:
    if value is None:
        return "none"
    return f"{value:.5g}" if isinstance(value, float) else str(value)
