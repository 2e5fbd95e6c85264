"""Recordings in the formats people have: one reader and one writer for each, chosen by the file's suffix.

text        .csv .txt .tsv .dat .asc   separators, decimal commas, encodings, rows of units
MATLAB      .mat                       version 5 (scipy) and 7.3 (h5py)
Parquet     .parquet                   units in the fields' metadata
MDF 3, 4    .mdf .mf4 .mf3 .dat (by its first bytes); written as .mf4
TDMS        .tdms
Excel       .xlsx .xls .ods            first sheet; written as .xlsx
"""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from pathlib import Path

from lacuna.analysis.recording.channel import Reader, Recorded, RecordingError
from lacuna.extras import names_missing_packages
from lacuna.given import require_file
from lacuna.written import whole_file

_READERS = {
    "text": (".csv", ".txt", ".tsv", ".dat", ".asc"),
    "matlab": (".mat",),
    "parquet": (".parquet", ".pq"),
    "mdf": (".mdf", ".mf4", ".mf3"),
    "tdms": (".tdms",),
    "excel": (".xlsx", ".xls", ".ods"),
}
_READ_ONLY = {".mdf": ".mf4", ".mf3": ".mf4", ".xls": ".xlsx", ".ods": ".xlsx"}  # and what is written in their place
SUFFIXES = tuple(suffix for suffixes in _READERS.values() for suffix in suffixes)


@names_missing_packages
def read_recorded(path: Path | str) -> Recorded:
    """The channels of a file. Raises RecordingError for what is no recording, MissingPackage for want of its reader."""
    path = Path(path)
    require_file(path, RecordingError)
    try:
        return _reader(path)(path)
    except (RecordingError, OSError, ImportError, MemoryError):
        raise
    except Exception as error:  # a damaged file may trip a library, or what is made of its content, anywhere
        said = f"{type(error).__name__}: {error}"
        raise RecordingError(f"{path}: damaged, or laid out as no recording is ({said})") from error


@names_missing_packages
def write_recorded(recorded: Recorded, path: Path) -> None:
    """Write the channels in the format of the path's suffix, whole or not at all. Raises RecordingError for others, and
    for a channel that would stand in the file as a second time, or has a name that no column can have."""
    kind, recorded = _kind(path), _without_guesses(recorded)
    if (instead := _READ_ONLY.get(path.suffix.lower())) is not None:
        raise RecordingError(f"{path}: {path.suffix} is read only; write {instead}")
    if unfit := [c.name for c in recorded.channels if not c.name.strip() or not c.name.isprintable()]:
        raise RecordingError(f"{path}: a channel cannot be called {unfit[0]!r} in a file: rename it")
    if second := [c.name for c in recorded.channels if c.name.lower() == "time"]:
        raise RecordingError(f"{path}: would have two columns called time: rename the channel {second[0]}")
    with whole_file(path) as partial:
        try:
            import_module(f"lacuna.analysis.recording.{kind}").write(recorded, partial)
        except (RecordingError, OSError, ImportError):
            raise
        except Exception as error:  # every library has errors of its own for a disk that is full
            raise RecordingError(f"{path}: cannot be written: {error}") from error


def _without_guesses(recorded: Recorded) -> Recorded:
    """A unit that was only inferred from the end of a name stays there: written as one, it would be believed."""
    said = [replace(c, name=c.head.text, unit="") if c.unit and not c.head.sure else c for c in recorded.channels]
    return replace(recorded, channels=tuple(said))


def _reader(path: Path) -> Reader:
    with path.open("rb") as file:
        kind = "mdf" if file.read(8) == b"MDF     " else ""
    return import_module(f"lacuna.analysis.recording.{kind or _kind(path)}").read


def _kind(path: Path) -> str:
    kind = next((name for name, suffixes in _READERS.items() if path.suffix.lower() in suffixes), None)
    if kind is None:
        raise RecordingError(f"{path}: no format is known by `{path.suffix}`; there are {' '.join(SUFFIXES)}")
    return kind
