"""The proof's simulator against recordings made elsewhere: with their truth it must leave nothing but their noise."""

import os
from pathlib import Path
import tomllib

import numpy as np
import pytest

from tests.proof.benches import BENCHES
from tests.proof.refit import nrmse

SHARED = Path(os.environ.get("LACUNA_SHARED", Path(__file__).parents[3] / "shared"))
CASES = sorted((SHARED / "recordings" / "practice").glob("*/truth.toml"))
KERNEL_NAMES = {
    "friction.coulomb": {"tau_c": "shaft_tau_c"},
    "friction.stribeck": {"tau_c": "shaft_tau_c", "w_s": "shaft_w_s", "tau_s": "tau_s"},
    "drive.dead_time": {"V_d": "V_d"},
    "load.gravity": {"mgl": "mgl", "phi": "mgl_phi"},
    "backlash": {"play": "play"},
    "torque.cogging": {"amplitude": "cog_a", "periods": "cog_n", "phase": "cog_phi"},
    "motor.short_circuit": {"fraction": "short_b"},
}


def _kernel(bench, truth):
    kernel = bench.kernel(truth["true_parameters"])
    for effect in truth.get("effects", []):
        names = KERNEL_NAMES[effect["effect"]]
        kernel |= {names[k]: v["value"] for k, v in effect["parameters"].items()}
    if "tau_s" in kernel:
        kernel["shaft_tau_e"] = kernel.pop("tau_s") - kernel["shaft_tau_c"]
    return kernel


@pytest.mark.skipif(not CASES, reason=f"no practice recordings below {SHARED}")
@pytest.mark.parametrize("path", CASES, ids=[c.parent.name for c in CASES])
@pytest.mark.parametrize("part", ["fit", "validate"])
def test_leaves_only_noise(path, part):
    folder, truth = path.parent, tomllib.loads(path.read_text())
    case = tomllib.loads((folder / "case.toml").read_text())
    bench = next(b for b in BENCHES.values() if b.model == case["model"])
    machine, kernel = bench.machine, _kernel(bench, truth)
    outputs = [n for n in machine.outputs if n in case["signals"]]
    measured, simulated = [], []
    for file in case["recordings"][part]:
        names = (folder / file).read_text().split("\n", 1)[0].split(",")
        column = dict(zip(names, np.genfromtxt(folder / file, delimiter=",", skip_header=1).T, strict=True))
        inputs = np.column_stack([column[n] for n in machine.inputs])
        y = machine.simulate(kernel, bench.period, inputs, hold=[n in bench.hold for n in machine.inputs])
        measured.append(np.column_stack([column[n] for n in outputs]))
        simulated.append(y[:, [machine.outputs.index(n) for n in outputs]])
    left = float(np.sqrt(np.mean(nrmse(measured, simulated) ** 2)))
    # The three-phase recordings come from a simulator that locates commutations on a coarser grid.
    slack = 1.02 if case["model"].endswith("BldcDrive") else 1.0005
    assert left < slack * truth["nrmse"][part]["floor"]
