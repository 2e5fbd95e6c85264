"""A plain figure of one run: one panel a unit, signals against time."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lacuna import runtime

MOST_SIGNALS = 8  # more lines than this in one panel tell a reader nothing


def draw(result: runtime.Result, names: list[str] | None, path: Path) -> Path:
    """Draw `names`, or what the model itself declares where none are given, and write `path`."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    panels: dict[str, list[str]] = defaultdict(list)
    for name in names or _top_level(result):
        panels[result.model.variables[name].unit].append(name)
    figure, axes = pyplot.subplots(len(panels), sharex=True, squeeze=False, figsize=(8, 1.0 + 2.2 * len(panels)))
    for axis, (unit, signals) in zip(axes[:, 0], panels.items(), strict=True):
        for name in signals[:MOST_SIGNALS]:
            axis.plot(result.time, result[name], label=name, linewidth=1)
        axis.set_ylabel(unit or "1")
        axis.legend(loc="upper right", fontsize="small")
        axis.grid(alpha=0.3)
    axes[-1, 0].set_xlabel("time, s")
    figure.tight_layout()
    temporary = path.with_suffix(".svg.part")
    figure.savefig(temporary, format="svg")
    pyplot.close(figure)
    return temporary.replace(path)


def _top_level(result: runtime.Result) -> list[str]:
    """Recorded Real variables of the model itself; those of its components where it declares none."""
    real = [name for name in result.columns if result.model.variables[name].type == "Real"]
    return [name for name in real if "." not in name] or real[: 2 * MOST_SIGNALS]
