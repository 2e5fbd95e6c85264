"""Classes as the editor has them: text that is not saved yet counts before the file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import ast, parse


class BufferedLibrary(Library):
    """A library in which `texts` (by resolved path) stand for the files of these names."""

    def __init__(self, paths: Iterable[str | Path] | None, texts: Mapping[Path, str]) -> None:
        super().__init__(paths)
        self._texts = texts

    def parse_file(self, path: Path) -> list[ast.Class]:
        text = self._texts.get(Path(path).resolve())
        if text is None:
            return super().parse_file(path)
        if path not in self._parsed:
            self._parsed[Path(path)] = parse(text, str(path))
        return self._parsed[Path(path)]
