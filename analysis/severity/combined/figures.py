"""Figures of combined faults: what a map can tell of both, and one recording on it."""

from __future__ import annotations

from matplotlib.figure import Figure

from lacuna.analysis.report.figures.style import INK, READABLE, new_figure, severity_axis, shade_bands
from lacuna.analysis.severity.combined.estimate import JointEstimate, JointEstimator
from lacuna.analysis.severity.combined.study import Study

CAPTION = (
    "Both severities that the recording shows, and where it puts them together: the coloured bands are the first's."
)


def draw_limits(study: Study) -> Figure:
    """Half widths of both 95 % intervals and their correlation, over both faults; hatched where the second severity
    cannot be read."""
    grid, limits = study.grid, study.limits
    fault, other = grid.settings.fault, grid.other
    x, y = fault.shown(grid.x), other.shown(grid.y)
    panels = (
        (f"{fault.name}: 95 % half width  ({fault.unit})", fault.shown(limits.half_first), "Blues", None),
        (f"{other.name}: 95 % half width  ({other.unit})", other.shown(limits.half_second), "Blues", None),
        ("correlation of the two readings", limits.correlation, "RdBu_r", (-1, 1)),
    )
    figure = new_figure(13.0, 4.2)
    for axes, (title, values, colours, span) in zip(figure.subplots(1, 3), panels, strict=True):
        low, high = span or (0, values.max())
        mesh = axes.pcolormesh(x, y, values.T, cmap=colours, vmin=low, vmax=high, shading="nearest")
        figure.colorbar(mesh, ax=axes)
        if not limits.readable.all():
            axes.contourf(x, y, limits.readable.T.astype(float), levels=[-0.5, 0.5], colors="none", hatches=["///"])
        axes.set_title(title, fontsize=10)
        axes.set_xlabel(f"{fault.name}  ({fault.unit})")
        axes.set_ylabel(f"{other.name}  ({other.unit})")
        axes.grid(False)
    return figure


def draw_estimate(estimator: JointEstimator, estimate: JointEstimate) -> Figure:
    """The joint posterior of one recording over both faults, with both 95 % intervals."""
    settings, other = estimator.grid.settings, estimator.grid.other
    fault = settings.fault
    x, y = fault.shown(estimator.x), other.shown(estimator.y)
    figure = new_figure()
    axes = figure.subplots()
    shade_bands(axes, settings)
    # Heights of a normal density on the ellipses that hold 95 % and 68 % of it.
    axes.contourf(x, y, estimate.density.T, levels=[0.05, 0.32, 1.01], colors=[INK], alpha=0.3)
    first, second = estimate.first, estimate.second
    axes.errorbar(
        fault.shown(first.severity), other.shown(second.severity),
        xerr=[[fault.shown(first.severity - first.low)], [fault.shown(first.high - first.severity)]],
        yerr=[[other.shown(second.severity - second.low)], [other.shown(second.high - second.severity)]],
        fmt="o", color=INK, capsize=4, label="estimate with its 95 % intervals",
    )  # fmt: skip
    axes.plot([], [], "s", color=INK, alpha=0.4, label="where the recording puts both, 68 % and 95 %")
    severity_axis(axes, settings)
    axes.set_ylim(y[0], y[-1])
    axes.set_ylabel(f"{other.name}  ({other.unit})")
    axes.legend(loc="upper left", **READABLE)
    return figure
