"""What a command answers: printed as text, as JSON, or not at all. What a user did wrong is said in a sentence and exit
status 1; a traceback is for our own mistakes only."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
import functools
import inspect
import json as json_text
import math
import os
from pathlib import Path
import signal
import sys
import tempfile
import traceback
from typing import Annotated, Any, NoReturn, get_type_hints

from rich.console import Console, RenderableType
import typer

import lacuna
from lacuna.cli.numbers import read_as_in_files
from lacuna.cli.progress import shown

WIDTH = 110  # columns, where the terminal has fewer or there is none: broken words help nobody
_JSON = "Print the answer as JSON, and nothing else on standard output; progress as lines of JSON on standard error"
Json = Annotated[bool, typer.Option("--json", help=_JSON)]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but warnings and errors, and no progress")]
_EVERYWHERE = {"json": Json, "quiet": Quiet}


@dataclass
class Answer:
    """`data` is what --json prints, `parts` what a terminal shows; `failure` ends the command with status 1."""

    data: dict[str, Any]
    parts: list[RenderableType] = field(default_factory=list)
    written: list[Path] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    failure: str = ""


def answered(command: Callable[..., Answer]) -> Callable[..., None]:
    """A command that prints its answer, with options --json and --quiet; LACUNA_DEBUG=1 shows tracebacks, too."""

    @functools.wraps(command)
    def run(*args: Any, context: typer.Context, json: bool = False, quiet: bool = False, **kwargs: Any) -> None:
        token = shown.set("nothing" if quiet else "lines" if json else "bar")
        try:
            answer = command(*args, **kwargs)
            answer.warnings += lacuna.record_making([str(context.info_name), *_words(context)], answer.written)
            with _read_by_others():
                _print(answer, json, quiet)
        except KeyboardInterrupt:
            typer.echo("interrupted", err=True)
            raise typer.Exit(130) from None
        except Exception as error:
            if isinstance(error, typer.Exit) or os.environ.get("LACUNA_DEBUG"):
                raise
            if not lacuna.is_user_error(error):
                _unexpected(error)
            _fail(lacuna.message_of(error), {}, json)
        finally:
            shown.reset(token)

    hints = get_type_hints(command, include_extras=True) | _EVERYWHERE | {"context": typer.Context, "return": None}
    read_as_in_files(hints)
    own = [p.replace(annotation=hints[n]) for n, p in inspect.signature(command).parameters.items()]
    more = [
        inspect.Parameter(n, inspect.Parameter.KEYWORD_ONLY, default=False, annotation=a)
        for n, a in _EVERYWHERE.items()
    ]
    more.append(inspect.Parameter("context", inspect.Parameter.KEYWORD_ONLY, annotation=typer.Context))
    run.__signature__ = inspect.Signature([*own, *more])  # type: ignore[attr-defined]
    run.__annotations__ = hints
    return run


def _words(context: typer.Context) -> list[str]:
    """What was typed after the command's name, without what changes no result: where it goes, how it is printed."""
    given, arguments = [], []
    for parameter in context.command.params:
        name, value = parameter.name or "", context.params.get(parameter.name or "")
        source = context.get_parameter_source(name)
        if source is None or source.name != "COMMANDLINE" or name in (*lacuna.ELSEWHERE, *_EVERYWHERE):
            continue
        for one in value if isinstance(value, list | tuple) else [value]:
            if parameter.param_type_name == "argument":
                arguments.append(str(one))
            elif getattr(parameter, "is_flag", False):
                given.append(parameter.opts[0] if one else parameter.secondary_opts[0])
            else:
                given += [parameter.opts[0], str(one)]
    return [*arguments, *given]


def _unexpected(error: Exception) -> NoReturn:
    """A fault of ours, said in two lines, with its traceback in a file; 70 is the status for such (sysexits.h)."""
    details = f"lacuna {lacuna.__version__}\n{' '.join(sys.argv)}\n\n{''.join(traceback.format_exception(error))}"
    try:
        with tempfile.NamedTemporaryFile(
            "w", prefix="lacuna-fault-", suffix=".txt", delete=False, encoding="utf-8", errors="backslashreplace"
        ) as file:
            file.write(details)
        where = file.name
    except OSError as refused:
        where = f"cannot be written ({refused.strerror}):\n{details}"
    typer.echo(f"error: this is a fault of Lacuna ({type(error).__name__}), not yours: please report it", err=True)
    typer.echo(f"details: {where}", err=True)
    raise typer.Exit(70) from None


@contextmanager
def _read_by_others() -> Iterator[None]:
    """Whoever reads the answer may leave before its end, as `head` does: that is no error of the command, whose files
    are written; its status is that of programs which a closed pipe ends."""
    try:
        yield
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what is still to be flushed
        raise typer.Exit(128 + signal.SIGPIPE) from None


def _print(answer: Answer, json: bool, quiet: bool) -> None:
    for warning in answer.warnings:
        typer.echo(warning, err=True)
    data = answer.data | {"warnings": answer.warnings, "written": [str(path) for path in answer.written]}
    if answer.failure:
        _show(answer, quiet or json)
        _fail(f"error: {answer.failure}", data, json)
    if json:
        _echo(data)
    _show(answer, quiet or json)


def _show(answer: Answer, silent: bool) -> None:
    if silent:
        return
    console = Console(width=max(Console().width, WIDTH))
    for part in answer.parts:
        if isinstance(part, str):
            typer.echo(part)
        else:
            console.print(part)
    for path in answer.written:
        typer.echo(f"written: {path}")


def _fail(message: str, data: dict[str, Any], json: bool) -> None:
    sys.unraisablehook = lambda _: None  # of half-written files that writers try to close while they are taken away
    typer.echo(message, err=True)
    if json:
        with suppress(OSError):  # where that is what failed, it has been said
            _echo(data | {"error": message.removeprefix("error: ")})
    raise typer.Exit(1)


def _echo(data: dict[str, Any]) -> None:
    typer.echo(json_text.dumps(_finite(data), indent=2, ensure_ascii=False, default=str))


def _finite(value: Any) -> Any:
    """JSON has no NaN or infinity: they become null."""
    if isinstance(value, dict):
        return {str(k): _finite(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(v) for v in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
