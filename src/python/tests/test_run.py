"""Runs: values against closed forms, rows without copies, restart, threads and Ctrl-C."""

import math
import os
import pickle
import signal
import threading
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest
from conftest import oscillator, pendulum
from scipy.optimize import minimize_scalar
from scipy.special import ellipk

import holonom


def period(length):
    """Period of a pendulum that starts level: 4 sqrt(l/g) K(m) with m = sin(45 deg)^2."""
    return 4 * math.sqrt(length / 9.81) * ellipk(0.5)


@pytest.mark.parametrize("length", [0.5, 2.0])
def test_a_pendulum_returns_after_the_period_of_the_elliptic_integral(length):
    scene = holonom.Scene(pendulum(), l=length)
    run = scene.simulate(until=period(length))
    # The error of a run is asked to be 1e-10 of its motion; a hundred times that is left for its growth.
    assert run["x"][-1] == pytest.approx(length, abs=1e-8 * length)
    assert run["y"][-1] == pytest.approx(0, abs=1e-8 * length)
    assert run["y"].min() == pytest.approx(-length, rel=1e-3)
    # lambda is the tension of the rod, which is 3 m g at the lowest point.
    assert run.lambda_.max() == pytest.approx(3 * 9.81, rel=1e-3)
    assert run.drift.position.max() < 1e-12
    assert abs(run.energy.error).max() < 1e-7


def test_columns_are_views_of_one_array():
    run = holonom.Scene(pendulum()).simulate(output_step=1e-4)
    assert run.rows.shape == (10001, 8) and run.rows.dtype == np.float64 and run.rows.flags.c_contiguous
    for part in [run.t, run["x"], run.q, run.v, run.lambda_]:
        assert np.shares_memory(part, run.rows)
    assert run.columns == ["t", "bob.x", "bob.y", "bob.x'", "bob.y'", "joint.rod.length", "x", "y"]
    assert np.array_equal(run.q, np.column_stack([run["x"], run["y"]]))
    assert run.units == {"x": "m", "y": "m"}
    assert run.summary.final.outputs.x == run["x"][-1]
    with pytest.raises(KeyError, match="no column `bob.z`(.|n)*did you mean `bob.[xy]`"):
        run["bob.z"]


def test_tables_for_pandas():
    pytest.importorskip("pandas")
    run = holonom.Scene(pendulum()).simulate(until=0.1, outputs_only=True)
    frame = run.to_pandas()
    assert list(frame) == ["t", "x", "y"] and frame["x"].iloc[-1] == run["x"][-1]
    assert list(run.energy.to_pandas()) == ["kinetic", "potential", "work", "error"]


def test_error_bars_hold_the_truth():
    run = holonom.Scene(pendulum()).simulate(until=period(1), check_error=True, rtol=1e-6)
    assert abs(run["x"][-1] - 1) <= run.error.outputs.x.max < 1e-4
    assert len(run.t) == len(run.drift.rows) == len(run.energy.rows)
    assert holonom.Scene(pendulum()).simulate(until=0.1).error is None


def test_a_restarted_run_is_the_uninterrupted_one_bit_by_bit():
    scene = holonom.Scene(pendulum())
    options = {"output_step": 0.1, "integrator": "rk4", "step": 0.01}
    whole = scene.simulate(until=1, **options)
    half = scene.simulate(until=0.5, **options)
    rest = pickle.loads(pickle.dumps(half)).restart(until=1, **options)
    assert rest.t[0] == 0.5 and rest.rows[-1].tobytes() == whole.rows[-1].tobytes()


def test_ctrl_c_ends_a_run_soon():
    scene = holonom.Scene(pendulum())
    threading.Timer(0.5, os.kill, [os.getpid(), signal.SIGINT]).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt) as caught:
        scene.simulate(until=1e6, output_step=1)
    assert time.monotonic() - begun < 1.0
    partial = caught.value.partial
    assert 0 < partial.t[-1] < 1e6
    end = math.ceil(partial.t[-1]) + 5
    assert partial.restart(until=end, output_step=1).t[-1] == end


def test_other_threads_go_on_during_a_run():
    ticks, done = [], threading.Event()

    def count():
        while not done.wait(0.001):
            ticks.append(1)

    thread = threading.Thread(target=count)
    thread.start()
    holonom.Scene(pendulum()).simulate(until=400)
    done.set()
    thread.join()
    assert len(ticks) > 3


