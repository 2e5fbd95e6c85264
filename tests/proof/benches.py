"""The benches of the proof: believed parameters, their uncertainty, instruments and experiments."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from tests.proof import excitation, simulator
from tests.proof.simulator import Machine


@dataclass(frozen=True)
class Instrument:
    """A recorded signal: its unit, the standard deviation of its noise and the size of its least bit."""

    unit: str
    noise: float
    quantum: float
    decimals: int


@dataclass(frozen=True)
class Bench:
    """What is believed of one machine and how it is tried; `renamed` maps a model parameter to the kernel's name."""

    model: str
    title: str
    machine: Machine
    believed: Mapping[str, float]
    uncertainty: Mapping[str, float]  # relative 1-sigma; 0 is exact
    instruments: Mapping[str, Instrument]
    input_units: Mapping[str, str]
    amplitude: Mapping[str, float]  # of each input
    period: float  # s
    durations: tuple[float, ...]  # s, to draw from
    sets_of_outputs: tuple[tuple[str, ...], ...]
    input_quantum: Mapping[str, float] = field(default_factory=dict)
    hold: tuple[str, ...] = ()
    renamed: Mapping[str, str] = field(default_factory=dict)
    fixed: Mapping[str, float] = field(default_factory=dict)  # kernel parameters that are not the model's
    leads: str = ""  # angle that must be right before a fit of the others can be: their edges follow it
    refit_step: float = 1e-4  # s, enough where nothing has events

    def kernel(self, parameters: Mapping[str, float]) -> dict[str, float]:
        """Model parameters under the kernel's names, with the kernel's own fixed ones."""
        return dict(self.fixed) | {self.renamed.get(name, name): value for name, value in parameters.items()}

    def draw_true(self, rng: np.random.Generator) -> dict[str, float]:
        """A machine of this kind: the believed values moved by what manufacture spreads."""
        return {
            n: v * (1 + np.clip(rng.standard_normal(), -2, 2) * self.uncertainty.get(n, 0.05))
            for n, v in self.believed.items()
        }

    def experiment(self, rng: np.random.Generator, kind: str, index: int, scale: float = 1.0) -> np.ndarray:
        """Inputs (samples x inputs) of one recording; `kind` is fit, validate or one_way."""
        t = np.arange(round(rng.choice(self.durations) / self.period) + 1) * self.period
        columns = _EXPERIMENTS[self.model](self, rng, t, kind, index, scale)
        for j, name in enumerate(self.machine.inputs):
            step = self.input_quantum.get(name, 0)
            columns[j] = np.round(columns[j] / step) * step if step else columns[j]
        return np.column_stack(columns)


def _single(bench: Bench, rng: np.random.Generator, t: np.ndarray, kind: str, index: int, scale: float) -> list:
    name = bench.machine.inputs[0]
    amplitude = scale * bench.amplitude[name]
    if kind == "one_way":
        return [excitation.one_way(rng, t, amplitude)]
    waves = excitation.OPEN_LOOP if kind == "fit" else excitation.VALIDATION
    return [waves[index % len(waves)](rng, t, amplitude)]


def _surface(bench: Bench, rng: np.random.Generator, t: np.ndarray, kind: str, index: int, scale: float) -> list:
    command = _single(bench, rng, t, kind, index, scale)[0]
    loaded = index % 2 == 1 or (kind == "validate" and rng.random() < 0.5)
    load = excitation.sines(rng, t, bench.amplitude["T_aero"]) if loaded else np.zeros_like(t)
    return [command, load]


def _bus(bench: Bench, rng: np.random.Generator, t: np.ndarray, kind: str, index: int, scale: float) -> list:
    top = scale * bench.amplitude["v_bus"]
    if kind == "validate":
        return [excitation.sweep_bus(rng, t, top), np.full_like(t, rng.choice([1.0, -1.0]))]
    wave = excitation.BUS[index % len(excitation.BUS)]
    direction = excitation.reversals(rng, t) if index == 2 else np.ones_like(t)
    return [wave(rng, t, top * (0.75 if index == 2 else 1.0)), direction]


