"""Which class a case believes in, and where it and what it uses are looked up.

The class may be one of the package Lacuna, of a library, or of a file beside case.toml. Whatever is built upon it (what
a search tries, the amended model, the judge) sees the same places.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from lacuna.codegen.library import MODEL_FOLDER, Library


class ModelPlaceError(ValueError):
    """A library or model file that is not there or is not one: the message names it."""


@dataclass(frozen=True)
class CaseModel:
    """The class's full name, the paths where names are looked up, the user's file (None: it is in a library)."""

    name: str
    search_path: tuple[str, ...]
    file: Path | None = None

    def library(self) -> Library:
        return Library(self.search_path)


def case_model(folder: Path, model: str, libraries: Sequence[str | Path]) -> CaseModel:
    """Resolve `model` and `libraries` as case.toml in `folder` writes them.

    Raises ModelPlaceError where a path is of no use, Diagnostic where a file does not parse or a class is not there.
    """
    paths = [str(MODEL_FOLDER)]
    for entry in libraries:
        paths.append(str(_library(folder, entry)))
    _unique(paths)
    file_name, colon, inside = model.partition(":")
    if not file_name.endswith(".mo"):
        found = CaseModel(model, tuple(paths))
        return CaseModel(found.library().find(model).path, found.search_path)
    file = (folder / file_name).resolve()
    if not file.is_file():
        what = "is a folder, not a model file" if file.is_dir() else "is not there"
        raise ModelPlaceError(f"the model file {folder / file_name} {what}")
    return _of_file(file, inside if colon else "", paths)


def _of_file(file: Path, inside: str, paths: list[str]) -> CaseModel:
    classes = Library(()).parse_file(file)
    cls = next((c for c in classes if c.name == file.stem), classes[-1])
    if cls.within:
        root = _package_root(file)
        if str(root) not in paths:
            paths.append(str(root))
        name = inside or f"{cls.within}.{cls.name}"
    else:
        paths += [str(file.parent), str(file)]
        name = inside or cls.name
    model = CaseModel(name, tuple(paths), file)
    return CaseModel(model.library().find(name).path, model.search_path, file)


def _library(folder: Path, entry: str | Path) -> Path:
    path = (folder / entry).resolve()
    if path.is_dir() and not (path / "package.mo").is_file() and not any(path.glob("*.mo")) and not _packages(path):
        raise ModelPlaceError(f"the library {folder / entry} holds no package.mo and no model")
    if not path.is_dir() and not (path.is_file() and path.suffix == ".mo"):
        raise ModelPlaceError(f"the library {folder / entry} is not there: name a package folder or a .mo file")
    return path


def _packages(folder: Path) -> list[Path]:
    return [p for p in folder.iterdir() if (p / "package.mo").is_file()]


def _unique(paths: list[str]) -> None:
    """Raise ModelPlaceError where two of the libraries are packages of one name."""
    seen: dict[str, str] = {}
    for path in map(Path, paths):
        file = path / "package.mo" if path.is_dir() else path
        for cls in Library(()).parse_file(file) if file.is_file() else []:
            if seen.setdefault(cls.name, str(path)) != str(path):
                raise ModelPlaceError(f"two libraries are called {cls.name}: {seen[cls.name]} and {path}")


def _package_root(file: Path) -> Path:
    """The outermost folder with package.mo around a file that says that it lies in a package."""
    root = file.parent
    if not (root / "package.mo").is_file():
        raise ModelPlaceError(f"{file} says 'within', but no package.mo lies beside it")
    while (root.parent / "package.mo").is_file():
        root = root.parent
    return root
