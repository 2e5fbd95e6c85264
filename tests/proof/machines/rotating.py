"""Rotating machines: a geared motor of library parts, two masses in own connectors."""

import numpy as np

from tests.proof.machines.machine import Hidden, Input, Machine, Output, Parameter


def _geared(x, u, p, e):
    J = p["Jm"] * p["n"] ** 2 + p["Jl"]
    w = x["load.w"]
    torque = p["n"] * p["k"] * x["coil.i"] - p["b"] * w + e["load.w"]
    return {
        "coil.i": (u["u"] - p["R"] * x["coil.i"] - p["k"] * p["n"] * w + e["coil.i"]) / p["L"],
        "load.w": torque / J,
        "load.phi": w,
    }


GEARED = Machine(
    "GearedMotor",
    "rotating",
    "library",
    """
model GearedMotor "Motor, gear and arm"
  import Lacuna.Components.Mechanics.*;
  import Lacuna.Components.Electrical.*;
%parameters%
  input Real u(unit="V");
  SignalVoltage supply;
  Resistor copper(R=R);
  Inductor coil(L=L, i(start=0, fixed=true));
  EMF emf(k=k);
  Ground ground;
  Inertia rotor(J=Jm);
  Gear gear(ratio=n);
  Inertia load(J=Jl, phi(start=0, fixed=true), w(start=0, fixed=true));
  ViscousFriction bearing(b=b);
equation
  supply.u = u;
  connect(supply.n, ground.p);
  connect(supply.p, copper.p);
  connect(copper.n, coil.p);
  connect(coil.n, emf.p);
  connect(emf.n, ground.p);
  connect(emf.flange, rotor.flange_a);
  connect(rotor.flange_b, gear.flange_a);
  connect(gear.flange_b, load.flange_a);
  connect(load.flange_b, bearing.flange_a);
end GearedMotor;
""",
    {
        "R": Parameter(1.5, "Ohm", 0.04),
        "L": Parameter(5e-3, "H", 0.1),
        "k": Parameter(0.05, "V.s/rad", 0.03),
        "Jm": Parameter(2e-5, "kg.m2", 0.05),
        "n": Parameter(12.0, "1", 0.0),
        "Jl": Parameter(5e-3, "kg.m2", 0.1),
        "b": Parameter(0.02, "N.m.s/rad", 0.3),
    },
    {"u": Input("V", -12.0, 12.0)},
    {
        "i": Output("coil.i", "A", lambda x, u, p, e: x["coil.i"]),
        "phi": Output("load.phi", "rad", lambda x, u, p, e: x["load.phi"]),
    },
    {"coil.i": 0.0, "load.w": 0.0, "load.phi": 0.0},
    _geared,
    (
        Hidden(
            "unbalanced arm",
            "load.w",
            lambda x, u, p, q: -q * np.sin(x["load.phi"]),
            0.3,
            ("load", "gear", "rotor", "bearing", "emf"),
            "k sin(phi)",
        ),
        Hidden(
            "seal",
            "load.w",
            lambda x, u, p, q: -q * np.tanh(x["load.w"] / 0.15) * (1 + 0.5 * np.exp(-np.abs(x["load.w"]) / 1.5)),
            0.25,
            ("load", "gear", "rotor", "bearing", "emf"),
            "Stribeck friction",
        ),
        Hidden(
            "brush drop",
            "coil.i",
            lambda x, u, p, q: -q * np.tanh(x["coil.i"] / 0.15),
            0.6,
            ("coil", "copper", "supply", "emf"),
            "voltage against the current",
        ),
        Hidden(
            "fan",
            "load.w",
            lambda x, u, p, q: -q * np.sign(x["load.w"]) * np.abs(x["load.w"]) ** 1.8,
            0.004,
            ("load", "gear", "rotor", "bearing", "emf"),
            "k |w|^1.8",
        ),
        Hidden(
            "viscoelastic seal",
            "load.w",
            lambda x, u, p, q: -q * (x["load.phi"] - x["z"]),
            0.6,
            ("load", "gear", "rotor", "bearing", "emf"),
            "Maxwell branch",
            rate=lambda x, u, p, q: (x["load.phi"] - x["z"]) / 0.3,
        ),
    ),
    period=0.004,
    substeps=4,
)


