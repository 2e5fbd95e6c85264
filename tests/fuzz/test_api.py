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
