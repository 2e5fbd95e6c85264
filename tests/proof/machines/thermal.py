"""Thermal machines: a house, a heat exchanger, an oven in the users' own connectors."""

import numpy as np

from tests.proof.machines.machine import Hidden, Input, Machine, Output, Parameter


def _house(x, u, p, e):
    between = p["G12"] * (x["T1"] - x["T2"])
    return {
        "T1": (u["P"] - between + e["T1"]) / p["C1"],
        "T2": (between - p["Ga"] * (x["T2"] - p["To"]) + e["T2"]) / p["C2"],
    }


HOUSE = Machine(
    "House",
    "thermal",
    "flat",
    """
model House "A heated room behind a wall"
%parameters%
  input Real P(unit="W") "Heater";
  Real T1(unit="K", start=285, fixed=true) "Air";
  Real T2(unit="K", start=285, fixed=true) "Wall";
equation
  C1*der(T1) = P - G12*(T1 - T2);
  C2*der(T2) = G12*(T1 - T2) - Ga*(T2 - To);
end House;
""",
    {
        "C1": Parameter(900.0, "J/K", 0.1),
        "C2": Parameter(4000.0, "J/K", 0.1),
        "G12": Parameter(6.0, "W/K", 0.15),
        "Ga": Parameter(9.0, "W/K", 0.15),
        "To": Parameter(285.0, "K", 0.0),
    },
    {"P": Input("W", 0.0, 700.0)},
    {"T1": Output("T1", "K", lambda x, u, p, e: x["T1"]), "T2": Output("T2", "K", lambda x, u, p, e: x["T2"])},
    {"T1": 285.0, "T2": 285.0},
    _house,
    (
        Hidden(
            "radiation", "T1", lambda x, u, p, q: -q * (x["T1"] ** 4 - p["To"] ** 4), 3e-8, ("T1",), "k (T1^4 - To^4)"
        ),
        Hidden(
            "natural convection",
            "T2",
            lambda x, u, p, q: -q * np.abs(x["T2"] - p["To"]) ** 1.25 * np.sign(x["T2"] - p["To"]),
            1.0,
            ("T2",),
            "k |T2 - To|^1.25",
        ),
        Hidden(
            "masonry",
            "T2",
            lambda x, u, p, q: -q * (x["T2"] - x["z"] - 285.0),
            8.0,
            ("T2",),
            "added storage at the wall",
            rate=lambda x, u, p, q: (x["T2"] - 285.0 - x["z"]) / 900.0,
        ),
        Hidden(
            "boiling",
            "T1",
            lambda x, u, p, q: -q * np.maximum(x["T1"] - 345.0, 0.0),
            4.0,
            ("T1",),
            "k max(T1 - 345, 0)",
        ),
    ),
    period=6.0,
)


def _exchanger(x, u, p, e):
    one, two = p["UA"] * (x["Th1"] - x["Tc1"]), p["UA"] * (x["Th2"] - x["Tc2"])
    return {
        "Th1": (u["mh"] * p["cp"] * (u["Tin"] - x["Th1"]) - one + e["Th1"]) / p["C"],
        "Th2": (u["mh"] * p["cp"] * (x["Th1"] - x["Th2"]) - two + e["Th2"]) / p["C"],
        "Tc2": (p["mc"] * p["cp"] * (p["Tci"] - x["Tc2"]) + two + e["Tc2"]) / p["C"],
        "Tc1": (p["mc"] * p["cp"] * (x["Tc2"] - x["Tc1"]) + one + e["Tc1"]) / p["C"],
    }


