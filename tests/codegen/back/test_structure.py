"""One small model a phenomenon: which states, dummy derivatives, blocks and unknowns of the integrator it must give."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import translate
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.structure.causal import LinearBlock, NonlinearBlock
from lacuna.codegen.symbolic.expr import to_text
from tests.codegen.generated import Generated, write_model
from tests.events.models import simulated


@pytest.fixture
def prepare(tmp_path: Path):
    def prepared(text: str) -> Prepared:
        return translate(write_model(tmp_path, text))[0]

    return prepared


def blocks(p: Prepared, kind: type) -> list[tuple[int, int]]:
    """(size, tears) of the blocks of one kind in the explicit form."""
    return [(len(s.tears) + len(s.assignments), len(s.tears)) for s in p.explicit if isinstance(s, kind)]


def unknowns(p: Prepared) -> list[str]:
    return p.system.states + [to_text(z) for z in p.residual.tears]


RIGID = """model RigidInertias
  parameter Real J1 = 2; parameter Real J2 = 3; parameter Real n = 4;
  Real phi1(start=0, fixed=true); Real w1(start=0, fixed=true); Real a1; Real phi2; Real w2; Real a2; Real tau;
equation
  w1 = der(phi1); a1 = der(w1); w2 = der(phi2); a2 = der(w2);
  phi1 = n*phi2;
  J1*a1 = 10 - tau;
  J2*a2 = n*tau;
end RigidInertias;
"""


def test_rigidly_coupled_inertias_are_one(prepare) -> None:
    p = prepare(RIGID)
    assert p.system.states == ["phi1", "w1"]
    assert unknowns(p) == ["phi1", "w1"]
    assert {"der(phi2)", "der(w2)"} <= set(p.system.dummies)
    assert blocks(p, NonlinearBlock) == []
    assert [tears for _, tears in blocks(p, LinearBlock)] == [1]


def test_state_select_decides_between_equals(prepare) -> None:
    text = RIGID.replace("Real phi2;", "Real phi2(stateSelect=StateSelect.prefer);")
    text = text.replace("Real w2;", "Real w2(stateSelect=StateSelect.prefer);").replace(", fixed=true", "")
    assert prepare(text).system.states == ["phi2", "w2"]


PENDULUM = """model Pendulum
  parameter Real L = 1; parameter Real g = 9.81;
  Real x(start=1); Real y(start=0.1, fixed=true); Real vx; Real vy(start=0, fixed=true); Real F;
equation
  der(x) = vx; der(y) = vy;
  der(vx) = -x*F; der(vy) = -y*F - g;
  x^2 + y^2 = L^2;
