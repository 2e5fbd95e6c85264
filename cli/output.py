"""Standard output that cannot be written to, for want of space or because it is closed: one line and status 1, in help
as in every answer."""

from __future__ import annotations

from contextlib import suppress
import os
import sys
from typing import Any

import typer


class Lacuna(typer.Typer):
    """The command; what happens to its output is said in a line."""

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        if sys.stdout is None:  # closed: a file of that number that refuses, and that no other file can be taken for
            sys.stdout = os.fdopen(os.open(os.devnull, os.O_RDONLY), "w")
        try:
            return super().__call__(*args, **kwargs)
        except OSError as error:
            if os.environ.get("LACUNA_DEBUG"):
                raise
            with suppress(OSError):
                typer.echo(f"error: standard output: {error.strerror or error}", err=True)
            raise SystemExit(1) from None
        finally:
            _let_go()


def _let_go() -> None:
    """What is still in the buffer of an output that refuses it is dropped: Python would say so again at its end."""
    try:
        sys.stdout.flush()
    except (OSError, ValueError):
        sys.stdout = os.fdopen(os.open(os.devnull, os.O_WRONLY), "w")
