"""Whose trajectory of SMPM_Braking is right? The machine and its bridge written by hand, over SciPy's Radau.

`python -m bench.braking` prints how far this program, Lacuna and the published reference are from each other: the
largest difference of each signal, in its range. The equations are those of a permanent magnet machine in the rotor's
coordinates on six diodes of two slopes and a resistor that follows the speed; no code is shared with what is judged.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp

from bench.msl import shared_folder
from bench.trajectories import read_reference
from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.search_path import search_path
from lacuna.runtime.model import Model
from lacuna.runtime.simulation import Session

NAME = "Modelica.Electrical.Machines.Examples.SynchronousMachines.SMPM_Braking"
SIGNALS = ("inertiaLoad.w", "smpm.idq_sr[1]", "smpm.idq_sr[2]")
UNTIL = 0.4  # s: the machine has come to rest by then, and the differences are past their largest

# The example's data (SM_PermanentMagnetData, SM_ReluctanceRotorData and the example's own parameters).
PAIRS, FREQUENCY, R_STATOR = 2, 50.0, 0.03
L_D = (0.1 + 0.3) / (2 * math.pi * FREQUENCY)  # H, leakage and main field, the same along both axes
FLUX = math.sqrt(2) * 112.3 / (2 * math.pi * FREQUENCY)  # Wb, of the open circuit's voltage
INERTIA = 0.29 + 0.29
W_NOMINAL = 2 * math.pi * FREQUENCY / PAIRS
ON, OFF = 1 / 1e-4, 1e-4  # S, of a diode
AXES = np.array([0.0, 2 * math.pi / 3, 4 * math.pi / 3])


class Bridge:
    """Potentials of the three terminals over the negative rail, for the currents into the machine and the load."""

    def __init__(self) -> None:
        self._on = np.zeros(6, dtype=bool)

    def __call__(self, currents: np.ndarray, load: float) -> np.ndarray:
        for _ in range(2**6):  # as many as there are modes
            upper, lower = np.split(np.where(self._on, ON, OFF), 2)
            a = np.zeros((4, 4))
            a[:3, :3] = -np.diag(upper + lower)
            a[:3, 3] = a[3, :3] = upper
            a[3, 3] = -upper.sum() - 1 / load
            *terminal, rail = np.linalg.solve(a, [*currents, 0.0])
            v = np.array(terminal)
            on = np.concatenate([v > rail, v < 0])
            if np.array_equal(on, self._on):
                return v
            self._on = on
        raise ArithmeticError("no mode of the bridge agrees with its own potentials")


def by_hand(times: np.ndarray) -> np.ndarray:
    """Speed and currents along both axes at `times`."""
    bridge = Bridge()

    def rates(_: float, y: np.ndarray) -> list[float]:
        i_d, i_q, w, phi = y
        angle = PAIRS * phi - AXES
        load = math.pi**2 / 8 * min(max(w / W_NOMINAL, 0.1), 10)
        v = bridge(i_d * np.cos(angle) - i_q * np.sin(angle), load)
        v_d, v_q = 2 / 3 * (v @ np.cos(angle)), -2 / 3 * (v @ np.sin(angle))
        return [
            (v_d - R_STATOR * i_d + PAIRS * w * L_D * i_q) / L_D,
            (v_q - R_STATOR * i_q - PAIRS * w * (L_D * i_d + FLUX)) / L_D,
            1.5 * PAIRS * FLUX * i_q / INERTIA,
            w,
        ]

    # Radau at 1e-9 of sizes of 100 A, 100 rad/s and 30 rad; steps no longer than a tenth of a commutation.
    accuracy = {"rtol": 1e-9, "atol": [1e-7, 1e-7, 1e-7, 1e-8], "max_step": 2e-4}
    solution = solve_ivp(rates, (0, times[-1]), [0, 0, W_NOMINAL, 0], method="Radau", t_eval=times, **accuracy)
    return solution.y[[2, 0, 1]]


def main() -> None:
    folder = shared_folder()
    reference = read_reference(folder / "reference" / f"{NAME}.csv")
    times = np.unique(reference.time[reference.time <= UNTIL])
    last = np.searchsorted(reference.time, times, side="right") - 1
    model = Model(compile_model(NAME, search_path=search_path([folder])).path)
    run = Session(model, outputs=list(SIGNALS), output_times=times, events=False).run(stop=float(times[-1]))
    row = np.searchsorted(run.time, times, side="right") - 1
    hand = by_hand(times)
    for k, name in enumerate(SIGNALS):
        published, ours = reference.signals[name][last], run[name][row]
        span = float(np.ptp(reference.signals[name]))
        pairs = {
            "hand - ours": hand[k] - ours,
            "hand - reference": hand[k] - published,
            "ours - reference": ours - published,
        }
        print(name, *(f"{pair}: {np.max(np.abs(d)) / span:.1e}" for pair, d in pairs.items()), sep="  ")


if __name__ == "__main__":
    main()
