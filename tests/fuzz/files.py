"""python -m tests.fuzz.files [--seconds 180] [--seed 1] [NAME ...]: files of strangers, mutated, given to the commands.

Each file is one that its command takes; bytes, numbers, tokens, lines and encodings of it are changed. What must come
out is a result or one line that begins with "error", within PATIENCE: no fault of Lacuna, no exception, no hang.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
import os
from pathlib import Path
import random
import re
import shutil
import signal
import sys
import tempfile
import time
import traceback

from typer.testing import CliRunner

import lacuna
from lacuna.analysis.comparison.scenarios import DEFAULT_FILE
from lacuna.analysis.prognosis.store import Entry, Store
from lacuna.analysis.settings import PAPER, load_settings
from lacuna.cli.main import app
from lacuna.errors import is_user_error
from tests.analysis.plants import prepare_small_map
from tests.faults.scenarios import DECAY, EXAMPLES, HISTORY

PATIENCE = 30  # s, of one call; the slowest takes two where nothing else runs
_RECORDING = "time,x\n" + "".join(f"{0.01 * k:.2f},{0.99**k:.6f}\n" for k in range(60))
_DRIVEN = DECAY.replace("Decay", "Driven").replace("-k*x", "u - k*x").replace("Real x", "input Real u;\n  Real x")
_COLUMN = """model Column
  function csvColumn input String f; input String c; output Real v[:]; external "builtin"; end csvColumn;
  parameter Real v[:] = csvColumn("column.csv", "x");
  Real x = sum(v)*time;