def _two(x, u, p, e):
    twist = x["motor.phi"] - x["drum.phi"]
    torque = p["c"] * twist + p["d"] * (x["motor.w"] - x["drum.w"]) + e.get("shaft", 0.0)
    return {
        "motor.phi": x["motor.w"],
        "drum.phi": x["drum.w"],
        "motor.w": (u["tau"] - torque - p["b1"] * x["motor.w"] + e["motor.w"]) / p["J1"],
        "drum.w": (torque - p["b2"] * x["drum.w"] + e["drum.w"]) / p["J2"],
    }


TWO_MASS = Machine(
    "TwoMass",
    "rotating",
    "own connectors",
    """
model TwoMass "Motor, shaft and drum"
  connector Shaft_end
    Real angle(unit="rad");
    flow Real m(unit="N.m");
  end Shaft_end;
  model Wheel
    Shaft_end a;
    Shaft_end b;
    parameter Real J(unit="kg.m2", min=0) = 1;
    parameter Real f(unit="N.m.s/rad", min=0) = 0;
    Real phi(unit="rad", start=0, fixed=true);
    Real w(unit="rad/s", start=0, fixed=true);
  equation
    a.angle = phi;
    b.angle = phi;
    der(phi) = w;
    J*der(w) = a.m + b.m - f*w;
  end Wheel;
  model Shaft
    Shaft_end a;
    Shaft_end b;
    parameter Real c(unit="N.m/rad", min=0) = 1;
    parameter Real d(unit="N.m.s/rad", min=0) = 0;
    Real twist(unit="rad");
  equation
    twist = a.angle - b.angle;
    a.m = c*twist + d*der(twist);
    a.m + b.m = 0;
  end Shaft;
  model Drive
    Shaft_end e;
    input Real tau(unit="N.m");
  equation
    e.m = -tau;
  end Drive;
%parameters%
  input Real tau(unit="N.m");
  Drive drive;
  Wheel motor(J=J1, f=b1);
  Shaft shaft(c=c, d=d);
  Wheel drum(J=J2, f=b2);
equation
  drive.tau = tau;
  connect(drive.e, motor.a);
  connect(motor.b, shaft.a);
  connect(shaft.b, drum.a);
end TwoMass;
""",
    {
        "J1": Parameter(2e-3, "kg.m2", 0.05),
        "J2": Parameter(6e-3, "kg.m2", 0.05),
        "c": Parameter(8.0, "N.m/rad", 0.1),
        "d": Parameter(0.02, "N.m.s/rad", 0.4),
        "b1": Parameter(0.01, "N.m.s/rad", 0.3),
        "b2": Parameter(0.01, "N.m.s/rad", 0.3),
    },
    {"tau": Input("N.m", -1.0, 1.0)},
    {
        "w1": Output("motor.w", "rad/s", lambda x, u, p, e: x["motor.w"]),
        "w2": Output("drum.w", "rad/s", lambda x, u, p, e: x["drum.w"]),
    },
    dict.fromkeys(("motor.phi", "motor.w", "drum.phi", "drum.w"), 0.0),
    _two,
    (
        Hidden(
            "bearing of the drum",
            "drum.w",
            lambda x, u, p, q: -q * np.tanh(x["drum.w"] / 0.8),
            0.15,
            ("drum", "shaft"),
            "dry friction",
        ),
        Hidden(
            "hardening shaft",
            "shaft",
            lambda x, u, p, q: q * (x["motor.phi"] - x["drum.phi"]) ** 3,
            400.0,
            ("shaft", "motor", "drum"),
            "k twist^3",
        ),
        Hidden(
            "fan",
            "drum.w",
            lambda x, u, p, q: -q * x["drum.w"] * np.abs(x["drum.w"]),
            6e-4,
            ("drum", "shaft"),
            "k w |w|",
        ),
        Hidden(
            "brake shoe",
            "motor.w",
            lambda x, u, p, q: -q * np.tanh(x["motor.w"] / 0.8) * np.exp(-np.abs(x["motor.w"]) / 20.0),
            0.15,
            ("motor", "drive", "shaft"),
            "friction that fades with speed",
        ),
    ),
    period=0.004,
    substeps=4,
)

MACHINES = (GEARED, TWO_MASS)
