"""MAT files, version 5 by SciPy and 7.3 (HDF5) by h5py: vectors beside a vector of time, or a table with its names.

A table is what Lacuna writes (`time`, `names`, `units`, `data`), or a Modelica tool's result (`name`, `dataInfo`,
`data_2`).
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from lacuna.analysis.recording.channel import Recorded, RecordingError, as_reals, from_table, on_one_time

_HDF5 = b"\x89HDF\r\n\x1a\n"
_DESCRIPTION = 116  # bytes of text at the head of version 5


def read(path: Path) -> Recorded:
    content = _content(path)
    known = {name for name, value in content.items() if value is not None}
    if {"names", "data", "time"} <= known:
        names, units = _texts(content["names"]), _texts(content.get("units", []))
        if np.iscomplexobj(content["data"]):
            raise RecordingError(f"{path}: its data are complex; a recording is of real numbers")
        table, time = (
            np.atleast_2d(as_reals(path, "data", content["data"])),
            as_reals(path, "time", np.ravel(content["time"])),
        )
        columns = table.T if table.shape == (len(time), len(names)) else table
        if columns.shape != (len(names), len(time)):
            found = f"{len(names)} names, {len(time)} times and data of {' by '.join(map(str, table.shape))}"
            raise RecordingError(f"{path}: {found} do not go together")
        rows = np.vstack([time[None, :], columns])
        return from_table(path, ["time", *names], ["s", *(units or [""] * len(names))], rows)
    if {"name", "dataInfo", "data_2"} <= known:
        return _trajectories(path, content)
    return _vectors(path, content)


def _content(path: Path) -> dict[str, Any]:
    with path.open("rb") as file:
        newer = _HDF5 in file.read(1024)
    if newer:
        return _hdf5(path)
    from scipy.io import loadmat

    try:
        found = loadmat(path, chars_as_strings=True)
    except Exception as error:  # a damaged file may trip its parser anywhere
        raise RecordingError(f"{path}: not a MAT file that can be read: {error}") from None
    return {name: value for name, value in found.items() if not name.startswith("__")}


def _hdf5(path: Path) -> dict[str, Any]:
    import h5py

    content: dict[str, Any] = {}

    def keep(name: str, item: Any) -> None:
        if isinstance(item, h5py.Dataset) and not name.startswith("#"):
            numeric = item.dtype.kind in "fiub" and item.attrs.get("MATLAB_class") != b"char"
            content[name.replace("/", ".")] = (
                as_reals(path, name, item[()]).T if numeric else None
            )  # columns come first

    try:
        with h5py.File(path) as file:
            file.visititems(keep)
    except OSError as error:
        raise RecordingError(f"{path}: not a MAT file that can be read: {error}") from None
    return content


def _vectors(path: Path, content: dict[str, Any]) -> Recorded:
    """Vectors beside a vector of time, in the file or in one structure; of a matrix each column, numbered."""
    flat = _without_common_head(dict(_fields(content)))
    arrays = {n: v for n, v in flat.items() if isinstance(v, np.ndarray) and v.dtype.kind in "fiub" and v.size > 1}
    vectors = {n: as_reals(path, n, v.ravel()) for n, v in arrays.items() if v.size == max(v.shape)}
    if not vectors:
        raise RecordingError(f"{path}: holds no vectors of numbers; it has {', '.join(content) or 'nothing'}")
    lengths = {n: len(v) for n, v in vectors.items()}
    if len(set(lengths.values())) > 1:
        raise RecordingError(
            f"{path}: its vectors differ in length: " + ", ".join(f"{n} {k}" for n, k in lengths.items())
        )
    rows = next(iter(lengths.values()))
    for name, matrix in arrays.items():
        if name not in vectors and matrix.ndim == 2 and matrix.shape.count(rows) == 1:
            columns = matrix.T if matrix.shape[0] == rows else matrix
            vectors |= {f"{name}[{k}]": as_reals(path, name, column) for k, column in enumerate(columns, 1)}
    taken = {name.split("[")[0] for name in vectors}
    others = [name for name in flat if name not in vectors and name not in taken]
    return from_table(path, list(vectors), [""] * len(vectors), np.array(list(vectors.values())), others=others)


def _fields(content: dict[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """What is in a file or a structure of it, by dotted names."""
    for name, value in content.items():
        names = value.dtype.names if isinstance(value, np.ndarray) and value.size == 1 else None
        if names:
            inner = value.ravel()[0]
            yield from _fields({n: inner[n] for n in names}, f"{before}{name}.")
        else:
            yield before + name, value


def _without_common_head(flat: dict[str, Any]) -> dict[str, Any]:
    """Without the name of the one structure that holds everything."""
    heads = {name.partition(".")[0] for name in flat}
    inside = len(heads) == 1 and all("." in name for name in flat)
    return _without_common_head({n.partition(".")[2]: v for n, v in flat.items()}) if inside else flat


def _trajectories(path: Path, content: dict[str, Any]) -> Recorded:
    """The time-varying variables of a Modelica tool's result file (layout Aclass, version 1.1)."""
    info, data = np.asarray(content["dataInfo"], int), np.asarray(content["data_2"], float)
    if "binTrans" in "".join(_columns_of_text(content.get("Aclass", []))) + "".join(_texts(content.get("Aclass", []))):
        names, info = _columns_of_text(content["name"]), info.T
    else:
        names, data = _texts(content["name"]), data.T
    rows, kept = [], []
    for name, (table, column, *_rest) in zip(names, info, strict=True):
        if table in (0, 2):
            kept.append("time" if table == 0 or name.lower() == "time" else name)
            rows.append(np.sign(column or 1) * data[abs(column) - 1 if column else 0])
    return from_table(path, kept, ["s" if name == "time" else "" for name in kept], np.array(rows))


def _texts(value: Any) -> list[str]:
    """The texts of a cell array or of a matrix of characters."""
    texts = ((*np.ravel(text), "")[0] if isinstance(text, np.ndarray) else text for text in np.ravel(value))
    return [str(text).strip() for text in texts]


def _columns_of_text(matrix: Any) -> list[str]:
    """Names that run down the columns of a matrix of characters, as the transposed layout keeps them."""
    lines = [str(line) for line in np.ravel(matrix)]
    width = max(map(len, lines), default=0)
    padded = [line.ljust(width) for line in lines]
    return ["".join(column).replace("\0", "").strip() for column in zip(*padded, strict=True)]


def write(recorded: Recorded, path: Path) -> None:
    """Version 5: `time`, `names`, `units`, `data` [samples, channels]."""
    from scipy.io import savemat

    time, columns = on_one_time(recorded.channels)
    content = {
        "time": time,
        "names": np.array([c.name for c in recorded.channels], dtype=object),
        "units": np.array([c.unit for c in recorded.channels], dtype=object),
        "data": np.column_stack(columns),
    }
    savemat(path, content, appendmat=False, oned_as="column", do_compression=True)
    with path.open("r+b") as file:  # where scipy says what day it is
        file.write(b"MATLAB 5.0 MAT-file, written by lacuna".ljust(_DESCRIPTION))
