"""connect: equalities, sums of flows, and zero where nothing is connected."""

from __future__ import annotations

from pathlib import Path

from tests.codegen.front.helpers import equations, flatten_text

PARTS = """
connector Pin Real v; flow Real i; end Pin;
connector Signal = input Real;
connector Result = output Real;
model Resistor
  Pin p, n;
equation
  p.v - n.v = p.i;
  p.i + n.i = 0;
end Resistor;
model Source Result y = sin(time); end Source;
model Sink Signal u; end Sink;
"""
LAW = ["{0}.p.v - {0}.n.v = {0}.p.i", "{0}.p.i + {0}.n.i = 0"]


def law(*names: str) -> list[str]:
    return [line.format(name) for name in names for line in LAW]


def test_a_node_of_three(tmp_path: Path) -> None:
    text = PARTS + "model M Resistor a, b, c; equation connect(a.p, b.p); connect(b.p, c.p); end M;"
    assert equations(flatten_text(tmp_path, text)) == [
        *law("a", "b", "c"),
        "a.p.v = b.p.v", "a.p.v = c.p.v", "a.p.i + b.p.i + c.p.i = 0.0",
        "a.n.i = 0.0", "b.n.i = 0.0", "c.n.i = 0.0",
    ]  # fmt: skip


def test_flows_of_an_outer_connector_count_inwards(tmp_path: Path) -> None:
    """Inside a component its own connector is the outside: what enters through it leaves into the parts."""
    text = (
        PARTS
        + """
    model Pair Pin p, n; Resistor a, b;
    equation connect(p, a.p); connect(a.n, b.p); connect(b.n, n); end Pair;
    model M Pair pair; Resistor r; equation connect(pair.n, r.p); end M;"""
    )
    found = equations(flatten_text(tmp_path, text))
    assert "pair.a.p.i - pair.p.i = 0.0" in found
    assert "pair.n.i + r.p.i = 0.0" in found
    assert "pair.p.i = 0.0" in found
    potentials = [e for e in found if ".v = " in e and " - " not in e]
    assert len(potentials) == 4


def test_joining_twice_adds_nothing(tmp_path: Path) -> None:
    text = PARTS + "model M Resistor a, b; equation {} end M;"
    once = flatten_text(tmp_path, text.format("connect(a.p, b.p);"))
    twice = flatten_text(tmp_path, text.format("connect(a.p, b.p); connect(b.p, a.p);"))
    assert equations(once) == equations(twice)


def test_arrays_connect_element_by_element(tmp_path: Path) -> None:
    text = (
        PARTS
        + """model M
      Resistor r[3];
      Pin node;
      Source s[2];
      Sink k[2];
    equation
      connect(s.y, k.u);
      for i in 1:2 loop connect(r[i].n, r[i + 1].p); end for;
      connect(r[1].p, node);
    end M;"""
    )
    found = equations(flatten_text(tmp_path, text))
    assert [e for e in found if "k[" in e] == ["s[1].y = k[1].u", "s[2].y = k[2].u"]
    assert "r[1].n.i + r[2].p.i = 0.0" in found
    assert "r[2].n.v = r[3].p.v" in found


def test_signals_are_equal(tmp_path: Path) -> None:
    text = PARTS + "model M Source s; Sink a, b; equation connect(s.y, a.u); connect(s.y, b.u); end M;"
    assert equations(flatten_text(tmp_path, text)) == ["s.y = sin(time)", "s.y = a.u", "s.y = b.u"]


def test_each_equation_knows_its_place(tmp_path: Path) -> None:
    text = PARTS + "model M\n  Resistor a, b;\nequation\n  connect(a.p, b.p);\nend M;"
    model = flatten_text(tmp_path, text)
    joined = next(e for e in model.equations if e.text.startswith("connected"))
    first = model.equations[0]
    assert joined.span.line == text[: text.index("connect(a")].count("\n") + 1
    assert (first.origin, first.text) == ("a", "p.v - n.v = p.i")
