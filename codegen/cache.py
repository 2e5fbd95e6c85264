"""Compiled models on disk: one library for each content hash, and an index from requests to hashes.

A request (model, search path, modifications) remembers which files it read with their SHA-256; while those files
and this generator are unchanged the compiled library is used again without parsing anything. Everything is
written beside its place and renamed, so that processes may share the cache; what a power cut damaged is made again.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
import contextlib
from dataclasses import dataclass
from functools import lru_cache
import hashlib
import itertools
import json
import os
from pathlib import Path
import platform
import shutil
import stat
import time
from typing import Any

from lacuna.children import run
from lacuna.codegen import flat
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.emit.text.c_text import SourceNames
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.library.access import NONE, Access
from lacuna.codegen.library.search_path import names_in, split_name
from lacuna.codegen.library.search_path import search_path as default_path
import lacuna.rows
import lacuna.texts
import lacuna.units
from lacuna.written import whole_files, write_whole

COMPILER = (
    "cc", "-std=c11", "-O2", "-fPIC", "-shared", "-ffp-contract=off", "-Wall", "-Wextra", "-Wpedantic", "-Werror",
    "-Wno-tautological-compare", "-Wno-logical-not-parentheses",  # a model may say `b == b` and `(not a) <> b`
)  # fmt: skip
QUICK = {"-O2": "-O1"}  # of models of which hundreds are looked at: half the time, for runs that are as fast
STRICT = ("-Werror=implicit-function-declaration", "-Werror=int-conversion", "-Wl,-z,defs")  # C of others
LARGEST = 2 << 30  # bytes that are kept: some 10 000 models of the size of an actuator
RECENT = 3600  # s
TRIM_EVERY = 64  # libraries that are built between two looks at the size of the folder
_builds = itertools.count()
_HERE = Path(__file__).resolve().parent
INCLUDE = _HERE.parent / "runtime" / "include"


class CompilerError(RuntimeError):
    """The C compiler is missing or refused generated code (which is a fault of the generator)."""

    user_error = True


@dataclass
class Found:
    name: str
    library: str
    hash: str
    warnings: list[Diagnostic]


def _digest(*parts: str | bytes) -> str:
    h = hashlib.sha256()
    for part in parts:
        h.update(part.encode() if isinstance(part, str) else part)
        h.update(b"\0")
    return h.hexdigest()


@lru_cache(maxsize=1)
def generator_version() -> str:
    """Digest of the generator's own source, the ABI and the compiler's command: any change makes all models new."""
    headers = [INCLUDE / "mdl_abi.h", INCLUDE / "mdl_tangent.h"]
    files = [*sorted(_HERE.rglob("*.py")), Path(lacuna.units.__file__), Path(lacuna.texts.__file__),
             Path(lacuna.rows.__file__), *headers]  # fmt: skip
    return _digest(" ".join(COMPILER), *(f.read_bytes() for f in files))


def request_key(
    name: str, search_path: Sequence[str] | None, modifications: Mapping[str, object] | None, units: str,
    sensitivities: bool = False, access: Access = NONE, quick: bool = False,
) -> str:  # fmt: skip
    """Digest of what was asked for, and where it is looked up: `search_path`, else MODELICAPATH and package Lacuna.

    The text of the files is not part of it: the index holds that of each file read, so that an edit makes only those
    models new that read the edited file.
    """
    paths = [str(Path(p).resolve()) for p in (default_path() if search_path is None else search_path)]
    file, inner = split_name(name)
    changes = sorted((k, repr(v)) for k, v in (modifications or {}).items())
    asked = [str(file.resolve()) if file else "", inner, paths, changes, units, sensitivities]
    return _digest(json.dumps([*asked, [access.data, access.external], quick]))


def content_hash(
    model: flat.FlatModel, modifications: Mapping[str, object] | None, units: str, sensitivities: bool = False
) -> str:
    """Digest of what decides the C of a model: the generator, the text of every file read, that of its own file among
    them, and what was asked for. It is the same wherever the files lie."""
    changes = sorted((k, repr(v)) for k, v in (modifications or {}).items())
    files = SourceNames().digests(model.files.items())
    own = model.files.get(model.span.file, "")
    return _digest(generator_version(), json.dumps([model.name, own, files, changes, units, sensitivities]))


@lru_cache(maxsize=1)
def compiler() -> str:
    """Which program `cc` is: its path after links, its size and time; and which machine this is. Another one makes all
    libraries new."""
    found = shutil.which(COMPILER[0])
    if found is None:
        return ""
    path = Path(found).resolve()
    status = path.stat()
    return f"{path} {status.st_size} {status.st_mtime_ns} {platform.machine()}"


def _folders(files: Iterable[str], search_path: Sequence[str] | None) -> dict[str, str]:
    """Where classes are looked up beside these files, with a digest of the names there: a new file may win."""
    places = map(Path, default_path() if search_path is None else search_path)
    found = {*(Path(file).parent for file in files), *(p for p in places if p.is_dir())}
    return {str(folder): _names(str(folder)) for folder in sorted(found)}


def _names(folder: str) -> str:
    try:
        return _digest(*names_in(Path(folder)))
    except OSError:
        return ""


def _file_digest(path: str) -> str | None:
    try:
        return hashlib.sha256(Path(path).read_bytes()).hexdigest()
    except OSError:
        return None


def _sum_of(library: Path) -> Path:
    """The file beside a library that holds the SHA-256 of its bytes."""
    return library.with_suffix(".sha256")


def _is_whole(library: Path) -> bool:
    """Whether a library is there as it was compiled: neither cut nor exchanged, which loading it would not notice."""
    try:
        whole = _sum_of(library).read_text(encoding="ascii") == _file_digest(str(library))
    except (OSError, ValueError):
        return False
    if whole:
        with contextlib.suppress(OSError):  # a folder that is only read
            os.utime(_sum_of(library))  # when it was last used: `trim`
    return whole


def _is_current(entry: Mapping[str, Any]) -> bool:
    """Whether nothing has changed of what an entry of the index was made from."""
    return (
        entry["generator"] == [generator_version(), compiler()]
        and all(_names(folder) == digest for folder, digest in entry["folders"].items())
        and all(_file_digest(path) == digest for path, digest in entry["files"].items())
    )


def _refuse_shared(folder: Path) -> None:
    """Code is loaded from this folder: nobody but the user may be able to write there. Raises CompilerError."""
    status = folder.stat()
    if status.st_uid != os.getuid() or status.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
        raise CompilerError(
            f"{folder}: others can write to this folder of compiled models, and code is loaded from it; "
            f"run `chmod go-w {folder}`, or set LACUNA_CACHE to a folder of your own"
        )


class Cache:
    """A directory of compiled models: $LACUNA_CACHE, else ~/.cache/lacuna."""

    def __init__(self, directory: str | None = None):
        default = os.environ.get("LACUNA_CACHE") or Path.home() / ".cache" / "lacuna"
        self.directory = Path(directory or default).absolute()  # compilers work in folders of their own

    def _index(self, request: str) -> Path:
        return self.directory / "index" / f"{request[:32]}.json"

    def find(self, request: str) -> Found | None:
        """The compiled model of a request, if nothing that it was made from has changed."""
        try:
            entry = json.loads(self._index(request).read_text(encoding="utf-8"))
            library = self.private() / entry["library"]
            if library.parent != self.directory or not _is_current(entry) or not _is_whole(library):
                return None
            os.utime(self._index(request))  # when it was last used: `trim`
            warnings = [Diagnostic(w[0], w[1], Span(*w[2]) if w[2] else None, w[3], severity="warning")
                        for w in entry["warnings"]]  # fmt: skip
            return Found(entry["name"], str(library), entry["hash"], warnings)
        except (OSError, ValueError, KeyError, TypeError, AttributeError, IndexError):
            return None  # never made, or damaged

    def remember(
        self,
        request: str,
        prepared: Prepared,
        library: str,
        warnings: Sequence[Diagnostic],
        search_path: Sequence[str] | None,
    ) -> None:
        spans = [(w, [w.span.file, w.span.line, w.span.column, w.span.length] if w.span else None) for w in warnings]
        entry = {
            "name": prepared.declared.name, "library": Path(library).name, "hash": prepared.hash,
            "generator": [generator_version(), compiler()], "files": prepared.declared.files,
            "folders": _folders(prepared.declared.files, search_path),
            "warnings": [[w.code, w.message, span, w.hint] for w, span in spans],
        }  # fmt: skip
        write_whole(self._index(request), json.dumps(entry), lasting=False)

    def private(self) -> Path:
        """The directory, made where it is missing. Raises CompilerError where others can write to it."""
        self.directory.mkdir(mode=0o700, parents=True, exist_ok=True)
        _refuse_shared(self.directory)
        return self.directory

    def build(
        self, digest: str, source: str, foreign: flat.ForeignCode | None = None, quick: bool = False
    ) -> str:  # fmt: skip
        """Compile C `source` to a library named by its digest and the compiler, and keep both; returns its path."""
        digest = _digest(digest, compiler(), *(["quick"] if quick else []))
        self.private()
        library, c_file = self.directory / f"{digest[:32]}.so", self.directory / f"{digest[:32]}.c"
        if _is_whole(library):
            return str(library)
        write_whole(c_file, source, lasting=False)
        with whole_files(self.directory, lasting=False) as scratch:
            output = scratch / library.name
            compile_c(c_file, output, foreign, quick)
            _sum_of(output).write_text(str(_file_digest(str(output))), encoding="ascii")
        if next(_builds) % TRIM_EVERY == 0:
            trim(self.directory)
        return str(library)


def trim(folder: Path, largest: int = LARGEST) -> None:
    """Remove what was not used for longest until what is left takes no more than `largest` bytes. What was used within
    the hour stays: another process may be about to load it."""
    groups: dict[Path, list[os.stat_result]] = {}
    for path in _kept(folder):
        with contextlib.suppress(OSError):  # another process removed it
            groups.setdefault(path.with_suffix(""), []).append(path.stat())
    held = sum(status.st_size for group in groups.values() for status in group)
    old = time.time() - RECENT
    for last, stem in sorted((max(s.st_mtime for s in group), stem) for stem, group in groups.items()):
        if held <= largest or last > old:
            return
        for path in sorted(stem.parent.glob(f"{stem.name}.*")):  # the sum before the library: never half a one
            path.unlink(missing_ok=True)
        held -= sum(status.st_size for status in groups[stem])


def _kept(folder: Path) -> Iterator[Path]:
    """Files of the cache, without those that are being written. Folders come and go: `os.walk` passes over them."""
    for inside, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        yield from (Path(inside) / name for name in files)


def compile_c(
    c_file: Path, output: Path, foreign: flat.ForeignCode | None = None, quick: bool = False
) -> None:  # fmt: skip
    """Run the compiler on a generated file. Raises CompilerError with its messages, Diagnostic for C of others."""
    of_others = foreign is not None and foreign.spans
    options = [o for o in COMPILER if not o.startswith("-W")] + list(STRICT) if of_others else list(COMPILER)
    libraries = foreign.libraries if foreign is not None else []
    options = [QUICK.get(o, o) if quick else o for o in options]
    command = [*options, f"-I{INCLUDE}", "-o", str(output), str(c_file), *libraries, "-lm"]
    try:
        result = run(command)
    except FileNotFoundError:
        raise CompilerError("no C compiler: install one that is called as `cc` (Debian: apt install gcc)") from None
    if result.returncode and of_others:
        said = next((x for x in result.stderr.splitlines() if "error" in x or "undefined" in x), "it says nothing")
        names = ", ".join(foreign.spans)
        message = f"the external C of {names} cannot be compiled: {said.split(': ', 1)[-1]}"
        raise Diagnostic(
            "R094", message, next(iter(foreign.spans.values())), "correct it, or what Include and Library name"
        )
    if result.returncode:
        lines = "\n".join(result.stderr.splitlines()[:20])
        raise CompilerError(f"the compiler refused {c_file}, a fault of the generator:\n{lines}")
