"""`lacuna fit`, `locate`, `name`, `amend`, `judge`: the steps of an explanation, each to be run and looked at alone."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

from rich.table import Table
import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.options import Libraries
from lacuna.cli.progress import progress

Case = Annotated[Path, typer.Argument(metavar="CASE", help="Folder with case.toml and its recordings")]
Out = Annotated[Path | None, typer.Option(help="Folder of report.html; default: out/STEP/CASE")]
SHOWN = 12  # rows of a ranking


@answered
def fit(case: Case, library: Libraries = None, out: Out = None) -> Answer:
    """Are the believed equations enough? Fit all parameters that are not exact; print them with their intervals."""
    with progress() as tell:
        found = lacuna.open_case(case, libraries=library or []).fit(out=out, progress=tell)
    return _answer(found, _parameters(found), _errors(found, "before"))


@answered
def locate(case: Case, library: Libraries = None, out: Out = None) -> Answer:
    """Which effort is missing, and where? Rank the places of the model by what an effort there would explain."""
    with progress() as tell:
        return _ranking(lacuna.open_case(case, libraries=library or []).locate(out=out, progress=tell))


@answered
def name(case: Case, library: Libraries = None, out: Out = None) -> Answer:
    """Which physics is it? Attach the catalogue's effects, simulate and fit again, and rank them by the evidence."""
    with progress() as tell:
        return _ranking(lacuna.open_case(case, libraries=library or []).name(out=out, progress=tell))


@answered
def amend(
    case: Case,
    effect: Annotated[str, typer.Option(help="Identifier, such as friction.coulomb; default: the best")] = "",
    library: Libraries = None,
    out: Out = None,
) -> Answer:
    """Write the model amended by one effect of the catalogue, fitted, and judge the file as it is written."""
    with progress() as tell:
        found = lacuna.open_case(case, libraries=library or []).amend(effect, out=out, progress=tell)
    return _answer(found, _errors(found, "after"))


@answered
def judge(
    case: Case,
    model: Annotated[
        Path, typer.Argument(metavar="MODEL.mo[:CLASS]", help="A model file with the believed model's variables")
    ],
    library: Libraries = None,
    out: Out = None,
) -> Answer:
    """How well does a model file, as written, simulate the recordings that nothing was fitted to?"""
    found = lacuna.open_case(case, libraries=library or []).judge(model, out=out)
    table = Table("signal", "NRMSE, validation")
    for signal, value in found.validate.items():
        table.add_row(signal or "all", f"{value:.4g}")
    data = {"fit": found.fit, "validate": found.validate}
    return Answer(data, [table], [found.report], doubts(found.problems))


def _answer(found: lacuna.Explanation, *parts: Table | str, **more: object) -> Answer:
    return Answer(found.diagnosis | more, list(parts), list(found.written), doubts(found.problems))


def doubts(problems: Iterable[str]) -> list[str]:
    """What was left out of the recordings, or is doubtful in them."""
    return [f"warning: {problem}" for problem in problems]


def _ranking(found: lacuna.Explanation) -> Answer:
    table = Table(*found.ranked)
    for row in found.ranking[:SHOWN]:
        table.add_row(*row)
    ranking = [dict(zip(found.ranked, row, strict=True)) for row in found.ranking]
    remark = [found.remark] if found.remark else []
    return _answer(found, table, *remark, ranking=ranking)


def _parameters(found: lacuna.Explanation) -> Table:
    table = Table("parameter", "believed", "fitted", "± (95 %)", "unit", "")
    for name, p in found.parameters.items():
        flag = "outside belief" if p["outside_belief"] else ""
        table.add_row(name, f"{p['believed']:.5g}", f"{p['value']:.5g}", found.half_width(name), p["unit"], flag)
    return table


def _errors(found: lacuna.Explanation, which: str) -> Table:
    """NRMSE on the validation recordings, beside what noise alone gives."""
    table = Table("signal", "NRMSE, validation", "noise alone")
    for signal, value in found.errors.items():
        table.add_row(signal, f"{value[which]:.4g}", f"{value['noise_floor']:.4g}")
    table.add_row("all", f"{found.nrmse['validate'][which]:.4g}", "")
    return table
