"""Results that other tools open: MAT files for Modelica readers, Parquet; every declared name is in them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.io import loadmat

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from tests.results import read_result

MODEL = """model Box "Two names for one current"
  parameter Real R(unit="Ohm") = 2 "Widerstand, Ω";
  Real i(unit="A", start=1, fixed=true) "Current";
  Real j(unit="A") "The same, counted the other way";
  Real k(unit="A") "The same";
  Boolean high = i > 0.5;
equation
  der(i)*1 = -R*i/2;
  j = -i;
  k = i;
end Box;
"""


@pytest.fixture(scope="module")
def result(tmp_path_factory) -> runtime.Result:
    file = tmp_path_factory.mktemp("model") / "Box.mo"
    file.write_text(MODEL, encoding="utf-8")
    model = runtime.Model(compile_model(str(file), units="warn").path)
    return runtime.simulate(model, stop=1.0, interval=0.01, events=False)


def test_a_modelica_reader_opens_the_mat_file(result: runtime.Result, tmp_path: Path) -> None:
    dymat = pytest.importorskip("DyMat")
    path = runtime.write_mat(result, tmp_path / "Box.mat", result.model.declared)
    file = dymat.DyMatFile(str(path))
    assert set(file.names()) == {"i", "j", "k", "high", "R", *[n for n in file.names() if n.startswith("der")]}
    for name in ("i", "j", "k", "high"):
        np.testing.assert_array_equal(file.data(name), result[name])
        np.testing.assert_array_equal(file.abscissa(name, valuesOnly=True), result.time)
    np.testing.assert_array_equal(file.data("R"), [2.0, 2.0])
    assert file.description("j") == "The same, counted the other way [A]"
    np.testing.assert_allclose(file.data("i"), np.exp(-result.time), rtol=1e-4)  # di/dt = -i


def test_the_mat_file_has_the_layout_of_modelica_tools(result: runtime.Result, tmp_path: Path) -> None:
    content = loadmat(runtime.write_mat(result, tmp_path / "Box.mat", result.model.declared), chars_as_strings=False)
    assert ["".join(row).strip() for row in content["Aclass"]] == ["Atrajectory", "1.1", "", "binTrans"]
    names = ["".join(column).strip() for column in content["name"].T]
    assert names[0] == "time"
    info = dict(zip(names, content["dataInfo"].T.tolist(), strict=True))
    assert info["i"][:2] == info["k"][:2] == [2, -info["j"][1]]  # aliases take no room, and keep their sign
    assert info["R"][0] == 1
    np.testing.assert_array_equal(content["data_1"][0], result.time[[0, -1]])
    np.testing.assert_array_equal(content["data_2"][0], result.time)


def test_parquet_has_columns_and_units(result: runtime.Result, tmp_path: Path) -> None:
    pq = pytest.importorskip("pyarrow.parquet")
    table = pq.read_table(runtime.write_parquet(result, tmp_path / "Box.parquet", result.model.declared))
    for name in ("time", "i", "j", "k"):
        np.testing.assert_array_equal(table[name].to_numpy(), result[name])
    assert table.schema.field("i").metadata[b"unit"] == b"A"


def test_a_number_in_csv_is_short_and_exact(result: runtime.Result, tmp_path: Path) -> None:
    path = runtime.write_csv(result, tmp_path / "Box.csv", ["i", "j", "high"])
    columns, meta = read_result(path)
    np.testing.assert_array_equal(columns["i"], result["i"])
    np.testing.assert_array_equal(columns["j"], -result["i"])
    assert path.read_text(encoding="utf-8").splitlines()[1] == "0,1,-1,1"
    assert list(meta["columns"]) == ["time", "i", "j", "high"]


def test_what_carries_a_value_within_an_event_is_not_recorded(tmp_path: Path) -> None:
    """`new x[1]` stood beside x[1] in the results."""
    text = "model Register\n  Integer x[2](each start=0, each fixed=true);\nalgorithm\n  when sample(0.1, 0.2) then\n"
    file = tmp_path / "Register.mo"
    file.write_text(f"{text}    x := {{x[2] + 1, x[1]}};\n  end when;\nend Register;\n", encoding="utf-8")
    model = runtime.Model(compile_model(str(file)).path)
    assert model.recordable == model.declared == ["x[1]", "x[2]"]