end Pendulum;
"""


def test_pendulum_starts_with_the_states_that_have_good_pivots(prepare) -> None:
    p = prepare(PENDULUM)
    assert p.system.preferred == ["vy", "y"]  # at x = 1 the constraint determines x
    assert p.system.states == p.system.dynamic == ["$state1[1]", "$state2[1]"]
    assert {"der(x)", "der(vx)", "der(der(x))", "der(y)", "der(vy)"} <= set(p.system.dummies)
    assert sum(row.integral is not None for row in p.system.rows) == 4
    assert (2, 2) in blocks(p, NonlinearBlock)  # x and y from the state


def test_pendulum_keeps_the_states_that_it_must_have(prepare) -> None:
    always = ", stateSelect=StateSelect.always)"
    p = prepare(
        PENDULUM.replace("y(start=0.1, fixed=true)", "y(start=0.1, fixed=true" + always).replace(
            "vy(start=0, fixed=true)", "vy(start=0, fixed=true" + always
        )
    )
    assert p.system.states == ["y", "vy"]
    assert len(p.system.model.asserts) == 2  # which end the run where the other coordinate, and its speed, is none
    assert {"der(x)", "der(vx)", "der(der(x))"} <= set(p.system.dummies)
    assert sum(row.integral is not None for row in p.system.rows) == 4
    assert blocks(p, NonlinearBlock) == [(1, 1)]  # x from y
    assert len(p.residual.tears) == 3  # x, der(x) and the force: two constraints and a saddle point


def test_reinit_makes_its_variable_a_state(prepare) -> None:
    text = RIGID.replace("end Rigid", "when phi1 > 1 then reinit(w2, 0); end when;\nend Rigid").replace(
        "w1(start=0, fixed=true)", "w1"
    )
    assert prepare(text).system.states == ["phi1", "w2"]


def test_explicit_system_needs_no_block(prepare) -> None:
    p = prepare(
        "model Chain Real x(start=1, fixed=true); Real y; Real z; equation z = 2*y; y = x^2; der(x) = -z; end Chain;"
    )
    assert [to_text(s.unknown) for s in p.explicit] == ["y", "z", "der(x)"]
    assert unknowns(p) == ["x"]


def test_linear_loop_is_torn(prepare) -> None:
    p = prepare(
        "model Loop parameter Real a=2; Real x(start=1, fixed=true); Real y; Real z; Real q;\n"
        "equation y + a*z = x; z - y = q; q + y = 3*x; der(x) = -q; end Loop;"
    )
    assert blocks(p, LinearBlock) == [(3, 1)]
    assert blocks(p, NonlinearBlock) == []


def test_nonlinear_loop_is_torn(prepare) -> None:
    p = prepare(
        "model Loop parameter Real a=1; Real x(start=1, fixed=true); Real y; Real z;\n"
        "equation y + a*y^3 + z = 2*x; z - a*exp(y/10) = x; der(x) = -y; end Loop;"
    )
    assert blocks(p, NonlinearBlock) == [(2, 1)]


def test_division_by_what_may_vanish_is_checked(prepare) -> None:
    p = prepare("model Div Real x(start=1, fixed=true); Real y; equation x*y = 1; der(x) = -y*y; end Div;")
    assert [type(s).__name__ for s in p.explicit] == ["Division", "Assignment"]
    assert unknowns(p) == ["x", "y"]  # y cannot be computed where x may be zero: the integrator solves for it


def test_aliases_keep_sign_start_and_selection(prepare) -> None:
    p = prepare(
        "model Alias Real a(start=3, fixed=true); Real b; Real c; Real d;\n"
        "equation b = -a; c + b = 0; d = -c; der(d) = a; end Alias;"
    )
    assert p.system.states == ["d"]
    assert p.aliases == {"a": ("d", -1), "b": ("d", 1), "c": ("d", -1)}
    d = p.model.variables["d"]
    assert d.start.value == -3
    assert d.fixed.value is True


def test_what_equals_parameters_leaves_the_equations(prepare) -> None:
    p = prepare(
        "model Const parameter Real k=2; Real u; Real v; Real x(start=0, fixed=true);\n"
        "equation u = 3*k; v = u + 1; der(x) = v; end Const;"
    )
    assert p.storage.parameters == ["k", "u", "v"]
    assert len(p.explicit) == 1


def test_two_names_of_one_derivative_are_aliases(prepare) -> None:
    p = prepare(
        "model Speeds Real phi(start=0, fixed=true); Real w(start=1, fixed=true); Real w2; Real a;\n"
        "equation w = der(phi); w2 = der(phi); a = der(w2); a = -phi; end Speeds;"
    )
    assert p.system.states == ["phi", "w2"]
    assert p.aliases["w"] == ("w2", 1)
    assert p.model.variables["w2"].start.value == 1
    assert p.system.dummies == []


def test_friction_with_locked_mode_is_one_mixed_block(prepare) -> None:
    """Path variable s of the friction law: acceleration in s while sliding, torque in s while locked."""
    p = prepare(
        "model Stick parameter Real J=1; parameter Real tau_c=1;\n"
        "  Real w(start=0, fixed=true); Real a; Real s; Real tau; Boolean locked(start=true);\n"
        "equation J*a = 2 - tau; der(w) = a; a = if locked then 0 else s - tau_c; tau = if locked then s else tau_c;\n"
        "  locked = pre(locked) and not s > tau_c; end Stick;"
    )
    sizes = blocks(p, LinearBlock)
    assert len(sizes) == 1
    assert sizes[0][0] == 3
    assert len(p.relations) == 1


def test_ladder_whose_recursion_would_blow_up_is_solved_whole(tmp_path: Path) -> None:
    """Node voltages of 40 equal sections fall by the golden ratio squared from each to the next."""
    text = """model Ladder
      parameter Integer n = 40; Real v[n]; Real i[n]; Real x(start = 1, fixed = true);
      parameter Real R = 1; parameter Real T(unit = "s") = 1;
    equation
      der(x)*T = -v[n];
      v[1] = x; i[1] = (v[1] - v[2])/R;
      for k in 2:n-1 loop
        (v[k-1] - v[k])/R + (v[k+1] - v[k])/R = i[k]; i[k] = v[k]/R;
      end for;
      (v[n-1] - v[n])/R = i[n]; i[n] = v[n]/R;
    end Ladder;
    """
    model = Generated(write_model(tmp_path, text), tmp_path)
    v = model.rhs(0.0, np.array([1.0]))[1][:5]
    np.testing.assert_allclose(v[1:] / v[:-1], (3 - np.sqrt(5)) / 2, rtol=1e-12)


def test_constraints_that_are_degenerate_at_the_start_values_are_read_in_their_neighbourhood(tmp_path: Path) -> None:
    """i = phi r, r (2 + phi) = 1 with all start values zero: phi = 2 t/(1 - t), so that der(phi) = 2/(1 - t)^2."""
    text = """model Chain
  Real i, phi, r, g, u;
equation
  i = time;
  i = phi*r;
  r*g = 1;
  g = 2 + phi;
  u = der(phi);
end Chain;
"""
    result = simulated(tmp_path, text, stop=0.5, interval=0.1, events=False)
    assert result["u"] == pytest.approx(2 / (1 - result.time) ** 2, rel=1e-6)
