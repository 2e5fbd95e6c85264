"""What a stranger's model may do: run for long within limits, name things as it likes; never more than that."""

from __future__ import annotations

from pathlib import Path

import pytest
from typer.testing import CliRunner

from lacuna.cli.main import app

RECURSIVE = """model M
  function f
    input Real n;
    output Real y;
  algorithm
    {body}
  end f;
  function g
    input Real n;
    output Real y;
  algorithm
    y := f(n - 1);
  end g;
  Real z = f({argument});
end M;
"""
BOUND = "model M parameter {kind} k = {value}; Real x = {use}; end M;"
CSV_COLUMN = 'function csvColumn input String f; input String c; output Real v[:]; external "builtin"; end csvColumn; '


def simulated(folder: Path, text: str, *options: str) -> tuple[int, str]:
    """Exit status and what was said."""
    model = folder / "model.mo"
    model.write_text(text, encoding="utf-8")
    result = CliRunner().invoke(app, ["simulate", str(model), "--out", str(folder / "out"), *options])
    return result.exit_code, result.output


@pytest.mark.parametrize(
    ("body", "argument", "reason"),
    [
        ("y := if n <= 0 then 0 else 1 + f(n - 1);", "1e7 + time", "too deep"),
        ("y := if n <= 0 then 0 else 1 + g(n);", "1e7 + time", "too deep"),
        ("y := f(n);", "time", "too deep"),
        ("y := if n < 2 then n else f(n - 1) + f(n - 2);", "60 + floor(time)", "ran too long"),
        ("y := 0; " + "for i in 1:1000 loop " * 4 + "y := y + n;" + " end for;" * 4, "time", "ran too long"),
    ],
)
def test_a_function_ends(tmp_path: Path, body: str, argument: str, reason: str) -> None:
    status, said = simulated(tmp_path, RECURSIVE.format(body=body, argument=argument))
    assert (status, reason in said) == (1, True), said
    assert "model.mo:" in said and "in: function M." in said  # no place was told


def test_functions_that_call_each_other_give_their_value(tmp_path: Path) -> None:
    text = RECURSIVE.format(body="y := if n <= 0 then 0 else 1 + g(n);", argument="20 + floor(time)")
    assert simulated(tmp_path, text)[0] == 0
    assert (tmp_path / "out" / "M.csv").read_text().splitlines()[1].split(",")[1] == "20"


def test_an_integer_beyond_what_is_exact_ends_the_run(tmp_path: Path) -> None:
    text = "model M Integer i(start=1, fixed=true); equation when sample(0, 0.01) then i = pre(i)*10; end when; end M;"
    status, said = simulated(tmp_path, text)
    assert (status, "2^53" in said) == (1, True), said


@pytest.mark.parametrize(
    "declared",
    [
        "parameter Integer n = 9007199254740991; Integer i = n + 2;",
        "Integer k = if time < 0.5 then 1 else 94906267; Integer i = k*94906266 - k;",
        "Integer i(start=9007199254740990, fixed=true); equation when time > 0.5 then i = pre(i) + 3; end when;",
    ],
)
def test_an_integer_that_is_rounded_to_2_53_ends_the_run(tmp_path: Path, declared: str) -> None:
    """2^53 + 1 is 2^53 in a double, which passed for exact."""
    status, said = simulated(tmp_path, f"model M {declared} end M;")
    assert (status, "2^53" in said) == (1, True), said


F = "function f input Integer k; output Real y; algorithm y := 0; if k*k + 1 > k*k then y := 1; end if; end f; "


@pytest.mark.parametrize(
    "used",
    [
        "Boolean c = k*k + 1 > k*k;",
        "Real y = if k*k*k + 1 == k*k*k then 1 else 0;",
        "Real y = f(k);",
        "Real y = min(k*k, 7);",
        "Real y = sign(k*k - 7);",
        'equation assert(not k*k + 1 == k*k, "");',
        "Integer n(start=0, fixed=true); equation when k*k + 1 <= k*k then n = pre(n) + 1; end when;",
    ],
)
def test_what_a_product_beyond_2_53_decides_ends_the_run(tmp_path: Path, used: str) -> None:
    """k k + 1 > k k was false, without a word; where a branch that does not hold compares, nothing is lost."""
    text = f"model M {F} Integer k = if time < 0.5 then 3 else 1000000007; {used} end M;"
    status, said = simulated(tmp_path, text)
    assert (status, "2^53" in said or "(value nan)" in said) == (1, True), said
    text = f"model M {F} Integer k = if time < 0.5 then 3 else 50000; {used} end M;"
    assert simulated(tmp_path, text)[0] == 0
    guarded = "model M Integer k = if time < 0.5 then 3 else 1000000007; Boolean c = k < 1000 and k*k > 10; end M;"
    assert simulated(tmp_path, guarded)[0] == 0


