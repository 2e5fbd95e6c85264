"""The judge: a model file as written, simulated on recordings that nothing was fitted to or chosen on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.fit.fit import nrmse, residuals_of
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import noise_of


@dataclass(frozen=True)
class Judgement:
    """NRMSE of each output and of the case (key "") on the fit and on the validation recordings."""

    fit: dict[str, float]
    validate: dict[str, float]
    residuals: dict[str, dict[str, np.ndarray]]


def judge(machine: Machine, values: Mapping[str, float]) -> Judgement:
    """Simulate all recordings of the machine's case at these values. Raises CaseError where a run fails."""
    judged = try_judge(machine, values)
    if judged is None:
        raise CaseError(
            f"{machine.path}: a simulation failed on the recordings of {machine.case.label}: look at its parameters"
        )
    return judged


def try_judge(machine: Machine, values: Mapping[str, float]) -> Judgement | None:
    """The same; None where a run fails, as a hypothesis may on recordings that it was not fitted to."""
    case = machine.case
    residuals = residuals_of(machine, [*case.fit, *case.validate], values)
    if residuals is None:
        return None
    return Judgement(nrmse(case, case.fit, residuals), nrmse(case, case.validate, residuals), residuals)


def judge_file(case: Case, amendment: Amendment, path: Path, starts: Mapping[str, float]) -> Judgement:
    """The same for a model file, with the values that are written in it; `starts` are fitted initial states."""
    plain = Amendment(amendment.structure, amendment.attachments)
    return judge(Machine(case, plain, source=path).precise(starts, noise_of(case)), starts)


def noise_floor(case: Case, recordings: Sequence[Recording], noise: Mapping) -> dict[str, float]:
    """NRMSE that noise alone gives each output."""
    result = {}
    for signal in case.outputs:
        spread = float(np.nanstd(np.concatenate([r.columns[signal.column] for r in recordings])))
        result[signal.column] = noise[signal.column].std / spread if spread > 0 else float("inf")
    return result
