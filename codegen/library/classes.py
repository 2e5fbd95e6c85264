"""Finding classes by name: the folder tree of a package, single files, and classes nested in either.

A folder that holds package.mo is that package; `model/` is package Lacuna. Files are read when first needed
and parsed once per process for each content.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
import hashlib
from pathlib import Path

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.library.access import NONE, Access
from lacuna.codegen.library.folders import only_class, refuse_both, refuse_twice
from lacuna.codegen.library.predefined import PREDEFINED
from lacuna.codegen.library.renamed import OLD_NAMES, renamed
from lacuna.codegen.library.search_path import (
    MODEL_FOLDER,
    PACKAGE_FILE,
    holds_packages,
    is_file,
    is_folder,
    known_classes,
    names_in,
    outermost,
    package_in,
    search_path,
    split_name,
)  # fmt: skip
from lacuna.codegen.syntax import ast, parse

HOME_PACKAGE = "Lacuna"
MODEL_KINDS = ("model", "block", "class")  # what can be simulated


@lru_cache(maxsize=4096)
def _parse_cached(file: str, text: str) -> tuple[ast.Class, ...]:
    return tuple(parse(text, file))


class Library:
    """Classes under `paths`: package folders, folders of packages and .mo files, or single .mo files; the first that
    has a name counts. By default those of `search_path()`: MODELICAPATH and the package Lacuna.

    `files` lists every file read so far with the SHA-256 of its text.
    """

    def __init__(self, paths: Iterable[str | Path] | None = None, access: Access = NONE) -> None:
        self.paths = [str(path) for path in (search_path() if paths is None else paths)]
        self.access = access
        self.files: dict[str, str] = {}
        self.root = ast.Class(Span("", 0, 0), "package", "")  # its classes: those of a model's own file
        self._places = [Path(path).resolve() for path in self.paths]  # where top-level classes are looked up, in order
        self._folders: dict[int, Path] = {}  # id of a package class -> its folder
        self._parsed: dict[Path, list[ast.Class]] = {}
        self._members: dict[tuple[int, str], ast.Class | None] = {}  # None where there is no file
        self._own: set[Path] = set()  # files and package folders that were named by their path
        self._packages: dict[str, str] = {}  # see foreign_package
        self.renamed: dict[str, str] = {}  # old names that were used, and what they are read as
        self.views: dict[tuple[object, ...], ast.Class] = {}  # see flatten/names/views.py
        self.bases: dict[int, list[ast.Class]] = {}  # of classes that were asked for, by identity
        self.meanings: dict[tuple[int, str, bool, bool], ast.Class] = {}  # see find_first in flatten/names/scope.py
        self._paths: dict[str, int] = {}
        self.resolving: set[int] = set()  # classes whose bases are being looked up, by identity
        self.defining: set[int] = set()  # short definitions whose bases are being followed
        self.kept: list[object] = []  # whose identities are keys of those above

    def _package(self, folder: Path) -> ast.Class:
        package = only_class(self.parse_file(folder / PACKAGE_FILE), folder / PACKAGE_FILE)
        if id(package) not in self._folders:
            refuse_twice(package, folder)
        self._folders[id(package)] = folder
        return package

    @property
    def folders(self) -> list[Path]:
        """Folders of the packages seen so far, outermost first."""
        return list(self._folders.values())

    def folder_of(self, cls: ast.Class) -> Path | None:
        """The folder of a package that is one."""
        return self._folders.get(id(cls))

    def parse_file(self, path: Path) -> list[ast.Class]:
        """The classes of one file, each time the same objects. Raises F001 when it cannot be read."""
        path = Path(path)
        if path not in self._parsed:
            if path.exists() and not path.is_file():
                raise Diagnostic("F001", f"{path} is not a file", hint="a model is a .mo file")
            try:
                text = path.read_bytes().decode("utf-8")
            except OSError as error:
                raise Diagnostic("F001", f"cannot read {path}: {error.strerror}", hint="check the path") from None
            except UnicodeDecodeError:
                raise Diagnostic("F001", f"{path} is not UTF-8 text", hint="save it as UTF-8") from None
            self.files[str(path)] = hashlib.sha256(text.encode()).hexdigest()
            self._parsed[path] = list(_parse_cached(str(path), text))
        return self._parsed[path]

    def member(self, cls: ast.Class, name: str) -> ast.Class | None:
        """The class `name` declared directly in `cls`: nested in the text, or a file or folder of its package."""
        found = cls.classes.get(name)
        if found is None and (cls is self.root or id(cls) in self._folders):
            key = id(cls), name
            if key not in self._members:
                self._members[key] = self._top_level(name) if cls is self.root else self._in_folder(cls, name)
            found = self._members[key]
        return renamed(self, cls, name) if found is None and name in OLD_NAMES else found

    def _top_level(self, name: str) -> ast.Class | None:
        for place in self._places:
            found = next((cls for cls in self._classes_at(place, name) if cls.name == name), None)
            if found is not None:
                return found
        return PREDEFINED.get(name)

    def _classes_at(self, place: Path, name: str) -> list[ast.Class]:
        """Top-level classes of a place of the search path, among which `name` is if it is there."""
        if place.is_file():
            return self.parse_file(place)
        if (place / PACKAGE_FILE).is_file():
            return [self._package(place)]
        found = package_in(place, name)
        if found is None:
            return []
        return self.parse_file(found) if found.is_file() else [self._package(found)]

    def _in_folder(self, cls: ast.Class, name: str) -> ast.Class | None:
        """The class `name` of a package that is a folder: one that a file elsewhere puts there, else the folder's."""
        return self._put_into(cls, name) or self._from_folder(cls, self._folders[id(cls)], name)

    def _put_into(self, cls: ast.Class, name: str) -> ast.Class | None:
        """A class of a single file, or of a file in a folder that is no package, whose `within` names the package
        `cls`: it takes the place of the package's own, as where a tool loads that file after the package."""
        for place in self._places:
            file = place if place.is_file() else place / f"{name}.mo"
            taken = is_file(file) and not is_file(place / PACKAGE_FILE)
            for found in self.parse_file(file) if taken else ():
                if (found.within, found.name) == (cls.path, name):
                    found.parent = cls
                    return found
        return None

    def _from_folder(self, cls: ast.Class, folder: Path, name: str) -> ast.Class | None:
        file = folder / f"{name}.mo"
        package = folder / name / PACKAGE_FILE
        if is_file(file):
            found = only_class(self.parse_file(file), file)
            refuse_both(found, [package] if is_file(package) else [])
        elif is_file(package):
            found = self._package(folder / name)
        elif is_folder(folder / name):
            hint = f"a folder is a package when it holds one: add {package}"
            raise Diagnostic("F002", f"the folder {folder / name} holds no package.mo", cls.span, hint)
        else:
            return None
        if found.name != name:
            put_right = f"rename the class to {name}, or the file to {found.name}.mo"
            raise Diagnostic("F003", f"{file.name} declares {found.name}", found.span, put_right)
        if found.within != cls.path:
            message = f"{name} lies in package {cls.path}, but its file says 'within {found.within}'"
            raise Diagnostic("F004", message, found.span, f"start the file with: within {cls.path};")
        found.parent = cls
        return found

    def members(self, cls: ast.Class) -> list[str]:
        """Names of the classes declared directly in `cls`, for listings and hints."""
        names = set(cls.classes)
        if cls is self.root:
            for place in self._places:
                names.update(
                    names_in(place) if holds_packages(place) else [c.name for c in self._classes_at(place, "")]
                )
        elif id(cls) in self._folders:
            names.update(names_in(self._folders[id(cls)]))
        return sorted(names)

    def find(self, name: str) -> ast.Class:
        """The class called `name`: a full name, a name inside package Lacuna, a path to a .mo file or to the folder of
        a package, or either of these with a class in it, as `file.mo:Pkg.Class`.

        Of a file it is the class named like the file, else the last one; it sees the package that the file lies in,
        or else the files beside it and the package that its `within` names.
        Raises R001 with the nearest names when there is none, F007 where a folder is no package.
        """
        place, inner = split_name(name)
        if place is None:
            return self._by_name(inner)
        cls = self._of_file(place)
        if not inner:
            return cls
        inside = self.member(self.root, inner.split(".")[0]) is None and self.member(cls, inner.split(".")[0])
        return self._below(cls, inner) if inside else self._by_name(inner)

    def _by_name(self, name: str, span: Span | None = None) -> ast.Class:
        home = self.member(self.root, HOME_PACKAGE)
        if home is None or self.member(self.root, name.split(".")[0]) is not None:
            return self._below(self.root, name, span=span)
        return self._below(home, name, self.members(self.root), span)

    def _below(self, cls: ast.Class, name: str, others: Iterable[str] = (), span: Span | None = None) -> ast.Class:
        """The class `name` inside `cls`. Raises R001, with the nearest names among those there and `others`."""
        for part in name.split("."):
            found = self.member(cls, part)
            if found is None:
                known = [*self.members(cls), *others]
                where = f" in package {cls.path}" if cls.name else ""
                raise Diagnostic("R001", f"there is no class {part}{where}", span, hint=known_classes(part, known))
            cls, others = found, ()
        return cls

    def _of_file(self, path: Path) -> ast.Class:
        resolved = path.resolve()
        self._own.add(outermost(resolved.parent) or resolved)
        folder = resolved if resolved.is_dir() else resolved.parent
        top = outermost(folder)
        if top is not None:
            return self._in_package(top, resolved)
        if resolved.is_dir():
            hint = "name a .mo file, or a folder with package.mo; the folder of a library goes to --library"
            raise Diagnostic("F007", f"{path} is a folder and holds no package.mo", hint=hint)
        classes = self.parse_file(path)
        for cls in classes:
            if cls.within:
                cls.parent = self._owner(cls)
            self.root.classes[cls.name] = cls
        self._look_in(folder)
        if any(cls.within for cls in classes):
            self._look_in(resolved, first=True)
        return next((cls for cls in classes if cls.name == path.stem), classes[-1])

    def _owner(self, cls: ast.Class) -> ast.Class:
        """The package that a file's `within` names; it lies neither in the class itself nor in what is inside it."""
        owner = around = self._by_name(cls.within, cls.span)
        while around is not None:
            if around is cls:
                hint = "name the package that the class lies in, or leave 'within' out"
                raise Diagnostic("F004", f"{cls.name} lies within itself", cls.span, hint)
            around = around.parent
        return owner

    def _in_package(self, top: Path, path: Path) -> ast.Class:
        """The class of a file or folder inside the package at `top`, which is looked up from now on, too."""
        cls = self._package(top)
        if self.member(self.root, cls.name) is not cls:
            self._look_in(top, first=True)
        names = path.with_suffix("").relative_to(top).parts if path.is_file() else path.relative_to(top).parts
        inner = [part for part in names if part != "package"]
        return self._below(cls, ".".join(inner)) if inner else cls

    def _look_in(self, place: Path, first: bool = False) -> None:
        if place not in self._places:
            self._places.insert(0 if first else len(self._places), place)
        self._members.clear()
        self.meanings.clear()

    def forget_views(self) -> None:
        """Start a translation anew: equal input gives equal names."""
        for memo in (self.views, self.bases, self.meanings, self.kept, self._paths):
            memo.clear()

    def count_path(self, path: str) -> int:
        """How many classes seen from elsewhere have had this path, the new one included: each has names of its own."""
        self._paths[path] = self._paths.get(path, 0) + 1
        return self._paths[path]

    def foreign_package(self, file: str) -> str:
        """The top-level package that `file` belongs to where that is a library found by the search path; "" for a model
        named by its path, for what lies beside it and for package Lacuna."""
        if file not in self._packages:
            path = Path(file)
            top = outermost(path.parent) or path
            single = top == path and not (top.parent in self._places and self._holds_package(top))
            own = not file or top in self._own or top == MODEL_FOLDER or single
            self._packages[file] = "" if own else top.stem.split(" ")[0]
        return self._packages[file]

    def _holds_package(self, file: Path) -> bool:
        return all(cls.kind in ("package", "record") for cls in self._parsed.get(file, ()))

    def all_classes(self, cls: ast.Class | None = None) -> list[ast.Class]:
        """Every class below `cls` (default: everything), packages first; reads all files."""
        result = []
        start = cls or self.root
        for name in self.members(start):
            found = self.member(start, name)
            if found is not None:
                result.append(found)
                result += self.all_classes(found)
        return result

    def models(self, cls: ast.Class | None = None) -> list[str]:
        """Full names of the models below `cls` (default: everywhere) that can be simulated by themselves as far as
        their kind tells: no functions, connectors, records, nothing partial. Reads all files."""
        return [c.path for c in self.all_classes(cls) if c.kind in MODEL_KINDS and not c.partial and not c.alias]
