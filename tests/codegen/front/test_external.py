"""External C of the user: refused unless allowed, then compiled with what its annotation names (Modelica 3.6, 12.9)."""

from __future__ import annotations

from pathlib import Path
import zipfile

import numpy as np
import pytest

import lacuna
from lacuna.codegen.errors import Diagnostic

HEADER = """\
#ifndef MINE_H
#define MINE_H
#include "ModelicaUtilities.h"
#include "offset.h"
static double weigh(double x, const double *a, int n, int *count, double *twice, int *flags) {
  double sum = OFFSET;
  for (int i = 0; i < n; i++) {
    sum += a[i] * x;
    twice[i] = 2 * a[i] * x;
    flags[i] = a[i] > 1.5;
  }
  *count = n;
  return sum;
}
static double below(double x) {
  if (x > 0.5) ModelicaFormatError("%g is too large", x);
  return x;
}
#endif
"""
MODEL = """\
package P
  function weigh
    input Real x;
    input Real a[:];
    output Real y;
    output Integer count;
    output Real twice[size(a, 1)];
    output Boolean flags[size(a, 1)];
    external "C" y = weigh(x, a, size(a, 1), count, twice, flags) annotation(Include="#include \\"mine.h\\"");
  end weigh;
  function whole
    input Real x;
    output Real z;
  protected
    Real y;
    Integer count;
    Real twice[3];
    Boolean flags[3];
  algorithm
    (y, count, twice, flags) := weigh(x, {1, 2, 3});
    z := y + 100*count + twice[3] + (if flags[1] then 1e4 else 0) + (if flags[2] then 1e3 else 0);
  end whole;
  function first
    input String s;
    input Integer k;
    output Integer n;
    external annotation(Include="static int first(const char *s, int k) { return s[k]; }");
  end first;
  function cosine "declared by nobody: its types follow from the function"
    input Real x;
    output Real y;
    external "C" y = cos(x);
  end cosine;
  function below
    input Real x;
    output Real y;
    external "C" annotation(Include="#include <mine.h>");
  end below;
  model Values
    Real y = whole(time);
    Real b = first("abc", 1);
    Real w(start=1, fixed=true);
    Real q(start=0.5) "through the difference quotient of the function";
  equation
    der(w) = -cosine(w);
    cosine(q) = q;
  end Values;
  model Fails
    Real x(start=0, fixed=true);
  equation
    der(x) = below(time);
  end Fails;
  model Missing
    function nowhere
      input Real x;
      output Real y;
      external "C" y = no_such_function(x);
    end nowhere;
    Real y = nowhere(time);
  end Missing;
  model Fortran
    function f
      input Real x;
      output Real y;
      external "FORTRAN 77" y = f(x);
    end f;
    Real y = f(time);
  end Fortran;
end P;
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    include = tmp_path / "Resources" / "Include"
    include.mkdir(parents=True)
    (include / "mine.h").write_text(HEADER, encoding="utf-8")
    (include / "offset.h").write_text("#define OFFSET 1.0\n", encoding="utf-8")
    (tmp_path / "P.mo").write_text(MODEL, encoding="utf-8")
    return tmp_path / "P.mo"


def test_it_is_refused_unless_allowed(package: Path) -> None:
    with pytest.raises(Diagnostic, match="allow-external") as refused:
        lacuna.load(package, class_name="P.Values")
    assert (refused.value.code, refused.value.span.line) == ("R094", 20)


def test_values_cross_in_the_types_of_c(package: Path) -> None:
    model = lacuna.load(package, class_name="P.Values", allow_external=True)
    assert sum("W009" in str(w) for w in model.warnings) == 3
    result = model.simulate(stop=1, rtol=1e-9)
    np.testing.assert_allclose(result["y"], 1301 + 12 * result["time"], rtol=1e-14)
    assert result["b"][-1] == ord("b")
    np.testing.assert_allclose(result["q"], 0.7390851332151607, rtol=1e-9)
    gudermann = np.arcsinh(np.tan(1)) - result["time"]  # the integral of dw/cos(w) from 1
    np.testing.assert_allclose(result["w"], np.arctan(np.sinh(gudermann)), rtol=1e-7)


def test_a_header_that_changes_makes_the_model_new(package: Path) -> None:
    before = lacuna.load(package, class_name="P.Values", allow_external=True).simulate(stop=1)["y"][0]
    (package.parent / "Resources/Include/offset.h").write_text("#define OFFSET 2.0\n", encoding="utf-8")
    assert lacuna.load(package, class_name="P.Values", allow_external=True).simulate(stop=1)["y"][0] == before + 1
    with pytest.raises(Diagnostic, match="allow-external"):  # what was compiled is not for those who do not allow it
        lacuna.load(package, class_name="P.Values")


def test_an_error_of_the_c_ends_the_run(package: Path, capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(lacuna.IncompleteRun):
        lacuna.load(package, class_name="P.Fails", allow_external=True).simulate(stop=1)
    assert "is too large" in capfd.readouterr().err


@pytest.mark.parametrize(("name", "said"), [("Missing", "no_such_function"), ("Fortran", "FORTRAN")])
def test_what_cannot_be_compiled_is_refused_with_its_line(package: Path, name: str, said: str) -> None:
    line = next(k for k, text in enumerate(MODEL.splitlines(), 1) if said in text)
    with pytest.raises(Diagnostic, match=said) as refused:
        lacuna.load(package, class_name=f"P.{name}", allow_external=True)
    assert (refused.value.code, refused.value.span.line) == ("R094", line)


def test_an_fmu_carries_the_c(package: Path, tmp_path: Path) -> None:
    """Its sources hold the text of the headers: nothing of the model's folder is needed to compile them."""
    made = lacuna.export_fmu(package, tmp_path / "out" / "v.fmu", class_name="P.Values", allow_external=True)
    source = zipfile.ZipFile(made.path).read("sources/generated.c").decode()
    assert "static double weigh(" in source
    assert "#define OFFSET 1.0" in source
    assert '#include "mine.h"' not in source


def test_data_is_read_below_the_folders_that_are_named(tmp_path: Path) -> None:
    (tmp_path / "data").mkdir()
    (tmp_path / "models").mkdir()
    (tmp_path / "data" / "t.csv").write_text("time,x\n0,1\n1,3\n", encoding="utf-8")
    text = """\
model Load
  import Lacuna.Functions.csvColumn;
  parameter String file = "t.csv";
  parameter Real x[:] = csvColumn(file, "x");
  Real y = sum(x)*time;
end Load;
"""
    model = tmp_path / "models" / "Load.mo"
    model.write_text(text, encoding="utf-8")
    with pytest.raises(Diagnostic, match="there is no data file"):
        lacuna.load(model)
    assert lacuna.load(model, data=[tmp_path / "data"]).simulate(stop=1)["y"][-1] == 4
    model.write_text(text.replace("t.csv", "../data/t.csv"), encoding="utf-8")
    with pytest.raises(Diagnostic, match="there is no data file"):
        lacuna.load(model)
    model.write_text(text.replace("t.csv", str(tmp_path / "data/t.csv")), encoding="utf-8")
    assert lacuna.load(model, data=[tmp_path / "data"]).simulate(stop=1)["y"][-1] == 4
    with pytest.raises(Diagnostic, match="there is no folder of data"):
        lacuna.load(model, data=[tmp_path / "none"])
