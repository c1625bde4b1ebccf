"""Forces whose components are compiled functions."""

import ctypes
import shutil
import subprocess

import numpy as np
import pytest
from conftest import oscillator

import holonom

SOURCE = """
double fx(double t, const double *r, const double *v) { return -9*r[0] - 0.1*v[0]; }
double fy(double t, const double *r, const double *v) { return -9*r[1] - 0.1*v[1] + t; }
"""
DOUBLES = ctypes.POINTER(ctypes.c_double)
SIGNATURE = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double, DOUBLES, DOUBLES)


@pytest.fixture
def own():
    """The run of the same force as expressions of the scene."""
    scene = oscillator(None)
    components = ["-9*mass.x - 0.1*mass.x'", "-9*mass.y - 0.1*mass.y' + t"]
    scene["forces"] = [{"name": "law", "type": "applied_force", "at": "mass", "force": components}]
    return holonom.Scene(scene).simulate()


def agrees(law, own):
    run = holonom.Scene(oscillator(law)).simulate()
    # Both are the same numbers up to the rounding of their sums.
    return np.allclose(run.q, own.q, rtol=0, atol=1e-12)


def test_functions_of_c_give_the_motion_of_expressions(own, tmp_path):
    compiler = shutil.which("gcc") or pytest.skip("there is no gcc")
    (tmp_path / "law.c").write_text(SOURCE)
    subprocess.run([compiler, "-shared", "-fPIC", "-o", tmp_path / "law.so", tmp_path / "law.c"], check=True)
    library = ctypes.CDLL(str(tmp_path / "law.so"))
    assert agrees([library.fx, library.fy], own)


class Cfunc:
    """As a function that Numba compiled: no callable, but with one."""

    def __init__(self, function):
        self.ctypes = SIGNATURE(function)


@pytest.mark.parametrize("kind", [SIGNATURE, Cfunc, lambda function: function])
def test_callbacks_and_functions_serve_as_components(own, kind):
    assert agrees([kind(lambda t, r, v: -9 * r[0] - 0.1 * v[0]), kind(lambda t, r, v: -9 * r[1] - 0.1 * v[1] + t)], own)


def test_what_is_no_law_is_refused():
    zero = SIGNATURE(lambda t, r, v: 0)
    with pytest.raises(TypeError, match="write a list with one for each axis"):
        holonom.Scene(oscillator(zero))
    with pytest.raises(ValueError, match="the force has 3 components; in 2 dimensions it has 2"):
        holonom.Scene(oscillator([zero, zero, zero]))
    with pytest.raises(holonom.SceneError, match="function"):
        holonom.Scene(oscillator([1, 2]))
