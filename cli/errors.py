"""What a user did wrong is said in a sentence and exit status 1; a traceback is for our own mistakes only."""

from __future__ import annotations

from collections.abc import Callable, Iterable
import functools
import os
import sys
from typing import ParamSpec, TypeVar

import typer

from lacuna.extras import named

P = ParamSpec("P")
T = TypeVar("T")


class UserError(Exception):
    """Something the user can put right; the message says what and how."""


def reported(command: Callable[P, T]) -> Callable[P, T]:
    """A command whose user errors end in a message on stderr and status 1; LACUNA_DEBUG=1 shows the traceback too."""

    @functools.wraps(command)
    def run(*args: P.args, **kwargs: P.kwargs) -> T:
        try:
            return command(*args, **kwargs)
        except KeyboardInterrupt:
            typer.echo("interrupted", err=True)
            raise typer.Exit(130) from None
        except Exception as error:
            if isinstance(error, ModuleNotFoundError):
                error = named(error) or error
            if os.environ.get("LACUNA_DEBUG") or not is_user_error(error):
                raise
            typer.echo(message_of(error), err=True)
            raise typer.Exit(1) from None

    return run


def is_user_error(error: Exception) -> bool:
    """Diagnostics, refusals of the stages (their exceptions carry `user_error = True`) and unreadable files."""
    return isinstance(error, UserError | OSError) or _is_diagnostic(error) or getattr(error, "user_error", False)


def _is_diagnostic(error: Exception) -> bool:
    module = sys.modules.get("lacuna.codegen.errors")
    return module is not None and isinstance(error, module.Diagnostic)


def message_of(error: Exception) -> str:
    if isinstance(error, OSError) and error.filename:
        return f"error: {error.filename}: {error.strerror}"
    text = str(error)
    return text if _is_diagnostic(error) or text.startswith("error") else f"error: {text}"


def nearest(name: str, valid: Iterable[str]) -> str:
    """The end of a refusal of `name`: the valid names that may be meant, or else some that there are."""
    from lacuna.runtime.errors import suggestion

    return suggestion(name, valid)
