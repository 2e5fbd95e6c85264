"""`lacuna lsp` and `lacuna format`: what editors start."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.options import Libraries


def lsp(library: Libraries = None) -> None:
    """Language server for Modelica files, on standard input and output: started by an editor, not by hand."""
    try:
        lacuna.serve_editor(library or [])
    except Exception as error:
        if not lacuna.is_user_error(error):
            raise
        typer.echo(lacuna.message_of(error), err=True)
        raise typer.Exit(1) from None


def _named(given: str) -> Path:
    """An empty name, as of a variable that a shell has not set, is no folder: Python takes it for the one of work."""
    if not given:
        raise typer.BadParameter("an empty name is no file and no folder; the present folder is called `.`")
    return Path(given)


@answered
def format(
    files: Annotated[
        list[Path], typer.Argument(parser=_named, metavar="FILES...", help="Files of Modelica, or folders of them")
    ],
    check: Annotated[bool, typer.Option("--check", help="Write nothing; status 1 where a file would change")] = False,
) -> Answer:
    """Format Modelica files in place: indentation by nesting and empty lines, nothing that has a meaning."""
    found = [p for f in files for p in (sorted(f.rglob("*.mo")) if f.is_dir() else [f])]
    changed, refused = [], []
    for path in found:
        try:
            changed += [path] if lacuna.format_file(path, check=check) else []
        except Exception as error:
            if not lacuna.is_user_error(error):
                raise
            refused.append(lacuna.message_of(error))
    wrong = [f"left as they are: {len(refused)} of {len(found)} files"] if refused else []
    wrong += [f"not formatted: {', '.join(map(str, changed))}"] if check and changed else []
    data = {"changed": [str(path) for path in changed], "refused": refused}
    return Answer(data, [], [] if check else changed, refused, "; ".join(wrong))
