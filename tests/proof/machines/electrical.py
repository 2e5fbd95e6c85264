"""Electrical machines: a filter of library parts, a battery cell, a loudspeaker."""

import numpy as np

from tests.proof.machines.machine import Hidden, Input, Machine, Output, Parameter


def _filter(x, u, p, e):
    across = u["u"] - p["R"] * x["coil.i"] - x["cap.v"]
    return {
        "coil.i": (across + e["coil.i"]) / p["L"],
        "cap.v": (x["coil.i"] - x["cap.v"] / p["Rl"] + e["cap.v"]) / p["C"],
    }


FILTER = Machine(
    "Filter",
    "electrical",
    "library",
    """
model Filter "Choke, capacitor and load"
  import Lacuna.Components.Electrical.*;
%parameters%
  input Real u(unit="V");
  SignalVoltage source;
  Resistor copper(R=R);
  Inductor coil(L=L, i(start=0, fixed=true));
  Capacitor cap(C=C, v(start=0, fixed=true));
  Resistor load(R=Rl);
  Ground ground;
equation
  source.u = u;
  connect(source.n, ground.p);
  connect(source.p, copper.p);
  connect(copper.n, coil.p);
  connect(coil.n, cap.p);
  connect(cap.n, ground.p);
  connect(load.p, cap.p);
  connect(load.n, ground.p);
end Filter;
""",
    {
        "R": Parameter(0.8, "Ohm", 0.1),
        "L": Parameter(2e-3, "H", 0.1),
        "C": Parameter(1e-4, "F", 0.1),
        "Rl": Parameter(8.0, "Ohm", 0.1),
    },
    {"u": Input("V", -20.0, 20.0)},
    {
        "i": Output("coil.i", "A", lambda x, u, p, e: x["coil.i"]),
        "v": Output("cap.v", "V", lambda x, u, p, e: x["cap.v"]),
    },
    {"coil.i": 0.0, "cap.v": 0.0},
    _filter,
    (
        Hidden(
            "saturating choke",
            "coil.i",
            lambda x, u, p, q: q * x["coil.i"] ** 2 * (u["u"] - p["R"] * x["coil.i"] - x["cap.v"]),
            0.02,
            ("coil", "copper", "source"),
            "L/(1 + k i^2)",
        ),
        Hidden(
            "diode",
            "cap.v",
            lambda x, u, p, q: -q * (np.exp(np.clip(x["cap.v"], -30, 30) / 3.0) - 1.0),
            0.01,
            ("cap", "load"),
            "k (exp(v/3) - 1)",
        ),
        Hidden(
            "absorption",
            "cap.v",
            lambda x, u, p, q: -q * (x["cap.v"] - x["z"]),
            0.05,
            ("cap", "load"),
            "relaxation branch",
            rate=lambda x, u, p, q: (x["cap.v"] - x["z"]) / 2e-3,
        ),
        Hidden(
            "lamp",
            "cap.v",
            lambda x, u, p, q: -q * np.sign(x["cap.v"]) * np.sqrt(np.abs(x["cap.v"])),
            0.2,
            ("cap", "load"),
            "k sign(v) sqrt|v|",
        ),
    ),
    period=5e-5,
    substeps=3,
)


def _battery(x, u, p, e):
    return {"s": (-u["i"] + e["s"]) / p["Q"], "v1": (u["i"] - x["v1"] / p["R1"] + e["v1"]) / p["C1"]}


