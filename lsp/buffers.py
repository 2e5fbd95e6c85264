"""Classes as the editor has them: text that is not saved yet counts before the file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from lacuna.codegen.library.classes import Library
from lacuna.codegen.library.search_path import PACKAGE_FILE
from lacuna.codegen.syntax import ast, parse


class BufferedLibrary(Library):
    """A library in which `texts` (by resolved path) stand for the files of these names. It outlives an edit: what the
    edit does not touch is looked up once."""

    def __init__(self, paths: Iterable[str | Path] | None, texts: Mapping[Path, str]) -> None:
        super().__init__(paths)
        self._texts = texts
        self._resolved: dict[Path, Path] = {}  # of the files that were parsed
        self._on_disk: dict[Path, tuple[int, int] | None] = {}  # what was read, and folders looked into, as they were
        for place in self._places:
            self._on_disk[place] = _as_it_is(place)

    def parse_file(self, path: Path) -> list[ast.Class]:
        if path not in self._parsed:
            self._resolved[path] = path.resolve()
            self._on_disk.setdefault(path.parent, _as_it_is(path.parent))
            text = self._texts.get(self._resolved[path])
            if text is None:
                self._on_disk[path] = _as_it_is(path)
                return super().parse_file(path)
            self._parsed[path] = parse(text, str(path))
        return self._parsed[path]

    def _look_in(self, place: Path, first: bool = False) -> None:
        self._on_disk.setdefault(place, _as_it_is(place))
        super()._look_in(place, first)

    @property
    def current(self) -> bool:
        """Is the disk as it was when it was read?"""
        return all(_as_it_is(path) == then for path, then in self._on_disk.items())

    def forget(self, path: Path) -> bool:
        """Read the file at `path` anew, and nothing else; False where that is not all: others lie in a package's own
        file, and one in no package brings in what lies beside it."""
        if path.name == PACKAGE_FILE or not (path.parent / PACKAGE_FILE).is_file():
            return False
        gone: set[int] = set()
        for at in [at for at, resolved in self._resolved.items() if resolved == path]:
            gone.update(id(cls) for cls in self._parsed.pop(at, ()))
            self._on_disk.pop(at, None)
        self._members = {key: cls for key, cls in self._members.items() if id(cls) not in gone}
        self.forget_views()
        return True


def _as_it_is(path: Path) -> tuple[int, int] | None:
    """When a file or folder was last written, and its size; None where there is none."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size
