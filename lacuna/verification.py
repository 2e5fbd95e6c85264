"""Is a result what its command makes of its inputs? How it was made stands beside it; `verify` makes it again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import hashlib
from importlib.metadata import version
import json
from pathlib import Path
import sys
import tempfile
from typing import Any

from lacuna.children import run
from lacuna.errors import UserError
from lacuna.given import LARGEST, json_of
from lacuna.progress import Progress, spoken
from lacuna.written import write_whole

MADE_BY = "made-by.json"
FORMAT = "lacuna-made-by-1"
VERIFIABLE = ("simulate", "maps", "sweep", "assess", "forecast", "explain")
# Options that write, serve or connect elsewhere and change no result: never recorded, never followed.
ELSEWHERE = ("out", "store", "actuator", "cycles", "hours", "replaced", "watch", "port", "scheduler")
EXTERNAL = "--allow-external"
_FORBIDDEN = {f"--{name}" for name in ELSEWHERE}
MOST_ENTRIES = 20_000  # files and folders below one that was named: seconds to read; a disk has a hundred times as many
UNREAD = ""  # the digest of what is larger


@dataclass(frozen=True)
class Verification:
    """`differs` names the files that are not what the command makes now, `checked` all that were looked at."""

    command: tuple[str, ...]
    checked: tuple[str, ...]
    differs: tuple[str, ...]

    @property
    def same(self) -> bool:
        return not self.differs


def record_making(command: Sequence[str], written: Sequence[Path]) -> list[str]:
    """Write beside the results of a command how they were made: its words without the options ELSEWHERE, and the
    digests of the files and folders among them. `written` are files in one folder, or that folder. A warning for each
    that is too large."""
    if command[0] not in VERIFIABLE or not written:
        return []
    folder = written[0] if written[0].is_dir() else written[0].parent
    stems = {path.stem for path in written if path.is_file()}
    files = [path for path in _results_in(folder) if not stems or path.name.partition(".")[0] in stems]
    inputs = {name: _digest(Path(name), folder) for word in command[1:] if (name := _file_of(word))}
    made = {
        "format": FORMAT, "version": version("lacuna"), "command": list(command), "inputs": inputs,
        "files": sorted(path.relative_to(folder).as_posix() for path in files),
    }  # fmt: skip
    write_whole(folder / MADE_BY, json.dumps(made, indent=1, ensure_ascii=False) + "\n")
    large = [word for word, digest in inputs.items() if digest == UNREAD]
    why = f"holds more than {MOST_ENTRIES} files or {LARGEST >> 20} MB, or such as may not be read"
    return [f"warning: {word} {why}: lacuna verify will not see whether it changed" for word in large]


def _file_of(word: str) -> str | None:
    """The file or folder that a word of a command names: itself, or as in NAME=FILE and NAME=FILE:COLUMN."""
    given = word.partition("=")[2]
    named = (name for name in (word, given, given.partition(":")[0]) if name and Path(name).exists())
    return next(named, None)


def _results_in(folder: Path) -> list[Path]:
    """What a command left in its folder, without what it keeps for itself: hidden files, caches of rows and parts."""
    kept = {"rows", "parts"}
    found = (path for path in folder.rglob("*") if path.is_file() and path.name != MADE_BY)
    return [p for p in found if not any(n.startswith(".") or n in kept for n in p.relative_to(folder).parts)]


def verify(folder: str | Path, progress: Progress | None = None, *, allow_external: bool = False) -> Verification:
    """Give the command that made the results in `folder` again, and compare.

    Every file is compared byte by byte, but for pages (.html), which say when and by which words they were made, and
    for entries `seconds` of JSON. Run it where the command was given: its words may name files relatively. A command
    that compiles the C of external functions, which runs with your rights, is given only with `allow_external`. Raises
    UserError where the folder does not say how it was made, an input has changed, or the command fails.
    """
    folder = Path(folder)
    made = _made_by(folder)
    if EXTERNAL in made["command"] and not allow_external:
        raise UserError(
            f"{folder} was made with {EXTERNAL}; again, that compiles and runs, as you, the C that its models name: "
            f"where you trust them, verify with {EXTERNAL}"
        )
    for word, digest in made["inputs"].items():
        if not Path(word).exists() or _digest(Path(word), folder) != digest:
            raise UserError(f"{word} is not what the results in {folder} were made from: it is gone or has changed")
    spoken(progress)(f"making again: lacuna {' '.join(made['command'])}")
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as scratch:
        again = Path(scratch) / folder.resolve().name
        done = run([sys.executable, "-m", "lacuna.cli.main", *made["command"], "--out", again])
        if not again.is_dir():
            raise UserError(f"the command of {folder} fails now: {done.stderr.strip()[:500]}")
        checked = [name for name in made["files"] if not name.endswith(".html")]
        differs = [name for name in checked if _content(folder / name) != _content(again / name)]
    return Verification(tuple(made["command"]), tuple(checked), tuple(differs))


def _made_by(folder: Path) -> dict[str, Any]:
    path = folder / MADE_BY
    if not path.exists():
        raise UserError(f"{folder} does not say how it was made: there is no {MADE_BY}")
    made = json_of(path, UserError)
    try:
        words, files, inputs = made["command"], made["files"], made["inputs"]
        sound = made["format"] == FORMAT and words[0] in VERIFIABLE and isinstance(inputs, dict)
        sound = sound and all(isinstance(word, str) for word in (*words, *files))
        sound = sound and bool(files) and not any(word.partition("=")[0] in _FORBIDDEN for word in words)
    except (KeyError, IndexError, TypeError):
        sound = False
    if not sound or any(".." in Path(name).parts or Path(name).is_absolute() for name in files):
        raise UserError(f"{path} is not of this version, or damaged")
    return dict(made)


def _digest(path: Path, results: Path) -> str:
    """Of a file, or of all files below a folder with their names, those in `results` apart; UNREAD of too much."""
    digest, files = hashlib.sha256(), [path] if not path.is_dir() else _files_below(path, results.resolve())
    if files is None:
        return UNREAD
    for file in files:
        digest.update(file.relative_to(path).as_posix().encode() + b"\0")
        with file.open("rb") as content:
            digest.update(hashlib.file_digest(content, "sha256").digest())
    return digest.hexdigest()


def _files_below(path: Path, apart: Path) -> list[Path] | None:
    """In order, those in `apart` left out; None where they are too many, too large together, or closed."""
    found, size = [], 0
    try:
        for count, entry in enumerate(path.rglob("*")):
            if entry.is_file() and not entry.resolve().is_relative_to(apart):
                found.append(entry)
                size += entry.stat().st_size
            if count > MOST_ENTRIES or size > LARGEST:
                return None
    except PermissionError:
        return None
    return sorted(found)


def _content(path: Path) -> object:
    if not path.is_file():
        return None
    if path.suffix == ".json":
        try:
            return _without_seconds(json_of(path, UserError))
        except UserError:
            return b""
    return path.read_bytes()


def _without_seconds(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_seconds(v) for key, v in value.items() if key != "seconds"}
    return [_without_seconds(v) for v in value] if isinstance(value, list) else value