end Column;
"""
_SPICE = (
    b"nan", b"inf", b"-inf", b"1e999", b"-1", b"0", b"1e308", b"1e-320", b"9" * 400, b"1_0", b"0x1", b"\xef\xbb\xbf",
    b"\x00", b"\xff\xfe", b"\r", b"\n\n", b",", b";", b"\t", b'"', b"'", b"[", b"]", b"{}", b"[]", b"#", b"=", b"true",
    b"null", b"\\u0000", "\u0661".encode(), "é".encode("latin-1"), b"../../etc/passwd", b"[[", b"time", b"x" * 3000,
    b"2024-01-01T00:00:00Z",
)  # fmt: skip
_TOKEN = re.compile(rb"[A-Za-z_]\w*|[-+]?\d[\d.]*(?:[eE][-+]?\d+)?|\s+|.", re.DOTALL)


def mutate(content: bytes, dice: random.Random) -> bytes:
    """A few changes: of bytes where it is binary, of tokens and lines where it is text."""
    kind = dice.random()
    if kind < 0.06:
        return dice.choice((b"", content[: len(content) // 2], content * 2, content.replace(b"\n", b"\r\n")))
    if kind < 0.12:
        text = content.decode("utf-8", "replace")
        return text.encode(dice.choice(("utf-16", "utf-16-le", "utf-8-sig", "utf-32")), "replace")
    if b"\0" in content[:2000]:
        changed = bytearray(content)
        for _ in range(dice.choice((1, 2, 8, 64))):
            changed[dice.randrange(len(changed))] = dice.choice((0, 1, 0x7F, 0x80, 0xFF, dice.randrange(256)))
        return bytes(changed)
    pieces = _TOKEN.findall(content)
    for _ in range(dice.choice((1, 1, 2, 5))):
        at, other = dice.randrange(len(pieces)), dice.randrange(len(pieces))
        action = dice.randrange(5)
        if action == 0:
            pieces[at] = dice.choice(_SPICE)
        elif action == 1:
            pieces.insert(at, dice.choice(_SPICE))
        elif action == 2:
            pieces[at], pieces[other] = pieces[other], pieces[at]
        elif action == 3:
            del pieces[at : at + dice.randrange(1, 20)]
        else:
            pieces[at:at] = pieces[other : other + dice.randrange(1, 30)]
        pieces = pieces or [b" "]
    return b"".join(pieces)


@dataclass(frozen=True)
class Target:
    """`file` is mutated; then `words` are given to the command line, or `call` is called with the folder."""

    file: str
    words: tuple[str, ...] = ()
    call: Callable[[Path], object] | None = None


def _open(place: Path) -> object:
    return lacuna.open_case(place / "missing-physics")


ASSESS = ("assess", "test.csv", "--map", "map", "--out", "out")
TARGETS = {
    "input": Target("u.csv", ("simulate", "Driven.mo", "-u", "u=u.csv:x", "--out", "out")),
    "convert-csv": Target("rec.csv", ("convert", "rec.csv", "out/a.csv")),
    "convert-meta": Target("Decay.meta.json", ("convert", "Decay.csv", "out/a.csv")),
    "convert-mat": Target("rec.mat", ("convert", "rec.mat", "out/a.csv")),
    "convert-parquet": Target("rec.parquet", ("convert", "rec.parquet", "out/a.csv")),
    "convert-xlsx": Target("rec.xlsx", ("convert", "rec.xlsx", "out/a.csv")),
    "convert-mf4": Target("rec.mf4", ("convert", "rec.mf4", "out/a.csv")),
    "convert-tdms": Target("rec.tdms", ("convert", "rec.tdms", "out/a.csv")),
    "csv-column": Target("column.csv", ("simulate", "Column.mo", "--out", "out")),
    "case-new": Target("rec.csv", ("case", "new", "Decay.mo", "rec.csv", "--out", "out")),
    "case": Target("missing-physics/case.toml", call=_open),
    "case-recording": Target("missing-physics/sine.csv", call=_open),
    "settings": Target("settings.toml", call=lambda place: load_settings(place / "settings.toml")),
    "against": Target("rec.csv", ("compare", "Decay.mo", "--against", "rec.csv", "--out", "out")),
    "forecast": Target("history.csv", ("forecast", "history.csv", "--out", "out")),
    "fleet": Target("history.csv", ("fleet", "history.csv", "--out", "out")),
    "format": Target("Column.mo", ("format", "Column.mo")),
    "scenarios": Target("scenarios.toml", ("compare", "--scenarios", "scenarios.toml", "--only", "x", "--out", "out")),
    "laws": Target("Decay.mo", ("forecast", "history.csv", "--laws", "Decay.mo", "--out", "out")),
    "library": Target("Column.mo", ("check", "Driven.mo", "-L", "Column.mo")),
    "store": Target("tests.db", ("forecast", "tests.db", "--out", "out")),
    "store-fleet": Target("tests.db", ("fleet", "tests.db", "--out", "out")),
    "map-table": Target("map/severity.table", ASSESS),
    "map-expected": Target("map/expected.npz", ASSESS),
    "map-settings": Target("map/settings.toml", ASSESS),
    "map-bands": Target("map/settings.toml", ("forecast", "history.csv", "--map", "map", "--out", "out")),
    "assessed": Target("test.csv", ASSESS),
    "verify": Target("result/made-by.json", ("verify", "result")),
    "verify-meta": Target("result/Decay.meta.json", ("verify", "result")),
    "model": Target("Driven.mo", ("simulate", "Driven.mo", "-u", "u=1", "--out", "out")),
}  # fmt: skip


def lay_out(place: Path, prepared: Path) -> None:
    """What the commands read, as it should be; `prepared`: the folder of a prepared map."""
    for name, text in {
        "Decay.mo": DECAY, "Driven.mo": _DRIVEN, "Column.mo": _COLUMN, "rec.csv": _RECORDING, "u.csv": _RECORDING,
        "column.csv": _RECORDING, "history.csv": HISTORY, "settings.toml": PAPER.read_text(encoding="utf-8"),
        "scenarios.toml": DEFAULT_FILE.read_text(encoding="utf-8"),
    }.items():  # fmt: skip
        (place / name).write_text(text, encoding="utf-8")
    shutil.copytree(EXAMPLES / "missing-physics", place / "missing-physics")
    shutil.copy(EXAMPLES / "preflight" / "test.csv", place)
    shutil.copytree(prepared, place / "map")
    Store(place / "tests.db").append([
        Entry("left", 0.05 + 1e-4 * n, 0.04 + 1e-4 * n, 0.06 + 1e-4 * n, f"recording {n}", "map", "1", cycles=n)
        for n in range(0, 1500, 100)
    ])  # fmt: skip
    os.chdir(place)
    for words in (
        *(("convert", "rec.csv", f"rec.{suffix}") for suffix in ("mat", "parquet", "xlsx", "mf4", "tdms")),
        ("simulate", "Decay.mo", "--out", "result"),
    ):
        CliRunner().invoke(app, list(words))
    for suffix in ("csv", "meta.json"):
        shutil.copy(place / "result" / f"Decay.{suffix}", place)


def try_file(name: str, dice: random.Random | None, place: Path) -> str:
    """What came out of the file, mutated by `dice`, in a word. Raises for what must not."""
    target = TARGETS[name]
    path = place / target.file
    good = path.read_bytes() if dice else b""
    if dice:
        path.write_bytes(mutate(good, dice))
    signal.alarm(PATIENCE)
    try:
        return _call(target, place)
    finally:
        signal.alarm(0)
        if dice:
            path.write_bytes(good)
        shutil.rmtree(place / "out", ignore_errors=True)


def _call(target: Target, place: Path) -> str:
    if target.call is not None:
        try:
            target.call(place)
        except Exception as error:
            if is_user_error(error):
                return "refused"
            raise
        return "taken"
    result = CliRunner().invoke(app, list(target.words))
    if result.exit_code not in (0, 1, 2) or (result.exception and not isinstance(result.exception, SystemExit)):
        details = re.search(r"details: (\S+)", result.output)
        more = Path(details[1]).read_text(encoding="utf-8") if details else ""
        raise RuntimeError(f"status {result.exit_code}: {result.output[-600:]}\n{more[-1500:]}")
    return "refused" if result.exit_code else "taken"


def out_of_time(*_: object) -> None:
    raise TimeoutError(f"no end after {PATIENCE} s")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--seconds", type=float, default=180.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    signal.signal(signal.SIGALRM, out_of_time)
    kept = Path("out/fuzz/files").resolve()
    kept.mkdir(parents=True, exist_ok=True)
    outcomes, seed, end = Counter[str](), options.seed, time.monotonic() + options.seconds
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder).resolve()
        (place / "tests").mkdir()
        prepare_small_map(place / "tests")
        lay_out(place, place / "tests" / "map")
        names = [n for n in options.names or TARGETS if (place / TARGETS[n].file).exists()]
        while time.monotonic() < end:
            name = names[seed % len(names)]
            try:
                outcomes[f"{name} {try_file(name, random.Random(seed), place)}"] += 1
            except Exception as error:
                outcomes[f"{name} FAILED"] += 1
                said = f"seed {seed}, {name}: {type(error).__name__}: {error}\n{traceback.format_exc(limit=-4)}"
                with suppress(OSError):
                    (kept / f"{seed}_{name}.txt").write_text(said)
                print(said[-900:], file=sys.stderr, flush=True)
            seed += 1
    print(f"{outcomes.total()} files: " + ", ".join(f"{n} {what}" for what, n in sorted(outcomes.items())))
    return 1 if any(what.endswith("FAILED") for what in outcomes) else 0


if __name__ == "__main__":
    sys.exit(main())
