"""`lacuna fit`, `locate`, `name`, `amend`, `judge`: the steps of an explanation, each to be run and looked at alone."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from rich.console import Console
from rich.table import Table
import typer

from lacuna.cli.errors import UserError, reported
from lacuna.cli.output import console

if TYPE_CHECKING:
    from lacuna.discovery.explanation import Explanation

Case = Annotated[Path, typer.Argument(metavar="CASE", help="Folder with case.toml and its recordings")]
Out = Annotated[Path | None, typer.Option(help="Folder of report.html; default: out/STEP/CASE")]
SHOWN = 12  # rows of a ranking


@reported
def fit(case: Case, out: Out = None) -> None:
    """Are the believed equations enough? Fit all parameters that are not exact; print them with their intervals."""
    from lacuna.discovery.cases import load
    from lacuna.discovery.steps import fitted

    with Console(stderr=True).status("reading the recordings") as status:
        result = fitted(load(case), status.update)
    _parameters(result)
    _errors(result.before.validate, result.floor)
    _report(result, "fit", case, out)


@reported
def locate(case: Case, out: Out = None) -> None:
    """Which effort is missing, and where? Rank the places of the model by what an effort there would explain."""
    from lacuna.discovery.cases import load
    from lacuna.discovery.steps import add_location, fitted

    with Console(stderr=True).status("reading the recordings") as status:
        result = fitted(load(case), status.update)
        add_location(result, status.update)
    found = result.located
    table = Table("place", "missing", "misfit explained")
    for place in found.places[:SHOWN]:
        table.add_row(place.location, f"{place.kind}, {place.unit}", f"{place.explained:.1%}")
    console().print(table)
    if found.organiser:
        typer.echo(found.organiser.sentence)
    _report(result, "locate", case, out)


@reported
def name(case: Case, out: Out = None) -> None:
    """Which physics is it? Attach the catalogue's effects, simulate and fit again, and rank them by the evidence."""
    from lacuna.discovery.cases import load
    from lacuna.discovery.steps import add_naming, fitted

    with Console(stderr=True).status("reading the recordings") as status:
        loaded = load(case)
        library = loaded.library()
        result = fitted(loaded, status.update, library)
        add_naming(result, library, status.update)
    table = Table("hypothesis", "evidence against none", "confidence")
    for ranked in result.namings[0].ranked[:SHOWN]:
        table.add_row(ranked.attachment.label, f"{-ranked.score:.1f}", f"{ranked.confidence:.3f}")
    console().print(table)
    _report(result, "name", case, out)


@reported
def amend(
    case: Case,
    effect: Annotated[str, typer.Option(help="Identifier, such as friction.coulomb; default: the best")] = "",
    out: Out = None,
) -> None:
    """Write the model amended by one effect of the catalogue, fitted, and judge the file as it is written."""
    from lacuna.discovery.cases import load
    from lacuna.discovery.explain import judge_written, write_amended
    from lacuna.discovery.steps import add_amendment, add_scatter, fitted

    with Console(stderr=True).status("reading the recordings") as status:
        loaded = load(case)
        library = loaded.library()
        result = fitted(loaded, status.update, library)
        add_amendment(result, library, effect, status.update)
        add_scatter(result, status.update)
    folder = _folder("amend", case, out)
    path = write_amended(result, folder)
    judge_written(result, path)
    _errors(result.after.validate, result.floor)
    typer.echo(f"written: {path}")
    _report(result, "amend", case, out, path)


@reported
def judge(
    case: Case,
    model: Annotated[Path, typer.Argument(metavar="MODEL.mo", help="A model file with the believed model's variables")],
    out: Out = None,
) -> None:
    """How well does a model file, as written, simulate the recordings that nothing was fitted to?"""
    from lacuna.discovery import places
    from lacuna.discovery.amend import Amendment
    from lacuna.discovery.cases import load
    from lacuna.discovery.judge import judge_file
    from lacuna.discovery.report import write_judgement

    loaded = load(case)
    if not model.is_file():
        raise UserError(f"{model}: there is no such file")
    found = judge_file(loaded, Amendment(places.read(loaded.library(), loaded.base)), model, {})
    _errors(found.validate, None)
    typer.echo(f"written: {write_judgement(loaded, found, _folder('judge', case, out), model.name)}")


def _parameters(result: Explanation) -> None:
    from lacuna.discovery.diagnosis import build

    table = Table("parameter", "believed", "fitted", "± (95 %)", "unit", "")
    for name, p in build(result, None)["parameters"].items():
        flag = "outside belief" if p["outside_belief"] else ""
        table.add_row(name, f"{p['believed']:.5g}", f"{p['value']:.5g}", f"{2 * p['std']:.2g}", p["unit"], flag)
    console().print(table)


def _errors(nrmse: dict[str, float], floor: dict[str, float] | None) -> None:
    """NRMSE on the validation recordings; the key "" is that of all signals together."""
    table = Table("signal", "NRMSE, validation", *(["noise alone"] if floor else []))
    for signal, value in nrmse.items():
        noise = [f"{floor[signal]:.4g}" if signal in floor else ""] if floor else []
        table.add_row(signal or "all", f"{value:.4g}", *noise)
    console().print(table)


def _folder(step: str, case: Path, out: Path | None) -> Path:
    folder = out or Path("out") / step / case.resolve().name
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def _report(result: Explanation, step: str, case: Path, out: Path | None, amended: Path | None = None) -> None:
    from lacuna.discovery.report import write

    typer.echo(f"written: {write(result, _folder(step, case, out), amended)}")
