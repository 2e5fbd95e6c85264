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
from lacuna.codegen.suggest import did_you_mean
from lacuna.codegen.syntax import ast, parse

HOME_PACKAGE = "Lacuna"
MODEL_FOLDER = Path(__file__).resolve().parent.parent / "model"


_PREDEFINED = """
type StateSelect = enumeration(never, avoid, default, prefer, always);
type AssertionLevel = enumeration(warning, error);
partial class ExternalObject end ExternalObject;
"""  # Modelica 3.6, 4.9.8, 8.3.7 and 12.9.7
PREDEFINED = {cls.name: cls for cls in parse(_PREDEFINED, "")}


@lru_cache(maxsize=4096)
def _parse_cached(file: str, text: str) -> tuple[ast.Class, ...]:
    return tuple(parse(text, file))


class Library:
    """Classes under `paths`: package folders, folders of .mo files, or single .mo files.

    `files` lists every file read so far with the SHA-256 of its text.
    """

    def __init__(self, paths: Iterable[str | Path] = (MODEL_FOLDER,)) -> None:
        self.files: dict[str, str] = {}
        self.root = ast.Class(Span("", 0, 0), "package", "")
        self._folders: dict[int, Path] = {}  # id of a package class -> its folder
        self._loose: list[Path] = []
        self._parsed: dict[Path, list[ast.Class]] = {}
        self._members: dict[tuple[int, str], ast.Class | None] = {}  # None where there is no file
        for path in map(Path, paths):
            self._add(path)

    def _add(self, path: Path) -> None:
        if path.is_file():
            for cls in self.parse_file(path):
                self.root.classes[cls.name] = cls
        elif (path / "package.mo").is_file():
            cls = self._package(path)
            self.root.classes[cls.name] = cls
        elif path.is_dir():
            self._loose.append(path)

    def _package(self, folder: Path) -> ast.Class:
        classes = self.parse_file(folder / "package.mo")
        self._folders[id(classes[0])] = folder
        return classes[0]

    @property
    def folders(self) -> list[Path]:
        """Folders of the packages seen so far, outermost first."""
        return list(self._folders.values())

    def parse_file(self, path: Path) -> list[ast.Class]:
        """The classes of one file, each time the same objects. Raises F001 when it cannot be read."""
        path = Path(path)
        if path not in self._parsed:
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
        if found is None and cls is self.root:
            found = self._loose_class(name)
        elif found is None and id(cls) in self._folders:
            key = id(cls), name
            if key not in self._members:
                self._members[key] = self._from_folder(cls, self._folders[id(cls)], name)
            found = self._members[key]
        return found

    def _loose_class(self, name: str) -> ast.Class | None:
        for folder in self._loose:
            if (folder / name / "package.mo").is_file():
                self.root.classes[name] = self._package(folder / name)
            elif (folder / f"{name}.mo").is_file():
                for cls in self.parse_file(folder / f"{name}.mo"):
                    self.root.classes.setdefault(cls.name, cls)
        return self.root.classes.get(name) or PREDEFINED.get(name)

    def _from_folder(self, cls: ast.Class, folder: Path, name: str) -> ast.Class | None:
        file = folder / f"{name}.mo"
        if file.is_file():
            classes = self.parse_file(file)
        elif (folder / name / "package.mo").is_file():
            classes = [self._package(folder / name)]
        elif (folder / name).is_dir():
            hint = f"a folder is a package when it holds package.mo: add {folder / name / 'package.mo'}"
            raise Diagnostic("F002", f"the folder {folder / name} holds no package.mo", cls.span, hint)
        else:
            return None
        found = classes[0]
        if found.name != name:
            hint = f"rename the class to {name}, or the file to {found.name}.mo"
            raise Diagnostic("F003", f"{file.name} declares {found.name}", found.span, hint)
        if found.within != cls.path:
            hint = f"start the file with: within {cls.path};"
            message = f"{name} lies in package {cls.path}, but its file says 'within {found.within}'"
            raise Diagnostic("F004", message, found.span, hint)
        found.parent = cls
        return found

    def members(self, cls: ast.Class) -> list[str]:
        """Names of the classes declared directly in `cls`, for listings and hints."""
        names = set(cls.classes)
        for folder in self._loose if cls is self.root else [self._folders[id(cls)]] if id(cls) in self._folders else []:
            for entry in folder.iterdir():
                if entry.suffix == ".mo" and entry.stem != "package":
                    names.add(entry.stem)
                elif (entry / "package.mo").is_file():
                    names.add(entry.name)
        return sorted(names)

    def find(self, name: str) -> ast.Class:
        """The class called `name`: a full name, a name inside package Lacuna, or a path to a .mo file.

        Of a file it is the class named like the file, else the last one; it sees the files beside it, and the
        package that its `within` names.
        Raises R001 with the nearest names when there is none.
        """
        if name.endswith(".mo"):
            return self._of_file(Path(name))
        parts = name.split(".")
        start = self.root
        home = self.member(self.root, HOME_PACKAGE)
        if self.member(self.root, parts[0]) is None and home is not None:
            start = home
        cls = start
        for part in parts:
            found = self.member(cls, part)
            if found is None:
                known = self.members(cls) + (self.members(self.root) if cls is home and start is home else [])
                where = f" in package {cls.path}" if cls.name else ""
                hint = did_you_mean(part, known, f"there is {', '.join(known[:12])}" if known else "")
                raise Diagnostic("R001", f"there is no class {part}{where}", hint=hint)
            cls = found
        return cls

    def _of_file(self, path: Path) -> ast.Class:
        resolved = path.resolve()
        for folder in self._folders.values():
            if resolved.is_relative_to(folder.resolve()):
                relative = resolved.relative_to(folder.resolve()).with_suffix("")
                names = [p for p in relative.parts if p != "package"]
                cls = next(c for c in self.root.classes.values() if self._folders.get(id(c)) == folder)
                for name in names:
                    cls = self.member(cls, name)
                return cls
        classes = self.parse_file(path)
        for cls in classes:
            self.root.classes.setdefault(cls.name, cls)
            if cls.within:
                cls.parent = self._owner(cls)
        self._loose.append(path.parent)
        return next((cls for cls in classes if cls.name == path.stem), classes[-1])

    def _owner(self, cls: ast.Class) -> ast.Class:
        """The package that a file's `within` names; it lies neither in the class itself nor in what is inside it."""
        owner = around = self.find(cls.within)
        while around is not None:
            if around is cls:
                hint = "name the package that the class lies in, or leave 'within' out"
                raise Diagnostic("F004", f"{cls.name} lies within itself", cls.span, hint)
            around = around.parent
        return owner

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
