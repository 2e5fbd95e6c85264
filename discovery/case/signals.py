"""Columns of a case: what each records, and by what it is brought into the unit of the model's variable."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from lacuna.discovery.case.problem import CaseError
from lacuna.recorded_units import ZERO_CELSIUS, UnitError, factor_into, to_si


@dataclass(frozen=True)
class Signal:
    """One column: what it records and in which unit; times `scale` and plus `offset` it is in `model_unit`."""

    column: str
    role: str  # input | output
    variable: str
    unit: str
    model_unit: str  # of the variable; SI where that declares none
    scale: float
    interpolation: str = "linear"
    noise_std: float | None = None  # in the model's unit; None where case.toml does not give it
    offset: float = 0.0  # between degrees Celsius and kelvin
    counts: bool = False  # of a Boolean or an Integer: there is nothing between its values


def signal_of(path: Path, column: str, table: dict) -> Signal:
    """A column as `[signals.column]` of a case.toml describes it, in SI. Raises CaseError."""
    try:
        scale, si = to_si(table["unit"])
    except UnitError as error:
        raise CaseError(f"{path}: [signals.{column}] {error}") from error
    noise = table.get("noise_std")
    return Signal(
        column, table["role"], table.get("variable", column), table["unit"], si, scale,
        table.get("interpolation", "linear"), None if noise is None else float(noise) * scale,
    )  # fmt: skip


def of_variable(signal: Signal, unit: str, type_: str) -> Signal:
    """A column in SI as one of its variable: in the unit that this declares, and held where there is nothing between
    its values."""
    told = in_unit(signal, unit)
    return told if type_ == "Real" else replace(told, counts=True, interpolation="hold")


def in_unit(signal: Signal, declared: str) -> Signal:
    """A column in SI as one in the unit that its variable declares (bar, mm, degC); as it is where that is another
    quantity, which is said where the model is compiled, or the variable declares none."""
    if (signal.model_unit, declared) in (("degC", "K"), ("K", "degC")):
        return replace(signal, model_unit=declared, offset=ZERO_CELSIUS if declared == "K" else -ZERO_CELSIUS)
    try:
        factor = factor_into(declared, signal.model_unit)
    except ValueError:
        return signal
    if factor == 1.0:
        return signal
    noise = None if signal.noise_std is None else signal.noise_std * factor
    return replace(signal, model_unit=declared, scale=signal.scale * factor, noise_std=noise)
