"""The proof's own simulator: the C kernel of this folder, compiled once for its content and called through ctypes."""

from collections.abc import Mapping, Sequence
import ctypes
from dataclasses import dataclass
from functools import cache
import hashlib
import os
from pathlib import Path
import subprocess
import tempfile

import numpy as np

KERNEL = Path(__file__).parent / "kernel"


class _Bench(ctypes.Structure):
    _fields_ = [
        ("parameters", ctypes.c_char_p),
        ("states", ctypes.c_int),
        ("modes", ctypes.c_int),
        ("guards", ctypes.c_int),
        ("outputs", ctypes.c_int),
    ]


class _Experiment(ctypes.Structure):
    _fields_ = [
        ("samples", ctypes.c_int),
        ("inputs", ctypes.c_int),
        ("substeps", ctypes.c_int),
        ("period", ctypes.c_double),
        ("input", ctypes.c_void_p),
        ("hold", ctypes.c_void_p),
        ("delay", ctypes.c_double),
        ("lag", ctypes.c_void_p),
    ]


@cache
def _library() -> ctypes.CDLL:
    sources = sorted(KERNEL.glob("*.[ch]"))
    key = hashlib.sha256(b"".join(s.read_bytes() for s in sources)).hexdigest()[:16]
    folder = Path(os.environ.get("LACUNA_CACHE", Path.home() / ".cache" / "lacuna")) / "proof"
    library = folder / f"kernel-{key}.so"
    if not library.exists():
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder) as scratch:
            built = Path(scratch) / "kernel.so"
            units = [str(s) for s in sources if s.suffix == ".c"]
            subprocess.run(
                [
                    "cc",
                    "-O2",
                    "-std=c11",
                    "-Wall",
                    "-Wextra",
                    "-Wpedantic",
                    "-Werror",
                    "-shared",
                    "-fPIC",
                    "-o",
                    str(built),
                    *units,
                    "-lm",
                ],
                check=True,
            )
            built.rename(library)
    return ctypes.CDLL(str(library))


@dataclass(frozen=True)
class Machine:
    """One bench of the kernel: its parameter names, its inputs and outputs in the kernel's order."""

    symbol: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    step: float  # s, the largest that keeps the fixed-step error far below the noise

    @property
    def _c(self) -> _Bench:
        return _Bench.in_dll(_library(), self.symbol)

    @property
    def parameter_names(self) -> list[str]:
        return self._c.parameters.decode().split()

    def simulate(
        self,
        parameters: Mapping[str, float],
        period: float,
        inputs: np.ndarray,
        *,
        hold: Sequence[bool] = (),
        delay: float = 0.0,
        lags: Mapping[str, float] | None = None,
        initial: Mapping[int, float] | None = None,
        step: float | None = None,
    ) -> np.ndarray:
        """Outputs, samples x len(self.outputs), for inputs (samples x len(self.inputs)) at `period` seconds.

        A parameter that is not given is zero, and an effect at zero is absent. Raises ArithmeticError when a state
        stops being finite and KeyError for a parameter that the bench has not.
        """
        bench, names = self._c, self.parameter_names
        unknown = set(parameters) - set(names)
        if unknown:
            raise KeyError(f"{self.symbol} has no parameter {sorted(unknown)}")
        p = np.array([parameters.get(name, 0.0) for name in names])
        u = np.ascontiguousarray(inputs, dtype=float)
        held = np.array(hold or [False] * len(self.inputs), dtype=np.intc)
        lag = np.array([(lags or {}).get(name, 0.0) for name in self.outputs])
        x0 = np.zeros(max(bench.states, 2))
        for index, value in (initial or {}).items():
            x0[index] = value
        y = np.empty((len(u), bench.outputs))
        experiment = _Experiment(
            len(u),
            u.shape[1],
            max(1, round(period / (step or self.step))),
            period,
            u.ctypes.data,
            held.ctypes.data,
            delay,
            lag.ctypes.data,
        )
        failed = _library().simulate(
            ctypes.byref(bench),
            ctypes.c_void_p(p.ctypes.data),
            ctypes.c_void_p(x0.ctypes.data),
            ctypes.byref(experiment),
            ctypes.c_void_p(y.ctypes.data),
        )
        if failed:
            raise ArithmeticError(f"{self.symbol}: the simulation diverged")
        return y


SERVO = Machine("servo", ("u",), ("i", "w", "theta"), 2e-5)
JOINT = Machine("servo", ("tau",), ("i", "w", "theta"), 5e-5)
SCREW = Machine("screw", ("theta_cmd", "T_aero"), ("u", "i", "thm", "ths"), 5e-6)
BLDC = Machine("bldc", ("v_bus", "dir"), ("ia", "ib", "ic", "theta", "w"), 1e-5)
DEVICE = Machine("device", ("x", "v"), ("F",), 1e-4)
ACTUATOR = Machine("actuator", ("theta_cmd", "T_aero"), ("ia", "ib", "ic", "thm", "ths"), 5e-6)
