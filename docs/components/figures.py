"""Draw the figures of these pages from runs: `python docs/components/figures.py`, from the root of the repository."""

from __future__ import annotations

from pathlib import Path
import sys
import tempfile

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from lacuna import runtime  # noqa: E402
from lacuna.codegen.compile import compile_model  # noqa: E402

COLOURS = ("#0b5394", "#b45309", "#3d7a3d", "#8e3b6f")


def run(model: str, **options: object) -> runtime.Result:
    """A model of the library by name, or the body of a small one."""
    options.setdefault("rtol", 1e-8)
    if "." in model and "\n" not in model:
        return runtime.simulate(runtime.Model(compile_model(model).path), **options)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "Example.mo"
        file.write_text(f"model Example\n{model}\nend Example;\n", encoding="utf-8")
        return runtime.simulate(runtime.Model(compile_model(str(file)).path), **options)


def figure(name: str, rows: list[tuple[str, dict[str, tuple[np.ndarray, np.ndarray]]]], x_label: str) -> None:
    """One panel a row: its y label, and its curves by name."""
    fig, axes = plt.subplots(len(rows), 1, figsize=(6.4, 1.9 * len(rows) + 0.4), sharex=True, squeeze=False)
    for axis, (label, curves) in zip(axes[:, 0], rows, strict=True):
        for colour, (legend, (x, y)) in zip(COLOURS, curves.items(), strict=False):
            axis.plot(x, y, color=colour, linewidth=1.1, label=legend)
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
        if len(curves) > 1:
            axis.legend(frameon=False, fontsize=8, loc="best")
        axis.spines[["top", "right"]].set_visible(False)
    axes[-1, 0].set_xlabel(x_label)
    fig.tight_layout()
    fig.savefig(HERE / f"{name}.svg", metadata={"Date": None, "Creator": None})
    plt.close(fig)


def electrical() -> None:
    """A half-wave rectifier on R-L: the diode conducts beyond the zero of the voltage, until the current is zero."""
    result = run(
        """
        import Lacuna.Components.*;
        Electrical.SignalVoltage source; Electrical.Ground ground; Electrical.IdealDiode diode(Ron=0, Roff=1e8);
        Electrical.Resistor r(R=2); Electrical.Inductor l(L=10e-3, i(start=0, fixed=true));
        Sources.Sine u(amplitude=10, f=50);
        equation
        connect(u.y, source.u); connect(source.n, ground.p); connect(source.p, diode.p); connect(diode.n, r.p);
        connect(r.n, l.p); connect(l.n, source.n);
        """,
        stop=0.05, interval=1e-4,
    )  # fmt: skip
    t = 1e3 * result.time
    rows = [
        ("voltage, V", {"source": (t, result["u.y"]), "diode": (t, result["diode.v"])}),
        ("current, A", {"i": (t, result["l.i"])}),
    ]
    figure("electrical", rows, "time, ms")


def drives() -> None:
    """Three commutations of the pre-flight test: the leg that is left, its diode, its open interval."""
    names = [f"winding.{x}.i" for x in "abc"] + ["bridge.a.v", "bridge.leg_a.diode"]
    result = run("Actuators.EccentricBldc", stop=0.5, outputs=names, interval=2e-5, parameters={"zeta": 0.3})
    keep = (result.time > 0.45) & (result.time < 0.48)
    t = 1e3 * result.time[keep]
    rows = [
        ("phase currents, A", {x: (t, result[f"winding.{x}.i"][keep]) for x in "abc"}),
        ("terminal a, V", {"v": (t, result["bridge.a.v"][keep])}),
        ("diode of a", {"diode": (t, result["bridge.leg_a.diode"][keep])}),
    ]
    figure("drives", rows, "time, ms")


