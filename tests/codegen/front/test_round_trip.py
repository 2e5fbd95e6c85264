"""Printing an expression and reading it again gives the same node: printer, parser and lowering agree."""

from __future__ import annotations

from pathlib import Path
import re

from hypothesis import HealthCheck, assume, given, settings

from lacuna.codegen.flat.text import dump_flat
from lacuna.codegen.symbolic import expr as ex
from tests.codegen.back.expressions import EXPRESSIONS
from tests.codegen.front.helpers import flatten_text


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(EXPRESSIONS)
def test_an_expression_survives_printing_and_parsing(tmp_path: Path, e: ex.Expr) -> None:
    text = f"model M Real a, b, c, y; equation y = {ex.to_text(e)}; end M;"
    assume(not re.search(r"/ 0\.0(?!\d)", text))  # the language refuses it
    (equation,) = flatten_text(tmp_path, text).equations
    assert equation.rhs is e, ex.to_text(e)


def test_a_flat_model_reads_as_modelica(tmp_path: Path) -> None:
    """The dump of a model without dotted names is itself a model, and its dump is the same text."""
    text = """model M "text with \\"quotes\\""
      parameter Real p(unit = "Ohm", min = 0) = 2 "resistance";
      final parameter Integer n = 3;
      Real x(start = 1, fixed = true, stateSelect = StateSelect.prefer), y(nominal = 100);
      discrete Real s(start = 0);
      Boolean on(start = false) = x > 0.5;
    initial equation
      y = -1;
    equation
      der(x) = -x^2/(1 + abs(x)) - (if on then -y else max(x, y));
      der(y) = x - (y - 1);
      when {sample(0, 0.1), change(on)} then
        s = pre(s) + 1;
        if s > 9 and not on then terminate("done"); end if;
      elsewhen x < -1 or initial() then
        s = 0;
        reinit(x, 1);
      end when;
      assert(x < 10, "x is large", AssertionLevel.warning);
    end M;"""

    def dumped(text: str) -> str:
        return re.sub(r"  // \d+$", "", dump_flat(flatten_text(tmp_path, text, units="off")), flags=re.MULTILINE)

    once = dumped(text)
    assert dumped(once.replace("class M", "model M").replace(" := ", " = ")) == once
