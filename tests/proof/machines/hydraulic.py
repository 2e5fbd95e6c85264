"""Hydraulic and pneumatic machines: a cylinder, three tanks in own connectors, two air vessels."""

import numpy as np

from tests.proof.machines.machine import Hidden, Input, Machine, Output, Parameter


def _cylinder(x, u, p, e):
    return {
        "x": x["v"],
        "v": (p["A"] * x["p"] - p["b"] * x["v"] - p["k"] * x["x"] + e["v"]) / p["m"],
        "p": (p["kq"] * u["u"] - p["A"] * x["v"] - p["cl"] * x["p"] + e["p"]) / p["Ch"],
    }


def _sealed(x, u, p, q):
    return -q * (1 + 0.8 * np.exp(-((x["v"] / 0.03) ** 2))) * np.tanh(x["v"] / 0.006)


CYLINDER = Machine(
    "Cylinder",
    "hydraulic",
    "flat",
    """
model Cylinder "A valve, a cylinder and a sprung mass"
%parameters%
  input Real u(unit="1") "Opening of the valve";
  Real p(unit="Pa", start=0, fixed=true) "Load pressure";
  Real v(unit="m/s", start=0, fixed=true);
  Real x(unit="m", start=0, fixed=true);
equation
  Ch*der(p) = kq*u - A*v - cl*p;
  m*der(v) = A*p - b*v - k*x;
  der(x) = v;
end Cylinder;
""",
    {
        "Ch": Parameter(2e-12, "m3/Pa", 0.15),
        "kq": Parameter(2e-4, "m3/s", 0.03),
        "A": Parameter(1e-3, "m2", 0.01),
        "cl": Parameter(1e-11, "m3/(s.Pa)", 0.3),
        "m": Parameter(50.0, "kg", 0.05),
        "b": Parameter(2000.0, "N.s/m", 0.3),
        "k": Parameter(5e4, "N/m", 0.1),
    },
    {"u": Input("1", -1.0, 1.0)},
    {"p": Output("p", "Pa", lambda x, u, p, e: x["p"]), "x": Output("x", "m", lambda x, u, p, e: x["x"])},
    {"p": 0.0, "v": 0.0, "x": 0.0},
    _cylinder,
    (
        Hidden(
            "turbulent leakage",
            "p",
            lambda x, u, p, q: -q * np.sign(x["p"]) * np.sqrt(np.abs(x["p"])),
            1e-8,
            ("p",),
            "k sign(p) sqrt|p|",
        ),
        Hidden("seals", "v", _sealed, 200.0, ("v", "x"), "Stribeck friction of the seals"),
        Hidden("hardening spring", "v", lambda x, u, p, q: -q * x["x"] ** 3, 5e6, ("v", "x"), "k x^3"),
        Hidden(
            "accumulator",
            "p",
            lambda x, u, p, q: -q * (x["p"] - x["z"]),
            3e-11,
            ("p",),
            "added storage",
            rate=lambda x, u, p, q: (x["p"] - x["z"]) / 0.15,
        ),
    ),
    period=0.003,
    substeps=6,
)


def _tanks(x, u, p, e):
    a, b = p["k1"] * (x["t1.h"] - x["t2.h"]), p["k2"] * (x["t2.h"] - x["t3.h"])
    return {
        "t1.h": (u["q"] - a + e["t1.h"]) / p["A1"],
        "t2.h": (a - b + e["t2.h"]) / p["A2"],
        "t3.h": (b - p["k3"] * x["t3.h"] + e["t3.h"]) / p["A3"],
    }


