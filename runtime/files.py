"""Results in files: `<run>.csv` with `<run>.meta.json` beside it, and MATLAB .mat for large signals."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
import json
import os
from pathlib import Path
import tempfile

import numpy as np

from lacuna.runtime.errors import SimulationError
from lacuna.runtime.result import Result

FORMAT = "lacuna-result-1"


def _replace(path: Path, write: Callable[[Path], None]) -> None:
    """Write to a temporary file in the same folder, then rename: nobody sees half a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    os.close(handle)
    temporary = Path(name)
    try:
        write(temporary)
        temporary.chmod(0o644)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def metadata(result: Result) -> dict:
    """What meta.json says: units, kinds, parameters, solver, counters, event log, completeness."""
    variables = {name: result.model.variables[name] for name in result.columns}
    return {
        "format": FORMAT,
        "model": result.model.name,
        "model_hash": result.model.hash,
        "complete": result.complete,
        "failure": asdict(result.failure) if result.failure else None,
        "terminated": result.terminated,
        "solver": result.settings,
        "columns": {
            "time": {"unit": "s", "description": "time", "kind": "time"},
            **{n: {"unit": v.unit, "description": v.description, "kind": v.kind} for n, v in variables.items()},
        },
        "parameters": result.parameters,
        "counters": result.counters,
        "events": [asdict(entry) for entry in result.event_log],
    }


def meta_path(path: Path) -> Path:
    return path.with_name(path.name.removesuffix(".csv") + ".meta.json")


def write_csv(result: Result, path: str | Path) -> Path:
    """Write `path` (17 digits: every double survives; last column `event` 0/1) and its .meta.json."""
    path = Path(path)
    table = np.column_stack([result.time, *(result[name] for name in result.columns), result.event])
    header = ",".join(_field(name) for name in ("time", *result.columns, "event"))
    formats = ["%.17g"] * (table.shape[1] - 1) + ["%d"]
    _replace(path, lambda p: np.savetxt(p, table, fmt=formats, delimiter=",", header=header, comments=""))
    text = json.dumps(_finite(metadata(result)), indent=1, ensure_ascii=False) + "\n"
    _replace(meta_path(path), lambda p: p.write_text(text, encoding="utf-8"))
    return path


def _field(name: str) -> str:
    """Names with a comma (array elements of two indices) are quoted, as CSV asks."""
    return f'"{name}"' if "," in name else name


def _finite(value: object) -> object:
    """JSON has no NaN or infinity: they become null."""
    if isinstance(value, dict):
        return {k: _finite(v) for k, v in value.items()}
    if isinstance(value, list):
        return [_finite(v) for v in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value


def read_csv(path: str | Path) -> tuple[dict[str, np.ndarray], dict]:
    """Columns by name (with `time` and, where there is one, `event`) and the metadata ({} where there is none).

    Raises SimulationError naming file and line or column where the file is not such a table.
    """
    import csv

    path = Path(path)
    with path.open(newline="", encoding="utf-8") as file:
        header = next(csv.reader(file), [])
    if not header or header[0] != "time":
        raise SimulationError(f"{path}: the first column must be called time")
    if len(set(header)) != len(header):
        raise SimulationError(f"{path}: two columns have the same name")
    try:
        table = np.genfromtxt(path, delimiter=",", skip_header=1, ndmin=2)
    except ValueError as error:
        raise SimulationError(f"{path}: {error}") from error
    if table.size and table.shape[1] != len(header):
        raise SimulationError(f"{path}: {len(header)} names for {table.shape[1]} columns")
    columns = table.T if table.size else np.empty((len(header), 0))
    meta = meta_path(path)
    return dict(zip(header, columns, strict=True)), json.loads(meta.read_text("utf-8")) if meta.exists() else {}


def write_mat(result: Result, path: str | Path) -> Path:
    """A MATLAB 5 file, which MATLAB, Octave, scipy.io.loadmat and Modelica tools' readers open.

    `time` [n], `event` [n], `names` (full names), `units`, and `data` [n, len(names)] in their order. Names such as
    gear.phi_rel are no MATLAB identifiers, hence the table of names.
    """
    from scipy.io import savemat

    path = Path(path)
    columns = result.columns
    data = np.column_stack([result[name] for name in columns]) if columns else np.empty((len(result), 0))
    content: Mapping[str, object] = {
        "time": result.time,
        "event": result.event.astype(np.uint8),
        "names": np.array(columns, dtype=object),
        "units": np.array([result.model.variables[name].unit for name in columns], dtype=object),
        "data": data,
        "model": result.model.name,
        "complete": result.complete,
    }
    _replace(path, lambda p: savemat(p, content, appendmat=False, oned_as="column", do_compression=True))
    return path
