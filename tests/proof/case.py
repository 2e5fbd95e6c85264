"""A case in memory: the machine, what it hides, its recordings by ideal and by real instruments."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.signal import lfilter

from tests.proof.benches import Bench
from tests.proof.effects import Concealed
from tests.proof.plan import Plan


@dataclass
class Case:
    """A case in memory: machine, instruments and recordings, with the truth."""

    name: str
    plan: Plan
    bench: Bench
    outputs: tuple[str, ...]
    believed: dict[str, float]
    true: dict[str, float]
    concealed: list[Concealed]
    inputs: list[np.ndarray]
    fit: int  # recordings before this one are for fitting
    noise_scale: float
    colour: float
    unknown_noise: bool
    clean: list[np.ndarray] = None
    measured: list[np.ndarray] = None
    refit: dict = None  # refitted parameters, and the errors of the refitted model and of the truth


def simulate(case: Case) -> list[np.ndarray]:
    """What ideal instruments (but for concealed sensor errors) would have recorded."""
    bench, machine = case.bench, case.bench.machine
    kernel = bench.kernel(case.true)
    lag, delay = {}, 0.0
    for c in case.concealed:
        kernel |= c.kernel
        lag |= c.lag
        delay += c.delay
    hold = [name in bench.hold for name in machine.inputs]
    columns = [machine.outputs.index(name) for name in case.outputs]
    recorded = []
    for u in case.inputs:
        y = machine.simulate(kernel, bench.period, u, hold=hold, delay=delay, lags=lag)[:, columns]
        for c in case.concealed:
            for j, name in enumerate(case.outputs):
                if name in c.once_per_rev:
                    amplitude, phase = c.once_per_rev[name]
                    y[:, j] += amplitude * np.sin(y[:, j] + phase)
                y[:, j] = y[:, j] * c.gain.get(name, 1.0) + c.offset.get(name, 0.0)
        recorded.append(y)
    return recorded


def place_stops(case: Case) -> None:
    """Puts end stops within the stroke that the recordings reach without them."""
    for k, c in enumerate(case.concealed):
        if not c.stop_share:
            continue
        machine, others = case.bench.machine, [o for o in case.concealed if o is not c]
        angle = "ths" if "ths" in machine.outputs else "theta"
        free = replace(case, concealed=others, outputs=(angle,))
        at = c.stop_share * max(float(y.max()) for y in simulate(free)[: case.fit])
        case.concealed[k] = replace(
            c,
            kernel={**c.kernel, "stop_high": at},
            parameters={"position": (at, "rad", ("stop", "limit", "theta_max", "phi_max"))},
        )


def noise_std(case: Case, name: str) -> float:
    """Of a signal, with its quantisation."""
    instrument = case.bench.instruments[name]
    return float(np.hypot(instrument.noise * case.noise_scale, instrument.quantum / np.sqrt(12)))


def measure(case: Case, rng: np.random.Generator) -> list[np.ndarray]:
    """Noise of the case's colour and quantisation on the clean recordings."""
    measured = []
    for clean in case.clean:
        y = np.empty_like(clean)
        for j, name in enumerate(case.outputs):
            instrument = case.bench.instruments[name]
            white = rng.standard_normal(len(clean))
            white[1:] *= np.sqrt(1 - case.colour**2)
            coloured = lfilter([1.0], [1.0, -case.colour], white)
            noisy = clean[:, j] + instrument.noise * case.noise_scale * coloured
            y[:, j] = np.round(noisy / instrument.quantum) * instrument.quantum
        measured.append(y)
    return measured