EXCHANGER = Machine(
    "Exchanger",
    "thermal",
    "flat",
    """
model Exchanger "Counter-flow heat exchanger, two cells a side"
%parameters%
  input Real Tin(unit="K") "Hot water in";
  input Real mh(unit="kg/s") "Hot water's flow";
  Real Th1(unit="K", start=300, fixed=true);
  Real Th2(unit="K", start=300, fixed=true);
  Real Tc2(unit="K", start=300, fixed=true);
  Real Tc1(unit="K", start=300, fixed=true);
equation
  C*der(Th1) = mh*cp*(Tin - Th1) - UA*(Th1 - Tc1);
  C*der(Th2) = mh*cp*(Th1 - Th2) - UA*(Th2 - Tc2);
  C*der(Tc2) = mc*cp*(Tci - Tc2) + UA*(Th2 - Tc2);
  C*der(Tc1) = mc*cp*(Tc2 - Tc1) + UA*(Th1 - Tc1);
end Exchanger;
""",
    {
        "C": Parameter(4000.0, "J/K", 0.1),
        "cp": Parameter(4180.0, "J/(kg.K)", 0.0),
        "UA": Parameter(300.0, "W/K", 0.2),
        "mc": Parameter(0.06, "kg/s", 0.1),
        "Tci": Parameter(290.0, "K", 0.0),
    },
    {"Tin": Input("K", 320.0, 370.0), "mh": Input("kg/s", 0.02, 0.12)},
    {"Th2": Output("Th2", "K", lambda x, u, p, e: x["Th2"]), "Tc1": Output("Tc1", "K", lambda x, u, p, e: x["Tc1"])},
    dict.fromkeys(("Th1", "Th2", "Tc2", "Tc1"), 300.0),
    _exchanger,
    (
        Hidden(
            "loss to the room",
            "Th1",
            lambda x, u, p, q: -q * np.sign(x["Th1"] - 293.0) * np.abs(x["Th1"] - 293.0) ** 1.33,
            25.0,
            ("Th1", "Th2"),
            "k (Th1 - 293)^1.33",
        ),
        Hidden(
            "header",
            "Th2",
            lambda x, u, p, q: -q * (x["Th2"] - 300.0 - x["z"]),
            250.0,
            ("Th2",),
            "added storage",
            rate=lambda x, u, p, q: (x["Th2"] - 300.0 - x["z"]) / 60.0,
        ),
        Hidden(
            "radiating end",
            "Tc1",
            lambda x, u, p, q: -q * (x["Tc1"] ** 4 - 293.0**4),
            4e-7,
            ("Tc1",),
            "k (Tc1^4 - 293^4)",
        ),
    ),
    period=2.0,
)


def _furnace(x, u, p, e):
    a, b = p["G1"] * (x["element.T"] - x["mass_.T"]), p["G2"] * (x["mass_.T"] - p["Ta"])
    return {
        "element.T": (u["P"] - a + e["element.T"]) / p["C1"],
        "mass_.T": (a - b + e["mass_.T"]) / p["C2"],
    }


FURNACE = Machine(
    "Furnace",
    "thermal",
    "own connectors",
    """
model Furnace "An element heats a charge"
  connector Heat "Where heat passes"
    Real theta(unit="K");
    flow Real phi(unit="W");
  end Heat;
  model Body "Stores heat"
    Heat h;
    parameter Real C(unit="J/K", min=0) = 100;
    Real T(unit="K", start=293, fixed=true);
  equation
    T = h.theta;
    C*der(T) = h.phi;
  end Body;
  model Wall "Conducts"
    Heat a;
    Heat b;
    parameter Real G(unit="W/K", min=0) = 1;
  equation
    a.phi = G*(a.theta - b.theta);
    a.phi + b.phi = 0;
  end Wall;
  model Outside "Does not change"
    Heat h;
    parameter Real T(unit="K") = 293;
  equation
    h.theta = T;
  end Outside;
  model Source "Heat from a command"
    Heat h;
    input Real P(unit="W");
  equation
    h.phi = -P;
  end Source;
%parameters%
  input Real P(unit="W");
  Source supply;
  Body element(C=C1);
  Body mass_(C=C2);
  Wall contact(G=G1);
  Wall lining(G=G2);
  Outside room(T=Ta);
equation
  supply.P = P;
  connect(supply.h, element.h);
  connect(element.h, contact.a);
  connect(contact.b, mass_.h);
  connect(mass_.h, lining.a);
  connect(lining.b, room.h);
end Furnace;
""",
    {
        "C1": Parameter(150.0, "J/K", 0.1),
        "C2": Parameter(900.0, "J/K", 0.1),
        "G1": Parameter(3.0, "W/K", 0.15),
        "G2": Parameter(2.0, "W/K", 0.15),
        "Ta": Parameter(293.0, "K", 0.0),
    },
    {"P": Input("W", 0.0, 500.0)},
    {
        "Te": Output("element.T", "K", lambda x, u, p, e: x["element.T"]),
        "Tm": Output("mass_.T", "K", lambda x, u, p, e: x["mass_.T"]),
    },
    {"element.T": 293.0, "mass_.T": 293.0},
    _furnace,
    (
        Hidden(
            "radiation",
            "element.T",
            lambda x, u, p, q: -q * (x["element.T"] ** 4 - 293.0**4),
            4e-9,
            ("element", "supply", "contact"),
            "k (T^4 - Ta^4)",
        ),
        Hidden(
            "melting charge",
            "mass_.T",
            lambda x, u, p, q: -q * np.exp(-(((x["mass_.T"] - 350.0) / 12.0) ** 2)),
            120.0,
            ("mass_", "lining", "contact"),
            "heat taken around 350 K",
        ),
        Hidden(
            "cold mass",
            "mass_.T",
            lambda x, u, p, q: -q * (x["mass_.T"] - 293.0 - x["z"]),
            1.5,
            ("mass_", "lining", "contact"),
            "added storage",
            rate=lambda x, u, p, q: (x["mass_.T"] - 293.0 - x["z"]) / 400.0,
        ),
    ),
    period=2.5,
)

MACHINES = (HOUSE, EXCHANGER, FURNACE)
