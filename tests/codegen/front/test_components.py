"""Classes to components: modifications, inheritance, redeclaration, conditions, arrays, inner and outer."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.symbolic.expr import to_text
from tests.codegen.front.helpers import equations, flatten_text

INERTIA = """
type Angle = Real(final quantity = "Angle", final unit = "rad", displayUnit = "deg");
model Inertia "Rotating mass"
  parameter Real J(unit = "kg.m2", min = 0) = 1 "Moment of inertia";
  Angle phi(start = 0.5);
  Real w(unit = "rad/s", start = 0, fixed = true);
protected
  parameter Real half = J/2;
equation
  w = der(phi);
  J*der(w) = 0;
end Inertia;
"""


def test_attributes_come_from_type_declaration_and_use(tmp_path: Path) -> None:
    text = INERTIA + "model M Inertia a(J = 3, phi(start = 2, fixed = true, stateSelect = StateSelect.prefer)); end M;"
    phi = flatten_text(tmp_path, text).variables["a.phi"]
    assert (phi.unit, phi.quantity, phi.state_select) == ("rad", "Angle", "prefer")
    assert (phi.start.value, phi.fixed.value) == (2.0, True)


def test_description_place_and_binding_are_kept(tmp_path: Path) -> None:
    j = flatten_text(tmp_path, INERTIA + "model M Inertia a(J = 3); end M;").variables["a.J"]
    assert (j.description, j.binding.value, j.min.value, j.variability) == ("Moment of inertia", 3.0, 0.0, "parameter")
    assert j.span.line == 4


@pytest.mark.parametrize(
    ("outer", "expected"),
    [
        ("extends Base(k = 2);", 2.0),
        ("extends Base;", 1.0),
        ("Base b(k = 5);", 5.0),
        ("extends Middle(k = 4);", 4.0),
        ("extends Middle;", 3.0),
    ],
)
def test_the_outer_modification_wins(tmp_path: Path, outer: str, expected: float) -> None:
    text = f"""
    model Base parameter Real k = 1; Real x = k*time; end Base;
    model Middle extends Base(k = 3); end Middle;
    model M {outer} end M;"""
    model = flatten_text(tmp_path, text)
    assert (model.variables.get("k") or model.variables["b.k"]).binding.value == expected


def test_a_modifier_means_the_variables_around_it(tmp_path: Path) -> None:
    text = INERTIA + "model M parameter Real J = 7; Inertia a(J = 2*J); end M;"
    assert to_text(flatten_text(tmp_path, text).variables["a.J"].binding) == "2 * J"


def test_arrays_of_components_take_their_own_values(tmp_path: Path) -> None:
    text = INERTIA + "model M Inertia a[2](J = {3, 4}, each phi(start = 1), w(fixed = {true, false})); end M;"
    variables = flatten_text(tmp_path, text).variables
    assert [variables[f"a[{i}].J"].binding.value for i in (1, 2)] == [3.0, 4.0]
    assert [variables[f"a[{i}].phi"].start.value for i in (1, 2)] == [1.0, 1.0]
    assert [variables[f"a[{i}].w"].fixed.value for i in (1, 2)] == [True, False]


def test_an_index_that_changes_chooses_among_components(tmp_path: Path) -> None:
    text = """
    model Part parameter Real k = 1; Real x = k*time; end Part;
    model M Part p[3](k = {1, 2, 3}); Integer n(start = 1); Real y = p[n].x;
    equation when time > 1 then n = 3; end when; end M;"""
    found = equations(flatten_text(tmp_path, text))
    assert found[-1] == "y = if n == 1 then p[1].x else if n == 2 then p[2].x else if n == 3 then p[3].x else nan"


def test_redeclaration_keeps_the_constraint(tmp_path: Path) -> None:
    text = """
    partial model Load Real tau; end Load;
    model None_ extends Load; equation tau = 0; end None_;
    model Spring extends Load; parameter Real c = 1; equation tau = c*time; end Spring;
    model Bench replaceable None_ load constrainedby Load; end Bench;
    model M Bench bench(redeclare Spring load(c = 4)); end M;"""
    model = flatten_text(tmp_path, text)
    assert equations(model) == ["bench.load.tau = bench.load.c * time"]
    assert model.variables["bench.load.c"].binding.value == 4.0


def test_a_condition_removes_component_and_connections(tmp_path: Path) -> None:
    text = """
    connector Pin Real v; flow Real i; end Pin;
    model Ground Pin p; equation p.v = 0; end Ground;
    model M
      parameter Boolean grounded = false;
      Ground g if grounded;
      Ground h;
    equation
      connect(g.p, h.p);
    end M;"""
    model = flatten_text(tmp_path, text)
    assert [name for name in model.variables if name.startswith("g.")] == []
    assert equations(model) == ["h.p.v = 0", "h.p.i = 0.0"]
    assert model.variables["grounded"].evaluated


def test_inner_serves_every_outer_below(tmp_path: Path) -> None:
    text = """
    model World parameter Real g = 9.81; end World;
    model Body outer World world; Real f = 2*world.g; end Body;
    model Frame Body body; end Frame;
    model M inner World world(g = 1.6); Frame frame; end M;"""
    model = flatten_text(tmp_path, text)
    assert equations(model) == ["frame.body.f = 2 * world.g"]
    assert list(model.variables) == ["world.g", "frame.body.f"]


def test_sizes_follow_parameters_and_bindings(tmp_path: Path) -> None:
    text = """model M
      Real x[n + 1] = fill(time, n + 1);
      parameter Integer n = size(table, 1);
      parameter Real table[:, 2] = [0, 1; 1, 4; 2, 9];
    end M;"""
    model = flatten_text(tmp_path, text)
    assert [name for name in model.variables if name[0] == "x"] == ["x[1]", "x[2]", "x[3]", "x[4]"]
    assert model.variables["table[3,2]"].binding.value == 9.0
    assert model.variables["n"].evaluated


def test_structural_parameters_can_be_set_from_outside(tmp_path: Path) -> None:
    text = "model Part parameter Integer n = 1; Real x[n] = fill(time, n); end Part; model M Part part; end M;"
    model = flatten_text(tmp_path, text, modifications={"part.n": 3.0})
    assert sum(name.startswith("part.x") for name in model.variables) == 3


def test_numbers_from_outside_set_conditions_and_enumerations(tmp_path: Path) -> None:
    text = """model M
      type Kind = enumeration(none, dry, wet);
      model Part Real x = time; end Part;
      parameter Kind kind = Kind.none;
      parameter Boolean heated = false;
      Part wet if kind == Kind.wet;
      Part heater if heated;
    end M;"""
    for given, found in (({}, set()), ({"heated": 1.0}, {"heater.x"}), ({"kind": 3.0}, {"wet.x"})):
        model = flatten_text(tmp_path, text, modifications=given)
        assert {name for name in model.variables if name.endswith(".x")} == found
    for given, hint in (({"heated": 2.0}, "0 is false, 1 is true"), ({"kind": 4.0}, "1 is none, 2 is dry, 3 is wet")):
        with pytest.raises(Diagnostic) as caught:
            flatten_text(tmp_path, text, modifications=given)
        assert (caught.value.code, caught.value.hint) == ("R024", hint)


def test_records_are_bound_whole_and_by_field(tmp_path: Path) -> None:
    text = """
    record Data parameter Real R = 1; parameter Real L = 2; end Data;
    model Motor parameter Data data; Real v = data.R + data.L; end Motor;
    model M
      parameter Data own(R = 5);
      Motor a(data = own), b(data(L = 9)), c(data = Data(L = 3));
    end M;"""
    variables = flatten_text(tmp_path, text).variables
    texts = {name: to_text(v.binding) for name, v in variables.items() if v.binding is not None}
    assert texts == {
        "own.R": "5.0", "own.L": "2.0", "a.data.R": "own.R", "a.data.L": "own.L",
        "b.data.R": "1.0", "b.data.L": "9.0", "c.data.R": "1.0", "c.data.L": "3.0",
    }  # fmt: skip


def test_enumerations_are_numbers_with_names(tmp_path: Path) -> None:
    text = """
    type Mode = enumeration(locked, forward, backward);
    model M
      Mode mode(start = Mode.locked);
      Real x[Mode];
      Integer count = size(x, 1);
    equation
      for m in Mode loop
        x[m] = if mode == m then 1 else 0;
      end for;
      when time > 1 then
        mode = Mode.forward;
      end when;
    end M;"""
    model = flatten_text(tmp_path, text)
    assert model.variables["mode"].enumeration == ("locked", "forward", "backward")
    assert equations(model) == ["count = 3"] + [f"x[{i}] = if mode == {i} then 1 else 0" for i in (1, 2, 3)]


def test_constants_of_packages_and_imports(tmp_path: Path) -> None:
    text = """
    package Lib
      package C constant Real g(unit = "m/s2") = 9.81; constant Real twice = 2*g; end C;
      model M
        import Lib.C;
        import K = Lib.C;
        import Lib.C.g;
        Real x = C.twice*time, y = K.g*time, z = g*time;
      end M;
    end Lib;
    model Top extends Lib.M; end Top;"""
    model = flatten_text(tmp_path, text, units="off")
    assert equations(model) == ["x = Lib.C.twice * time", "y = Lib.C.g * time", "z = Lib.C.g * time"]
    assert to_text(model.variables["Lib.C.twice"].binding) == "2 * Lib.C.g"


def test_selective_extension_leaves_parts_out(tmp_path: Path) -> None:
    text = """
    connector Pin Real v; flow Real i; end Pin;
    model Part Pin p; equation p.v = time; end Part;
    model Base Part a, b, c; equation connect(a.p, b.p); connect(b.p, c.p); end Base;
    model M extends Base(break a, break connect(b.p, c.p)); end M;"""
    found = equations(flatten_text(tmp_path, text))
    assert found == ["b.p.v = time", "c.p.v = time", "b.p.i = 0.0", "c.p.i = 0.0"]


def test_independent_findings_come_together(tmp_path: Path) -> None:
    text = """model M
      Real x = speed;
      Real y[2] = {1, 2, 3};
    equation
      z = 1;
      when time then x = 1; end when;
    end M;"""
    with pytest.raises(Diagnostic) as refused:
        flatten_text(tmp_path, text)
    codes = [refused.value.code, *(other.code for other in refused.value.others)]
    assert codes == ["R002", "R036", "R002", "R020"]


def test_what_is_protected_in_components_is_hidden_and_what_is_in_the_model_itself_is_not(tmp_path: Path) -> None:
    text = """
    model Inner Real seen = time; protected Real kept = 2*time; end Inner;
    model Middle Inner open; Inner all[2]; protected Inner shut; end Middle;
    model M Middle part; protected Middle own; Real plain = time; end M;"""
    hidden = {name for name, v in flatten_text(tmp_path, text).variables.items() if v.hidden}
    inside = {"open.kept", "all[1].kept", "all[2].kept", "shut.seen", "shut.kept"}
    assert hidden == {f"{middle}.{name}" for middle in ("part", "own") for name in inside}


def test_a_protected_input_is_no_input_of_the_model(tmp_path: Path) -> None:
    """As conditional connectors of blocks have them: what is connected to it gives its value."""
    text = """connector In = input Real;
connector Out = output Real;
block Ten
  Out y = 10;
end Ten;
model M
  Ten c;
  Real y = 2*inner_;
  input Real u;
protected
  In inner_;
equation
  connect(c.y, inner_);
end M;
"""
    model = flatten_text(tmp_path, text)
    assert [v.name for v in model.variables.values() if v.causality == "input"] == ["u"]
