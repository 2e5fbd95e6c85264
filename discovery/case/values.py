"""Names of fitted values: a model's parameter, its value in one recording only (`J@r1.csv`), a state's value at the
first sample of one (`start:phi@r1.csv`)."""

from __future__ import annotations

from collections.abc import Mapping

from lacuna.discovery.case.cases import Recording


def own_name(name: str, recording: str) -> str:
    """The name of a parameter's value in one recording only."""
    return f"{name}@{recording}"


def start_name(state: str, recording: Recording) -> str:
    """The name of a state's value at the first sample of a recording."""
    return own_name(f"start:{state}", recording.piece)


def is_parameter(name: str) -> bool:
    """Whether a fitted value is one of the model's parameters: no start value, nothing of one recording only."""
    return "@" not in name


def is_start(name: str) -> bool:
    return name.startswith("start:")


def state_of(name: str) -> str:
    """The state whose start value has this name; nothing where it is the name of another."""
    return name.removeprefix("start:").rpartition("@")[0] if is_start(name) else ""


def is_read(name: str, recording: Recording) -> bool:
    """Whether a simulation of a recording reads the fitted value of this name."""
    return is_parameter(name) or name.endswith(own_name("", recording.piece if is_start(name) else recording.file))


def values_in(parameters: Mapping[str, float], recording: Recording) -> dict[str, float]:
    """The model's parameters in a recording, without start values; those of its own go before the common ones."""
    suffix = own_name("", recording.file)
    own = {k.removesuffix(suffix): v for k, v in parameters.items() if k.endswith(suffix) and not is_start(k)}
    return {k: v for k, v in parameters.items() if is_parameter(k)} | own
