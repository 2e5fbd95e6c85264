"""For editors: the language server and the formatter."""

from __future__ import annotations

from collections.abc import Iterable
import logging
import os
from pathlib import Path

from lacuna.codegen.library.search_path import search_path
from lacuna.errors import UserError
from lacuna.extras import names_missing_packages
from lacuna.given import text_of
from lacuna.lsp.format import format_text
from lacuna.written import write_whole


@names_missing_packages
def serve_editor(libraries: Iterable[str | Path] = ()) -> None:
    """Speak the language server protocol on standard input and output until the editor ends it. Needs `editor`."""
    from lacuna.lsp.server import make_server

    _say_in_a_line()
    make_server(search_path(libraries)).start_io()


class _Line(logging.Formatter):
    """What went wrong, in a line; with where in the code if LACUNA_DEBUG asks for it."""

    def format(self, record: logging.LogRecord) -> str:
        if os.environ.get("LACUNA_DEBUG"):
            return super().format(record)
        said = record.getMessage().partition("\n")[0]  # pygls writes where in the code below it
        why = f": {record.exc_info[1]}" if record.exc_info else ""
        return f"lacuna lsp: {said}{why}".replace("\n", " ")


def _say_in_a_line() -> None:
    """What is no message of the protocol is told on standard error, and the server goes on."""
    handler = logging.StreamHandler()
    handler.setFormatter(_Line())
    logging.getLogger("pygls").addHandler(handler)
    logging.getLogger("pygls").propagate = False


def format_model(text: str, file: str = "") -> str:
    """The text of a .mo file, formatted: indentation and empty lines only, so that its meaning stays. Raises
    Diagnostic where it does not parse."""
    return format_text(text, file)


def format_file(path: str | Path, *, check: bool = False) -> bool:
    """Format a .mo file in place, or with `check` only say whether it would change; True where it does."""
    path = Path(path)
    text = text_of(path, UserError)
    formatted = format_model(text, str(path))
    if formatted != text and not check:
        write_whole(path, formatted)
    return formatted != text
