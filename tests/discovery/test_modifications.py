"""Parameters of a believed model as the amended one gives them: of arrays, which only have a value as a whole, too."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.classes import Library
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.modifications import modified
from lacuna.discovery.catalogue.places import read as structure_of
from lacuna.runtime import Model

CHAIN = """package Chain
  model Cell
    parameter Real R = 1;
    parameter Real b[2] = {1, 2};
    Real x(start=1, fixed=true);
  equation
    der(x) = -R*x + b[1] - b[2];
  end Cell;
  model Whole
    parameter Real k = 3;
    Cell cell[3];
  end Whole;
end Chain;
"""


def test_elements_are_given_together() -> None:
    given = {"k": 4.0, "cell[2].R": 0.5, "cell[1].R": 1.5, "a[1]": 7.0}
    assert modified(given) == ["k=4", "cell.R={1.5, 0.5}", "a={7}"]
    assert modified({f"m[{i},{j}]": 10.0 * i + j for i in (1, 2) for j in (1, 2)}) == ["m={{11, 12}, {21, 22}}"]


def test_the_model_that_is_written_has_these_values(tmp_path: Path) -> None:
    source = tmp_path / "Chain.mo"
    source.write_text(CHAIN)
    values = {f"cell[{i}].b[{j}]": i + 0.1 * j for i in (1, 2, 3) for j in (1, 2)} | {"k": 5.0}
    amendment = Amendment(structure_of(Library([str(source)]), "Chain.Whole"), parameters=values)
    path = tmp_path / "Amended.mo"
    path.write_text(amendment.text("Amended"))
    model = Model(compile_model(str(path), search_path=[str(source)]).path)
    assert {n: model.variables[n].start for n in values} == pytest.approx(values)
