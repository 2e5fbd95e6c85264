"""`lacuna examples` and `lacuna convert`: something to begin with, and recordings in another format."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import lacuna
from lacuna.cli.answer import Answer, answered


@answered
def examples(
    folder: Annotated[Path, typer.Argument(help="Where to put them")] = Path("lacuna-examples"),
) -> Answer:
    """Copy a small model, a case with something missing, a recorded pre-flight test, and the package of all models."""
    copied = lacuna.copy_examples(folder)
    return Answer({"folders": [str(path) for path in copied]}, [], list(copied))


@answered
def convert(
    recording: Annotated[Path, typer.Argument(help="A recording in any format that is read")],
    out: Annotated[Path, typer.Argument(help="The file to write; its suffix is the format")],
) -> Answer:
    """Write a recording in another format, with its units."""
    notes = lacuna.convert(recording, out)
    return Answer({"notes": list(notes)}, [f"look at: {note}" for note in notes], [out])
