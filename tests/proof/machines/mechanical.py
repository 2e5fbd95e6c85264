"""Mechanical machines: a slide of library parts, a pendulum."""

import numpy as np

from tests.proof.machines.machine import Hidden, Input, Machine, Output, Parameter


def _slide(x, u, p, e):
    return {
        "mass.s": x["mass.v"],
        "mass.v": (u["F"] - p["c"] * x["mass.s"] - p["d"] * x["mass.v"] + e["mass.v"]) / p["m"],
    }


SLIDE = Machine(
    "Slide",
    "sliding",
    "library",
    """
model Slide "A mass on a spring"
  import Lacuna.Components.Mechanics.*;
%parameters%
  input Real F(unit="N");
  ForceSource push;
  Mass mass(m=m, s(start=0, fixed=true), v(start=0, fixed=true));
  TranslationalSpringDamper spring(c=c, d=d);
  TranslationalFixed wall;
equation
  push.u = F;
  connect(push.flange, mass.flange_a);
  connect(mass.flange_b, spring.flange_a);
  connect(spring.flange_b, wall.flange);
end Slide;
""",
    {"m": Parameter(4.0, "kg", 0.03), "c": Parameter(900.0, "N/m", 0.1), "d": Parameter(25.0, "N.s/m", 0.3)},
    {"F": Input("N", -60.0, 60.0)},
    {"s": Output("mass.s", "m", lambda x, u, p, e: x["mass.s"])},
    {"mass.s": 0.0, "mass.v": 0.0},
    _slide,
    (
        Hidden(
            "cubic spring", "mass.v", lambda x, u, p, q: -q * x["mass.s"] ** 3, 4e4, ("mass", "spring", "push"), "k s^3"
        ),
        Hidden(
            "stribeck",
            "mass.v",
            lambda x, u, p, q: -q * (1 + 0.7 * np.exp(-np.abs(x["mass.v"] / 0.08))) * np.tanh(x["mass.v"] / 0.01),
            4.0,
            ("mass", "spring", "push"),
            "Stribeck friction",
        ),
        Hidden(
            "air drag",
            "mass.v",
            lambda x, u, p, q: -q * x["mass.v"] * np.abs(x["mass.v"]),
            30.0,
            ("mass", "spring", "push"),
            "k v |v|",
        ),
        Hidden(
            "rubber",
            "mass.v",
            lambda x, u, p, q: -q * (x["mass.s"] - x["z"]),
            250.0,
            ("mass", "spring", "push"),
            "Maxwell branch",
            rate=lambda x, u, p, q: (x["mass.s"] - x["z"]) / 0.12,
        ),
    ),
    period=0.01,
    substeps=6,
)


def _pendulum(x, u, p, e):
    return {"phi": x["w"], "w": (u["tau"] - p["b"] * x["w"] - p["mgl"] * np.sin(x["phi"]) + e["w"]) / p["J"]}


PENDULUM = Machine(
    "Pendulum",
    "rotating",
    "flat",
    """
model Pendulum "A driven pendulum"
%parameters%
  input Real tau(unit="N.m");
  Real phi(unit="rad", start=0, fixed=true);
  Real w(unit="rad/s", start=0, fixed=true);
equation
  der(phi) = w;
  J*der(w) = tau - b*w - mgl*sin(phi);
end Pendulum;
""",
    {"J": Parameter(0.05, "kg.m2", 0.05), "b": Parameter(0.03, "N.m.s/rad", 0.3), "mgl": Parameter(1.0, "N.m", 0.05)},
    {"tau": Input("N.m", -0.7, 0.7)},
    {"phi": Output("phi", "rad", lambda x, u, p, e: x["phi"])},
    {"phi": 0.0, "w": 0.0},
    _pendulum,
    (
        Hidden("air drag", "w", lambda x, u, p, q: -q * x["w"] * np.abs(x["w"]), 0.008, ("w", "phi"), "k w |w|"),
        Hidden("bearing", "w", lambda x, u, p, q: -q * np.tanh(x["w"] / 0.1), 0.04, ("w", "phi"), "dry friction"),
        Hidden(
            "magnet",
            "w",
            lambda x, u, p, q: -q * np.exp(-((x["phi"] / 0.35) ** 2)) * x["phi"],
            0.4,
            ("w", "phi"),
            "k phi exp(-(phi/0.35)^2)",
        ),
        Hidden(
            "cable",
            "w",
            lambda x, u, p, q: -q * np.maximum(x["phi"] - 0.45, 0.0),
            0.6,
            ("w", "phi"),
            "k max(phi - 0.45, 0)",
        ),
    ),
    period=0.02,
    substeps=4,
)


MACHINES = (SLIDE, PENDULUM)
