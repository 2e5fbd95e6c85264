"""Assessments in a database: SQLite in a file, or any other that SQLAlchemy reaches.

A row is never changed and never stored twice: it is known by the recording's hash, the map's hash, the actuator and
the fault, and holds a checksum of its own. Where a newer map reads a recording otherwise, its row is added and the
older one kept; what counts is the latest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, fields
import hashlib
import json
from pathlib import Path
from typing import Any

import numpy as np
import sqlalchemy as sa
from sqlalchemy.exc import IntegrityError, SQLAlchemyError

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.doubts import UNITS, doubts_of
from lacuna.analysis.prognosis.history import EVENTS, History

WAIT = 30  # s, for another writer
LOCK = 0x1ACA  # of a PostgreSQL store while it is made or brought up to date

_tables = sa.MetaData()
_version = sa.Table("lacuna_history", _tables, sa.Column("version", sa.Integer, nullable=False))
_assessments = sa.Table(
    "lacuna_assessment",
    _tables,
    sa.Column("id", sa.Integer, primary_key=True, autoincrement=True),
    sa.Column("actuator", sa.String(200), nullable=False, index=True),
    sa.Column("fault", sa.String(100), nullable=False),
    sa.Column("cycles", sa.Double),
    sa.Column("hours", sa.Double),
    sa.Column("event", sa.String(20), nullable=False),
    sa.Column("severity", sa.Double, nullable=False),
    sa.Column("low", sa.Double, nullable=False),
    sa.Column("high", sa.Double, nullable=False),
    sa.Column("covariance", sa.Text, nullable=False),  # JSON, of the severities that one recording gives
    sa.Column("features", sa.Text, nullable=False),  # JSON
    sa.Column("recording", sa.String(64), nullable=False),  # SHA-256 of the file
    sa.Column("path", sa.Text, nullable=False),  # where the file was
    sa.Column("map", sa.String(64), nullable=False),  # SHA-256 of what decides an estimate
    sa.Column("version", sa.String(50), nullable=False),  # of Lacuna
    sa.Column("checksum", sa.String(64), nullable=False),  # SHA-256 of all these
    sa.UniqueConstraint("recording", "map", "actuator", "fault"),
)

NUMBERS = ("severity", "low", "high", "cycles", "hours")

Migration = Callable[[sa.Connection], None]


def _add_checksums(connection: sa.Connection) -> None:
    """Version 1 had none; what its rows hold is taken as it is."""
    if "checksum" in {column["name"] for column in sa.inspect(connection).get_columns(_assessments.name)}:
        return
    connection.execute(sa.text(f"ALTER TABLE {_assessments.name} ADD COLUMN checksum VARCHAR(64) DEFAULT '' NOT NULL"))
    for row in connection.execute(sa.select(_assessments)).mappings().all():
        own = _assessments.update().where(_assessments.c.id == row["id"])
        connection.execute(own.values(checksum=_checksum(row)))


# How a store of version k becomes one of version k + 1.
MIGRATIONS: list[Migration] = [
    lambda connection: _tables.create_all(connection, checkfirst=True),
    _add_checksums,
]


@dataclass(frozen=True)
class Entry:
    """One severity of one recording. `covariance` and `features` are what JSON can hold."""

    actuator: str
    severity: float
    low: float
    high: float
    recording: str
    map: str
    version: str
    fault: str = ""
    cycles: float | None = None
    hours: float | None = None
    event: str = ""
    covariance: object = None
    features: object = None
    path: str = ""

    def __post_init__(self):
        if not self.actuator or (self.cycles is None and self.hours is None):
            raise AnalysisError("an assessment to be stored needs its actuator, and its cycles or hours")
        if self.event not in EVENTS:
            raise AnalysisError(f"event is {self.event!r}; known is 'replaced', or nothing")
        for name in NUMBERS:  # a database may not know NumPy's
            if getattr(self, name) is not None:
                object.__setattr__(self, name, float(getattr(self, name)))
        numbers = [self.severity, self.low, self.high, self.cycles or 0.0, self.hours or 0.0]
        if self.low > self.high:
            raise AnalysisError(f"actuator {self.actuator}: low is {self.low:g}, above high, {self.high:g}")
        if not np.all(np.isfinite(numbers)) or min(numbers[3:]) < 0:
            raise AnalysisError(
                f"actuator {self.actuator}: an assessment to be stored holds finite numbers, use not below 0"
            )


class Store:
    """Opens, and where needed makes or brings up to date, the store at `url`; a path stands for a SQLite file.

    Raises AnalysisError where the database cannot be reached, is damaged, or was written by a newer version.
    """

    def __init__(self, url: str | Path):
        self.url = str(url)
        try:
            place = sa.make_url(self.url) if "://" in self.url else sa.URL.create("sqlite", database=self.url)
            own = {"timeout": WAIT} if place.get_backend_name() == "sqlite" else {}
            self._engine = sa.create_engine(place, connect_args=own)
        except (SQLAlchemyError, ModuleNotFoundError, ValueError) as error:
            raise AnalysisError(f"{_hidden(self.url)}: not a database that can be used: {error}") from None
        if own:
            sa.event.listen(self._engine, "connect", _leave_transactions_to_us)
            sa.event.listen(self._engine, "begin", lambda connection: connection.exec_driver_sql("BEGIN IMMEDIATE"))
        self._migrate()

    @contextmanager
    def _connection(self) -> Iterator[sa.Connection]:
        try:
            with self._engine.begin() as connection:
                yield connection
        except IntegrityError:
            raise
        except SQLAlchemyError as error:
            cause = str(getattr(error, "orig", None) or error).strip().splitlines()[0]
            raise AnalysisError(f"{_hidden(self.url)}: {cause}") from None

    def _migrate(self) -> None:
        with self._connection() as connection:
            if connection.dialect.name == "postgresql":  # SQLite's transactions exclude each other anyway
                connection.execute(sa.text(f"SELECT pg_advisory_xact_lock({LOCK})"))
            _version.create(connection, checkfirst=True)
            found = connection.execute(sa.select(sa.func.max(_version.c.version))).scalar() or 0
            if found > len(MIGRATIONS):
                raise AnalysisError(f"{_hidden(self.url)}: written by a newer Lacuna (format {found}); update this one")
            for number in range(found, len(MIGRATIONS)):
                MIGRATIONS[number](connection)
                connection.execute(_version.insert().values(version=number + 1))

    def append(self, entries: Sequence[Entry]) -> int:
        """Store what is not stored yet; how many that were. Many processes may write at once. Raises AnalysisError for
        a recording that is stored with another use or event: rows are never changed."""
        return sum(self._append_one(entry) for entry in entries)

    def _append_one(self, entry: Entry) -> bool:
        values = asdict(entry)
        for name in ("covariance", "features"):
            values[name] = json.dumps(values[name], sort_keys=True)
        try:
            with self._connection() as connection:
                connection.execute(_assessments.insert().values(**values, checksum=_checksum(values)))
        except IntegrityError:
            self._require_same_use(entry)
            return False
        return True

    def _require_same_use(self, entry: Entry) -> None:
        c, known = _assessments.c, ("recording", "map", "actuator", "fault")
        query = sa.select(c.cycles, c.hours, c.event).where(*(c[n] == getattr(entry, n) for n in known))
        with self._connection() as connection:
            row = connection.execute(query).mappings().one()
        for name, stored in row.items():
            if stored != getattr(entry, name):
                said = f"{name} {stored!r}, not {getattr(entry, name)!r}: what is stored is never changed"
                raise AnalysisError(f"{_hidden(self.url)}: actuator {entry.actuator}: this recording has {said}")

    def entries(self, *, all_maps: bool = False) -> list[Entry]:
        """In order of actuator, fault and use: the latest of each recording, or with `all_maps` every one."""
        c = _assessments.c
        query = sa.select(_assessments).order_by(c.actuator, c.fault, c.cycles, c.hours, c.id)
        with self._connection() as connection:
            rows = [dict(row._mapping) for row in connection.execute(query)]
        for row in rows:
            if not (row["checksum"] and _checksum(row) == row["checksum"]):
                place = f"row {row['id']} of {_assessments.name}"
                raise AnalysisError(f"{_hidden(self.url)}: damaged, or changed by something else: {place}")
        latest: dict[tuple, dict] = {}
        for number, row in enumerate(rows):
            key = number if all_maps else (row["actuator"], row["fault"], row["recording"])
            if key not in latest or latest[key]["id"] < row["id"]:
                latest[key] = row
        names = [f.name for f in fields(Entry)]
        kept = sorted(
            latest.values(), key=lambda r: (r["actuator"], r["fault"], r["cycles"] or 0, r["hours"] or 0, r["id"])
        )
        try:
            return [
                Entry(**{n: json.loads(row[n]) if n in ("covariance", "features") else row[n] for n in names})
                for row in kept
            ]
        except ValueError as error:
            raise AnalysisError(f"{_hidden(self.url)}: damaged: {error}") from None

    def histories(self, unit: str | None = None) -> list[History]:
        """What `forecasts` takes. Raises AnalysisError where use is not counted in one unit, or does not increase."""
        groups: dict[tuple[str, str], list[Entry]] = {}
        for entry in self.entries():
            groups.setdefault((entry.actuator, entry.fault), []).append(entry)
        if not groups:
            raise AnalysisError(f"{_hidden(self.url)}: there is no assessment in this store")
        return [_history(key, rows, unit, _hidden(self.url)) for key, rows in sorted(groups.items())]

    def outdated(self, map_hash: str) -> list[Entry]:
        """Latest entries that another map gave, whose recording is still where and what it was."""
        return [e for e in self.entries() if e.map != map_hash and e.path and file_hash(Path(e.path)) == e.recording]

    def export(self, path: Path) -> None:
        """Every entry as .csv or .parquet, so that `lacuna forecast` reads it."""
        import pyarrow as pa
        import pyarrow.csv
        import pyarrow.parquet as pq

        rows = [asdict(e) for e in self.entries()]
        for row in rows:
            row |= {name: json.dumps(row[name]) for name in ("covariance", "features")} | {"map_hash": row.pop("map")}
            row["recording_hash"] = row.pop("recording")
        table = pa.Table.from_pylist(rows)
        partial = path.with_name(f".{path.name}.partial")
        if path.suffix == ".parquet":
            pq.write_table(table, partial)
        elif path.suffix == ".csv":
            pa.csv.write_csv(table, partial)
        else:
            raise AnalysisError(f"{path}: a history is exported as .csv or .parquet")
        partial.replace(path)


def opened(url: str | Path) -> Store:
    """The store at `url`, to read it. Raises AnalysisError, too, where there is no such file: none is made."""
    if "://" not in str(url) and not Path(url).is_file():
        raise AnalysisError(f"{url}: there is no such store; `lacuna assess --store` makes one")
    return Store(url)


def _checksum(row: Mapping[str, Any]) -> str:
    """SHA-256 of what an entry holds; empty where a number is none."""
    held = {f.name: row[f.name] for f in fields(Entry)}
    for name in NUMBERS:
        if held[name] is None:
            continue
        if not isinstance(held[name], int | float):
            return ""
        held[name] = float(held[name])
    return hashlib.sha256(json.dumps(held, sort_keys=True).encode()).hexdigest()


def _history(key: tuple[str, str], rows: list[Entry], unit: str | None, where: str) -> History:
    complete = [u for u in UNITS if all(getattr(e, u) is not None for e in rows)]
    own = unit or (complete[0] if complete else "")
    if own not in complete:
        raise AnalysisError(f"{where}: actuator {key[0]}: {unit or 'cycles and hours'} are mixed or missing")
    rows = sorted(rows, key=lambda e: getattr(e, own))
    use = np.array([getattr(e, own) for e in rows])
    if np.any(np.diff(use) <= 0):
        k = int(np.flatnonzero(np.diff(use) <= 0)[0])
        raise AnalysisError(f"{where}: actuator {key[0]}: two recordings at {own} {use[k]:g}")
    columns = (np.array([getattr(e, name) for e in rows]) for name in ("severity", "low", "high"))
    other = np.array([getattr(e, UNITS[1 - UNITS.index(own)]) for e in rows], dtype=float)
    doubts = doubts_of(f"{where}: actuator {key[0]}: test", range(1, len(rows) + 1), use, other, own)
    return History(key[0], own, use, *columns, np.array([e.event == "replaced" for e in rows]), key[1], (), doubts)


def file_hash(path: Path) -> str:
    """SHA-256 of a file, empty where there is none."""
    try:
        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return ""


def _leave_transactions_to_us(connection, _record) -> None:
    connection.isolation_level = None  # the driver would begin them late, after the first reading


def _hidden(url: str) -> str:
    """Without the password."""
    try:
        return sa.make_url(url).render_as_string(hide_password=True)
    except SQLAlchemyError:
        return url.split("@")[-1]
