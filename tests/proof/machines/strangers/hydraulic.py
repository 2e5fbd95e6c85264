"""Hydraulic strangers: tanks with orifices in millimetres, a long pipe in own connectors in bar and litres a minute."""

import numpy as np

from tests.proof.machines.machine import Hidden, Input, Machine, Output, Parameter


def _orifice(x, u, p, e):
    g = 9.81

    def flow(h):
        return np.sign(h) * np.sqrt(2 * g * np.abs(h) + 1e-9)

    q12 = p["a12"] * flow(x["ha"] - x["hb"])
    return {
        "ha": (p["kp"] * u["n"] - q12 + e["ha"]) / p["Aa"],
        "hb": (q12 - p["ao"] * flow(x["hb"]) + e["hb"]) / p["Ab"],
    }


ORIFICE = Machine(
    "OrificeTanks",
    "hydraulic",
    "flat",
    """
model OrificeTanks "Two tanks, orifices between and behind"
  constant Real g(unit="m/s2") = 9.81;
%parameters%
  input Real n(unit="1") "Speed of the pump";
  Real ha(unit="m", start=0.2, fixed=true);
  Real hb(unit="m", start=0.1, fixed=true);
  Real q12(unit="m3/s");
  Real qo(unit="m3/s");
equation
  q12 = a12*(if ha > hb then sqrt(2*g*noEvent(abs(ha - hb))) else -sqrt(2*g*noEvent(abs(ha - hb))));
  qo = ao*sqrt(2*g*noEvent(max(hb, 0)));
  Aa*der(ha) = kp*n - q12;
  Ab*der(hb) = q12 - qo;
end OrificeTanks;
""",
    {
        "Aa": Parameter(0.012, "m2", 0.04),
        "Ab": Parameter(0.02, "m2", 0.04),
        "a12": Parameter(6e-5, "m2", 0.1),
        "ao": Parameter(5e-5, "m2", 0.1),
        "kp": Parameter(1.6e-4, "m3/s", 0.1),
    },
    {"n": Input("1", 0.15, 1.0)},
    {
        "upper": Output("ha", "mm", lambda x, u, p, e: 1e3 * x["ha"]),
        "lower": Output("hb", "mm", lambda x, u, p, e: 1e3 * x["hb"]),
    },
    {"ha": 0.2, "hb": 0.1},
    _orifice,
    (
        Hidden("seepage", "ha", lambda x, u, p, q: -q * x["ha"], 5e-5, ("ha", "q12"), "laminar leak"),
        Hidden(
            "overflow",
            "hb",
            lambda x, u, p, q: -q * np.maximum(x["hb"] - 0.25, 0.0) ** 1.5,
            1e-3,
            ("hb", "q12", "qo"),
            "weir",
        ),
        Hidden(
            "pump slip", "ha", lambda x, u, p, q: -q * u["n"] * x["ha"], 6e-5, ("ha", "q12"), "pump yields under head"
        ),
    ),
    period=1.0,
)


def _surge(x, u, p, e):
    return {
        "line.q": ((1e5 * u["ps"] - x["vessel.p"]) - p["R"] * x["line.q"] + e["line.q"]) / p["I"],
        "vessel.p": (x["line.q"] - p["Kv"] * u["y"] * x["vessel.p"] + e["vessel.p"]) / p["Cf"],
    }


SURGE = Machine(
    "SurgeLine",
    "hydraulic",
    "own connectors",
    """
package SurgeLine "A long pipe into an air vessel and a valve"
  connector Flange "Pressure and volume flow"
    Real p(unit="Pa");
    flow Real V_flow(unit="m3/s");
  end Flange;
  model Source
    Flange f;
    input Real p_set(unit="Pa");
  equation
    f.p = p_set;
  end Source;
  model Line "Inertance and laminar resistance"
    Flange a;
    Flange b;
    parameter Real I(unit="kg/m4", min=0) = 1e7;
    parameter Real R(unit="Pa.s/m3", min=0) = 1e7;
    Real q(unit="m3/s", start=0, fixed=true);
  equation
    q = a.V_flow;
    a.V_flow + b.V_flow = 0;
    I*der(q) = a.p - b.p - R*q;
  end Line;
  model Vessel
    Flange f;
    parameter Real C(unit="m3/Pa", min=0) = 1e-9;
    Real p(unit="Pa", start=2e5, fixed=true);
  equation
    p = f.p;
    C*der(p) = f.V_flow;
  end Vessel;
  model Valve
    Flange f;
    parameter Real Kv(unit="m3/(s.Pa)", min=0) = 1e-9;
    input Real y(unit="1");
  equation
    f.V_flow = Kv*y*f.p;
  end Valve;
  model Plant
%parameters%
    input Real ps(unit="Pa");
    input Real y(unit="1");
    Source source;
    Line line(I=I, R=R);
    Vessel vessel(C=Cf);
    Valve valve(Kv=Kv);
  equation
    source.p_set = ps;
    valve.y = y;
    connect(source.f, line.a);
    connect(line.b, vessel.f);
    connect(vessel.f, valve.f);
  end Plant;
end SurgeLine;
""",
    {
        "I": Parameter(4e7, "kg/m4", 0.08),
        "R": Parameter(6e7, "Pa.s/m3", 0.1),
        "Cf": Parameter(2.5e-8, "m3/Pa", 0.08),
        "Kv": Parameter(8e-9, "m3/(s.Pa)", 0.08),
    },
    {"ps": Input("bar", 2.0, 6.0), "y": Input("1", 0.2, 1.0)},
    {
        "flow": Output("line.q", "l/min", lambda x, u, p, e: 6e4 * x["line.q"]),
        "pressure": Output("vessel.p", "bar", lambda x, u, p, e: 1e-5 * x["vessel.p"]),
    },
    {"line.q": 0.0, "vessel.p": 2e5},
    _surge,
    (
        Hidden(
            "turbulent line",
            "line.q",
            lambda x, u, p, q: -q * x["line.q"] * np.abs(x["line.q"]),
            8e9,
            ("line", "source"),
            "k q|q|",
        ),
        Hidden(
            "leak",
            "vessel.p",
            lambda x, u, p, q: -q * np.sqrt(np.maximum(x["vessel.p"], 0)),
            1e-6,
            ("vessel", "line", "valve"),
            "orifice leak",
        ),
        Hidden(
            "relief valve",
            "vessel.p",
            lambda x, u, p, q: -q * np.maximum(x["vessel.p"] - 3.2e5, 0.0),
            3e-9,
            ("vessel", "line", "valve"),
            "relief",
        ),
        Hidden(
            "gas pocket",
            "vessel.p",
            lambda x, u, p, q: -q * (x["vessel.p"] - 2e5 - x["z"]),
            6e-9,
            ("vessel", "line", "valve"),
            "added storage",
            rate=lambda x, u, p, q: (x["vessel.p"] - 2e5 - x["z"]) / 3.0,
        ),
    ),
    inner="SurgeLine.Plant",
    period=0.02,
    substeps=2,
)


MACHINES = (ORIFICE, SURGE)
