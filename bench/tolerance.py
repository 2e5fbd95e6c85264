"""`make tolerance-study`: which tolerance the maps need, measured; writes docs/tolerance.md and its figure.

The yardstick is RK4 on the causalised equations with located events: another method, through the other of the two
forms of the model, at two steps that must agree with each other first.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
import os
from pathlib import Path
import time

import numpy as np

from bench.report import stamp
from lacuna import runtime
from lacuna.analysis.settings import Settings, load_settings
from lacuna.analysis.spectra.chain import Chain
from lacuna.codegen.compile import compile_model

ROOT = Path(__file__).parents[1]
ALLOWED = 1e-5  # relative deviation of a phase RMS: 3 microampere in 300 mA, a thousandth of the smallest band's rise
STEPS = (1e-5, 5e-6)  # s, of RK4
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
ABSOLUTE = 1e-2  # absolute tolerance over relative tolerance, as in the map's settings


@dataclass(frozen=True)
class Runs:
    """One solver setting over all severities."""

    label: str
    rms: np.ndarray  # A, [severities, phases]
    bins: np.ndarray  # of the first peak, [severities, phases]
    seconds: float  # a simulation, mean

    def deviation(self, other: Runs) -> float:
        """Largest relative deviation of a phase RMS."""
        return float(np.max(np.abs(self.rms / other.rms - 1)))


class Study:
    """The paper's actuator at `severities`, by any solver."""

    def __init__(self, severities: Sequence[float], settings: Settings | None = None):
        self.severities = severities
        self.settings = settings or load_settings()
        self._model = runtime.Model(compile_model(self.settings.model).path)
        self._chain = Chain(self.settings)
        self._times = np.arange(self.settings.samples) / self.settings.sampling_rate

    def runs(self, label: str, **solver: object) -> Runs:
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            results = list(pool.map(lambda severity: self._one(severity, **solver), self.severities))
        rms, bins, seconds = (np.array(part) for part in zip(*results, strict=True))
        return Runs(label, rms, bins, float(np.mean(seconds)))

    def _one(self, severity: float, **solver: object) -> tuple[np.ndarray, np.ndarray, float]:
        begin = time.perf_counter()
        result = runtime.simulate(
            self._model, parameters={self.settings.fault.parameter: severity}, stop=float(self._times[-1]),
            output_times=self._times, outputs=self.settings.currents, events=False, **solver,
        )  # fmt: skip
        seconds = time.perf_counter() - begin
        if not result.complete:
            raise RuntimeError(f"severity {severity:g}: {result.failure}")
        features = self._chain.analyse([result[name] for name in self.settings.currents])
        return features.rms, features.peak_bin, seconds

    def fixed(self, step: float) -> Runs:
        return self.runs(f"RK4, {step:g} s, events located", solver="rk4", step=step)

    def variable(self, solver: str, rtol: float, atol: float) -> Runs:
        return self.runs(f"{solver}, {rtol:g}", solver=solver, rtol=rtol, atol=atol)


@dataclass(frozen=True)
class Findings:
    severities: int
    steps_agree: float  # the two steps of RK4, relative
    variable: dict[str, list[tuple[float, float, float, bool]]]  # solver -> (rtol, deviation, s, first peaks equal)
    fixed: list[tuple[float, float]]  # (step s, s of computing)
    chosen: tuple[str, float, float]  # solver, rtol, deviation of the map's settings


def measure(severities: Sequence[float], tolerances: Sequence[float] = TOLERANCES) -> Findings:
    study = Study(severities)
    coarse, fine = (study.fixed(step) for step in STEPS)

    def row(solver: str, rtol: float) -> tuple[float, float, float, bool]:
        runs = study.variable(solver, rtol, ABSOLUTE * rtol)
        return rtol, runs.deviation(fine), runs.seconds, bool(np.array_equal(runs.bins, fine.bins))

    settings = study.settings
    used = study.variable(settings.solver, settings.relative_tolerance, settings.absolute_tolerance)
    return Findings(
        len(severities),
        coarse.deviation(fine),
        {solver: [row(solver, rtol) for rtol in tolerances] for solver in ("ida", "dopri5")},
        [(step, runs.seconds) for step, runs in zip(STEPS, (coarse, fine), strict=True)],
        (settings.solver, settings.relative_tolerance, used.deviation(fine)),
    )


def page(found: Findings) -> str:
    """docs/tolerance.md."""
    solver, rtol, deviation = found.chosen
    lines = [
        "# Which tolerance a map needs", "",
        "Written by `make tolerance-study`; the numbers are measured, the times are of one machine.", "",
        f"The paper's actuator at {found.severities} eccentricities from 0 to 50 %. What counts is the RMS of each",
        "filtered phase current over the whole record, from which the map is made. The yardstick is RK4 with located",
        f"events at {STEPS[1]:g} s: another method, through the causalised equations, whereas IDA solves the residual",
        f"form. Its phase RMS at {STEPS[0]:g} s and at {STEPS[1]:g} s differ by at most {found.steps_agree:.1e}",
        "relative.", "",
        "| solver | relative tolerance | largest deviation of a phase RMS | first peaks equal | s a simulation |",
        "| --- | --- | --- | --- | --- |",
        *(
            f"| {name} | {r:.0e} | {d:.1e} | {'yes' if equal else 'no'} | {s:.3f} |"
            for name, rows in found.variable.items()
            for r, d, s, equal in rows
        ),
        *(f"| rk4, step {step:g} s | | | | {s:.3f} |" for step, s in found.fixed), "",
        f"The absolute tolerance is {ABSOLUTE:g} times the relative one, for each unit of a nominal value.", "",
        f"A map is allowed {ALLOWED:g}: on 300 mA that is 3 uA, five thousand times less than the rise of the smallest",
        f"band, 16 mA. The maps use {solver} at {rtol:g}; it deviates by {deviation:.1e}, "
        + ("within what is allowed." if deviation <= ALLOWED else "MORE than what is allowed."), "",
        "![Deviation against tolerance](figures/tolerance.svg)",
    ]  # fmt: skip
    return "\n".join(lines) + "\n"


def draw(found: Findings, path: Path) -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    with pyplot.rc_context({"svg.hashsalt": "lacuna"}):
        figure, axis = pyplot.subplots(figsize=(6, 3.6))
        for name, rows in found.variable.items():
            axis.loglog([r for r, *_ in rows], [d for _, d, *_ in rows], marker="o", label=name)
        axis.axhline(ALLOWED, color="#666666", linestyle="--", linewidth=1, label="allowed")
        axis.set_xlabel("relative tolerance")
        axis.set_ylabel("deviation of phase RMS from RK4, relative")
        axis.grid(alpha=0.3)
        axis.legend()
        figure.tight_layout()
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, metadata={"Date": None})
        pyplot.close(figure)


def main() -> None:
    found = measure([round(0.02 * k, 2) for k in range(26)])
    draw(found, ROOT / "docs" / "figures" / "tolerance.svg")
    text = page(found)
    target = ROOT / "docs" / "tolerance.md"
    target.write_text(text, encoding="utf-8")
    stamp(target, "make tolerance-study")
    print(text)


if __name__ == "__main__":
    main()
