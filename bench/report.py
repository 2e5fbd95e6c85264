"""Tables in the terminal and the same rows as CSV and JSON."""

from __future__ import annotations

from collections.abc import Sequence
import csv
import json
from pathlib import Path
import platform
import re

from rich.console import Console
from rich.table import Table

import lacuna

Row = dict[str, object]
WIDTH = 120  # columns, where the terminal has fewer or there is none


def show(title: str, rows: Sequence[Row]) -> None:
    """One line a row, one column a key of the first row."""
    table = Table(title=title, title_justify="left")
    for key, value in rows[0].items():
        table.add_column(key, justify="left" if isinstance(value, str) else "right")
    for row in rows:
        table.add_row(*(_text(value) for value in row.values()))
    Console(width=max(Console().width, WIDTH)).print(table)


def _text(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, float):
        return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
    return str(value)


def stamp(page: Path, command: str) -> None:
    """Say in the first lines of a written page of docs/ which command wrote it, and of which version."""
    text = re.sub(r"\A---\n.*?\n---\n", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    page.write_text(f"---\ncommand: {command}\nversion: {lacuna.__version__}\n---\n{text}", encoding="utf-8")


def write_csv(path: Path, rows: Sequence[Row]) -> None:
    """`path` appears when it is complete."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(path.suffix + ".part")
    with part.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    part.replace(path)


def write_json(path: Path, sections: dict[str, Sequence[Row]]) -> None:
    """All sections with what machine they were measured on; `path` appears when it is complete."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(path.suffix + ".part")
    machine = {"system": platform.platform(), "processor": platform.processor() or platform.machine()}
    part.write_text(json.dumps({"machine": machine, **sections}, indent=1), encoding="utf-8")
    part.replace(path)
