"""`--watch`: a page in the browser that shows a figure anew whenever a source is saved, until Ctrl-C."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
import signal
import threading
from typing import Annotated, Any

import typer

import lacuna
from lacuna.cli.answer import Answer

Watch = Annotated[
    bool, typer.Option("--watch", help="Show the figure in the browser, again at every save; Ctrl-C ends it")
]
Port = Annotated[
    int, typer.Option(min=0, max=65535, help="Of the page of --watch, on this machine only; 0: a free one")
]


def watched(draw: Callable[[], Any], model: str, sources: Iterable[Path], port: int) -> Answer:
    """Watch the model's file or folder and what else is given; the answer when it is over."""
    stop = threading.Event()
    before = {s: signal.signal(s, lambda *_: stop.set()) for s in (signal.SIGINT, signal.SIGTERM)}
    place = Path(model.partition(":")[0] if ".mo:" in model else model)
    own = [place, place.resolve().parent] if place.exists() else []
    try:
        lacuna.watch(
            draw, [*own, *sources], title=model, port=port, stop=stop, told=typer.echo,
            opened=lambda address: typer.echo(f"open {address}"),
        )  # fmt: skip
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    return Answer({}, ["ended"])