def _imposed(bench: Bench, rng: np.random.Generator, t: np.ndarray, kind: str, index: int, scale: float) -> list:
    f = rng.uniform(0.25, 1.2)
    stroke = scale * bench.amplitude["x"] * rng.uniform(0.4, 1.0)
    if kind == "validate":
        w = 2 * np.pi * f * np.array([1.0, rng.uniform(2.2, 2.8)])
        a, phase = stroke * np.array([0.7, 0.3]), rng.uniform(0, 2 * np.pi, 2)
        x = (a * (np.sin(np.outer(t, w) + phase) - np.sin(phase))).sum(axis=1)
        return [x, (a * w * np.cos(np.outer(t, w) + phase)).sum(axis=1)]
    return [stroke * np.sin(2 * np.pi * f * t), stroke * 2 * np.pi * f * np.cos(2 * np.pi * f * t)]


ENCODER = 2 * np.pi / 4096

DC_SERVO = Bench(
    model="Benches.DcServo",
    title="DC servo on a laboratory bench",
    machine=simulator.SERVO,
    believed={"R": 3.5, "L": 3.3e-3, "Ke": 0.03, "J": 7e-6, "b": 2e-5},
    uncertainty={"R": 0.03, "L": 0.1, "Ke": 0.03, "J": 0.1, "b": 0.3},
    instruments={
        "i": Instrument("A", 0.012, 8 / 4096, 4),
        "w": Instrument("rad/s", 0.5, 0.05, 3),
        "theta": Instrument("rad", 0.0, ENCODER, 6),
    },
    input_units={"u": "V"},
    amplitude={"u": 7.0},
    input_quantum={"u": 24 / 4096},
    period=1e-3,
    durations=(5, 6, 8),
    sets_of_outputs=(("i", "theta"), ("i", "w", "theta"), ("i", "w"), ("i", "theta"), ("w",)),
)

SCREW_EMA = Bench(
    model="Benches.ScrewEma",
    title="Screw actuator with control surface",
    machine=simulator.SCREW,
    believed={"R": 2.1, "L": 7e-4, "Ke": 0.075, "Jm": 2.5e-5, "bm": 3e-5, "k": 1e5, "d": 12.0, "Js": 0.9, "bs": 5.0},
    uncertainty={
        "R": 0.03,
        "L": 0.1,
        "Ke": 0.03,
        "Jm": 0.08,
        "bm": 0.3,
        "k": 0.15,
        "d": 0.3,
        "Js": 0.06,
        "bs": 0.3,
        "N": 0,
        "Vdc": 0,
        "Kp": 0,
        "wmax": 0,
        "Kw": 0,
        "Ki": 0,
    },
    instruments={
        "u": Instrument("V", 0.08, 100 / 4096, 4),
        "i": Instrument("A", 0.08, 50 / 4096, 4),
        "thm": Instrument("rad", 0.0, ENCODER, 5),
        "ths": Instrument("rad", 0.0, ENCODER / 32, 7),
    },
    input_units={"theta_cmd": "rad", "T_aero": "N.m"},
    amplitude={"theta_cmd": 0.11, "T_aero": 45.0},
    period=1e-3,
    durations=(5, 6),
    sets_of_outputs=(("u", "i", "thm", "ths"), ("u", "i", "thm", "ths"), ("i", "thm", "ths"), ("u", "i", "ths")),
    fixed={"N": 160, "Vdc": 48, "Kp": 18, "wmax": 550, "Kw": 0.35, "Ki": 6},
)

BLDC_DRIVE = Bench(
    model="Benches.BldcDrive",
    title="Three-phase BLDC drive on a laboratory bench",
    machine=simulator.BLDC,
    believed={"R": 2.13, "L": 7.2e-4, "Ke": 0.12476, "J": 2.5e-5, "b": 3e-5, "tau_c": 0.09357},
    uncertainty={"R": 0.03, "L": 0.1, "Ke": 0.02, "J": 0.1, "b": 0.3, "tau_c": 0.1, "pp": 0},
    instruments={
        **{p: Instrument("A", 0.012, 32 / 4096, 4) for p in ("ia", "ib", "ic")},
        "theta": Instrument("rad", 0.0, ENCODER, 5),
    },
    input_units={"v_bus": "V", "dir": "1"},
    amplitude={"v_bus": 26.0},
    input_quantum={"v_bus": 0.01},
    period=2e-4,
    durations=(1.0, 1.2),
    hold=("dir",),
    renamed={"tau_c": "shaft_tau_c"},
    fixed={"pp": 2},
    sets_of_outputs=(("ia", "ib", "ic", "theta"), ("ia", "ib", "ic", "theta"), ("ia", "ib", "ic")),
    refit_step=2e-5,
    leads="theta",
)

