"""What goes on beside a component that joins two nodes: a place of its own, in connectors of anybody's."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read as read_structure
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.efforts.places.reading import read
from lacuna.discovery.explain import explain

from .recorded import concealed, record

WAGONS = """package Wagons
  connector Hook
    Real s(unit="m");
    flow Real f(unit="N");
  end Hook;
  model Wagon
    parameter Real m(unit="kg", min=0);
    Hook front, rear;
    Real s(unit="m", start=0, fixed=true);
    Real v(unit="m/s", start=0, fixed=true);
  equation
    front.s = s;
    rear.s = s;
    der(s) = v;
    m*der(v) = front.f + rear.f;
  end Wagon;
  model Buffer
    parameter Real c(unit="N/m", min=0) = 8e4;
    parameter Real d(unit="N.s/m", min=0) = 2e3;
    Hook a, b;
    Real x(unit="m");
  equation
    x = b.s - a.s;
    b.f = c*x + d*der(x){beside};
    a.f + b.f = 0;
  end Buffer;
  model Pull
    input Real force(unit="N");
    Hook hook;
  equation
    hook.f = -force;
  end Pull;
  model Train
    input Real u(unit="N");
    Pull pull(force=u);
    Wagon first(m=900), last(m=700);
    Buffer buffer;
  equation
    connect(pull.hook, first.front);
    connect(first.rear, buffer.b);
    connect(buffer.a, last.front);
  end Train;
end Wagons;
"""
BELIEVED, STIFFENING = WAGONS.replace("{beside}", ""), WAGONS.replace("{beside}", " + 6e7*x^3")
CASE = """model = "Wagons.mo:Wagons.Train"
[parameters]
"first.m" = 900
"last.m" = 700
"buffer.c" = 8e4
"buffer.d" = 2e3
[uncertainty]
"first.m" = 0.03
"last.m" = 0.03
"buffer.c" = 0.05
"buffer.d" = 0.1
[signals.u]
role = "input"
variable = "u"
unit = "N"
[signals.first]
role = "output"
variable = "first.v"
unit = "m/s"
noise_std = 0.003
[signals.last]
role = "output"
variable = "last.v"
unit = "m/s"
noise_std = 0.003
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


@pytest.fixture(scope="module")
def train(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A case in which the buffer between two wagons stiffens."""
    folder = tmp_path_factory.mktemp("train")
    case, machine = concealed(folder, "Wagons", STIFFENING, BELIEVED, CASE, "Wagons.Train")
    random, time = np.random.default_rng(8), np.arange(600) * 0.02
    for n in (1, 2, 3):
        u = 1500 * np.repeat(random.uniform(-1, 1, 20), 30)
        errors = {v: 0.003 * random.normal(size=600) for v in ("first", "last")}
        record(case / f"r{n}.csv", machine, time, {"u": u}, {v: f"{v}.v" for v in errors}, errors)
    return case


def test_a_component_of_two_ports_is_a_branch(train: Path) -> None:
    found = read(Library([str(train / "Wagons.mo")]), "Wagons.Train")
    branches = {s.label: s.ends for s in found.places if s.kind == "branch"}
    assert branches == {"first": ("first.front", "first.rear"), "buffer": ("buffer.b", "buffer.a")}


def test_what_flows_past_a_component_leaves_one_node_for_the_other(train: Path) -> None:
    """Nothing is added to the train: the rates of both momenta sum to zero."""
    case = load(train)
    amendment = Amendment(read_structure(case.library(), case.base))
    door = opened(case, amendment, case.library(), [])
    along = door.linear.along({"first.m": 900.0, "last.m": 700.0, "buffer.c": 8e4, "buffer.d": 2e3}, case.fit[0])
    number = next(k for k, s in enumerate(door.sites) if (s.kind, s.label) == ("branch", "buffer"))
    rates = dict(zip(door.linear.states, along.direct[0, :, number], strict=False))
    assert rates["last.v"] != 0
    assert 900 * rates["first.v"] == pytest.approx(-700 * rates["last.v"], rel=1e-9)


def test_a_law_of_the_component_is_found_at_the_component(train: Path) -> None:
    result = explain(load(train))
    assert result.verdict == "missing_physics"
    (finding,) = result.findings
    assert finding.ranked.attachment.location == "buffer"
    assert result.after.validate[""] < 1.1 * np.sqrt(np.mean([f**2 for f in result.floor.values()]))
