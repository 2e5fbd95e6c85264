"""Moving strangers: a solenoid with its plunger, a quarter of a car."""

import numpy as np

from tests.proof.machines.machine import Hidden, Input, Machine, Output, Parameter


def _solenoid(x, u, p, e):
    # flux linkage lam = L(s) i ; L = L0/(1+s/s0)
    s0 = p["s0"]
    L = p["L0"] / (1 + x["s"] / s0)
    dL = -p["L0"] / s0 / (1 + x["s"] / s0) ** 2
    i = x["i"]
    force = -0.5 * i**2 * dL  # towards smaller gap
    return {
        "i": (u["u"] - p["R"] * i - dL * x["v"] * i + e["i"]) / L,
        "s": x["v"],
        "v": (-force - p["c"] * (x["s"] - p["sr"]) - p["d"] * x["v"] + e["v"]) / p["m"],
    }


SOLENOID = Machine(
    "Solenoid",
    "magnetic",
    "flat",
    """
model Solenoid "Coil, gap and plunger on a spring"
%parameters%
  input Real u(unit="V");
  Real i(unit="A", start=0, fixed=true);
  Real s(unit="m", start=0.004, fixed=true) "Gap";
  Real v(unit="m/s", start=0, fixed=true);
  Real lambda(unit="Wb") "Flux linkage";
  Real F(unit="N") "Pull";
equation
  lambda = L0*i/(1 + s/s0);
  der(lambda) = u - R*i;
  F = 0.5*i^2*L0/s0/(1 + s/s0)^2;
  der(s) = v;
  m*der(v) = -F - c*(s - sr) - d*v;
end Solenoid;
""",
    {
        "L0": Parameter(0.08, "H", 0.08),
        "s0": Parameter(0.002, "m", 0.08),
        "R": Parameter(6.0, "Ohm", 0.04),
        "m": Parameter(0.08, "kg", 0.03),
        "c": Parameter(4500.0, "N/m", 0.06),
        "sr": Parameter(0.004, "m", 0.0),
        "d": Parameter(18.0, "N.s/m", 0.3),
    },
    {"u": Input("V", 0.5, 3.5)},
    {
        "i": Output("i", "mA", lambda x, u, p, e: 1e3 * x["i"]),
        "s": Output("s", "mm", lambda x, u, p, e: 1e3 * x["s"]),
    },
    {"i": 0.0, "s": 0.004, "v": 0.0},
    _solenoid,
    (
        Hidden(
            "guide friction", "v", lambda x, u, p, q: -q * np.tanh(x["v"] / 0.003), 0.3, ("v", "s", "F"), "dry friction"
        ),
        Hidden(
            "stiff spring", "v", lambda x, u, p, q: -q * (x["s"] - p["sr"]) ** 3, 5e8, ("v", "F", "s"), "cubic spring"
        ),
        Hidden(
            "contact drop", "i", lambda x, u, p, q: -q * np.tanh(x["i"] / 0.03), 0.3, ("i", "lambda"), "constant drop"
        ),
        Hidden(
            "eddy currents",
            "i",
            lambda x, u, p, q: -q * (x["i"] - x["z"]),
            0.8,
            ("i", "lambda"),
            "relaxation branch",
            rate=lambda x, u, p, q: (x["i"] - x["z"]) / 0.04,
        ),
    ),
    period=0.004,
    substeps=4,
)


def _quarter(x, u, p, e):
    f = p["cs"] * (x["zu"] - x["zs"]) + p["ds"] * (x["vu"] - x["vs"]) + e.get("susp", 0.0)
    return {
        "zs": x["vs"],
        "zu": x["vu"],
        "vs": (f + e["vs"]) / p["ms"],
        "vu": (p["ct"] * (1e-3 * u["road"] - x["zu"]) - f + e["vu"]) / p["mu"],
    }


QUARTER = Machine(
    "QuarterCar",
    "sliding",
    "flat",
    """
model QuarterCar "Body, wheel and road"
%parameters%
  input Real road(unit="m");
  Real zs(unit="m", start=0, fixed=true);
  Real vs(unit="m/s", start=0, fixed=true);
  Real zu(unit="m", start=0, fixed=true);
  Real vu(unit="m/s", start=0, fixed=true);
  Real f(unit="N") "Suspension";
equation
  f = cs*(zu - zs) + ds*(vu - vs);
  der(zs) = vs;
  der(zu) = vu;
  ms*der(vs) = f;
  mu*der(vu) = ct*(road - zu) - f;
end QuarterCar;
""",
    {
        "ms": Parameter(300.0, "kg", 0.04),
        "mu": Parameter(40.0, "kg", 0.05),
        "cs": Parameter(16000.0, "N/m", 0.08),
        "ds": Parameter(1100.0, "N.s/m", 0.2),
        "ct": Parameter(1.7e5, "N/m", 0.08),
    },
    {"road": Input("mm", -60.0, 60.0)},
    {
        "body": Output("zs", "mm", lambda x, u, p, e: 1e3 * x["zs"]),
        "wheel": Output("zu", "mm", lambda x, u, p, e: 1e3 * x["zu"]),
    },
    {"zs": 0.0, "zu": 0.0, "vs": 0.0, "vu": 0.0},
    _quarter,
    (
        Hidden(
            "strut friction",
            "susp",
            lambda x, u, p, q: q * np.tanh((x["vu"] - x["vs"]) / 0.02),
            60.0,
            ("f", "vs", "zs"),
            "dry friction in the strut",
        ),
        Hidden(
            "bump stop",
            "susp",
            lambda x, u, p, q: q * (np.maximum(x["zu"] - x["zs"] - 0.02, 0.0)),
            3e4,
            ("f", "vs"),
            "bump stop",
        ),
        Hidden(
            "progressive spring", "susp", lambda x, u, p, q: q * (x["zu"] - x["zs"]) ** 3, 2e7, ("f", "vs"), "cubic"
        ),
        Hidden(
            "asymmetric damper",
            "susp",
            lambda x, u, p, q: -q * np.maximum(x["vs"] - x["vu"], 0.0),
            500.0,
            ("f", "vs"),
            "rebound is harder",
        ),
    ),
    period=0.01,
    substeps=3,
)


MACHINES = (SOLENOID, QUARTER)