@pytest.mark.parametrize(
    ("kind", "value", "use", "given"),
    [
        ("Real", "1", "k*time", "1_0"),
        ("Real", "1", "k*time", "nan"),
        ("Real", "1", "k*time", "inf"),
        ("Real", "1", "k*time", "١٢"),
        ("Integer", "1", "k*time", "1.5"),
        ("Integer", "1", "k*time", "1e30"),
        ("Integer", "1", "sum(fill(time, k))", "1.5"),
        ("Boolean", "true", "if k then time else 0", "7"),
        ("E", "E.a", "if k == E.a then time else 0", "7"),
    ],
)
def test_a_parameter_takes_values_of_its_type_only(tmp_path: Path, kind: str, value: str, use: str, given: str) -> None:
    text = BOUND.format(kind=kind, value=value, use=use).replace("model M", "model M type E = enumeration(a, b);", 1)
    status, said = simulated(tmp_path, text, "-p", f"k={given}")
    assert status == 1, said
    assert simulated(tmp_path, text)[0] == 0


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("c=1", "c is a constant, no parameter to be set"),
        ("found=9", "found of M is not to be set: equations give its value"),
        ("y=3", "y of M is not to be set: equations give its value"),
        ("held=2", "is final"),
    ],
)
def test_what_the_model_fixes_is_not_set(tmp_path: Path, given: str, told: str) -> None:
    text = """model M
  constant Real c = 4;
  parameter Real found(fixed = false, start = 2);
  final parameter Real held = 3;
  Real y = c*time;
initial equation
  found^2 = held;
end M;
"""
    status, said = simulated(tmp_path, text, "-p", given)
    assert status == 1
    assert told in said
    assert simulated(tmp_path, text)[0] == 0


@pytest.mark.parametrize(
    ("kind", "given", "said"),
    [
        ("Integer", "1.5", "whole numbers"),
        ("Integer", "1e30", "whole numbers"),
        ("Boolean", "2", "Boolean (0 or 1)"),
        ("Boolean", "{}/u.csv:u", "Boolean (0 or 1)"),
    ],
)
def test_an_input_takes_values_of_its_type_only(tmp_path: Path, kind: str, given: str, said: str) -> None:
    """1.5 went into an Integer, and 2 into a Boolean, as if they were Reals."""
    (tmp_path / "u.csv").write_text("time,u\n0,1\n0.5,0.5\n", encoding="utf-8")
    text = f"model M input {kind} u; Real x = if u == u then time else 0; end M;"
    status, found = simulated(tmp_path, text, "-u", "u=" + given.format(tmp_path))
    assert (status, "input u cannot be" in found and said in found) == (1, True), found
    assert simulated(tmp_path, text, "-u", "u=1")[0] == 0


def test_a_signal_that_is_named_twice_is_one_column(tmp_path: Path) -> None:
    assert simulated(tmp_path, "model M Real x = time, y = 2*x; end M;", *["--signal", "x", "--signal", "x"])[0] == 0
    assert (tmp_path / "out" / "M.csv").read_text().splitlines()[0] == "time,x"


@pytest.mark.parametrize("option", ["--rtol", "--atol"])
def test_a_tolerance_that_keeps_no_digit_is_refused(option: str, tmp_path: Path) -> None:
    """With --atol 1000 the explicit method ended at 1.2 where exp(-5) is the answer, and called the run complete."""
    status, said = simulated(tmp_path, "model M Real x(start=1, fixed=true); equation der(x) = -x; end M;", option, "2")
    assert (status, "keeps no digit" in said) == (1, True)


def test_no_name_leads_out_of_the_folder(tmp_path: Path) -> None:
    name = "'../../" + "a" * 300 + "'"
    assert simulated(tmp_path, f"model {name} Real x = time; end {name};")[0] == 0
    assert {p.name for p in tmp_path.iterdir()} == {"model.mo", "out"}


@pytest.mark.parametrize("where", ["part", "library", "command"])
def test_a_name_that_no_file_can_have_is_not_found(tmp_path: Path, where: str) -> None:
    """Names are looked up as files of a package; a file's name has 255 bytes at most."""
    name = "T" * 300
    if where == "command":
        result = CliRunner().invoke(app, ["simulate", f"Lacuna.{name}", "--out", str(tmp_path / "out")])
        assert (result.exit_code, "R001" in result.output) == (1, True)
        return
    text = f"model M {name} x; end M;" if where == "part" else f"model M extends Lacuna.Types.{name}; end M;"
    status, said = simulated(tmp_path, text)
    assert (status, "error[R001]" in said) == (1, True), said


