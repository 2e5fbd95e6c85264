"""What is typed as NAME=VALUE on the command line, and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from lacuna.cli.errors import UserError

MODEL_HELP = "Qualified name (Lacuna.Actuators.X or Actuators.X) or a .mo file"

Model = Annotated[str, typer.Argument(metavar="MODEL", help=MODEL_HELP)]
Units = Annotated[
    Literal["error", "warn", "all"],
    typer.Option(help="An inconsistent equation is an error, a warning, or (all) an error in libraries, too"),
]
Assignments = Annotated[
    list[str] | None,
    typer.Option("--parameter", "-p", metavar="NAME=VALUE", help="Set a parameter (SI units); repeat for more"),
]


def assignments(texts: list[str] | None, option: str = "-p") -> dict[str, str]:
    """`["motor.R=2.1", ...]` as a mapping of names to the text of their values."""
    result: dict[str, str] = {}
    for text in texts or []:
        name, equals, value = text.partition("=")
        if not equals or not name.strip() or not value.strip():
            raise UserError(f"{option} {text}: expected NAME=VALUE")
        if name.strip() in result:
            raise UserError(f"{option} {text}: {name.strip()} is given twice")
        result[name.strip()] = value.strip()
    return result


def number(name: str, text: str) -> float:
    """A real number, or true/false as 1/0."""
    words = {"true": 1.0, "false": 0.0}
    try:
        return words[text.lower()] if text.lower() in words else float(text)
    except ValueError:
        raise UserError(f"{name}={text}: '{text}' is neither a number nor true/false") from None


def default_folder(kind: str, name: str) -> Path:
    """out/KIND/NAME, where the last part of a model's name or the stem of its file stands for it."""
    stem = Path(name).stem if name.endswith(".mo") else name.rsplit(".", 1)[-1]
    return Path("out") / kind / stem
