"""What is typed as NAME=VALUE on the command line, and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

import lacuna
from lacuna.cli.complete import inputs_of, models, parameters_of, variables_of
from lacuna.texts import decimal, file_name

MODEL_HELP = "Qualified name (Lacuna.Actuators.X or Actuators.X), a .mo file, or the folder of a package"

Model = Annotated[str, typer.Argument(metavar="MODEL", help=MODEL_HELP, autocompletion=models)]
ClassName = Annotated[str, typer.Option("--model", metavar="CLASS", help="Class inside the file or package MODEL")]
Libraries = Annotated[
    list[Path] | None,
    typer.Option(
        "--library", "-L", metavar="PATH",
        help="Folder of a package, folder of packages, or a .mo file to look classes up in; repeat for more. "
        "Folders of MODELICAPATH come after these",
    ),
]  # fmt: skip
Units = Annotated[
    Literal["error", "warn", "all"],
    typer.Option(
        help="Where units do not agree, or a component or connector is not balanced: an error, a warning, or "
        "(all) an error of units in libraries, too"
    ),
]
Data = Annotated[
    list[Path] | None,
    typer.Option("--data", metavar="FOLDER", help="Folder for files of data, beside the model's own; repeat for more"),
]
AllowExternal = Annotated[
    bool,
    typer.Option("--allow-external", help="Compile the C that external functions of the model name; it runs as you"),
]
Parameters = Annotated[
    list[str] | None,
    typer.Option(
        "--parameter", "-p", metavar="NAME=VALUE", autocompletion=parameters_of,
        help="Set a parameter (in its declared unit); repeat for more",
    ),
]  # fmt: skip
Inputs = Annotated[
    list[str] | None,
    typer.Option(
        "--input", "-u", metavar="NAME=VALUE|FILE.csv[:COLUMN]", autocompletion=inputs_of,
        help="Drive an input by a constant or by a recorded column (in its declared unit); repeat for more",
    ),
]  # fmt: skip
Hold = Annotated[bool, typer.Option("--hold", help="Hold recorded inputs between samples, not linear")]
Signals = Annotated[
    list[str] | None,
    typer.Option("--signal", autocompletion=variables_of, help="Record only these variables; repeat for more"),
]


def assignments(texts: list[str] | None, option: str = "-p") -> dict[str, str]:
    """`["motor.R=2.1", ...]` as a mapping of names to the text of their values."""
    result: dict[str, str] = {}
    for text in texts or []:
        name, equals, value = text.partition("=")
        if not equals or not name.strip() or not value.strip():
            raise lacuna.UserError(f"{option} {text}: expected NAME=VALUE")
        if name.strip() in result:
            raise lacuna.UserError(f"{option} {text}: {name.strip()} is given twice")
        result[name.strip()] = value.strip()
    return result


def parameters(texts: list[str] | None) -> dict[str, float]:
    """Of -p; true and false stay what they are, for parameters that are Boolean."""
    return {name: value(name, text) for name, text in assignments(texts).items()}


def inputs(texts: list[str] | None, hold: bool) -> dict[str, lacuna.Input]:
    """Of -u: a number, or FILE.csv with the column's name after a colon (default: the input's own)."""
    found: dict[str, lacuna.Input] = {}
    for name, text in assignments(texts, "-u").items():
        given = _constant(text)
        if given is None:
            file, _, column = text.partition(":") if not Path(text).exists() else (text, "", "")
            given = lacuna.recorded(file, column or name, hold=hold)
        found[name] = given
    return found


def _constant(text: str) -> float | None:
    """A number or true/false; None for anything else, which is the name of a file."""
    try:
        return value("", text)
    except lacuna.UserError:
        return None


def value(name: str, text: str) -> float:
    """True or false, which are no numbers of the model, or a real number."""
    words = {"true": True, "false": False}
    if text[0] in "{[" and name:
        one = f"-p '{name}[1]=...', of a matrix -p '{name}[1,2]=...'"
        raise lacuna.UserError(f"{name}={text}: an array is given by its elements, one by one: {one}")
    return words[text.lower()] if text.lower() in words else number(name, text, " nor true/false")


def number(name: str, text: str, other: str = "") -> float:
    try:
        return decimal(text)
    except ValueError:
        said = f"neither a finite number{other}" if other else "no finite number"
        raise lacuna.UserError(f"{name}={text}: '{text}' is {said}") from None


def default_folder(kind: str, name: str) -> Path:
    """out/KIND/NAME, where the last part of a class's name or the stem of a file stands for it."""
    name = name.rpartition(":")[2] or name
    stem = Path(name).stem if name.endswith(".mo") else Path(name).name
    return Path("out") / kind / file_name(stem or Path(name).resolve().name)
