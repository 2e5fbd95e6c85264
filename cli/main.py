"""The `lacuna` command: one file a sub-command, each a thin layer over the public face `lacuna`."""

from __future__ import annotations

from typing import Annotated

import typer

import lacuna
from lacuna.cli import (
    assess,
    case,
    check,
    compare,
    compile,
    editor,
    examples,
    explain,
    fleet,
    fmu,
    forecast,
    list,
    maps,
    simulate,
    steps,
    sweep,
    verify,
)
from lacuna.cli.output import Lacuna

app = Lacuna(
    name="lacuna",
    no_args_is_help=True,
    rich_markup_mode="rich",
    context_settings={"help_option_names": ["-h", "--help"]},
    help="""Equations in, health maps out; and when a recording disagrees, the missing physics.

MODEL is a qualified name such as [bold]Actuators.EccentricBldc[/bold], found in the package Lacuna that is
installed with it, in a [bold]--library[/bold] or in MODELICAPATH; a [bold].mo[/bold] file of yours, or the folder of a
package, with [bold]--model[/bold] for a class in it. Commands write under [bold]out/[/bold] unless --out says
otherwise, print what they wrote, and end with status 0 only when all went well.

[bold]Start here[/bold]

lacuna check My.mo: every finding with its line

lacuna simulate My.mo --plot: trajectories, CSV and figure

lacuna maps: operating maps of the paper's actuator

lacuna explain CASE: what a recording knows and the model does not""",
)

MODELS, FAULTS, PHYSICS = "Models", "Maps and severity", "Missing physics"


def _version(asked: bool) -> None:
    if asked:
        typer.echo(f"lacuna {lacuna.__version__}")
        raise typer.Exit


@app.callback()
def main(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version")
    ] = False,
) -> None:
    pass


app.command("check", rich_help_panel=MODELS)(check.check)
app.command("compile", rich_help_panel=MODELS)(compile.compile)
app.command("simulate", rich_help_panel=MODELS)(simulate.simulate)
app.command("compare", rich_help_panel=MODELS)(compare.compare)
app.command("fmu", rich_help_panel=MODELS)(fmu.fmu)
app.command("format", rich_help_panel=MODELS)(editor.format)
app.command("lsp", rich_help_panel=MODELS)(editor.lsp)
app.add_typer(list.app, name="list", rich_help_panel=MODELS)
app.command("verify", rich_help_panel=MODELS)(verify.verify)
app.command("examples", rich_help_panel=MODELS)(examples.examples)
app.command("maps", rich_help_panel=FAULTS)(maps.maps)
app.command("sweep", rich_help_panel=FAULTS)(sweep.sweep)
app.command("assess", rich_help_panel=FAULTS)(assess.assess)
app.command("forecast", rich_help_panel=FAULTS)(forecast.forecast)
app.command("fleet", rich_help_panel=FAULTS)(fleet.fleet)
app.add_typer(case.app, name="case", rich_help_panel=PHYSICS)
app.command("convert", rich_help_panel=PHYSICS)(examples.convert)
app.command("explain", rich_help_panel=PHYSICS)(explain.explain)
app.command("fit", rich_help_panel=PHYSICS)(steps.fit)
app.command("locate", rich_help_panel=PHYSICS)(steps.locate)
app.command("name", rich_help_panel=PHYSICS)(steps.name)
app.command("amend", rich_help_panel=PHYSICS)(steps.amend)
app.command("judge", rich_help_panel=PHYSICS)(steps.judge)

if __name__ == "__main__":
    app()
