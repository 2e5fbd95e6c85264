"""Places of a model that is spread over files: in the classes that it inherits, and in those of components there."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read as structure_of
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.efforts.places.reading import read
from lacuna.discovery.efforts.places.sites import Site

from .recorded import acted

FILES = {
    "package": 'package Cart "A cart on a rail"\nend Cart;\n',
    "Motor": (
        'within Cart;\nmodel Motor\n  parameter Real k(unit="N/V") = 2;\n  parameter Real T(unit="s") = 0.1;\n'
        '  input Real u(unit="V");\n  Real f(unit="N", start=0, fixed=true);\n'
        "equation\n  T*der(f) = k*u - f;\nend Motor;\n"
    ),
    "Base": (
        'within Cart;\npartial model Base "Whatever drives it"\n  parameter Real m(unit="kg") = 4;\n'
        '  parameter Real d(unit="N.s/m") = 3;\n  input Real u(unit="V");\n  Motor motor(u=u);\n'
        '  Real v(unit="m/s", start=0, fixed=true);\nequation\n  m*der(v) = motor.f - d*v;\nend Base;\n'
    ),
    "Middle": "within Cart;\nmodel Middle\n  extends Base;\nend Middle;\n",
    "Driven": (
        'within Cart;\nmodel Driven "As it is built"\n  extends Middle(m=5);\n'
        '  Real x(unit="m", start=0, fixed=true);\nequation\n  der(x) = v;\nend Driven;\n'
    ),
}


@pytest.fixture
def cart(tmp_path: Path) -> Path:
    folder = tmp_path / "Cart"
    folder.mkdir()
    for name, text in FILES.items():
        (folder / f"{name}.mo").write_text(text)
    return tmp_path


def places(folder: Path) -> dict[str, Site]:
    return {s.label: s for s in read(Library([str(folder)]), "Cart.Driven").places}


def test_inherited_equations_and_those_of_inherited_components_are_places(cart: Path) -> None:
    """They were closed, and with them every model that is a variant of a partial one."""
    found = places(cart)
    assert set(found) == {"m*der(v) = motor.f - d*v", "motor: T*der(f) = k*u - f"}
    assert [[step.cls.name for step in s.way] for s in found.values()] == [
        ["Middle", "Base"],
        ["Middle", "Base", "Motor"],
    ]


@pytest.mark.parametrize(
    ("label", "steady"), [("m*der(v) = motor.f - d*v", 6.0 / 3), ("motor: T*der(f) = k*u - f", 6.0 / 3)]
)
def test_what_is_added_there_acts(cart: Path, label: str, steady: float) -> None:
    """A constant effort of 6 N moves the cart at 2 m/s in the end, wherever on the way it is added."""
    times = np.array([0.0, 5 / 3, 40.0])
    ((_, mid, last),) = acted(cart, "Cart.Driven", [places(cart)[label]], 6.0, ["v"], times, silent=["u"])
    assert last == pytest.approx(steady, rel=1e-6)
    assert mid == pytest.approx(2 * (1 - np.exp(-1)), rel=0.1)  # of 5 kg, as the variant has it


def test_a_case_of_such_a_model_is_opened(cart: Path) -> None:
    (cart / "case.toml").write_text(
        'model = "Cart.Driven"\nlibraries = ["."]\n[signals.u]\nrole = "input"\nvariable = "u"\nunit = "V"\n'
        '[signals.v]\nrole = "output"\nvariable = "v"\nunit = "m/s"\nnoise_std = 1e-3\n'
        '[recordings]\nfit = ["r1.csv"]\nvalidate = ["r2.csv"]\n'
    )
    time = np.arange(0.0, 2.0, 0.01)
    for name in ("r1", "r2"):
        np.savetxt(cart / f"{name}.csv", np.column_stack([time, 0 * time, 1e-3 * np.sin(900 * time)]), "%.6g", ",",
                   header="time,u,v", comments="")  # fmt: skip
    case = load(cart)
    door = opened(case, Amendment(structure_of(case.library(), case.base)), case.library(), [])
    assert {s.label for s in door.sites if s.kind == "equation"} == set(places(cart))


def test_a_library_beside_the_model_is_not_the_users_own(cart: Path) -> None:
    """As the standard library may lie beside it: the equations of its parts are no places."""
    (cart / "Mine.mo").write_text("model Mine\n  extends Cart.Driven;\nend Mine;\n")
    found = read(Library([str(cart)]), "Mine")
    assert found.places == ()
    assert "the equation stands in Cart.Base" in {why for _, why in found.closed}
