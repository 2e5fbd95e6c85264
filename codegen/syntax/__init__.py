"""Text to syntax tree: `parse(text, file)` gives the classes of one .mo file."""

from .classes import parse

__all__ = ["parse"]