def test_an_optimizer_finds_the_length_of_a_pendulum():
    scene = holonom.Scene(pendulum())

    def miss(length):
        """The pendulum is at its lowest point after a quarter of a second."""
        return scene.with_(l=length).simulate(until=0.25, rtol=1e-9)["x"][-1] ** 2

    found = minimize_scalar(miss, bounds=(0.1, 1.0), method="bounded", options={"xatol": 1e-9})
    # The square is flat at its minimum: half of its digits are left.
    assert found.x == pytest.approx(9.81 * (0.25 / ellipk(0.5)) ** 2, rel=1e-6)


def test_a_law_in_python_gives_the_motion_of_its_closed_form():
    run = holonom.Scene(oscillator(lambda t, r, v: [-9 * r[0], -9 * r[1]])).simulate()
    # All of the difference is the error of the run, of which 1e-10 is asked.
    assert np.allclose(run["mass.x"], np.cos(3 * run.t), rtol=0, atol=1e-8)
    driven = holonom.Scene(oscillator(lambda t, r, v: np.array([2 - v[0], 0]))).simulate()
    assert np.allclose(driven["mass.x'"], 2 - 2 * np.exp(-driven.t), rtol=0, atol=1e-8)


def test_a_law_in_python_is_linearized():
    scene = holonom.Scene(oscillator(lambda t, r, v: (-(r[0] ** 3) - 0.5 * v[0], -7 * r[1])))
    model = scene.linearize(chart="frozen")
    # Central differences are right to the two thirds power of the rounding: 4e-11, times the third derivative 6.
    expected = [[0, 0, 1, 0], [0, 0, 0, 1], [-3, 0, -0.5, 0], [0, -7, 0, 0]]
    assert np.allclose(model.A, expected, rtol=0, atol=1e-9)


def test_an_exception_of_a_law_ends_the_run():
    def law(t, r, v):
        if t > 0.5:
            raise ZeroDivisionError("own")
        return [0, 0]

    scene = holonom.Scene(oscillator(law))
    with pytest.raises(ZeroDivisionError, match="own") as caught:
        scene.simulate()
    assert 0 < caught.value.partial.t[-1] <= 0.5
    with pytest.raises(ValueError, match="the force has 1 components; in 2 dimensions it has 2"):
        holonom.Scene(oscillator(lambda t, r, v: [1]))


def test_andrews_mechanism_is_the_published_one(models):
    run = holonom.Scene(models / "andrews.json").simulate(until=0.03, rtol=1e-8)
    # In 80-bit arithmetic, as the scene says; 1e-8 of the largest angle is asked.
    assert run["beta"][-1] == pytest.approx(15.810771195, abs=1e-6)


def simulated(scene):
    """Run in a process of its own."""
    return scene.simulate(until=0.5)


def failed(scene):
    """Run in a process of its own."""
    return scene.simulate(integrator="rk5")


def test_processes_give_the_same_rows_bit_by_bit():
    scene = holonom.Scene(pendulum())
    scenes = [scene.with_(l=length) for length in (0.5, 1, 2)]
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        for mine, theirs in zip(map(simulated, scenes), pool.map(simulated, scenes), strict=True):
            assert theirs.rows.tobytes() == mine.rows.tobytes()
        with pytest.raises(holonom.SceneError, match="there is no integrator `rk5`"):
            pool.submit(failed, scene).result()


def test_laws_in_python_serve_all_commands():
    scene = holonom.Scene(oscillator(lambda t, r, v: (-9 * r[0], -9 * r[1]), name="laws"))
    assert scene.check().degrees_of_freedom == 2
    assert "verdict: right" in scene.validate(horizon=0.3, budget="20s").text
    calls = []

    def law(t, r, v):
        calls.append(t)
        if len(calls) > 50:
            raise ZeroDivisionError("own")
        return [0, 0]

    broken = holonom.Scene(oscillator(law))
    with pytest.raises(ZeroDivisionError, match="own"):
        broken.drift()
    # The exception is told once, and does not end other runs.
    assert scene.simulate(until=0.1).t[-1] == 0.1
