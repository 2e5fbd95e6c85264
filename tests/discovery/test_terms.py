"""Variables and terms that a law at a place may have, on trajectories made by hand."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from lacuna.discovery.efforts.laws.terms import counts, groups, variables
from lacuna.discovery.efforts.linear import Along
from lacuna.discovery.efforts.sites import Site as Place
from lacuna.discovery.law.empirical_law import free_of
from lacuna.discovery.law.law import Law, Site, attach
from lacuna.discovery.law.law_terms import Group, Variable

TIME = np.linspace(0, 10, 201)
ROOM = {
    "T1": 300 + 20 * np.sin(TIME),
    "T2": 300 + 5 * np.sin(0.4 * TIME),
    "P": 100 * np.sign(np.sin(3 * TIME)),
}


def known(**units: str) -> dict[str, SimpleNamespace]:
    """What the search reads of a model's table of variables."""
    return {n: SimpleNamespace(unit=u, type="Real", kind="algebraic") for n, u in units.items()}


def along(**values: np.ndarray | float) -> list[Along]:
    empty = np.zeros((0, 0, 0))
    return [Along(TIME, empty, empty, empty, empty, empty, dict(values))]


def found(**more: np.ndarray | float) -> list[Variable]:
    units = {"T1": "K", "T2": "K", "P": "W", "To": "K", "q": "W"}
    return variables(along(**ROOM, **more), "T1", known(**units), ["T1", "T2"], frozenset())


def test_states_are_taken_against_each_other_and_against_what_surrounds_them() -> None:
    apart = [v.reading for v in found(To=290.0) if v.minus]
    assert apart == ["(T1 - T2)", "(T1 - To)", "(T2 - To)"]


def test_a_difference_that_a_variable_of_the_model_already_is_comes_once() -> None:
    q = 3.0 * (ROOM["T1"] - ROOM["T2"])
    assert [v.reading for v in found(q=q) if v.minus] == []


def test_a_law_of_a_difference_reads_the_model_and_is_told_in_it() -> None:
    variable = next(v for v in found(To=290.0) if v.reading == "(T1 - To)")
    place = Site(Place("equation", "C1*der(T1) = P - q"), "T1", "W", (variable,))
    law = Law(place, (Group((f"sign({variable.local})*abs{variable.scaled}^1.25",)),))
    assert law.expression({"c_1": -2.0}) == f"-2*sign((T1 - To))*abs((T1 - To)/{variable.size:g})^1.25"
    assert attach(law).signals == ((variable.local, "(T1 - To)"),)
    np.testing.assert_allclose(variable.course(along(**ROOM, To=290.0)[0].values), ROOM["T1"] - 290.0)


def test_every_term_can_be_evaluated_and_is_counted_by_how_many_variables_it_has() -> None:
    kept = found(To=290.0)
    paths = {v.local: v.course(along(**ROOM, To=290.0)[0].values) for v in kept} | {"time": TIME}
    scaled = {v.local: paths[v.local] / v.size for v in kept}
    ranges = {n: (float(c.min()), float(c.max())) for n, c in scaled.items()}
    every = groups(kept, ranges, 0.05, 10.0)
    sizes = {v.local: v.size for v in kept}
    place = Site(Place("equation", "C1*der(T1) = P - q"), "T1", "W", tuple(kept))
    for group in every:
        law = Law(place, (group,))
        start = {n: s.start for n, s in law.shapes().items()} | {c: 1.0 for c, _, _ in law.numbered()}
        assert all(f.scale > 0 for f in free_of(law, attach(law), start)), group
        for course in group.values(paths, sizes):
            assert np.isfinite(course).all(), group.texts
    one, several = counts(kept, every)
    assert one + several == len({g.texts for g in every})
    assert several == len({g.texts for g in every if sum(f"{v.local}_ref" in g.texts[0] for v in kept) == 2})
