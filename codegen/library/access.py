"""What a translation may reach beyond the text of models: folders of data, and C code that a model names.

Both are given by who translates, never by a model.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from lacuna.codegen.errors import Diagnostic


@dataclass(frozen=True)
class Access:
    """`data`: folders, absolute, below which files of data may lie; `external`: whether C of others is compiled."""

    data: tuple[str, ...] = ()
    external: bool = False

    @classmethod
    def of(cls, data: Iterable[str | Path] = (), external: bool = False) -> Access:
        """Raises F040 for a folder of data that is not there."""
        folders = [Path(folder).expanduser().resolve() for folder in data]
        for folder in folders:
            if not folder.is_dir():
                raise Diagnostic("F040", f"there is no folder of data {folder}", hint="check the path")
        return cls(tuple(map(str, folders)), external)


NONE = Access()
