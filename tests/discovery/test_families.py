"""One law in all elements of an array."""

from __future__ import annotations

from pathlib import Path
import shutil

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.efforts.find import places_of
from lacuna.discovery.efforts.places.families import families, is_shared, meant
from lacuna.discovery.efforts.places.reading import read
from lacuna.discovery.explain import explain, write_amended
from lacuna.discovery.steps import fitted

TANKS = """model Tanks "Three in a row, each of which leaks"
  parameter Integer n = 3;
  parameter Real A(unit="m2", min=0) = 0.5;
  parameter Real k(unit="m2/s", min=0) = 0.02;
  input Real q(unit="m3/s");
  Real h[n](each unit="m", each start=0.5, each fixed=true);
equation
  for i in 1:n loop
    A*der(h[i]) = (if i == 1 then q else k*h[max(i - 1, 1)]) - k*h[i];
  end for;
end Tanks;
"""
APART = """model Tanks "The same, each an instance of its class"
  model Tank
    parameter Real A(unit="m2", min=0) = 0.5;
    parameter Real k(unit="m2/s", min=0) = 0.02;
    input Real feed(unit="m3/s");
    Real drain(unit="m3/s");
    Real h(unit="m", start=0.5, fixed=true);
  equation
    A*der(h) = feed - drain;
    drain = k*h;
  end Tank;
  parameter Real A(unit="m2", min=0) = 0.5;
  parameter Real k(unit="m2/s", min=0) = 0.02;
  input Real q(unit="m3/s");
  Tank upper(A=A, k=k, feed=q);
  Tank middle(A=A, k=k, feed=upper.drain);
  Tank lower(A=A, k=k, feed=middle.drain);
end Tanks;
"""
CASE = """model = "Tanks.mo"
[parameters]
A = 0.5
k = 0.02
[uncertainty]
k = 0.05
[signals.q]
role = "input"
variable = "q"
unit = "m3/s"
interpolation = "hold"
[signals.h1]
role = "output"
variable = "h[1]"
unit = "m"
noise_std = 0.002
[signals.h3]
role = "output"
variable = "h[3]"
unit = "m"
noise_std = 0.002
[recordings]
fit = ["r1.csv", "r2.csv", "r3.csv"]
validate = ["r4.csv"]
"""
LEAK = 0.006  # m3/s for each m^2 of level squared


