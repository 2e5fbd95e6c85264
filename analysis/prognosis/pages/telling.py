"""What is said of a forecast: the sentence, and the entry of forecast.json."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

import numpy as np

from lacuna.analysis.prognosis.forecast import Forecast
from lacuna.analysis.prognosis.verdict import FORECAST, STEADY

FORMAT = 1  # of forecast.json
NAMED = 24  # parts that an action names: who is told to remove must not look them up


def sentence(f: Forecast, risk: float) -> str:
    """For the technician: what remains, how sure, and until when."""
    who = f"Actuator {whom(f.history.actuator, f.history.fault)}"
    unit, limit = f.history.unit, f.limits.names[-1]
    if f.verdict == STEADY:
        return f"{who} is steady: {f.reason}."
    if f.verdict != FORECAST:
        return f"{who}: too early to say; {f.reason}."
    low95, low, median, high, high95 = f.quantiles[-1]
    if median <= 0:
        return f"{who} has reached {limit}: remove it now."
    wide = f"80 % sure: {use(low)} to {use(high)}; 95 %: {use(low95)} to {use(high95)}"
    text = f"{who} reaches {limit} in {use(median)} {unit} ({wide})."
    if f.advised is None:
        return f"{text} The risk stays below {100 * risk:g} % as far as tests are listed."
    if f.advised <= f.at:
        return f"{text} Remove it now: at the next test the risk of {limit} is above {100 * risk:g} %."
    return f"{text} Until the test at {_grouped(f.advised, 6)} {unit} the risk of {limit} stays below {100 * risk:g} %."


@dataclass(frozen=True)
class Advice:
    """Of one actuator (and fault): its last advised test, None where there is none as far as is listed; `at` is the
    use at its last test."""

    who: str
    advised: float | None
    at: float
    unit: str


def whom(actuator: str, fault: str) -> str:
    return f"{actuator} ({fault})" if fault else actuator


def removals(
    advised: Sequence[Advice], count: int, beyond: Sequence[str] = (), limit: str = "", risk: float | None = None
) -> tuple[str, str]:
    """(verdict, next action) over `count` parts: `advised` are those with a forecast, `beyond` those that read beyond
    the last limit and cannot be forecast; `limit` is the name of that limit, `risk` what is taken of it."""
    now = [a.who for a in advised if a.advised is not None and a.advised <= a.at]
    is_or_are = f"{'actuator' if count == 1 else 'actuators'} {'is' if count == 1 or len(now) == 1 else 'are'}"
    whose = "its" if len(now) == 1 else "their"
    why = f": at {whose} next test the risk of {limit} is above {100 * risk:g} %" if limit and risk else ""
    verdict = f"{len(now)} of {count} {is_or_are} to be removed now{why if now else ''}."
    due = [f"remove {_some(now)}"] * bool(now)
    due += [f"repeat the test of {_some(beyond)}, or remove: it reads beyond the last limit"] * bool(beyond)
    if due:
        return verdict, "; ".join(due)
    left = [(a.advised - a.at, a) for a in advised if a.advised is not None]
    if not left:
        return verdict, "go on testing: no removal is due as far as tests are listed"
    soonest, part = min(left, key=lambda pair: pair[0])
    last = f"{_grouped(part.advised or 0, 6)} {part.unit}"
    return (
        verdict,
        f"go on testing; {part.who} is the first to be removed, after its test at {last} (in {use(soonest)})",
    )


def _some(names: Sequence[str]) -> str:
    more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
    return ", ".join(names[:NAMED]) + more


def use(value: float) -> str:
    """Three digits, and no parts of a cycle from ten of them on; what lies beyond the horizon is said so."""
    if not math.isfinite(value):
        return "beyond the horizon"
    return _grouped(round(value) if abs(value) >= 10 else value, 3)


def _grouped(value: float, digits: int) -> str:
    """Thousands apart by a space that breaks no line."""
    return f"{float(f'{value:.{digits}g}'):,.10g}".replace(",", "\N{NO-BREAK SPACE}")


def entry(f: Forecast, risk: float) -> dict:
    """The actuator's part of forecast.json; the format is described in docs/guide."""
    return {
        "verdict": f.verdict,
        "sentence": sentence(f, risk),
        "reason": f.reason,
        "unit": f.history.unit,
        "at": f.at,
        "tests": int(np.isfinite(f.history.severity[f.history.lives[-1]]).sum()),
        "horizon": f.horizon,
        "severity": {"value": f.severity[0], "low": f.severity[0] - 1.96 * f.severity[1],
                     "high": f.severity[0] + 1.96 * f.severity[1]},
        **{name: _limit(row) for name, row in zip(f.limits.names, told_quantiles(f), strict=True)},
        "probability": [
            {f.history.unit: float(n), **{name: float(p) for name, p in zip(f.limits.names, column, strict=True)}}
            for n, column in zip(f.ahead, f.risk.T, strict=True) if f.tells
        ],
        "advised_last_test": f.advised,
        "risk": risk,
        "law": {"name": next(iter(f.weights)), "weights": f.weights},
        "warnings": list(f.warnings),
    }  # fmt: skip


def told_quantiles(f: Forecast) -> np.ndarray:
    """[limits, levels], inf where nothing may be told: nobody plans by what contradicts itself."""
    return f.quantiles if f.tells else np.full_like(f.quantiles, np.inf)


def _limit(row: np.ndarray) -> dict:
    low95, low, median, high, high95 = (float(v) if np.isfinite(v) else None for v in row)
    return {"median": median, "interval80": [low, high], "interval95": [low95, high95]}


def forecast_json(said: Sequence[Forecast], risk: float, version: str) -> dict:
    """The content of forecast.json; a second fault of an actuator stands under `faults` of the first."""
    actuators: dict[str, dict] = {}
    for f in said:
        own = entry(f, risk)
        if f.history.actuator in actuators:
            actuators[f.history.actuator].setdefault("faults", {})[f.history.fault] = own
        else:
            actuators[f.history.actuator] = own | ({"fault": f.history.fault} if f.history.fault else {})
    return {"format": FORMAT, "version": version, "actuators": actuators}


def urgency(f: Forecast) -> tuple:
    """Sorts by risk: forecasts by the use left to the last advised test, then those without one by their median, then
    what is too early to say, then what is steady."""
    order = {"forecast": 0, "too_early": 1, "steady": 2}
    left = math.inf if f.advised is None else f.advised - f.at
    return order[f.verdict], left, float(f.quantiles[-1, 2] / max(f.horizon, 1e-300)), f.history.actuator


def counted_verdicts(said: Sequence[Forecast]) -> str:
    count = {v: sum(f.verdict == v for f in said) for v in ("forecast", "too_early", "steady")}
    return f"{count['forecast']} forecast, {count['too_early']} too early to say, {count['steady']} steady."