def mechanics() -> None:
    """A mass on a moving belt: it sticks, breaks away at the static level, slips back, sticks again."""
    result = run(
        """
        import Lacuna.Components.Mechanics.*;
        Inertia body(J=1, phi(start=0, fixed=true)); Spring spring(c=100); Fixed wall; SpeedSource belt;
        SlidingContact contact(tau_c=2, peak=1.5, w_fric(start=0, fixed=true));
        equation
        belt.u = 0.5; connect(wall.flange, spring.flange_a); connect(spring.flange_b, body.flange_a);
        connect(belt.flange, contact.flange_a); connect(contact.flange_b, body.flange_a);
        """,
        stop=3.0, interval=5e-3,
    )  # fmt: skip
    t = result.time
    rows = [
        ("speed, rad/s", {"body": (t, result["body.w"]), "belt": (t, np.full_like(t, 0.5))}),
        ("friction, N.m", {"tau": (t, -result["contact.tau_fric"])}),
    ]
    figure("mechanics", rows, "time, s")


def control() -> None:
    """A loop whose output saturates: with the integral held it settles at once, without it swings."""
    curves: dict[str, tuple[np.ndarray, np.ndarray]] = {}
    outputs: dict[str, tuple[np.ndarray, np.ndarray]] = {}
    for legend, y_max in (("integral held", 1.0), ("integral winds up", 1e3)):
        result = run(
            f"""
            import Lacuna.Components.Control.*;
            PI c(k=4, Ti=0.3, y_max={y_max}); Limiter drive(y_max=1); Lacuna.Components.Sources.Step s;
            Real y(start=0, fixed=true);
            constant Real rate(unit="1/s") = 1;
            equation
            c.u = s.y - y; connect(c.y, drive.u); der(y) = rate*drive.y;
            """,
            stop=6.0, interval=1e-2, max_step=1e-2,
        )  # fmt: skip
        curves[legend] = (result.time, result["y"])
        outputs[legend] = (result.time, result["drive.y"])
    figure("control", [("output", curves), ("command", outputs)], "time, s")


def sensors() -> None:
    """One angle through three sensors."""
    result = run(
        """
        import Lacuna.Components.*;
        Mechanics.SpeedSource hub; Sources.Sine speed(amplitude=1, f=1); Sensors.Encoder encoder(steps=128, T=5e-3);
        Sensors.PositionTransducer transducer(offset=0.03, gain=1.05, f_c=5); Sensors.Noise noise(T=5e-3, std=0.01);
        Control.Adc adc(T=5e-3, range=0.5, bits=6);
        equation
        connect(speed.y, hub.u); connect(hub.flange, encoder.flange); connect(hub.flange, transducer.flange);
        adc.u = hub.phi + noise.y;
        """,
        stop=1.0, interval=2e-3,
    )  # fmt: skip
    names = {"true": "hub.phi", "encoder": "encoder.y", "transducer": "transducer.y", "noise and converter": "adc.y"}
    figure("sensors", [("angle, rad", {k: (result.time, result[v]) for k, v in names.items()})], "time, s")


def actuators() -> None:
    """The flight control actuator's step, healthy and worn."""
    faults = {
        "healthy": {},
        "friction x 3": {"friction": 3.0},
        "play 1 degree": {"backlash": np.radians(1)},
        "eccentricity 0.5": {"zeta": 0.5},
    }
    names = ["surface.phi", "drive.i_pair"]
    results = {
        k: run("Actuators.FlightControlEma", parameters=p, outputs=names, stop=0.6, interval=1e-3, events=False)
        for k, p in faults.items()
    }
    rows = [
        ("surface, rad", {k: (r.time, r["surface.phi"]) for k, r in results.items()}),
        ("current, A", {k: (r.time, r["drive.i_pair"]) for k, r in results.items()}),
    ]
    figure("actuators", rows, "time, s")


if __name__ == "__main__":
    matplotlib.rcParams["svg.hashsalt"] = "lacuna"
    for draw in (electrical, drives, mechanics, control, sensors, actuators):
        draw()
