"""A quantity of `lacuna explain`, from one dated diagnosis to the next, as a severity: its share of the way to a limit.

A diagnosis.json gives the value of each parameter of the model, and of each effect that it found, with its standard
deviation. Nothing is said of a quantity in a diagnosis that does not name it: a missing test.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
import math
from pathlib import Path

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.forecast import Limits
from lacuna.analysis.prognosis.history import TWO_SIDED_95, History
from lacuna.analysis.prognosis.verdict import trend
from lacuna.given import json_of

FILE, CASE = "diagnosis.json", "case.toml"
SHARES = Limits(("limit",), (1.0,), -math.inf, math.inf)
Quantities = dict[str, tuple[float, float, float]]  # name: value, standard deviation, value of a healthy machine
Reading = tuple[str, float, float, float]


class Reader:
    """(quantity, severity, low, high) of a diagnosis, for each quantity of `limits` {name: value at its limit}.

    Severity is 0 at the healthy value and 1 at the limit, which may lie on either side of it. A parameter is healthy
    at the value that its model declares, which the first diagnosis read fixes; an effect is where it is absent.
    Without limits the values of all quantities are given as they are, for `drifts`. `explain` gives the folder with the
    diagnosis of a case that has none yet.
    """

    def __init__(self, limits: Mapping[str, float], explain: Callable[[Path], Path]):
        self.limits, self._explain = limits, explain
        self.healthy: dict[str, float] = {}

    def __call__(self, path: Path) -> list[Reading]:
        if path.is_dir() and not (path / FILE).exists() and (path / CASE).exists():
            path = self._explain(path)
        found = quantities(path)
        if self.limits:
            return [_severity(path, name, limit, found, self.healthy) for name, limit in self.limits.items()]
        for name, (_, _, believed) in found.items():
            self.healthy.setdefault(name, believed)
        return [(name, v, v - TWO_SIDED_95 * sd, v + TWO_SIDED_95 * sd) for name, (v, sd, _) in found.items()]

    def drifts(self, histories: Sequence[History]) -> str:
        """What changes from test to test, in words: those quantities first that drift by most standard deviations."""
        told = {}
        for h in histories:
            known = np.isfinite(h.severity)
            if not known.any():
                continue
            use, value = h.use[known], h.severity[known]
            by = trend(use, value, np.maximum((h.high - h.low)[known] / 2 / TWO_SIDED_95, 1e-300))
            far = f", drifts by {by:+.1f} standard deviations" if by else ""
            text = f"{h.fault} ({value[0]:.4g} to {value[-1]:.4g}, healthy {self.healthy[h.fault]:.4g}{far})"
            told[f"{h.actuator}: {text}" if len({o.actuator for o in histories}) > 1 else text] = abs(by)
        return ", ".join(sorted(told, key=lambda text: -told[text]))


def _severity(path: Path, name: str, limit: float, found: Quantities, healthy: dict[str, float]):
    if name not in found:
        if "@" not in name:
            raise AnalysisError(f"{path}: no quantity {name!r}; there are {changes(found)}")
        return name, math.nan, math.nan, math.nan
    value, deviation, believed = found[name]
    start = healthy.setdefault(name, believed)
    span = limit - start
    if not math.isfinite(span) or span == 0:
        raise AnalysisError(f"{path}: the limit of {name} is {limit:g}, and {start:g} is healthy")
    severity, width = (value - start) / span, TWO_SIDED_95 * deviation / abs(span)
    return name, severity, severity - width, severity + width


def quantities(path: Path) -> Quantities:
    """Of a diagnosis.json, or of a folder with one: parameters by name, an effect's as effect@location.parameter."""
    file = path / FILE if path.is_dir() else path
    content = json_of(file, AnalysisError)
    try:
        own = {
            name: (float(p["value"]), float(p["std"]), float(p["believed"]))
            for name, p in content.get("parameters", {}).items()
        }
        effects = {
            f"{f['effect']}@{f['location']}.{name}": (float(p["value"]), float(p["std"]), 0.0)
            for f in content.get("findings", [])
            for name, p in f.get("parameters", {}).items()
        }
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise AnalysisError(f"{file}: not a diagnosis of `lacuna explain`: {error!r}") from None
    return own | effects


def changes(found: Quantities) -> str:
    """Quantities in words, those first that lie furthest from healthy, in their standard deviations."""
    far = {name: abs(v - healthy) / max(sd, 1e-300) for name, (v, sd, healthy) in found.items()}
    names = sorted(far, key=lambda name: -far[name])
    return ", ".join(f"{n} ({found[n][0]:.4g}, healthy {found[n][2]:.4g})" for n in names) or "none"
