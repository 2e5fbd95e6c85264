"""FMUs of the tests' models, made once a session, and instances of them driven by hand."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
import shutil
from typing import Any

import fmpy
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave

import lacuna

ROOT = Path(__file__).parents[2]
MODELS = Path(__file__).parent / "models"
OWN = {path.stem: str(path) for path in sorted(MODELS.glob("*.mo")) if path.stem != "Late"}  # for co-simulation only
OTHERS = {
    "T1": str(ROOT / "tests/models/SquareWaveServo.mo"),
    "T2": str(ROOT / "tests/models/SixStepMotor.mo"),
    "FlightControlEma": "Actuators.FlightControlEma",
}
LIBRARY = {
    name.rsplit(".", 1)[-1]: f"Modelica.{name}"
    for name in (
        "Blocks.Examples.PID_Controller", "Blocks.Examples.BooleanNetwork1",
        "Electrical.Analog.Examples.HeatingRectifier", "Electrical.Analog.Examples.OpAmps.InvertingSchmittTrigger",
        "Electrical.Analog.Examples.SwitchWithArc", "Electrical.Machines.Examples.DCMachines.DCPM_Start",
        "Mechanics.Rotational.Examples.CoupledClutches", "Mechanics.Rotational.Examples.LossyGearDemo1",
        "Mechanics.Translational.Examples.ElastoGap", "Thermal.HeatTransfer.Examples.ControlledTemperature",
    )
}  # fmt: skip
ALL = {**OWN, **OTHERS, **LIBRARY}
_CLASSES = {
    ("3.0", "me"): FMU3Model, ("3.0", "cs"): FMU3Slave, ("2.0", "me"): FMU2Model, ("2.0", "cs"): FMU2Slave,
}  # fmt: skip


class Fmus:
    """`path(name, version)`: exported on first use, into `folder`. Those of LIBRARY need `libraries`, its folder."""

    def __init__(self, folder: Path):
        self._folder = folder

    def path(self, name: str, version: str = "3.0", **more: Any) -> Path:
        marks = "".join(f"-{k}-{v}" for k, v in sorted(more.items()) if k not in ("parameters", "libraries"))
        target = self._folder / f"{Path(name).stem}-{version}{marks}-{len(more.get('parameters', ()))}.fmu"
        if not target.exists():
            units = "warn" if name in LIBRARY else "error"
            lacuna.export_fmu(ALL.get(name, name), target, version=version, units=units, **more)
        return target

    @contextmanager
    def instance(
        self, name: str, kind: str = "me", version: str = "3.0", exported: dict[str, Any] | None = None, **more: Any
    ) -> Iterator[Any]:
        """An instantiated FMU of FMPy with `.vr`, the value references by name; `exported` is said to the export."""
        path = self.path(name, version, **(exported or {}))
        folder = fmpy.extract(str(path))
        description = fmpy.read_model_description(str(path))
        element = description.modelExchange if kind == "me" else description.coSimulation
        fmu = _CLASSES[version, kind](
            guid=description.guid, unzipDirectory=folder, modelIdentifier=element.modelIdentifier, instanceName="test"
        )
        fmu.vr = {v.name: v.valueReference for v in description.modelVariables}
        fmu.description = description
        fmu.instantiate(**more)
        try:
            yield fmu
        finally:
            fmu.freeInstance()
            shutil.rmtree(folder, ignore_errors=True)
