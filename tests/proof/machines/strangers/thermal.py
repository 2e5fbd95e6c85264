"""Thermal strangers: chip and radiator in degrees Celsius, an oven under PI control that is given a set-point alone."""

import numpy as np

from tests.proof.machines.machine import Hidden, Input, Machine, Output, Parameter

K0 = 273.15


def _radiator(x, u, p, e):
    ta = u["Ta"] + K0
    q12 = p["G12"] * (x["Tc"] - x["Th"])
    q23 = p["G23"] * (x["Th"] - x["Tf"])
    return {
        "Tc": (u["P"] - q12 + e["Tc"]) / p["Cc"],
        "Th": (q12 - q23 + e["Th"]) / p["Ch"],
        "Tf": (q23 - p["h"] * (x["Tf"] - ta) + e["Tf"]) / p["Cf"],
    }


RADIATOR = Machine(
    "Radiator",
    "thermal",
    "flat",
    """
model Radiator "Chip, heat spreader and fins"
%parameters%
  input Real P(unit="W") "Loss of the chip";
  input Real Ta(unit="K") "Air";
  Real Tc(unit="K", start=298.15, fixed=true) "Chip";
  Real Th(unit="K", start=298.15, fixed=true) "Spreader";
  Real Tf(unit="K", start=298.15, fixed=true) "Fins";
  Real q12(unit="W");
  Real q23(unit="W");
equation
  q12 = G12*(Tc - Th);
  q23 = G23*(Th - Tf);
  Cc*der(Tc) = P - q12;
  Ch*der(Th) = q12 - q23;
  Cf*der(Tf) = q23 - h*(Tf - Ta);
end Radiator;
""",
    {
        "Cc": Parameter(8.0, "J/K", 0.1),
        "Ch": Parameter(60.0, "J/K", 0.1),
        "Cf": Parameter(220.0, "J/K", 0.1),
        "G12": Parameter(2.5, "W/K", 0.1),
        "G23": Parameter(4.0, "W/K", 0.1),
        "h": Parameter(1.3, "W/K", 0.15),
    },
    {"P": Input("W", 5.0, 120.0), "Ta": Input("degC", 18.0, 32.0)},
    {
        "chip": Output("Tc", "degC", lambda x, u, p, e: x["Tc"] - K0),
        "fins": Output("Tf", "degC", lambda x, u, p, e: x["Tf"] - K0),
    },
    {"Tc": 298.15, "Th": 298.15, "Tf": 298.15},
    _radiator,
    (
        Hidden(
            "radiation", "Tf", lambda x, u, p, q: -q * (x["Tf"] ** 4 - (u["Ta"] + K0) ** 4), 5e-9, ("Tf",), "radiation"
        ),
        Hidden(
            "leakage current", "Tc", lambda x, u, p, q: q * np.exp((x["Tc"] - 320.0) / 28.0), 4.0, ("Tc",), "k exp(T)"
        ),
        Hidden(
            "phase change",
            "Th",
            lambda x, u, p, q: -q * (x["Th"] - K0 - 45.0 - x["z"]),
            2.0,
            ("Th", "q12", "q23"),
            "stored",
            rate=lambda x, u, p, q: (x["Th"] - K0 - 45.0 - x["z"]) / 40.0,
        ),
        Hidden("fan", "Tf", lambda x, u, p, q: -q * np.maximum(x["Tf"] - 330.0, 0.0), 1.0, ("Tf",), "thermostat fan"),
    ),
    period=1.0,
)


def _oven(x, u, p, e):
    # PI control with an actuator, command is the set-point; heater power limited by tanh in the truth only if hidden
    err = u["Tset"] + K0 - x["T"]
    y = p["Kp"] * (err + x["xi"] / p["Ti"]) + e.get("y", 0.0)
    return {
        "xi": err,
        "H": (p["Pm"] * y - x["H"] + e["H"]) / p["tau"],
        "T": (x["H"] - p["G"] * (x["T"] - 293.15) + e["T"]) / p["C"],
    }


OVEN = Machine(
    "PiOven",
    "thermal",
    "flat",
    """
model PiOven "Oven under PI control, only the set-point is an input"
%parameters%
  input Real Tset(unit="K");
  Real T(unit="K", start=293.15, fixed=true);
  Real H(unit="W", start=0, fixed=true) "Heat of the element";
  Real xi(unit="K.s", start=0, fixed=true);
  Real y(unit="1");
equation
  der(xi) = Tset - T;
  y = Kp*(Tset - T + xi/Ti);
  tau*der(H) = Pm*y - H;
  C*der(T) = H - G*(T - 293.15);
end PiOven;
""",
    {
        "Kp": Parameter(0.02, "1/K", 0.0),
        "Ti": Parameter(120.0, "s", 0.0),
        "Pm": Parameter(1500.0, "W", 0.05),
        "tau": Parameter(20.0, "s", 0.15),
        "C": Parameter(2200.0, "J/K", 0.1),
        "G": Parameter(4.0, "W/K", 0.1),
    },
    {"Tset": Input("degC", 30.0, 140.0)},
    {
        "T": Output("T", "degC", lambda x, u, p, e: x["T"] - K0),
        "y": Output("y", "%", lambda x, u, p, e: 100 * p["Kp"] * (u["Tset"] + K0 - x["T"] + x["xi"] / p["Ti"])),
    },
    {"xi": 0.0, "H": 0.0, "T": 293.15},
    _oven,
    (
        Hidden("radiation", "T", lambda x, u, p, q: -q * (x["T"] ** 4 - 293.15**4), 2e-8, ("T",), "radiation"),
        Hidden(
            "load",
            "T",
            lambda x, u, p, q: -q * (x["T"] - 293.15 - x["z"]),
            4.0,
            ("T",),
            "added storage",
            rate=lambda x, u, p, q: (x["T"] - 293.15 - x["z"]) / 90.0,
        ),
    ),
    period=2.0,
    substeps=2,
)


MACHINES = (RADIATOR, OVEN)
