"""The believed model refitted to a case's recordings, by Gauss-Newton on the outputs: what no parameter can explain."""

from collections.abc import Mapping, Sequence

import numpy as np

from tests.proof.benches import Bench

Recording = tuple[np.ndarray, np.ndarray]  # inputs, outputs (samples x signals)


def nrmse(measured: Sequence[np.ndarray], simulated: Sequence[np.ndarray]) -> np.ndarray:
    """RMS error over standard deviation of each signal, pooled over the recordings; missing samples left out."""
    y, s = np.concatenate(measured), np.concatenate(simulated)
    return np.sqrt(np.nanmean((y - s) ** 2, axis=0)) / np.nanstd(y, axis=0)


def case_nrmse(measured: Sequence[np.ndarray], simulated: Sequence[np.ndarray]) -> float:
    """RMS over the signals of their NRMSE."""
    return float(np.sqrt(np.mean(nrmse(measured, simulated) ** 2)))


class Refit:
    """A believed model against recordings of chosen outputs."""

    def __init__(
        self,
        bench: Bench,
        outputs: Sequence[str],
        recordings: Sequence[Recording],
        spread: Mapping[str, float] | None = None,
    ):
        """`spread` replaces a signal's standard deviation as what its error is measured by."""
        self.bench, self.recordings = bench, recordings
        self.columns = [bench.machine.outputs.index(name) for name in outputs]
        self.hold = [name in bench.hold for name in bench.machine.inputs]
        self.measured = [y for _, y in recordings]
        deviation = np.nanstd(np.concatenate(self.measured), axis=0)
        self.spread = np.array([(spread or {}).get(n, d) for n, d in zip(outputs, deviation, strict=True)])

    def simulate(self, parameters: Mapping[str, float]) -> list[np.ndarray]:
        kernel, machine = self.bench.kernel(parameters), self.bench.machine
        return [
            machine.simulate(kernel, self.bench.period, u, hold=self.hold, step=self.bench.refit_step)[:, self.columns]
            for u, _ in self.recordings
        ]

    def residual(self, parameters: Mapping[str, float]) -> np.ndarray:
        """(measured - simulated) / spread, flat; a missing sample is zero."""
        parts = [(y - s) / self.spread for y, s in zip(self.measured, self.simulate(parameters), strict=True)]
        return np.nan_to_num(np.concatenate(parts), nan=0.0).ravel()

    def jacobian(self, parameters: Mapping[str, float], names: Sequence[str], base: np.ndarray) -> np.ndarray:
        """Derivative of the residual to the logarithm of each parameter."""
        shift = 1e-3
        columns = [(self.residual({**parameters, n: parameters[n] * (1 + shift)}) - base) / shift for n in names]
        return np.column_stack(columns)

    def fit(self, start: Mapping[str, float], iterations: int = 12) -> tuple[dict[str, float], float]:
        """Parameters and case NRMSE at the nearest minimum (Levenberg-Marquardt on the logarithms)."""
        names = [n for n in start if self.bench.uncertainty.get(n, 0.05) > 0]
        best, r = dict(start), self.residual(start)
        damping = 1e-3
        for _ in range(iterations):
            J = self.jacobian(best, names, r)
            normal, gradient = J.T @ J, J.T @ r
            improved = False
            for _ in range(5):
                step = -np.linalg.solve(normal + damping * np.diag(np.diag(normal) + 1e-12), gradient)
                trial = {
                    **best,
                    **{n: best[n] * float(np.exp(np.clip(d, -0.5, 0.5))) for n, d in zip(names, step, strict=True)},
                }
                try:
                    tried = self.residual(trial)
                except ArithmeticError:
                    tried = np.full_like(r, np.inf)
                if tried @ tried < r @ r:
                    gained = 1 - (tried @ tried) / (r @ r)
                    best, r, damping, improved = trial, tried, damping / 5, gained > 1e-5
                    break
                damping *= 6
            if not improved:
                break
        return best, float(np.sqrt(np.mean(r**2)))

    def relative_std(self, parameters: Mapping[str, float], noise: Sequence[float]) -> dict[str, float]:
        """Standard deviation of each fitted parameter over its value, for a white noise of given size per output."""
        names = [n for n in parameters if self.bench.uncertainty.get(n, 0.05) > 0]
        J = self.jacobian(parameters, names, self.residual(parameters))
        weight = np.tile(self.spread / np.asarray(noise), len(J) // len(noise))
        covariance = np.linalg.pinv((J * weight[:, None]).T @ (J * weight[:, None]))
        return dict(zip(names, np.sqrt(np.diag(covariance)), strict=True))