BATTERY = Machine(
    "Battery",
    "electrical",
    "flat",
    """
model Battery "A cell: rest voltage, resistance, one relaxation"
%parameters%
  input Real i(unit="A") "Out of the cell";
  Real s(unit="1", start=0.6, fixed=true) "Charge";
  Real v1(unit="V", start=0, fixed=true);
  Real v(unit="V") "At the poles";
equation
  Q*der(s) = -i;
  C1*der(v1) = i - v1/R1;
  v = U0 + a*s - R0*i - v1;
end Battery;
""",
    {
        "Q": Parameter(9000.0, "A.s", 0.05),
        "C1": Parameter(2000.0, "F", 0.2),
        "R1": Parameter(0.02, "Ohm", 0.2),
        "U0": Parameter(3.3, "V", 0.02),
        "a": Parameter(0.8, "V", 0.1),
        "R0": Parameter(0.03, "Ohm", 0.1),
    },
    {"i": Input("A", -5.0, 6.0)},
    {"v": Output("v", "V", lambda x, u, p, e: p["U0"] + p["a"] * x["s"] - p["R0"] * u["i"] - x["v1"] + e["out"])},
    {"s": 0.6, "v1": 0.0},
    _battery,
    (
        Hidden(
            "curved rest voltage", "out", lambda x, u, p, q: q * (x["s"] - 0.6) ** 3, 1.0, ("v", "s"), "k (s - 0.6)^3"
        ),
        Hidden(
            "slow relaxation",
            "out",
            lambda x, u, p, q: -q * x["z"],
            0.02,
            ("v", "v1", "s"),
            "a second relaxation",
            rate=lambda x, u, p, q: (u["i"] - x["z"]) / 250.0,
        ),
        Hidden(
            "charge transfer",
            "v1",
            lambda x, u, p, q: -q * np.sinh(np.clip(x["v1"] / 0.03, -20, 20)),
            0.03,
            ("v1", "v"),
            "k sinh(v1/0.03)",
        ),
    ),
    period=3.0,
)


def _speaker(x, u, p, e):
    return {
        "i": (u["u"] - p["R"] * x["i"] - p["Bl"] * x["v"] + e["i"]) / p["L"],
        "v": (p["Bl"] * x["i"] - p["d"] * x["v"] - p["k"] * x["x"] + e["v"]) / p["m"],
        "x": x["v"],
    }


SPEAKER = Machine(
    "Loudspeaker",
    "electrical",
    "flat",
    """
model Loudspeaker "Coil and cone"
%parameters%
  input Real u(unit="V");
  Real i(unit="A", start=0, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
  Real x(unit="m", start=0, fixed=true);
equation
  L*der(i) = u - R*i - Bl*v;
  m*der(v) = Bl*i - d*v - k*x;
  der(x) = v;
end Loudspeaker;
""",
    {
        "R": Parameter(6.0, "Ohm", 0.04),
        "L": Parameter(6e-4, "H", 0.1),
        "Bl": Parameter(7.0, "N/A", 0.05),
        "m": Parameter(0.02, "kg", 0.05),
        "d": Parameter(1.5, "N.s/m", 0.3),
        "k": Parameter(1800.0, "N/m", 0.1),
    },
    {"u": Input("V", -9.0, 9.0)},
    {"i": Output("i", "A", lambda x, u, p, e: x["i"]), "x": Output("x", "m", lambda x, u, p, e: x["x"])},
    {"i": 0.0, "v": 0.0, "x": 0.0},
    _speaker,
    (
        Hidden("stiff suspension", "v", lambda x, u, p, q: -q * x["x"] ** 3, 5e7, ("v", "x"), "k x^3"),
        Hidden(
            "creep",
            "v",
            lambda x, u, p, q: -q * (x["x"] - x["z"]),
            500.0,
            ("v", "x"),
            "Maxwell branch",
            rate=lambda x, u, p, q: (x["x"] - x["z"]) / 0.02,
        ),
        Hidden(
            "eddy currents",
            "i",
            lambda x, u, p, q: -q * (x["i"] - x["z"]),
            2.0,
            ("i",),
            "relaxation branch",
            rate=lambda x, u, p, q: (x["i"] - x["z"]) / 1e-3,
        ),
        Hidden("port noise", "v", lambda x, u, p, q: -q * x["v"] * np.abs(x["v"]), 2.0, ("v", "x"), "k v |v|"),
    ),
    period=3e-4,
    substeps=6,
)

MACHINES = (FILTER, BATTERY, SPEAKER)
