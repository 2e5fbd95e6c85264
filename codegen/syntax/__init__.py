"""Text to syntax tree: `parse(text, file)` gives the classes of one .mo file."""

from lacuna.codegen.syntax.classes import parse

__all__ = ["parse"]