JOINT = Bench(
    model="Benches.Joint",
    title="Torque-driven joint",
    machine=simulator.JOINT,
    believed={"J": 1e-4, "b": 1e-4},
    uncertainty={"J": 0.1, "b": 0.2},
    instruments={"w": Instrument("rad/s", 0.4, 0.05, 3), "theta": Instrument("rad", 0.0, ENCODER, 6)},
    input_units={"tau": "N.m"},
    amplitude={"tau": 0.02},
    input_quantum={"tau": 1e-5},
    period=2e-3,
    durations=(6, 8, 10),
    sets_of_outputs=(("w", "theta"), ("w",), ("w", "theta")),
    fixed={"torque_input": 1, "R": 1, "L": 1},
)

FRICTION_DEVICE = Bench(
    model="Benches.FrictionDevice",
    title="Damping device in a test machine",
    machine=simulator.DEVICE,
    believed={"c": 1e5},
    uncertainty={"c": 0.3},
    instruments={"F": Instrument("N", 150.0, 24000 / 4096, 2)},
    input_units={"x": "m", "v": "m/s"},
    amplitude={"x": 0.04},
    period=2e-3,
    durations=(6, 8),
    sets_of_outputs=(("F",),),
)

FLIGHT_CONTROL = Bench(
    model="Benches.FlightControl",
    title="Flight control actuator",
    machine=simulator.ACTUATOR,
    believed={
        "R": 1.05,
        "L": 3.5e-4,
        "Ke": 0.0375,
        "Jm": 2.5e-5,
        "bm": 3e-5,
        "tau_m": 0.01,
        "k": 1e5,
        "d": 12.0,
        "Js": 0.9,
        "bs": 5.0,
    },
    uncertainty={
        "R": 0.03,
        "L": 0.1,
        "Ke": 0.02,
        "Jm": 0.08,
        "bm": 0.3,
        "tau_m": 0.15,
        "k": 0.15,
        "d": 0.3,
        "Js": 0.06,
        "bs": 0.3,
        **dict.fromkeys(("pp", "N", "Vdc", "Kp", "wmax", "Kw", "Ki", "i_max", "Kp_i", "Ki_i"), 0),
    },
    instruments={
        **{p: Instrument("A", 0.04, 50 / 4096, 4) for p in ("ia", "ib", "ic")},
        "thm": Instrument("rad", 0.0, ENCODER, 5),
        "ths": Instrument("rad", 0.0, ENCODER / 32, 7),
    },
    input_units={"theta_cmd": "rad", "T_aero": "N.m"},
    amplitude={"theta_cmd": 0.1, "T_aero": 60.0},
    period=1e-3,
    durations=(2.5, 3),
    sets_of_outputs=(("ia", "ib", "ic", "thm", "ths"), ("ia", "ib", "thm", "ths")),
    renamed={"tau_m": "shaft_tau_c"},
    fixed={
        "pp": 2,
        "N": 160,
        "Vdc": 48,
        "Kp": 18,
        "wmax": 550,
        "Kw": 0.05,
        "Ki": 0.5,
        "i_max": 12,
        "Kp_i": 1,
        "Ki_i": 500,
    },
    refit_step=5e-5,
)

_EXPERIMENTS = {
    "Benches.DcServo": _single,
    "Benches.Joint": _single,
    "Benches.ScrewEma": _surface,
    "Benches.FlightControl": _surface,
    "Benches.BldcDrive": _bus,
    "Benches.FrictionDevice": _imposed,
}

BENCHES = {
    b.model.removeprefix("Benches."): b
    for b in (DC_SERVO, SCREW_EMA, BLDC_DRIVE, JOINT, FRICTION_DEVICE, FLIGHT_CONTROL)
}
