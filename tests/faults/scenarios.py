"""The commands that write, each with what it reads and what it leaves."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
import shutil

EXAMPLES = Path(__file__).parents[2] / "lacuna" / "examples"
HISTORY = "actuator,cycles,severity,low,high,event\n" + "".join(
    f"left,{n},{0.02 + 6e-5 * n:.5f},{0.015 + 6e-5 * n:.5f},{0.025 + 6e-5 * n:.5f},\n" for n in range(100, 3500, 200)
)
DECAY = """model Decay
parameter Real k = 1;
  Real x(start=1, fixed=true);
equation
  der(x) = -k*x;
end Decay;
"""


@dataclass(frozen=True)
class Scenario:
    """`together`: what it writes into `out` is all of one making. `fresh`: `out` must not be there before."""

    words: tuple[str, ...]
    out: str = "out"
    together: bool = True
    fresh: bool = False
    before: tuple[tuple[str, ...], ...] = ()  # commands whose results it reads
    cold: bool = False  # nothing is compiled yet
    slow: bool = False
    timed: str = ""  # files whose names hold this tell how long things took: other content each time


_SIMULATE = ("simulate", "Decay.mo", "--out", "out")
_PREPARE = ("maps", "--prepare", "--out", "map", "--settings", "settings.toml")
_CASE = "missing-physics"
SCENARIOS = {
    "compile": Scenario(_SIMULATE, cold=True),
    "simulate": Scenario((*_SIMULATE, "--event-rows")),
    "simulate-plot": Scenario((*_SIMULATE, "--plot"), together=False),
    "simulate-parquet": Scenario((*_SIMULATE, "--format", "parquet")),
    "simulate-mat": Scenario((*_SIMULATE, "--format", "mat")),
    "format": Scenario(("format", "place/Decay.mo"), out="place", fresh=True),
    "convert": Scenario(("convert", "Decay.csv", "out/test.mat"), fresh=True),
    "convert-parquet": Scenario(("convert", "Decay.csv", "out/test.parquet"), fresh=True),
    "convert-xlsx": Scenario(("convert", "Decay.csv", "out/test.xlsx"), fresh=True),
    "case": Scenario(("case", "new", "Decay.mo", "Decay.csv", "--out", "out"), fresh=True),
    "examples": Scenario(("examples", "out"), fresh=True),
    "fmu": Scenario(("fmu", "Decay.mo", "--out", "out/Decay.fmu")),
    "forecast": Scenario(("forecast", "history.csv", "--out", "out")),
    "fleet": Scenario(("fleet", "history.csv", "--out", "out"), together=False),
    "maps": Scenario(("maps", "--out", "out", "--settings", "settings.toml"), slow=True),
    "prepare": Scenario((*_PREPARE[:-4], "--out", "out", "--settings", "settings.toml"), together=False, slow=True),
    "assess": Scenario(("assess", "test.csv", "--map", "map", "--out", "out"), before=(_PREPARE,), slow=True),
    "assess-store": Scenario(
        ("assess", "test.csv", "--map", "map", "--out", "out", "--store", "x.db", "--actuator", "a", "--cycles", "7"),
        before=(_PREPARE,), slow=True,
    ),
    "sweep": Scenario(
        ("sweep", "--points", "8", "--chunk", "4", "--out", "out", "--settings", "settings.toml"), together=False,
        slow=True,
    ),
    "compare": Scenario(("compare", "Decay.mo", "--step", "0.01", "--out", "out"), slow=True, timed="precision"),
    "fit": Scenario(("fit", _CASE, "--out", "out"), together=False, slow=True),
    "explain": Scenario(("explain", _CASE, "--out", "out"), together=False, slow=True),
}  # fmt: skip


def lay_out(place: Path, settings: str) -> None:
    """What the commands read, in `place`."""
    for folder in ("place", "tmp", "cache"):
        (place / folder).mkdir(parents=True, exist_ok=True)
    (place / "Decay.mo").write_text(DECAY)
    (place / "place" / "Decay.mo").write_text(DECAY)
    (place / "history.csv").write_text(HISTORY)
    (place / "Decay.csv").write_text("time,x\n" + "".join(f"{0.01 * k:.2f},{0.99**k:.6f}\n" for k in range(100)))
    (place / "settings.toml").write_text(settings)
    shutil.copy(EXAMPLES / "preflight" / "test.csv", place)
    shutil.copytree(EXAMPLES / _CASE, place / _CASE, dirs_exist_ok=True)
