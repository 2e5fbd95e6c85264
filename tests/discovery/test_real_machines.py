"""The catalogue has what three real machines lack: fitted to half of the recordings, it holds on the others."""

from __future__ import annotations

import pytest

from bench.real_machines import recordings_folder
from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue import catalogue, places
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.fit.fit import believed, fit
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import noise_of
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.naming.judge import judge

STARTS = {
    "CoulombFriction": {"tau_c": 3e-3},
    "ImposedBand": {"F_c": 9e3, "F_s": 1.1e4, "v_s": 0.04, "F_x": 1e5, "reach": 6e-3},
    "AsymmetricFriction": {"tau_pos": 0.03, "tau_neg": 0.03},
}


@pytest.mark.parametrize(
    ("case_name", "effect_name", "most"),
    [("lab-dc-motor", "CoulombFriction", 0.040), ("band-damper", "ImposedBand", 0.130),
     ("servo-hsm150", "AsymmetricFriction", 0.160)],
)  # fmt: skip
def test_the_effect_holds_on_recordings_it_was_not_fitted_to(case_name: str, effect_name: str, most: float) -> None:
    try:
        folder = recordings_folder()
    except FileNotFoundError as absent:
        pytest.skip(str(absent))
    case, library = load(folder / case_name), Library()
    plain = Amendment(places.read(library, case.model))
    attachments = enumerate_attachments(case, plain.structure, catalogue.read(library), plain)
    attachment = next(a for a in attachments if a.effect.name == effect_name)
    machine = Machine(case, Amendment(plain.structure, [attachment]))
    free, fixed = believed(case, machine)
    for name, value in STARTS[effect_name].items():
        full = attachment.full_name(name)
        free.append(Free(full, value, 0.3 * value, machine.model.parameters[full].min))
    found = fit(machine, case.fit, noise_of(case), free, fixed)
    assert judge(machine, found.point).validate[""] < most
