"""How precisely a machine is simulated, and from where."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.case.noise import Noise
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.case.values import is_start
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.efforts.places.opened import RENAMES, opened
from lacuna.discovery.fit.fit import believed
from lacuna.discovery.fit.machine import LEAST_RTOL, RTOL, Machine, try_machine
from lacuna.discovery.fit.objective import noise_of
from lacuna.discovery.fit.starts import as_known_to

from .test_efforts import BELIEVED, cascade


@pytest.fixture(scope="module")
def machine(friction_case: Path) -> Machine:
    case = load(friction_case)
    return Machine(case, Amendment(read(Library(), case.model)))


def quieter(noise: dict[str, Noise], share: float) -> dict[str, Noise]:
    return {c: replace(n, std=share * n.std) for c, n in noise.items()}


def test_the_solver_is_as_precise_as_the_noise_asks(machine: Machine) -> None:
    """Its errors are no more than the noise allows, beside a solution a thousand times as precise."""
    free, fixed = believed(machine.case, machine)
    values = fixed | {f.name: f.centre for f in free}
    noise = noise_of(machine.case)
    assert machine.precise(values, noise).rtol == RTOL
    quiet = quieter(noise, 1e-4)
    precise = machine.precise(values, quiet)
    assert LEAST_RTOL < precise.rtol < RTOL
    reference = Machine(machine.case, machine.amendment, machine.solver, rtol=1e-3 * precise.rtol)
    for recording in machine.case.fit:
        here, there = precise.simulate(values, recording), reference.simulate(values, recording)
        for column, n in quiet.items():
            assert np.sqrt(np.mean((here[column] - there[column]) ** 2)) < 3e-3 * n.std


def test_no_noise_asks_for_more_than_the_solver_can_give(machine: Machine) -> None:
    free, fixed = believed(machine.case, machine)
    values = fixed | {f.name: f.centre for f in free}
    least = machine.precise(values, quieter(noise_of(machine.case), 1e-12))
    assert least.rtol == pytest.approx(LEAST_RTOL)
    assert least.amended(Amendment(machine.amendment.structure)).rtol == least.rtol


def test_a_hypothesis_in_which_a_first_value_is_of_no_state_does_not_fit(machine: Machine) -> None:
    """An effect may change which variables of a mechanism are states: that ends the hypothesis, and not the search."""
    other = replace(machine.case, initial={"R": 1.0})
    found, why = try_machine(other, machine.amendment, machine)
    assert found is None
    assert "R is no state" in why


def test_a_start_recorded_by_another_name_of_its_state(tmp_path: Path) -> None:
    """`level = upper` is an equation, in which an effort is tried: then the names are of two variables, and the state's
    start is still what is recorded of the level."""
    folder = cascade(tmp_path, BELIEVED)
    model, toml = folder / "Cascade.mo", folder / "case.toml"
    text = model.read_text().replace("equation\n", '  Real level(unit="m");\nequation\n  level = upper;\n')
    model.write_text(text)
    named = toml.read_text().replace("[signals.upper]", '[signals.upper]\nvariable = "level"')
    toml.write_text(named + '[initial]\nlevel = "recorded"\n')
    case = load(folder)
    known = Machine(case, Amendment(read(case.library(), case.base)))
    door = opened(case, known.amendment, case.library(), ["k"])
    assert any(s.label.startswith("level = upper") for s in door.sites)
    point, first = {"A": 0.01, "B": 0.02, "k": 3e-4}, case.fit[0]
    tried = [s.label for place in door.places([door.linear.along(point, first)]) for s in place.sites]
    assert "level = upper" not in tried and dict(door.closed)["level = upper"] == RENAMES  # nothing else reads it
    run = door.machine.trajectory(point, first, ["upper", "level"])
    assert run["upper"][0] == run["level"][0] == first.columns["upper"][0]
    starts = [f for f in believed(case, known)[0] if is_start(f.name)]
    assert starts and all(f.sigma for f in starts)
    split = as_known_to(door.machine, starts)  # what the effort adds at the first sample, nobody knows
    assert [f.name for f in split] == [f.name for f in starts] and not any(f.sigma for f in split)
    assert as_known_to(known, starts) == starts


TURNED = """model Turned "A rotor whose speed is the rate of a damper's angle, which counts the other way"
  parameter Real J(unit="kg.m2") = 0.01;
  parameter Real d(unit="N.m.s/rad") = 0.02;
  parameter Real wall(unit="rad") = 0;
  input Real T(unit="N.m");
  Real phi(unit="rad", start=0, fixed=true);
  Real w(unit="rad/s", start=0, fixed=true);
  Real rel(unit="rad", stateSelect=StateSelect.always);
  Real w_rel(unit="rad/s", stateSelect=StateSelect.always);
  Real a_rel(unit="rad/s2");
