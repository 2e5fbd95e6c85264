"""The two paths through the paper's model, IDA and RK4 with located events, agree on what a map is made of."""

from __future__ import annotations

from bench.tolerance import ALLOWED, STEPS, Study


def test_solver_of_the_map_agrees_with_rk4_at_two_steps() -> None:
    study = Study([0.0, 0.33, 0.34, 0.5])
    settings = study.settings
    map_runs = study.variable(settings.solver, settings.relative_tolerance, settings.absolute_tolerance)
    for step in STEPS:
        fixed = study.fixed(step)
        assert map_runs.deviation(fixed) < ALLOWED
        assert (map_runs.bins == fixed.bins).all()
