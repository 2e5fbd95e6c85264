"""Results in files: `<run>.csv` or `<run>.parquet` with `<run>.meta.json` beside it (for .mat: modelica_mat.py)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
import json
from pathlib import Path

import numpy as np

from lacuna.given import json_of
from lacuna.runtime.errors import SimulationError
from lacuna.runtime.model import Variable
from lacuna.runtime.result import Result
from lacuna.written import whole_files

FORMAT = "lacuna-result-1"
_CHUNK = 4096  # rows that are turned into text at once


def metadata(result: Result, names: Sequence[str] | None = None) -> dict:
    """What meta.json says: units, kinds, parameters, solver with the tolerances used, counters, event log, whether the
    run is complete. `names` are the columns of the file (default: those that the run recorded)."""
    variables = {name: result.model.variables[name] for name in (result.columns if names is None else names)}
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
            **{n: _column(v) for n, v in variables.items()},
        },
        "parameters": result.parameters,
        "counters": result.counters,
        "events": [asdict(entry) for entry in result.event_log],
    }


def _column(v: Variable) -> dict:
    inferred = {"unit_inferred": True} if v.inferred_unit and not v.unit else {}
    return {"unit": v.shown_unit, "description": v.description, "kind": v.kind} | inferred


def meta_path(path: Path) -> Path:
    return path.with_name(path.name.removesuffix(path.suffix) + ".meta.json")


@contextmanager
def with_metadata(result: Result, path: Path, names: Sequence[str]) -> Iterator[Path]:
    """Where to write what then stands at `path`, together with its .meta.json."""
    with whole_files(path.parent) as scratch:
        yield scratch / path.name
        text = json.dumps(_finite(metadata(result, names)), indent=1, ensure_ascii=False) + "\n"
        meta_path(scratch / path.name).write_text(text, encoding="utf-8")


def write_csv(result: Result, path: str | Path, names: Sequence[str] | None = None) -> Path:
    """Write `path` and its .meta.json: `time`, `names` (default: what was recorded), and `event`, 1 at rows that were
    added at an event, where there are any. Each number has the fewest digits that read back exactly."""
    path = Path(path)
    names = result.columns if names is None else list(names)
    columns = [result.time, *(result[name] for name in names)]
    ending = [f",{flag:d}\n" for flag in result.event] if result.event.any() else ["\n"] * len(result)
    header = ["time", *map(_field, names), *(["event"] if result.event.any() else [])]
    with with_metadata(result, path, names) as place, place.open("w", encoding="utf-8") as file:
        file.write(",".join(header) + "\n")
        for k in range(0, len(result), _CHUNK):
            rows = zip(*(column[k : k + _CHUNK].tolist() for column in columns), strict=True)
            file.writelines(",".join(map(_number, row)) + ending[k + i] for i, row in enumerate(rows))
    return path


def write_parquet(result: Result, path: str | Path, names: Sequence[str] | None = None) -> Path:
    """The same columns as Parquet, units and descriptions in the metadata of its fields; and the .meta.json."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    path = Path(path)
    names = result.columns if names is None else list(names)
    fields, arrays = [pa.field("time", pa.float64(), metadata={"unit": "s"})], [pa.array(result.time)]
    for name in names:
        v = result.model.variables[name]
        fields.append(pa.field(name, pa.float64(), metadata={"unit": v.shown_unit, "description": v.description}))
        arrays.append(pa.array(result[name]))
    if result.event.any():
        fields.append(pa.field("event", pa.bool_()))
        arrays.append(pa.array(result.event))
    table = pa.Table.from_arrays(arrays, schema=pa.schema(fields))
    with with_metadata(result, path, names) as place:
        pq.write_table(table, place, compression="zstd")
    return path


def _number(value: float) -> str:
    """The shortest text that reads back as `value`; whole numbers without a fraction."""
    return f"{value:.0f}" if value.is_integer() and abs(value) < 1e15 else repr(value)


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


def read_metadata(path: Path) -> dict:
    """What the .meta.json beside `path` says; {} where there is none, or where it is not one of ours.

    Raises SimulationError where it is damaged.
    """
    meta = meta_path(path)
    if not meta.exists():
        return {}
    said = json_of(meta, SimulationError)
    ours = isinstance(said, dict) and said.get("format") == FORMAT and isinstance(said.get("columns"), dict)
    return said if ours else {}
