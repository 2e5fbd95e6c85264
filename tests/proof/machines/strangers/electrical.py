"""An electrical stranger: a step-up converter, averaged, whose duty is recorded."""

import numpy as np

from tests.proof.machines.machine import Hidden, Input, Machine, Output, Parameter


def _boost(x, u, p, e):
    return {
        "iL": (p["Vin"] - p["RL"] * x["iL"] - (1 - u["d"]) * x["vC"] + e["iL"]) / p["L"],
        "vC": ((1 - u["d"]) * x["iL"] - x["vC"] / p["Rl"] + e["vC"]) / p["C"],
    }


BOOST = Machine(
    "Boost",
    "electrical",
    "flat",
    """
model Boost "Step-up converter, averaged, duty recorded"
%parameters%
  input Real d(unit="1") "Duty";
  Real iL(unit="A", start=1.4, fixed=true);
  Real vC(unit="V", start=16, fixed=true);
equation
  L*der(iL) = Vin - RL*iL - (1 - d)*vC;
  C*der(vC) = (1 - d)*iL - vC/Rl;
end Boost;
""",
    {
        "L": Parameter(2.2e-4, "H", 0.08),
        "RL": Parameter(0.12, "Ohm", 0.2),
        "C": Parameter(4.7e-4, "F", 0.08),
        "Rl": Parameter(22.0, "Ohm", 0.05),
        "Vin": Parameter(12.0, "V", 0.0),
    },
    {"d": Input("1", 0.15, 0.6)},
    {"iL": Output("iL", "A", lambda x, u, p, e: x["iL"]), "vC": Output("vC", "V", lambda x, u, p, e: x["vC"])},
    {"iL": 1.4, "vC": 16.0},
    _boost,
    (
        Hidden("diode", "iL", lambda x, u, p, q: -q * (1 - u["d"]), 0.7, ("iL",), "drop while the diode conducts"),
        Hidden("constant power load", "vC", lambda x, u, p, q: -q / x["vC"], 6.0, ("vC",), "P/v"),
        Hidden("suppressor", "vC", lambda x, u, p, q: -q * np.maximum(x["vC"] - 20.0, 0.0), 0.1, ("vC",), "clamp"),
        Hidden("switching loss", "iL", lambda x, u, p, q: -q * x["iL"] * x["vC"], 0.01, ("iL",), "i*v"),
    ),
    period=1e-4,
    substeps=2,
)


MACHINES = (BOOST,)
