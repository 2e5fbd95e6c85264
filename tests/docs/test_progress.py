"""Long work tells what it does: every call of the public face that computes takes `progress`, and uses it."""

from __future__ import annotations

import inspect
from pathlib import Path

import pytest

import lacuna

# At once, as fast as a file is read, or as long as its client wants.
IMMEDIATE = {
    "check", "copy_examples", "default_settings", "degradation_laws", "dump", "export_fmu", "export_history",
    "format_file", "format_model", "is_user_error",
    "list_effects", "list_models", "list_solvers", "load", "message_of", "nearest", "open_case", "record_making",
    "recorded",
    "serve_editor", "watch",
}  # fmt: skip
MODEL = """model Tank
  input Real u(unit="m3/s", start=0);
  parameter Real A(unit="m2") = 1;
  Real h(unit="m", start=0, fixed=true);
equation
  A*der(h) = u;
  annotation(experiment(StopTime=3000, Interval=1));
end Tank;
"""


@pytest.fixture
def told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, float | None]]:
    monkeypatch.chdir(tmp_path)
    Path("Tank.mo").write_text(MODEL, encoding="utf-8")
    Path("log.csv").write_text(
        "time,u,h\n" + "".join(f"{t},{0.1 * (t % 7 < 3)},{0.01 * t + 0.001 * (t % 3)}\n" for t in range(60)), "utf-8"
    )
    return []


def test_every_call_that_computes_takes_progress() -> None:
    calls = {n: f for n in lacuna.__all__ if inspect.isfunction(f := getattr(lacuna, n)) and n not in IMMEDIATE}
    calls |= {f"Case.{n}": getattr(lacuna.Case, n) for n in ("fit", "locate", "name", "amend", "judge")}
    calls["Model.simulate"] = lacuna.Model.simulate
    assert [name for name, call in calls.items() if "progress" not in inspect.signature(call).parameters] == []


def test_a_run_tells_the_share_of_its_time(told: list[tuple[str, float | None]]) -> None:
    model = lacuna.load("Tank.mo")
    model.simulate(solver="rk4", step=1e-3, progress=lambda text, share: told.append((text, share)))
    shares = [share for _, share in told]
    assert {text for text, _ in told} == {"simulating Tank"}
    assert shares == sorted(shares)
    assert 0 < shares[0] <= shares[-1] == 1


def test_what_the_listener_raises_ends_the_run(told: list[tuple[str, float | None]]) -> None:
    def listener(text: str, share: float | None) -> None:
        raise RuntimeError("stop")

    with pytest.raises(RuntimeError, match="stop"):
        lacuna.load("Tank.mo").simulate(solver="rk4", step=1e-4, progress=listener)


def test_short_work_tells_what_it_does(told: list[tuple[str, float | None]]) -> None:
    lacuna.convert("log.csv", "log.parquet", progress=lambda text, share: told.append((text, share)))
    lacuna.new_case("Tank.mo", ["log.csv"], "case", progress=lambda text, share: told.append((text, share)))
    assert [text for text, _ in told] == ["reading log.csv", "writing log.parquet", "matching columns to variables"]