def test_names_are_no_formulas_in_a_figure(tmp_path: Path) -> None:
    status, said = simulated(tmp_path, "model M Real '$x_{$' = time; end M;", "--plot")
    assert status == 0, said
    assert "$x_{$" in (tmp_path / "out" / "M.svg").read_text()


@pytest.mark.parametrize("rows", ["time,x,x\n0,1,2\n1,2,3\n", "time,x\n0,1\n1,1_0\n", "time,x\n0,1\n1,١\n"])
def test_a_column_of_data_is_what_it_says(tmp_path: Path, rows: str) -> None:
    (tmp_path / "data.csv").write_text(rows, encoding="utf-8")
    text = f'model M {CSV_COLUMN} parameter Real v[:] = csvColumn("data.csv", "x"); Real x = v[1]*time; end M;'
    status, said = simulated(tmp_path, text)
    assert (status, "F041" in said) == (1, True), said


DOUBLING = """model M
  function f
    input Real n;
    output Real y;
  protected
    String s = "a";
  algorithm
    for i in 1:60 loop
      {step}
    end for;
    y := n;
  end f;
  Real x = f({argument});
end M;
"""


@pytest.mark.parametrize("argument", ["40", "time"])
def test_a_string_that_doubles_ends(tmp_path: Path, argument: str) -> None:
    status, said = simulated(tmp_path, DOUBLING.format(step="s := s + s;", argument=argument))
    assert (status, "letters" in said) == (1, True), said


def test_what_nests_too_deeply_is_said(tmp_path: Path) -> None:
    body = "y := 2; for i in 1:10000 loop y := y^2; end for;"
    status, said = simulated(tmp_path, RECURSIVE.format(body=body, argument="40"))
    assert (status, "P013" in said) == (1, True) or status == 0, said


def test_want_of_memory_is_said_in_a_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr("lacuna.load", refuse)
    status, said = simulated(tmp_path, "model M Real x = time; end M;")
    assert (status, said.strip()) == (1, "error: there is not enough memory for this")


@pytest.mark.parametrize("command", [["simulate"], ["check"], ["fmu"], ["list", "models"], ["forecast"]])
def test_a_link_to_itself_is_named(tmp_path: Path, command: list[str]) -> None:
    """pathlib makes a RuntimeError of it, which was told as a fault of ours."""
    link = tmp_path / "loop.mo"
    link.symlink_to(link)
    result = CliRunner().invoke(app, [*command, str(link)])
    assert result.exit_code == 1 and "loop.mo: a symbolic link that leads to itself" in result.output


SUMS = "function g input Integer n; output Integer y; protected Integer z = n; algorithm for i in 1:60 loop z := {z}; "
SUMS += "end for; y := mod(z, 10); end g; "


@pytest.mark.parametrize("z", ["z + z + 1", "z - (-z)", "z + n*z"])
def test_sums_beyond_2_53_decide_nothing(tmp_path: Path, z: str) -> None:
    """In a function and in a model; what is known at translation is computed without rounding."""
    text = f"model M {SUMS.format(z=z)} parameter Integer p = 3; Integer y = g(p); end M;"
    status, said = simulated(tmp_path, text)
    assert (status, "2^53" in said) == (1, True), said
    exact = 3
    for _ in range(60):
        exact = {"z + z + 1": 2 * exact + 1, "z - (-z)": 2 * exact, "z + n*z": 4 * exact}[z]
    text = f"model M {SUMS.format(z=z)} constant Integer n = g(3); Real y = n + time; end M;"
    assert simulated(tmp_path, text)[0] == 0
    assert float((tmp_path / "out" / "M.csv").read_text().splitlines()[1].split(",")[1]) == exact % 10


def test_sums_of_a_model_beyond_2_53_decide_nothing(tmp_path: Path) -> None:
    text = "model M Integer q = if time < 0.5 then 3 else 4000000000000000; Integer a = mod(q + q + q + 1, 2); end M;"
    status, said = simulated(tmp_path, text)
    assert (status, "2^53" in said) == (1, True), said


def test_an_array_is_given_element_by_element(tmp_path: Path) -> None:
    text = "model M parameter Real v[2] = {3, 4}; Real y = v[1]*time; end M;"
    status, said = simulated(tmp_path, text, "-p", "v={1,2}")
    assert (status, "-p 'v[1]=...'" in said) == (1, True), said
    assert simulated(tmp_path, text, "-p", "v[1]=1")[0] == 0
