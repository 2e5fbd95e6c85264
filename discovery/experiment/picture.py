"""The proposed experiment drawn: what is played, what both explanations say of it, and by how much they differ."""

from __future__ import annotations

from matplotlib.figure import Figure

from lacuna.analysis.report.figures.style import in_style
from lacuna.discovery.case.cases import Case
from lacuna.discovery.experiment.proposal import Proposal

POINTS = 1500  # of a curve


def with_unit(name: str, unit: str) -> str:
    """The label of an axis."""
    return f"{name}  ({unit})".lstrip() if unit not in ("", "1") else name


@in_style()
def picture(case: Case, proposal: Proposal) -> Figure:
    """One row for each input, then the output that differs most, then the difference of all outputs over the noise."""
    inputs = case.inputs
    figure = Figure(figsize=(9, 1.4 * len(inputs) + 4.6), layout="constrained")
    axes = figure.subplots(len(inputs) + 2, 1, sharex=True, height_ratios=[1.0] * len(inputs) + [1.8, 1.4])
    time = proposal.waveform.time
    keep = slice(None, None, max(1, len(time) // POINTS))
    for ax, signal in zip(axes, inputs, strict=False):
        ax.plot(time[keep], proposal.waveform.columns[signal.column][keep], "0.3", lw=1)
        ax.set_ylabel(with_unit(signal.column, signal.model_unit))
    first, rival = proposal.predictions[0], proposal.predictions[proposal.hardest]
    ax = axes[-2]
    ax.plot(time[keep], first[proposal.column][keep], "C0", lw=1.2, label=proposal.rivals[0].label)
    ax.plot(time[keep], rival[proposal.column][keep], "C1--", lw=1.2, label=proposal.rivals[proposal.hardest].label)
    ax.set_ylabel(with_unit(proposal.column, case.signals[proposal.column].model_unit))
    figure.legend(loc="outside upper left", fontsize=8, frameon=False)
    ax = axes[-1]
    for k, signal in enumerate(case.outputs):
        difference = (first[signal.column] - rival[signal.column]) / proposal.sigma[signal.column]
        ax.plot(time[keep], difference[keep], f"C{k + 2}", lw=1, label=signal.column)
    ax.axhspan(-1.0, 1.0, color="0.9", zorder=0)
    ax.set_ylabel("difference, times the noise")
    ax.set_xlabel("time  (s)")
    ax.legend(loc="best", fontsize=8)
    return figure
