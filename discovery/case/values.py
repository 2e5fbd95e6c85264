"""Names of fitted values: a model's parameter, its value in one recording only (`J@r1.csv`), a start (`start:phi`)."""

from __future__ import annotations

from collections.abc import Mapping

from lacuna.discovery.case.cases import Recording


def own_name(name: str, recording: str) -> str:
    """The name of a parameter's value in one recording only."""
    return f"{name}@{recording}"


def is_parameter(name: str) -> bool:
    """Whether a fitted value is one of the model's parameters: no start value, nothing of one recording only."""
    return not name.startswith("start:") and "@" not in name


def values_in(parameters: Mapping[str, float], recording: Recording) -> dict[str, float]:
    """The model's parameters in a recording, without start values; those of its own go before the common ones."""
    suffix = own_name("", recording.name)
    own = {k.removesuffix(suffix): v for k, v in parameters.items() if k.endswith(suffix)}
    return {k: v for k, v in parameters.items() if is_parameter(k)} | own