TANKS = Machine(
    "ThreeTanks",
    "hydraulic",
    "own connectors",
    """
model ThreeTanks "Three tanks in a row"
  connector Pipe_end
    Real level(unit="m");
    flow Real q(unit="m3/s");
  end Pipe_end;
  model Tank
    Pipe_end bottom;
    parameter Real A(unit="m2", min=0) = 0.01;
    Real h(unit="m", start=0.1, fixed=true);
  equation
    bottom.level = h;
    A*der(h) = bottom.q;
  end Tank;
  model Pipe
    Pipe_end a;
    Pipe_end b;
    parameter Real k(unit="m2/s", min=0) = 1e-4;
  equation
    a.q = k*(a.level - b.level);
    a.q + b.q = 0;
  end Pipe;
  model Drain
    Pipe_end a;
    parameter Real k(unit="m2/s", min=0) = 1e-4;
  equation
    a.q = k*a.level;
  end Drain;
  model Pump
    Pipe_end a;
    input Real q(unit="m3/s");
  equation
    a.q = -q;
  end Pump;
%parameters%
  input Real q(unit="m3/s");
  Pump pump;
  Tank t1(A=A1);
  Tank t2(A=A2);
  Tank t3(A=A3);
  Pipe p12(k=k1);
  Pipe p23(k=k2);
  Drain outlet(k=k3);
equation
  pump.q = q;
  connect(pump.a, t1.bottom);
  connect(t1.bottom, p12.a);
  connect(p12.b, t2.bottom);
  connect(t2.bottom, p23.a);
  connect(p23.b, t3.bottom);
  connect(t3.bottom, outlet.a);
end ThreeTanks;
""",
    {
        "A1": Parameter(0.015, "m2", 0.03),
        "A2": Parameter(0.02, "m2", 0.03),
        "A3": Parameter(0.015, "m2", 0.03),
        "k1": Parameter(5e-4, "m2/s", 0.2),
        "k2": Parameter(4e-4, "m2/s", 0.2),
        "k3": Parameter(3e-4, "m2/s", 0.2),
    },
    {"q": Input("m3/s", 0.0, 2e-4)},
    {
        "h1": Output("t1.h", "m", lambda x, u, p, e: x["t1.h"]),
        "h2": Output("t2.h", "m", lambda x, u, p, e: x["t2.h"]),
        "h3": Output("t3.h", "m", lambda x, u, p, e: x["t3.h"]),
    },
    dict.fromkeys(("t1.h", "t2.h", "t3.h"), 0.1),
    _tanks,
    (
        Hidden(
            "hole",
            "t2.h",
            lambda x, u, p, q: -q * np.sqrt(np.maximum(x["t2.h"], 0.0)),
            5e-5,
            ("t2", "p12", "p23"),
            "k sqrt(h)",
        ),
        Hidden(
            "overflow",
            "t1.h",
            lambda x, u, p, q: -q * np.maximum(x["t1.h"] - 0.45, 0.0) ** 1.5,
            1e-3,
            ("t1", "p12", "pump"),
            "weir: k max(h - 0.45, 0)^1.5",
        ),
        Hidden(
            "side pond",
            "t3.h",
            lambda x, u, p, q: -q * (x["t3.h"] - 0.1 - x["z"]),
            2e-4,
            ("t3", "outlet", "p23"),
            "added storage",
            rate=lambda x, u, p, q: (x["t3.h"] - 0.1 - x["z"]) / 80.0,
        ),
    ),
    period=1.0,
)


def _air(x, u, p, e):
    across = p["g"] * (x["p1"] - x["p2"])
    return {
        "p1": (p["c"] * u["u"] * (p["ps"] - x["p1"]) - across + e["p1"]) / p["V1"],
        "p2": (across - p["gl"] * (x["p2"] - p["pa"]) + e["p2"]) / p["V2"],
    }


AIR = Machine(
    "AirVessels",
    "pneumatic",
    "flat",
    """
model AirVessels "Two air vessels behind a proportional valve, by mass"
%parameters%
  input Real u(unit="1") "Opening of the valve";
  Real p1(unit="Pa", start=1e5, fixed=true);
  Real p2(unit="Pa", start=1e5, fixed=true);
equation
  V1*der(p1) = c*u*(ps - p1) - g*(p1 - p2);
  V2*der(p2) = g*(p1 - p2) - gl*(p2 - pa);
end AirVessels;
""",
    {
        "V1": Parameter(2.4e-8, "kg/Pa", 0.05),
        "V2": Parameter(6e-8, "kg/Pa", 0.05),
        "c": Parameter(1e-8, "kg/(s.Pa)", 0.1),
        "g": Parameter(1.5e-8, "kg/(s.Pa)", 0.15),
        "gl": Parameter(8e-9, "kg/(s.Pa)", 0.2),
        "ps": Parameter(7e5, "Pa", 0.0),
        "pa": Parameter(1e5, "Pa", 0.0),
    },
    {"u": Input("1", 0.0, 1.0)},
    {"p1": Output("p1", "Pa", lambda x, u, p, e: x["p1"]), "p2": Output("p2", "Pa", lambda x, u, p, e: x["p2"])},
    {"p1": 1e5, "p2": 1e5},
    _air,
    (
        Hidden(
            "leak",
            "p2",
            lambda x, u, p, q: -q * np.sqrt(np.maximum(x["p2"] - 1e5, 0.0)),
            1.5e-6,
            ("p2",),
            "k sqrt(p2 - pa)",
        ),
        Hidden(
            "relief valve",
            "p1",
            lambda x, u, p, q: -q * np.maximum(x["p1"] - 3e5, 0.0),
            5e-9,
            ("p1",),
            "k max(p1 - 3e5, 0)",
        ),
        Hidden(
            "dead volume",
            "p2",
            lambda x, u, p, q: -q * (x["p2"] - 1e5 - x["z"]),
            8e-9,
            ("p2",),
            "added storage",
            rate=lambda x, u, p, q: (x["p2"] - 1e5 - x["z"]) / 6.0,
        ),
        Hidden(
            "quadratic leak", "p1", lambda x, u, p, q: -q * (x["p1"] ** 2 - 1e10), 8e-15, ("p1",), "k (p1^2 - pa^2)"
        ),
    ),
    period=0.1,
)

MACHINES = (CYLINDER, TANKS, AIR)
