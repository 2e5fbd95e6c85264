"""Where packages lie: the libraries that a user names, the folders of MODELICAPATH, and the package Lacuna."""

from __future__ import annotations

from collections.abc import Iterable
import os
from pathlib import Path
import re

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.syntax import parse
from lacuna.codegen.syntax.lexer import is_name
from lacuna.given import require_file
from lacuna.suggest import did_you_mean

MODEL_FOLDER = Path(__file__).resolve().parents[2] / "model"
PACKAGE_FILE = "package.mo"
WITHOUT_MODELICA = "name the folder of the Modelica Standard Library by --library, or in MODELICAPATH"
_VERSION = re.compile(r"(.+?) (\d[\w.+-]*)")  # of a library's folder: "Modelica 4.0.0" (specification, 18.8.4)


def search_path(libraries: Iterable[str | Path] = ()) -> list[str]:
    """Where a class is looked up, in this order: `libraries`, the folders of MODELICAPATH, the package Lacuna.

    A library is the folder of a package, a folder of packages, or a .mo file. Raises F005 where it is none of these,
    F006 where two of them have one name. Of MODELICAPATH (folders of packages, specification 13.3) the first folder
    that has a package counts, and folders that are not there are passed over, as of any search path.
    """
    given = [_library(Path(path).expanduser().resolve()) for path in libraries]
    _refuse_namesakes(given)
    roots = os.environ.get("MODELICAPATH", "").split(os.pathsep)
    return [*map(str, given), *(root for root in roots if root and Path(root).is_dir()), str(MODEL_FOLDER)]


def split_name(name: str) -> tuple[Path | None, str]:
    """A model as users name it: `Pkg.Class`; `file.mo`, or the folder of a package; either of these with `:Pkg.Class`.

    Returns the file or folder (None for a plain name) and the class ("" where none is named).
    """
    place, colon, inner = name.rpartition(":")
    if colon and (place.endswith(".mo") or os.sep in place or Path(place).is_dir()):
        return Path(place), inner
    if name.endswith(".mo") or os.sep in name or is_file(Path(name) / PACKAGE_FILE):
        return Path(name), ""
    named = all(map(is_name, name.split("."))) or not Path(name).is_dir()
    return (None, name) if named else (Path(name), "")


def known_classes(name: str, known: list[str]) -> str:
    """A hint where no class is called `name`: which of `known` may be meant, or what there is."""
    there = f"there is {', '.join(known[:12])}" if known else ""
    return did_you_mean(name, known, WITHOUT_MODELICA if name == "Modelica" else there)


def outermost(folder: Path) -> Path | None:
    """The folder of the top-level package that `folder` belongs to; None where it is no package."""
    found = None
    while (folder / PACKAGE_FILE).is_file():
        found, folder = folder, folder.parent
    return found


def is_file(path: Path) -> bool:
    """Whether a file lies there; none does at a name that is too long for one."""
    try:
        return path.is_file()
    except OSError:
        return False


def holds_packages(place: Path) -> bool:
    """Whether a folder is no package by itself."""
    return place.is_dir() and not (place / PACKAGE_FILE).is_file()


def is_folder(path: Path) -> bool:
    """As `is_file`."""
    try:
        return path.is_dir()
    except OSError:
        return False


def package_in(folder: Path, name: str) -> Path | None:
    """The folder or file of the top-level package `name` among those of `folder`; of several versions the newest."""
    if is_file(folder / name / PACKAGE_FILE):
        return folder / name
    if is_file(folder / f"{name}.mo"):
        return folder / f"{name}.mo"
    if not name.isidentifier() or not folder.is_dir():
        return None
    versions = [p for p in folder.glob(f"{name} *") if (p / PACKAGE_FILE).is_file() and name == _plain(p.name)]
    return max(versions, key=lambda p: [int(n) for n in re.findall(r"\d+", p.name[len(name) :])], default=None)


def names_in(folder: Path) -> list[str]:
    """Names of the packages and classes that lie in `folder`, by their folders and files."""
    with os.scandir(folder) as found:  # which knows files from folders without a look at each
        entries = sorted(found, key=lambda e: e.name)
    packages = [_plain(e.name) for e in entries if e.is_dir() and Path(e.path, PACKAGE_FILE).is_file()]
    files = [Path(e.name) for e in entries if e.name.endswith(".mo") and e.name != PACKAGE_FILE and e.is_file()]
    return packages + [file.stem for file in files if file.suffix]


def _plain(folder_name: str) -> str:
    """Without the version."""
    match = _VERSION.fullmatch(folder_name)
    return match[1] if match else folder_name


def _library(path: Path) -> Path:
    if path.name == PACKAGE_FILE and path.is_file():
        path = path.parent
    if path.is_file() and path.suffix == ".mo":
        return path
    if not path.exists():
        known = [p.name for p in path.parent.iterdir()] if path.parent.is_dir() else []
        raise Diagnostic(
            "F005", f"there is no library at {path}", hint=did_you_mean(path.name, known, "check the path")
        )
    if path.is_dir() and (top := outermost(path)):
        return top
    if path.is_file() or not names_in(path):
        hint = "a library is a folder with package.mo, a folder of such folders, or a .mo file"
        raise Diagnostic("F005", f"the library path {path} holds no package", hint=hint)
    return path


def _refuse_namesakes(libraries: list[Path]) -> None:
    first: dict[str, Path] = {}
    for library in libraries:
        for name in _names_of(library):
            other = first.setdefault(name, library)
            if other != library:
                message = f"two libraries are called {name}: {other} and {library}"
                raise Diagnostic("F006", message, hint="name one of them only")


def _names_of(library: Path) -> list[str]:
    if library.is_dir() and not (library / PACKAGE_FILE).is_file():
        return names_in(library)
    file = library / PACKAGE_FILE if library.is_dir() else library
    try:
        require_file(file, OSError)
        return [cls.name for cls in parse(file.read_text(encoding="utf-8"), str(file))]
    except (OSError, UnicodeDecodeError) as error:
        raise Diagnostic("F001", f"cannot read {file}: {error}", hint="save it as UTF-8") from None
