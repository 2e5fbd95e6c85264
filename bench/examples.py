"""Writes the recordings of lacuna/examples anew: `python -m bench.examples`. Fixed seeds: equal bytes on every run."""

from __future__ import annotations

from pathlib import Path
import tempfile

import numpy as np

from lacuna import runtime
from lacuna.analysis.settings import PAPER, load_settings
from lacuna.codegen.compile import compile_model

EXAMPLES = Path(__file__).parents[1] / "lacuna" / "examples"

# The machine that the case's recordings come from: the believed bench, with dry friction that its model leaves out.
MACHINE = """model Machine
  extends Lacuna.Benches.DcServo(R=3.62, Ke=0.0306, J=7.4e-6);
  Lacuna.Components.Mechanics.DryFriction brush(tau_c=2.4e-3);
equation
  connect(brush.flange_a, shaft.flange_b);
end Machine;
"""
CASE = """title = "A DC servo whose brushes rub"
model = "Benches.DcServo"            # what the machine is believed to be
source = "simulated, with noise"

[parameters]                         # believed values, SI
R = 3.5
Ke = 0.03
J = 7e-6

[uncertainty]                        # relative standard deviation of a belief
R = 0.05
Ke = 0.03
J = 0.1

[signals.u]
role = "input"
variable = "u"
unit = "V"

[signals.i]
role = "output"
variable = "i"
unit = "A"

[signals.w]
role = "output"
variable = "w"
unit = "rad/s"

[recordings]
fit = ["sine.csv", "steps.csv"]
validate = ["sweep.csv"]
"""


def voltages(time: np.ndarray) -> dict[str, np.ndarray]:
    """V of each recording: reversals, standstill and two amplitudes, so that friction shows."""
    steps = np.select([time < 0.2, time < 0.6, time < 0.9, time < 1.3], [0.0, 3.0, 0.4, -2.0], 1.5)
    return {
        "sine": 2.5 * np.sin(2 * np.pi * 1.5 * time),
        "steps": steps,
        "sweep": 3.0 * np.sin(2 * np.pi * (0.5 + 0.8 * time) * time),
    }


def write_case(folder: Path) -> None:
    random = np.random.default_rng(20)
    time = np.arange(0, 1.5, 1e-3)
    with tempfile.TemporaryDirectory() as scratch:
        machine = Path(scratch) / "Machine.mo"
        machine.write_text(MACHINE, encoding="utf-8")
        session = runtime.Session(
            runtime.Model(compile_model(str(machine)).path), solver="ida", rtol=1e-9, outputs=["i", "w"], interval=1e-3
        )
        for name, voltage in voltages(time).items():
            # As the amplifier and the converters write them: 1 mV, 1 mA, 0.01 rad/s.
            voltage = np.round(voltage, 3)
            result = session.run(inputs={"u": runtime.RecordedInput(time, voltage, "linear")}, stop=time[-1])
            grid = ~result.event
            current = result["i"][grid] + random.normal(0, 0.01, len(time))
            speed = result["w"][grid] + random.normal(0, 0.3, len(time))
            rows = (
                f"{t:.3f},{u:.3f},{i:.3f},{w:.2f}" for t, u, i, w in zip(time, voltage, current, speed, strict=True)
            )
            (folder / f"{name}.csv").write_text("time,u,i,w\n" + "\n".join(rows) + "\n", encoding="utf-8")
    (folder / "case.toml").write_text(CASE, encoding="utf-8")


def write_preflight(folder: Path) -> None:
    """A test at an eccentricity of 0.22, as a recorder with 10 kHz, 1 mA and the noise of the settings has it."""
    settings, rate = load_settings(PAPER), 10e3
    random = np.random.default_rng(22)
    model = runtime.Model(compile_model(settings.model).path)
    session = runtime.Session(model, solver="dopri5", outputs=list(settings.currents), interval=1 / rate)
    result = session.run(parameters={"zeta": 0.22}, stop=settings.duration + 0.01)
    grid = ~result.event
    time = result.time[grid]
    noisy = [result[name][grid] + random.normal(0, 0.005, len(time)) for name in settings.currents]
    rows = (f"{t:.4f}," + ",".join(f"{i:.3f}" for i in row) for t, *row in zip(time, *noisy, strict=True))
    header = ",".join(["time", *settings.currents])
    (folder / "test.csv").write_text(header + "\n" + "\n".join(rows) + "\n", encoding="utf-8")


if __name__ == "__main__":
    write_case(EXAMPLES / "missing-physics")
    write_preflight(EXAMPLES / "preflight")