@pytest.fixture(scope="module")
def leaking(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Recordings of tanks each of which loses LEAK h^2."""
    return recorded(tmp_path_factory.mktemp("tanks"))


def recorded(folder: Path, bent: float = 0.0, leaks: int = 3) -> Path:
    """A case of tanks of which the last so many leak, where the first gauge shows h + bent h^2."""
    random = np.random.default_rng(7)
    (folder / "Tanks.mo").write_text(TANKS)
    (folder / "case.toml").write_text(CASE)
    for name in ("r1", "r2", "r3", "r4"):
        feed = np.repeat(random.uniform(0, 0.06, 10), 40)
        h, rows = np.full(3, 0.5), []
        for k, q in enumerate(feed):
            noise = random.normal(0, 0.002, 2)
            rows.append(f"{k},{q:.6g},{h[0] + bent * h[0] ** 2 + noise[0]:.7g},{h[2] + noise[1]:.7g}")
            for _ in range(20):  # explicit midpoint
                half = h + 0.025 * _rates(h, q, leaks)
                h = h + 0.05 * _rates(half, q, leaks)
        (folder / f"{name}.csv").write_text("\n".join(["time,q,h1,h3", *rows, ""]))
    return folder


def _rates(h: np.ndarray, q: float, leaks: int) -> np.ndarray:
    return (np.array([q, *(0.02 * h[:2])]) - 0.02 * h - LEAK * h**2 * (np.arange(3) >= 3 - leaks)) / 0.5


def test_one_law_is_found_in_all_elements_of_an_array(leaking: Path, tmp_path: Path) -> None:
    found = explain(load(leaking))
    assert found.verdict == "missing_physics", found.reason
    (finding,) = found.findings
    attachment = finding.ranked.attachment
    assert attachment.location == "h[:]"
    law = found.final.point[attachment.full_name("c_1")]
    reference = found.final.machine.model.variables[attachment.full_name("x1_ref")].start
    assert attachment.signals == (("x1", "h[1]"),)
    assert law / reference**2 == pytest.approx(-LEAK, rel=0.03)
    text = write_amended(found, tmp_path).read_text()
    assert "k*h[i]) + missing_1[i];" in text
    assert "missing_1 = {law_h.effort, law_h_of_2.effort, law_h_of_3.effort};" in text
    assert "law_h_of_3(x1=h[3], c_1=law_h.c_1)" in text
    assert "law_h_2" not in text  # which a law at h[2] alone is called


def test_what_only_one_instance_tells_is_told_of_that_one(tmp_path: Path) -> None:
    """Only the upper tank ever spills: one that spills as all of its class would fits as well."""
    (tmp_path / "Tanks.mo").write_text(APART.replace("  Tank middle(A=A, k=k, feed=upper.drain);\n", "").replace(
        "lower(A=A, k=k, feed=middle.drain)", "lower(A=A, k=3*k, feed=upper.drain)"))  # fmt: skip
    (tmp_path / "case.toml").write_text(CASE.replace('"h[1]"', '"upper.h"').replace('"h[3]"', '"lower.h"'))
    random = np.random.default_rng(3)
    for name in ("r1", "r2", "r3", "r4"):
        h, rows = np.full(2, 0.5), []
        for k, q in enumerate(np.repeat(random.uniform(0.0, 0.08, 10), 40)):
            rows.append(f"{k},{q:.6g},{h[0] + random.normal(0, 0.002):.7g},{h[1] + random.normal(0, 0.002):.7g}")
            for _ in range(20):
                drains = np.array([0.02, 0.06]) * h
                h = h + 0.05 * (np.array([q - 0.05 * max(0.0, h[0] - 1.5), drains[0]]) - drains) / 0.5
        (tmp_path / f"{name}.csv").write_text("\n".join(["time,q,h1,h3", *rows, ""]))
    found = explain(load(tmp_path))
    assert (found.verdict, [f.ranked.attachment.location for f in found.findings]) == ("missing_physics", ["upper"])


def test_one_law_is_found_in_all_instances_of_a_class(leaking: Path, tmp_path: Path) -> None:
    folder = tmp_path / "apart"
    shutil.copytree(leaking, folder)
    (folder / "Tanks.mo").write_text(APART)
    case = (folder / "case.toml").read_text()
    (folder / "case.toml").write_text(case.replace('"h[1]"', '"upper.h"').replace('"h[3]"', '"lower.h"'))
    found = explain(load(folder))
    assert found.verdict == "missing_physics", found.reason
    (finding,) = found.findings
    attachment = finding.ranked.attachment
    assert attachment.location == "upper, middle, lower"
    (variable,) = attachment.law.references()
    law = found.final.point[attachment.full_name("c_1")]
    assert variable.name == "upper.h" and law / variable.size**2 == pytest.approx(-LEAK, rel=0.03)
    text = write_amended(found, tmp_path).read_text()
    assert "c_1=law_upper_middle_lower.c_1" in text and "x1=lower.h" in text.replace(" ", "")


@pytest.mark.parametrize(("leaks", "places"), [(3, ["h[:]"]), (1, ["h[2]", "h[3]"])])
def test_an_effort_in_every_element_is_weighed_beside_one_in_any(tmp_path: Path, leaks: int, places: list[str]) -> None:
    """What is missing in the last of three may as well be so before it, where nothing is recorded."""
    told = fitted(load(recorded(tmp_path, leaks=leaks)), lambda text: None)
    found = places_of(told.case, told.amendment, told.base, told.case.library())
    assert found.sites[0].location in places


def test_a_law_in_every_element_is_found_beside_a_gauge_that_bends(tmp_path: Path) -> None:
    found = explain(load(recorded(tmp_path, bent=0.3)))
    assert found.verdict == "missing_physics", found.reason
    told = {f.ranked.attachment.location: f.ranked.attachment for f in found.findings}
    assert list(told) == ["h[:]", "sensor:h1"]
    law, (variable,) = told["h[:]"], told["h[:]"].law.references()
    level, law_at = np.linspace(0.3, 1.5, 7), found.final.point[law.full_name("c_1")]
    assert law_at * (level / variable.size) ** 2 == pytest.approx(-LEAK * level**2, rel=0.1)


def test_elements_of_an_array_are_a_family(tmp_path: Path) -> None:
    (tmp_path / "Tanks.mo").write_text(TANKS)
    sites = read(Library([str(tmp_path)]), "Tanks").places
    ((whole, numbers),) = families(sites, range(len(sites)))
    assert (whole.label, whole.members, numbers) == ("h[:]", ("der(h[1])", "der(h[2])", "der(h[3])"), (0, 1, 2))


def test_names_of_one_element_are_those_of_another() -> None:
    assert meant("cell[2].gas.T", "cell[2]", "cell[3]") == "cell[3].gas.T"
    assert meant("der(h[1])", "der(h[1])", "der(h[12])") == "der(h[12])"
    assert not is_shared("h[2]", ["der(h[1])", "der(h[2])"])
    assert is_shared("q", ["der(h[1])", "der(h[2])"])
    assert meant("der(left.arm.w)", "left.arm", "right.arm") == "der(right.arm.w)"
    assert meant("left.armature.i", "left.arm", "right.arm") == "left.armature.i"
    assert not is_shared("right.arm.w", ["left.arm", "right.arm"]) and is_shared("u", ["left.arm", "right.arm"])


def test_the_best_law_of_a_family_so_far_is_told(leaking: Path) -> None:
    said: list[str] = []
    explain(load(leaking), said.append)
    fitting = [text for text in said if text.startswith("fitting a law at h[:]: ") and "; best so far " in text]
    assert fitting and fitting[-1].endswith("*abs(h[:])^2 at h[:]")
