"""What users wrote stays data in the C of a model: every character of a string, every name of a function."""

from __future__ import annotations

import ctypes
import math
from pathlib import Path
import re
import subprocess

import pytest

from lacuna.codegen.cache import INCLUDE, compile_c
from lacuna.codegen.compile import compile_model
from lacuna.codegen.emit.functions.prelude import _HELPERS, helpers
from lacuna.codegen.emit.text.c_text import c_comment, c_string
from lacuna.codegen.emit.text.expression import function_name
from lacuna.codegen.emit.text.names import Names
from lacuna.runtime import Model, simulate
from tests.codegen.generated import write_model

HARD = ["", "\a1", "\v7f", "a\x017", "\\", '"', "???/", "??/\n", "??=??(??<", "\\?", "?\\?", "%s", "*/ x /*", "\x7f",
        "\x80\x9f", "µΩ°", "\u202e", "\u2028", "\U0001f600", "\ufeff", "??" * 9]  # fmt: skip
TRIGRAPHS = [f"?{'?' * k}{c}9" for k in (1, 2) for c in "=/'()!<>-?"]


def test_strings_come_back_byte_for_byte(tmp_path: Path) -> None:
    texts = [*(chr(code) + tail for code in range(1, 256) for tail in ("", "0", "f")), *HARD, *TRIGRAPHS]
    rows = ",\n".join(f"  {c_string(text)} /* {c_comment(text)} */" for text in texts)
    source = f"const char *const texts[] = {{\n{rows}\n}};\n"
    (tmp_path / "texts.c").write_text(source, encoding="utf-8")
    compile_c(tmp_path / "texts.c", tmp_path / "texts.so")
    found = (ctypes.c_char_p * len(texts)).in_dll(ctypes.CDLL(str(tmp_path / "texts.so")), "texts")
    assert list(found) == [text.encode() for text in texts]


@pytest.mark.parametrize("text", ["a */ b", "/* a", "*//*", "/*/", "a\\", "??/", "x\u202ey"])
def test_a_comment_cannot_be_left(text: str) -> None:
    comment = c_comment(text)
    assert "*/" not in comment
    assert "/*" not in comment
    assert "??/" not in comment
    assert comment.isprintable()


def test_functions_have_names_of_their_own() -> None:
    names = ["P.a_b", "P.a.b", "P_a.b", "P.a_.b", "P.a._b", "f[2]", "f.2", "f[2,3]", "f[23]", "f:tangent", "f.tangent",
             "f_all", "f.all", "f", "P.'a.b'", "P.a_05f_b", "P.a__b"]  # fmt: skip
    taken = [function_name(name, whole) for name in names for whole in (False, True)]
    assert len(set(taken)) == len(taken)
    assert all(name.isidentifier() and name.isascii() for name in taken)


def test_functions_that_differ_in_a_dot_are_both_called(tmp_path: Path) -> None:
    body = (
        "input Real x; output Real y; protected Real r; algorithm r := x; while r > 1 loop r := r - {step}; end while; "
    )
    one, other = (body.format(step=step) + "y := r;" for step in (1, 0.25))
    model = write_model(tmp_path, f"""model Names
  package a function b {one} end b; end a;
  function a_b {other} end a_b;
  Real u = a.b(3.6 + 0*time), w = a_b(3.6 + 0*time);
end Names;""")  # fmt: skip
    compiled = Model(compile_model(model, cache_directory=str(tmp_path)).path)
    result = simulate(compiled, stop=1.0)
    assert result["u"][-1] == pytest.approx(0.6)
    assert result["w"][-1] == pytest.approx(0.85)


def test_the_range_of_a_loop_is_evaluated_once(tmp_path: Path) -> None:
    model = write_model(tmp_path, """model Once
  function f input Real x; output Real y; protected Integer n; algorithm
    n := integer(x); y := 0;
    for i in 1:n loop n := n + 1; for i in i:n loop y := y + 1; n := n - 1; end for; end for;
  end f;
  Real y = f(3.5 + 0*time);
end Once;""")  # fmt: skip
    result = simulate(Model(compile_model(model, cache_directory=str(tmp_path)).path), stop=1.0)
    n, y = 3, 0
    for i in range(1, n + 1):
        n += 1
        for _ in range(i, n + 1):
            y, n = y + 1, n - 1
    assert result["y"][-1] == y


def test_no_identifier_is_a_macro_of_the_headers() -> None:
    includes = "#include <math.h>\n#include <stddef.h>\n#include <string.h>\n#include <mdl_abi.h>\n"
    command = ["cc", "-std=c11", f"-I{INCLUDE}", "-dM", "-E", "-x", "c", "-"]
    text = subprocess.run(command, input=includes, capture_output=True, text=True, check=True).stdout
    macros = {line.split()[1] for line in text.splitlines() if "(" not in line.split()[1]}
    assert "HUGE_VAL" in macros
    assert {name for name in macros if not name.startswith("_") and Names([]).identifier(name) in macros} == set()


@pytest.mark.parametrize("name", list(_HELPERS))
def test_a_helper_brings_nothing_that_it_does_not_use(name: str) -> None:
    """A function of the prelude that nobody calls is an error of the compiler: each comes alone in some model."""
    text = helpers(f"{name}(")
    defined = re.findall(r"^static [^(;]*?\b(mdl_\w+)\(", text, re.MULTILINE)
    called = {other for other in defined if text.count(f"{other}(") > 1}
    own = set(re.findall(r"^static [^(;]*?\b(mdl_\w+)\(", _HELPERS[name], re.MULTILINE))
    assert set(defined) <= called | own


NESTED = """model Nested
  function slope input Real x; output Real y; algorithm
    y := 0;
    for i in 1:2 loop assert(y < 1e9, "large"); y := y + x/i; end for;
  end slope;
  function rate input Real x; output Real y; algorithm
    y := slope(x)*0.5;
    assert(y < 1e9, "large");
    for i in 1:2 loop y := y + x/i; end for;
  end rate;
  Real x(start=1, fixed=true);
equation
  der(x) = -rate(x);
end Nested;"""


def test_the_first_result_of_a_derivative_is_there_for_functions_that_call_it(tmp_path: Path) -> None:
    """It was defined after them, and the compiler refused the model. rate is 2.25 x, so x = exp(-2.25 t)."""
    model = Model(compile_model(write_model(tmp_path, NESTED), cache_directory=str(tmp_path)).path)
    assert simulate(model, stop=1.0, rtol=1e-9)["x"][-1] == pytest.approx(math.exp(-2.25), rel=1e-7)
