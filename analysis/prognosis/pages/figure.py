"""The fan chart: the tests of a part, the tracked severity, and where it goes from here."""

from __future__ import annotations

from matplotlib.axes import Axes
import numpy as np

from lacuna.analysis.prognosis.forecast import Forecast
from lacuna.analysis.prognosis.verdict import FORECAST
from lacuna.analysis.report.figures.style import BAND_FILL, BAND_INK, INK, MUTED, READABLE

FAN = ((0.025, 0.975, "95 %", "#c9d8e8"), (0.1, 0.9, "80 %", "#8fb1d3"))
LEVELS = 24  # severities at which the fan is drawn


def draw(axes: Axes, f: Forecast, smoothed: tuple[np.ndarray, np.ndarray, np.ndarray] | None, levels) -> None:
    """Severities are drawn in the unit that people read.

    `smoothed`: use, mean and standard deviation of the severity over the tests; `levels`: (severities, remaining
    use at the fan's quantiles and the median [levels, 5]) as `fan` gives them, or None."""
    h, part, scale = f.history, f.history.lives[-1], f.limits.scale
    severity, low, high = scale * h.severity, scale * h.low, scale * h.high
    known = np.isfinite(severity)
    strange = np.zeros(len(h.use), bool)
    strange[part] = f.outliers > 0.5
    top = _bands(axes, f)
    ok = known & ~strange
    around = [severity[ok] - low[ok], high[ok] - severity[ok]]
    axes.errorbar(h.use[ok], severity[ok], around, fmt="o", color=INK, markersize=3.5, elinewidth=0.8,
                  label="assessed, 95 %")  # fmt: skip
    if strange.any():
        axes.plot(h.use[strange], severity[strange], "x", color="#b3261e", label="outlier")
    for place in h.use[h.replaced]:
        axes.axvline(place, color=MUTED, linestyle=":", linewidth=1)
        axes.text(place, 0.99 * top, " replaced", va="top", fontsize=8, color=MUTED)
    if smoothed is not None:
        n, mean, deviation = smoothed[0], scale * smoothed[1], scale * smoothed[2]
        axes.fill_between(n, mean - 1.96 * deviation, mean + 1.96 * deviation, color="#0072B2", alpha=0.25, linewidth=0)
        axes.plot(n, mean, color="#0072B2", label="tracked")
    if levels is not None and f.verdict == FORECAST:
        severities, quantiles = scale * levels[0], levels[1]
        far = f.at + min(1.6 * np.nanmax(np.where(np.isfinite(quantiles), quantiles, np.nan)), 1.2 * f.horizon)
        at = f.at + np.where(np.isfinite(quantiles), quantiles, far)
        for k, (_, _, name, colour) in enumerate(FAN):
            axes.fill_betweenx(
                severities, at[:, k], at[:, 4 - k], color=colour, linewidth=0, label=f"{name} of forecasts"
            )
        axes.plot(at[:, 2], severities, color="#0b3d6b", linestyle="--", label="median")
        axes.set_xlim(right=max(np.nanmax(at), f.at * 1.02))
        if f.advised is not None:
            axes.axvline(f.advised, color="#b3261e", linewidth=1.2)
            axes.annotate("last advised test", (f.advised, 0.03 * top), xytext=(4, 0), textcoords="offset points",
                          rotation=90, va="bottom", ha="left", fontsize=8, color="#b3261e")  # fmt: skip
    axes.axvline(f.at, color=MUTED, linewidth=0.8)
    axes.set_xlabel(h.unit)
    axes.set_ylabel(f.limits.unit if np.isinf(f.limits.last) else f"severity  ({f.limits.unit or '1'})")
    axes.legend(loc="upper left", fontsize=8, **READABLE)


def _bands(axes: Axes, f: Forecast) -> float:
    scale = f.limits.scale
    severity = scale * np.where(np.isfinite(f.history.severity), f.history.severity, 0)
    edges = [scale * edge for edge in (*f.limits.values, f.limits.last)]
    top = min(max(1.12 * scale * f.limits.removal, 1.05 * np.max(severity)), edges[-1])
    for name, low, high in zip(f.limits.names, edges, edges[1:], strict=False):
        if low < top:
            axes.axhspan(low, min(high, top), color=BAND_FILL.get(name, "#eeeeee"), linewidth=0, zorder=0)
            axes.text(0.995, low, f"{name} ", transform=axes.get_yaxis_transform(), ha="right", va="bottom", fontsize=8,
                      color=BAND_INK.get(name, MUTED), fontweight="bold")  # fmt: skip
    axes.set_ylim(min(0, max(scale * f.limits.first, 1.05 * np.min(severity))), top)
    return top
