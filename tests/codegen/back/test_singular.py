"""Models without a unique solution: the message names equations and unknowns by source line."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.compile import translate
from lacuna.codegen.emit.source import generate
from lacuna.codegen.errors import Diagnostic
from tests.codegen.generated import write_model

CASES = {
    "parameters in a cycle": (
        "S001", 2, "depends on itself",
        "model Cycle\n  parameter Real a = b; parameter Real b = 2*a; Real x(start=0);\nequation\n"
        "  der(x) = a;\nend Cycle;",
    ),
    "aliases with different starts": (
        "S002", 2, "equal but have different fixed start",
        "model Starts\n  Real a(start=1, fixed=true); Real b(start=2, fixed=true);\nequation\n"
        "  a = b;\n  der(a) = -b;\n"
        "end Starts;",
    ),
    "more equations than unknowns": (
        "S003", 5, "too many equations: 2 for x",
        "model Over\n  Real x; Real y(start=0);\nequation\n"
        "  x = 2*time;\n  x = sin(time/5) + 1;\n  der(y) = x;\nend Over;",
    ),
    "fewer equations than unknowns": (
        "S003", 2, "too few equations: 1 for y, z",
        "model Under\n  Real y; Real z; Real x(start=0);\nequation\n  y + z = 1;\n  der(x) = -x;\nend Under;",
    ),
    "input of a component that nothing drives": (
        "S003", 3, "nothing gives a value to the input a.u2",
        "model Open\n  block Add\n    input Real u1; input Real u2; output Real y;\n  equation\n    y = u1 + u2;\n"
        "  end Add;\n  Add a(u1=time); Real x(start=0);\nequation\n  der(x) = a.y;\nend Open;",
    ),
    "differentiated input": (
        "S004", 4, "the input u would have to be differentiated",
        "model Driven\n  input Real u; Real x; Real w;\nequation\n  x = u;\n  w = der(x);\nend Driven;",
    ),
    "constraint without a regular pivot": (
        "S005", 5, "do not determine any of them at the start values",
        "model Pivot\n  Real x; Real y; Real f; Real g;\nequation\n  der(x) = f; der(y) = g;\n"
        "  x^2 + x*y = 1; 2*x^2 + 2*x*y = 2;\nend Pivot;",
    ),
    "discrete equation without an unknown": (
        "S010", 4, "no discrete variable is left",
        "model Solved\n  Boolean b; Real x(start=0);\nequation\n  not b = x > 1;\n  der(x) = 1;\nend Solved;",
    ),
    "discrete variable without an equation": (
        "S012", 2, "the discrete variable b has no equation",
        "model Missing\n  Boolean b; Real x(start=0);\nequation\n  der(x) = if b then 1 else -1;\nend Missing;",
    ),
    "assigned twice": (
        "S011", 5, "n is assigned twice",
        "model Twice\n  Integer n(start=0); Real x(start=0);\nequation\n  when x > 1 then n = 1; end when;\n"
        "  when x > 2 then n = 2; end when;\n  der(x) = 1;\nend Twice;",
    ),
    "assigned twice in one when-clause": (
        "S011", 6, "x[1] is assigned twice",
        "model Twice\n  Real x[2](each start=0);\nequation\n  when time > 1 then\n    x = {1, 2};\n    x[1] = 3;\n"
        "  end when;\nend Twice;",
    ),
    "assigned twice by a loop": (
        "S011", 4, "n is assigned twice",
        "model Twice\n  Integer n(start=0);\nequation\n  when time > 1 then for i in 1:2 loop n = i; end for; "
        "end when;\nend Twice;",
    ),
    "discrete loop without pre": (
        "S013", 4, "depend on each other in a loop: a, b",
        "model Loop\n  Boolean a; Boolean b; Real x(start=0);\nequation\n"
        "  a = not b;\n  b = not a;\n  der(x) = 1;\nend Loop;",
    ),
    "too many initial equations": (
        "S020", 5, "too many initial equations",
        "model Init\n  Real x(start=0);\ninitial equation\n  x = 1;\n  x = 2;\nequation\n  der(x) = -x;\nend Init;",
    ),
    "fixed start against an initial equation": (
        "S022", 2, "x has a fixed start value",
        "model Fixed\n  Real x(start=0, fixed=true);\ninitial equation\n  der(x) = 0;\nequation\n  der(x) = 1 - x;\n"
        "end Fixed;",
    ),
    "parameter to be solved for": (
        "S023", 2, "no initial equation gives the parameter n",
        "model Free\n  parameter Integer n(fixed=false); Real x(start=1);\ninitial equation\n  2*n = 4;\nequation\n"
        "  der(x) = -n*x;\nend Free;",
    ),
    "reinit of what is not a state": (
        "C002", 5, "is not a state here",
        "model Jump\n  Real x(start=0); Real y;\nequation\n  y = 2*x;\n  when x > 1 then reinit(y, 0); end when;\n"
        "  der(x) = 1;\nend Jump;",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_refused_with_place_and_reason(case: str, tmp_path: Path) -> None:
    code, line, message, text = CASES[case]
    with pytest.raises(Diagnostic) as caught:
        generate(translate(write_model(tmp_path, text))[0])
    assert caught.value.code == code, caught.value
    assert message in caught.value.message
    assert caught.value.span.line == line
    assert caught.value.hint


def test_notes_list_the_equations_and_unknowns_involved(tmp_path: Path) -> None:
    with pytest.raises(Diagnostic) as caught:
        translate(write_model(tmp_path, CASES["fewer equations than unknowns"][3]))
    assert [(span.line, remark) for span, remark in caught.value.notes] == [
        (4, "equation  y + z = 1"), (2, "unknown  y"), (2, "unknown  z")
    ]  # fmt: skip


def test_a_circuit_without_ground_is_told_so(tmp_path: Path) -> None:
    text = """model Floating
      Lacuna.Components.Electrical.ConstantVoltage source(V = 5);
      Lacuna.Components.Electrical.Resistor r(R = 10);
    equation
      connect(source.p, r.p);
      connect(r.n, source.n);
    end Floating;
    """
    with pytest.raises(Diagnostic) as caught:
        translate(write_model(tmp_path, text))
    assert caught.value.code == "S003"
    assert "ground" in caught.value.hint
    assert any(remark.endswith("(of r)") for _, remark in caught.value.notes)
