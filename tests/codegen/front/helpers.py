"""Flattening a text, for tests."""

from __future__ import annotations

from pathlib import Path

from lacuna.codegen.flat import FlatModel
from lacuna.codegen.flat.text import equation_text
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library


def flatten_text(folder: Path, text: str, **options: object) -> FlatModel:
    """The last class of `text`, flattened on its own."""
    path = folder / "model.mo"
    path.write_text(text, encoding="utf-8")
    return flatten(Library([]), str(path), **options)


def equations(model: FlatModel) -> list[str]:
    """Every equation as text."""
    return [equation_text(e) for e in model.equations]
