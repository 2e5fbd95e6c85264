"""`lacuna compile`: translate a model and show what the passes made of it."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from rich.table import Table
import typer

import lacuna
from lacuna.cli.answer import Answer, answered
from lacuna.cli.options import AllowExternal, ClassName, Data, Libraries, Model, Units

Dump = Annotated[
    Literal["flat", "structure", "c"] | None,
    typer.Option(help="Print the flat equations, the structure (states, blocks, tears, relations) or the generated C"),
]


@answered
def compile(
    model: Model, class_name: ClassName = "", library: Libraries = None, dump: Dump = None, units: Units = "error",
    data: Data = None, allow_external: AllowExternal = False,
) -> Answer:  # fmt: skip
    """Translate MODEL to C and compile it; print the seconds of each pass, or with --dump what the passes made.

    A model whose files are unchanged is neither translated nor compiled again.
    """
    reach: dict[str, Any] = {
        "class_name": class_name, "libraries": library or [], "units": units, "data": data or [],
        "allow_external": allow_external,
    }  # fmt: skip
    if dump:
        text = lacuna.dump(model, dump, **reach)
        return Answer({dump: text}, [text.removesuffix("\n")])
    loaded = lacuna.load(model, **reach)
    shown = _passes(loaded) if loaded.seconds else f"{loaded.name}: unchanged since it was compiled"
    data = {"name": loaded.name, "library": str(loaded.library), "seconds": loaded.seconds}
    return Answer(data, [shown, str(loaded.library)], warnings=loaded.warnings)


def _passes(model: lacuna.Model) -> Table:
    table = Table(title=model.name, title_justify="left")
    table.add_column("pass")
    table.add_column("seconds", justify="right")
    for label, value in model.seconds.items():
        table.add_row(label, f"{value:.3f}")
    table.add_row("in all", f"{sum(model.seconds.values()):.3f}", style="bold")
    return table
