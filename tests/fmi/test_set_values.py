"""What an importer sets and reads: dependent values follow at once; what is computed or of another type is refused."""

from __future__ import annotations

import numpy as np
import pytest

from tests.fmi.fmus import Fmus
from tests.fmi.test_instances import begin, real


def set_real(fmu, **values: float) -> None:
    for name, value in values.items():
        (fmu.setFloat64 if hasattr(fmu, "setFloat64") else fmu.setReal)([fmu.vr[name]], [value])


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_what_depends_on_a_tuned_parameter_is_read_anew_at_once(fmus: Fmus, version: str) -> None:
    """It was that of the old value until the next event or step."""
    with fmus.instance("Root", "cs", version) as fmu:
        begin(fmu)
        x, y = real(fmu, "x", "y")
        assert (x, y) == pytest.approx((2.0, 2.0))
        set_real(fmu, a=4.0)
        assert real(fmu, "b", "z", "der(x)") == pytest.approx([12.0, 24.0, 2.0])
        fmu.doStep(0.0, 0.1)
        assert real(fmu, "x") == pytest.approx([4.0 - 2.0 * np.exp(-0.1)], rel=1e-6)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_a_state_that_follows_from_an_initial_equation_is_not_set_nor_differentiated_before_it_does(
    fmus: Fmus, version: str
) -> None:
    with fmus.instance("Root", "cs", version) as fmu:
        with pytest.raises(Exception, match=r"[Ss]tatus|error"):
            set_real(fmu, x=-1.0)
        set_real(fmu, y=8.0)
        start = {"startTime": 0.0}
        if version == "2.0":
            fmu.setupExperiment(**start)
        fmu.enterInitializationMode(**({} if version == "2.0" else start))
        assert real(fmu, "x") == pytest.approx([4.0])
        derivative = fmu.getDirectionalDerivative
        with pytest.raises(Exception, match=r"[Ss]tatus|error"):
            derivative([fmu.vr["x"]], [fmu.vr["a"]], [1.0])


def test_a_value_of_another_type_is_refused(fmus: Fmus) -> None:
    """Halves became true, and 1.375 became 1."""
    with fmus.instance("Root", "cs") as fmu:
        begin(fmu)
        for call in (fmu.getInt32, fmu.getBoolean):
            with pytest.raises(Exception, match="failed"):
                call([fmu.vr["x"]])
        with pytest.raises(Exception, match="failed"):
            fmu.setInt32([fmu.vr["a"]], [3])
        assert real(fmu, "a") == [2.0]
