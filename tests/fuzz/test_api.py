"""What Python may hand in: a value that means nothing is refused, never taken for another."""

from __future__ import annotations

from pathlib import Path

import pytest

import lacuna
from tests.faults.scenarios import DECAY


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "Decay.mo"
    path.write_text(DECAY)
    return path


def test_what_means_nothing_is_refused(model: Path) -> None:
    with pytest.raises(lacuna.UserError, match="units may be"):
        lacuna.load(model, units="none")
    with pytest.raises(lacuna.UserError, match="what may be"):
        lacuna.dump(model, "tree")


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_an_absolute_tolerance_of_the_size_of_what_it_guards_is_refused(model: Path, solver: str) -> None:
    with pytest.raises(Exception, match="keeps no digit") as refused:
        lacuna.load(model).simulate(stop=5, atol=1.0, solver=solver)
    assert lacuna.is_user_error(refused.value)


def test_a_file_to_format_may_be_named_by_a_text(model: Path) -> None:
    assert lacuna.format_file(str(model))
    assert not lacuna.format_file(model)


@pytest.mark.parametrize("value", ["true", "1", None, [1, 2], 10**400])
def test_a_value_that_is_no_number_is_refused(model: Path, value: object) -> None:
    loaded = lacuna.load(model)
    name = next(n for n, v in loaded.variables.items() if v.kind == "parameter")
    state = next(n for n, v in loaded.variables.items() if v.kind == "state")
    for given in ({"parameters": {name: value}}, {"initial": {state: value}}):
        with pytest.raises(lacuna.UserError, match="that is no number"):
            loaded.simulate(stop=1, **given)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"solver": None}, "solver is one of ida, "),
        ({"solver": 3}, "solver is one of ida, "),
        ({"parameters": ["k"]}, "parameters is values by name"),
        ({"parameters": "k=3"}, "parameters is values by name"),
        ({"parameters": {1: 2.0}}, "parameters is values by name"),
        ({"initial": 2.0}, "initial is values by name"),
        ({"inputs": 5}, "inputs is values by name"),
        ({"inputs": {"u": None}}, "u cannot be 'None': that is no number"),
        ({"inputs": {"u": "x"}}, "u cannot be 'x': that is no number"),
        ({"inputs": {"u": ([0, 1],)}}, r"the input u is a number, a recording, or \(times, values\)"),
        ({"inputs": {"u": ([0, 1], ["a", "b"])}}, r"the input u is a number, a recording, or \(times, values\)"),
        ({"inputs": {"u": ([0, 1], [1, 2], [3, 4])}}, r"the input u is a number, a recording, or \(times, values\)"),
        ({"outputs": [1]}, "outputs is a list of names"),
        ({"outputs": "x"}, "outputs is a list of names"),
        ({"sensitivities": [1]}, "sensitivities is a list of names"),
    ],
)
def test_arguments_of_another_kind_are_refused(tmp_path: Path, given: dict, message: str) -> None:
    """They ended in errors of Python's that said nothing of them."""
    path = tmp_path / "Driven.mo"
    path.write_text("model Driven input Real u; Real x(start=0, fixed=true); equation der(x) = u - x; end Driven;")
    loaded = lacuna.load(path)
    with pytest.raises(lacuna.UserError, match=message):
        loaded.simulate(stop=1, **given)


def test_an_fmu_is_of_a_type_that_there_is(model: Path, tmp_path: Path) -> None:
    with pytest.raises(lacuna.UserError, match="an FMU is of type me or cs or both, not 'q'"):
        lacuna.export_fmu(model, tmp_path / "a.fmu", type="q")
