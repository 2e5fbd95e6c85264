"""A fleet: forecasts of very many histories, in chunks on Dask, one row an actuator.

A chunk is kept as a Parquet file named by what decides its content, so that a killed run goes on where it stopped,
and ends with the same bytes: nothing is drawn at random.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
import hashlib
import os
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from lacuna.analysis.campaign.tasks import callers_script_left_out, finished
from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.files import has_part, read_part, write_part
from lacuna.analysis.prognosis.doubts import UNITS, doubts_of
from lacuna.analysis.prognosis.filter.bank import Bank
from lacuna.analysis.prognosis.forecast import Forecast, Limits, Options, fleet_prior, forecasts
from lacuna.analysis.prognosis.history import History, refuse_slips
from lacuna.written import whole_file

CHUNK = 512  # histories: some seconds of work
ORDER = {"forecast": 0, "too_early": 1, "steady": 2}
Progress = Callable[[int, int], None]


def histories_of(table: pa.Table, name: str) -> list[History]:
    """Histories of a table that has severities throughout, column by column. Raises AnalysisError as
    `read_histories` does."""
    refuse_slips(name, table.column_names)
    unit = next((u for u in UNITS if u in table.column_names and not table[u].null_count), None)
    missing = [c for c in ("actuator", "severity", "low", "high") if c not in table.column_names]
    if missing or unit is None:
        raise AnalysisError(
            f"{name}: column {missing[0] if missing else 'cycles (or hours)'} is missing or not complete"
        )
    fault = _text(table, "fault")
    actuator = _text(table, "actuator")
    use, severity, low, high = (_numbers(table, c, name) for c in (unit, "severity", "low", "high"))
    event, other_unit = _text(table, "event"), UNITS[1 - UNITS.index(unit)]
    other = _numbers(table, other_unit, name) if other_unit in table.column_names else np.full(len(table), np.nan)
    _check(name, unit, actuator, use, severity, low, high, event)
    key = np.char.add(np.char.add(actuator, "\0"), fault)
    order = np.argsort(key, kind="stable")  # rows of one actuator in the table's order, which must be that of use
    starts = np.flatnonzero(np.concatenate([[True], key[order][1:] != key[order][:-1]]))
    result = []
    for a, b in zip(starts, [*starts[1:], len(order)], strict=True):
        rows = order[a:b]
        if np.any(np.diff(use[rows]) <= 0):
            k = int(rows[1:][np.diff(use[rows]) <= 0][0])
            raise AnalysisError(f"{name}:{k + 1}: {unit} do not increase for actuator {actuator[k]}")
        doubts = doubts_of(name, rows + 1, use[rows], other[rows], unit)
        result.append(
            History(str(actuator[rows[0]]), unit, use[rows], severity[rows], low[rows], high[rows],
                    event[rows] == "replaced", str(fault[rows[0]]), (), doubts)
        )  # fmt: skip
    return result


def _text(table: pa.Table, name: str) -> np.ndarray:
    if name not in table.column_names:
        return np.full(len(table), "")
    return np.array(pc.fill_null(pc.cast(table[name], pa.string()), "").to_pylist(), dtype=str)


def _numbers(table: pa.Table, name: str, where: str) -> np.ndarray:
    try:
        return pc.cast(table[name], pa.float64()).to_numpy(zero_copy_only=False).astype(float)
    except pa.ArrowException as error:
        raise AnalysisError(f"{where}: {name}: {error}") from None


def _check(name, unit, actuator, use, severity, low, high, event) -> None:
    with np.errstate(invalid="ignore"):
        for wrong, reason in [
            (actuator == "", "actuator is empty"),
            (~np.isfinite(use) | (use < 0), f"{unit} must be a finite number from 0 on"),
            (np.isinf(severity), "severity is not finite"),
            (~np.isnan(severity) & ~((low <= severity) & (severity <= high)), "severity lies outside its own interval"),
            (np.isnan(severity) & ~(np.isnan(low) & np.isnan(high)), "low and high without their severity"),
            (~np.isin(event, ("", "replaced")), "event is neither empty nor 'replaced'"),
        ]:
            if wrong.any():
                raise AnalysisError(f"{name}:{int(np.flatnonzero(wrong)[0]) + 1}: {reason}")


@dataclass(frozen=True)
class FleetWork:
    """What every worker needs."""

    bank: Bank
    limits: dict[str, Limits]  # by fault
    options: Options

    def key(self) -> bytes:
        digest = hashlib.sha256()
        for law in self.bank.laws:
            digest.update(repr((law.label, law.wander, law.diffusion)).encode() + law.growth.tobytes())
        digest.update(repr((self.bank.settings, sorted(self.limits.items()), self.options)).encode())
        digest.update(self.bank.prior.tobytes())
        for fault, scatter in sorted(self.bank.scatter.items()):
            digest.update(
                repr((fault, scatter.stated)).encode() + scatter.severity.tobytes() + scatter.spread.tobytes()
            )
        return digest.digest()


def run_fleet(
    histories: Sequence[History],
    work: FleetWork,
    folder: Path,
    *,
    scheduler: str | None = None,
    learn: bool = True,
    progress: Progress | None = None,
) -> pa.Table:
    """One row a history, those at greatest risk first; also in folder/fleet.parquet.

    `scheduler`: address of a Dask scheduler; by default workers of this machine, one a core. With `learn`, ended
    lives tell the prior first. Raises AnalysisError where a history is refused.
    """
    from lacuna.analysis.prognosis.forecast import check_range

    for h in histories:
        check_range(h, work.limits[h.fault])
    if learn:
        fleet_prior(histories, work.bank, lambda h: work.limits[h.fault])
    parts = folder / "parts"
    parts.mkdir(parents=True, exist_ok=True)
    pieces = [histories[k : k + CHUNK] for k in range(0, len(histories), CHUNK)]
    key = work.key()
    paths = [parts / f"{k:06d}-{_hash(key, piece)}.parquet" for k, piece in enumerate(pieces)]
    todo = [k for k, path in enumerate(paths) if not has_part(path)]
    done = len(pieces) - len(todo)
    for k, table in _results(work, pieces, todo, scheduler):
        write_part(paths[k], table)
        done += 1
        if progress:
            progress(done, len(pieces))
    whole = pa.concat_tables([read_part(path) for path in paths])
    whole = by_risk(whole).drop_columns("order")
    with whole_file(folder / "fleet.parquet") as partial:
        pq.write_table(whole, partial)
    return whole


def by_risk(table: pa.Table) -> pa.Table:
    """Forecasts first: by the use that is left to the last advised test, those without one (further than is listed)
    after them by their median; then what is too early to say, then what is steady."""
    left = pc.subtract(table["advised_last_test"], table["at"])
    keys = [("order", "ascending"), ("left", "ascending"), ("median", "ascending"), ("actuator", "ascending")]
    return table.append_column("left", left).sort_by(keys).drop_columns("left")


def _hash(key: bytes, piece: Sequence[History]) -> str:
    digest = hashlib.sha256(key)
    for h in piece:
        digest.update(f"{h.actuator}\0{h.fault}\0{h.unit}\0".encode())
        for values in (h.use, h.severity, h.low, h.high, h.replaced):
            digest.update(values.tobytes())
    return digest.hexdigest()[:20]


def _results(work: FleetWork, pieces, todo: list[int], scheduler: str | None) -> Iterator[tuple[int, pa.Table]]:
    """(chunk, its rows) as they are finished. One chunk is sooner done here than workers are started."""
    if len(todo) < 2 and not scheduler:
        yield from ((k, rows_of(pieces[k], work)) for k in todo)
        return
    from lacuna.analysis.campaign.clients import client_of

    with ExitStack() as opened:
        if not scheduler:
            opened.enter_context(callers_script_left_out())
        processes = {"n_workers": min(os.cpu_count() or 1, len(todo)), "threads_per_worker": 1}
        client = opened.enter_context(client_of(scheduler, **processes))
        shared = client.scatter(work, broadcast=True)
        yield from finished(client, lambda k: client.submit(rows_of, pieces[k], shared, pure=False, retries=2), todo)


def rows_of(piece: Sequence[History], work: FleetWork) -> pa.Table:
    """What a worker does with a chunk."""
    said = forecasts(piece, work.bank, lambda h: work.limits[h.fault], work.options, learn=False)
    return pa.Table.from_pylist([_row(f) for f in said], schema=SCHEMA)


_NUMBERS = ("at", "severity", "median", "low95", "low80", "high80", "high95", "advised_last_test", "risk_next")
SCHEMA = pa.schema(
    [
        *((name, pa.string()) for name in ("actuator", "fault", "verdict", "unit", "law", "warnings")),
        ("order", pa.int8()),
        *((name, pa.float64()) for name in _NUMBERS),
    ]
)


def _row(f: Forecast) -> dict:
    told = np.isfinite(f.quantiles[-1]) & f.tells
    low95, low80, median, high80, high95 = (float(v) if t else None for v, t in zip(f.quantiles[-1], told, strict=True))
    return {
        "actuator": f.history.actuator, "fault": f.history.fault, "verdict": f.verdict, "order": ORDER[f.verdict],
        "unit": f.history.unit, "at": f.at, "severity": f.severity[0], "median": median, "low95": low95, "low80": low80,
        "high80": high80, "high95": high95, "advised_last_test": f.advised,
        "risk_next": float(f.risk[-1, 0]) if f.tells and f.risk.shape[1] else None, "law": next(iter(f.weights)),
        "warnings": "; ".join(f.warnings),
    }  # fmt: skip