equation
  w = der(phi);
  rel = wall - phi;
  w_rel = der(rel);
  a_rel = der(w_rel);
  J*der(w) = T + d*w_rel;
end Turned;
"""


def test_a_first_speed_of_what_a_component_measures_the_other_way(tmp_path: Path) -> None:
    """The state is `w_rel`, and the case says where `w` begins; it decays in closed form."""
    (tmp_path / "Turned.mo").write_text(TURNED)
    time = np.linspace(0, 2, 101)
    for name in ("r1", "r2"):
        table = np.column_stack([time, 0 * time, 15 * np.exp(-2 * time)])
        np.savetxt(tmp_path / f"{name}.csv", table, "%.8g", ",", header="time,T,w", comments="")
    (tmp_path / "case.toml").write_text(
        'model = "Turned.mo"\n[initial]\nw = 15\n[signals.T]\nrole = "input"\nvariable = "T"\nunit = "N.m"\n'
        '[signals.w]\nrole = "output"\nvariable = "w"\nunit = "rad/s"\nnoise_std = 0.01\n'
        '[recordings]\nfit = ["r1.csv"]\nvalidate = ["r2.csv"]\n'
    )
    case = load(tmp_path)
    machine = Machine(case, Amendment(read(case.library(), case.base)))
    assert "w" not in machine.model.states
    assert machine.simulate({}, case.fit[0])["w"] == pytest.approx(15 * np.exp(-2 * time), abs=1e-4)


PROBED = """model Probed "Its components are called as ours might be"
  model Part
    parameter Real tau(unit="s") = 0.5;
    input Real u(unit="V");
    Real y(unit="V", start=0, fixed=true);
  equation
    tau*der(y) = u - y;
  end Part;
  input Real u(unit="V");
  input Real probe_u(unit="V");
  Part probe1(u=u + probe_u), probe2(u=probe1.y);
end Probed;
"""


def test_what_is_added_has_no_name_of_a_machine(tmp_path: Path) -> None:
    (tmp_path / "Probed.mo").write_text(PROBED)
    time = np.linspace(0, 2, 101)
    for name in ("r1", "r2"):
        np.savetxt(tmp_path / f"{name}.csv", np.column_stack([time, time, time, time]), "%.8g", ",",
                   header="time,u,v,y", comments="")  # fmt: skip
    recorded = '[signals.v]\nrole = "input"\nvariable = "probe_u"\nunit = "V"\n'
    text = (
        'model = "Probed.mo"\n[signals.u]\nrole = "input"\nvariable = "u"\nunit = "V"\n'
        '[signals.y]\nrole = "output"\nvariable = "probe2.y"\nunit = "V"\nnoise_std = 0.01\n'
        '[recordings]\nfit = ["r1.csv"]\nvalidate = ["r2.csv"]\n'
    )
    (tmp_path / "case.toml").write_text(text)
    case = load(tmp_path)
    with pytest.raises(CaseError, match="input `probe_u` of the model is not recorded"):
        Machine(case, Amendment(read(case.library(), case.base)))
    (tmp_path / "case.toml").write_text(text.replace("[signals.y]", recorded + "[signals.y]"))
    case = load(tmp_path)
    amendment = Amendment(read(case.library(), case.base))
    assert {"probe1: tau*der(y) = u - y", "probe2: tau*der(y) = u - y"} <= {
        s.label for s in opened(case, amendment, case.library(), []).sites
    }
