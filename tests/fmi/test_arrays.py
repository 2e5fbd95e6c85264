"""Arrays: one variable with dimensions in FMI 3.0, a variable for each element in FMI 2.0."""

from __future__ import annotations

from ctypes import c_double, c_uint32

import fmpy
import numpy as np
import pytest

from tests.fmi.fmus import Fmus
from tests.fmi.test_instances import begin

SHAPES = {
    "A": (2, 3), "k": (2,), "on": (2,), "u": (3,), "x": (3,), "y": (2,), "mixed": (3,), "seen": (2, 2), "n": (2,),
    "der(x)": (3,),
}  # fmt: skip
SCALARS = {"time", "way", "der(way)", "two[1]", "two[2]"}


def test_an_array_is_one_variable_where_its_elements_have_one_role(fmus: Fmus) -> None:
    description = fmpy.read_model_description(str(fmus.path("Mesh")))
    found = {v.name: v for v in description.modelVariables}
    assert {name: tuple(v.shape) for name, v in found.items() if v.shape} == SHAPES
    assert {name for name, v in found.items() if not v.shape} == SCALARS
    assert found["der(x)"].derivative is found["x"]
    assert [d.variable.name for d in description.derivatives] == ["der(x)", "der(way)"]
    assert (found["A"].start, found["on"].start) == ("-1.0 0.5 0.0 0.25 -2.0 0.125", "true false")


def test_fmi_2_has_a_variable_for_each_element(fmus: Fmus) -> None:
    found = {v.name for v in fmpy.read_model_description(str(fmus.path("Mesh", "2.0"))).modelVariables}
    wanted = {f"{name}[{','.join(str(k + 1) for k in at)}]" for name in SHAPES for at in np.ndindex(*SHAPES[name])}
    assert {name for name in wanted if not name.startswith("der(")} <= found and not found & set(SHAPES)


def test_values_of_arrays_are_set_and_read_in_the_order_of_their_subscripts(fmus: Fmus) -> None:
    with fmus.instance("Mesh", "cs") as fmu:
        vr = fmu.vr
        fmu.setFloat64([vr["A"], vr["u"]], [1, 2, 3, 4, 5, 6, 0, 0, 0])
        fmu.setInt32([vr["k"]], [5, 8])
        fmu.setBoolean([vr["on"]], [True, False])
        fmu.setFloat64([vr["x"]], [1.5, -2.0, 0.5])
        begin(fmu)
        assert fmu.getFloat64([vr["y"], vr["way"], vr["x"]], 6) == [-1.0, -1.0, 0.0, 1.5, -2.0, 0.5]
        fmu.doStep(0.0, 0.5)  # past two samples
        assert fmu.getInt32([vr["n"]], 2) == [10, 8] and fmu.getBoolean([vr["on"]], 2) == [True, False]
        assert fmu.getFloat64([vr["seen"], vr["two[1]"]], 5) == [1.5, -2.0, 0.5, 1.5, 0.0]


def test_a_wrong_number_of_values_is_refused(fmus: Fmus, capfd: pytest.CaptureFixture[str]) -> None:
    with fmus.instance("Mesh", "cs") as fmu, pytest.raises(Exception, match="failed"):
        fmu.setFloat64([fmu.vr["A"], fmu.vr["way"]], [1.0, 2.0])
    captured = capfd.readouterr()
    assert "2 values for 2 variables, which have 7" in captured.out + captured.err


def directional(fmu, unknowns: list[int], size: int, knowns: list[int], seed: list[float]) -> list[float]:
    """As FMPy's own call, which takes every variable to be one value."""
    result = (c_double * size)()
    fmu.fmi3GetDirectionalDerivative(
        fmu.component, (c_uint32 * len(unknowns))(*unknowns), len(unknowns), (c_uint32 * len(knowns))(*knowns),
        len(knowns), (c_double * len(seed))(*seed), len(seed), result, size,
    )  # fmt: skip
    return list(result)


def test_directional_derivatives_of_arrays_by_arrays(fmus: Fmus) -> None:
    """y = A x and x' = -i u x: both are known."""
    x, u, a = np.array([0.5, -1.0, 2.0]), np.array([1.0, 2.0, 3.0]), np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    i, dx, du, da = np.arange(1, 4), np.array([1.0, 0.5, -2.0]), np.array([0.1, 0.2, 0.3]), np.arange(6.0) / 7
    with fmus.instance("Mesh", "me") as fmu:
        vr = fmu.vr
        fmu.setFloat64([vr["A"], vr["u"], vr["x"]], [*a.ravel(), *u, *x])
        begin(fmu)
        fmu.updateDiscreteStates()
        fmu.enterContinuousTimeMode()
        knowns, seed = [vr["x"], vr["u"], vr["A"]], [*dx, *du, *da]
        found = directional(fmu, [vr["y"], vr["der(x)"], vr["der(way)"]], 6, knowns, seed)
        expected = [*(a @ dx + da.reshape(2, 3) @ x), *(-i * (u * dx + du * x)), dx[0]]
        assert found == pytest.approx(expected, rel=1e-12)
