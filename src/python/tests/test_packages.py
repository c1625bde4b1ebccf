"""Work with other packages: python-control, Dask, SciPy."""

import numpy as np
import pytest
from conftest import pendulum

import holonom


def test_bode_plots_of_python_control(models):
    control = pytest.importorskip("control")
    pytest.importorskip("matplotlib").use("Agg")
    scene = holonom.Scene(models / "quarter_car.json")
    plant = scene.linearize(equilibrium=True).to_control()
    response = control.frequency_response(plant, np.logspace(0, 2, 50))
    plot = control.bode_plot(response)
    outputs, inputs = plant.noutputs, plant.ninputs
    assert plot.axes.shape == (2 * outputs, inputs)
    magnitude = plot.lines[0, 0][0].get_ydata()
    exact = [abs(plant(1j * omega)[0, 0]) if outputs * inputs > 1 else abs(plant(1j * omega)) for omega in response.omega]
    assert np.allclose(magnitude, exact, rtol=1e-9)


def shard(scene, part):
    """Rows of a part of a study, by their number."""
    files = scene.study(vary="l=1..2:7", record="max(x),min(y),steps", until=0.5, shard=part, o=None).files
    header, *rows = files["study.csv"].decode().splitlines()
    return header, {int(row.split(",")[0]): row for row in rows}


def test_shards_on_dask_are_the_rows_of_the_whole_study():
    distributed = pytest.importorskip("distributed")
    scene = holonom.Scene(pendulum())
    whole = scene.study(vary="l=1..2:7", record="max(x),min(y),steps", until=0.5).files["study.csv"].decode()
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        parts = client.gather(client.map(shard, [scene, scene], ["1/2", "2/2"], pure=False))
    rows = {**parts[0][1], **parts[1][1]}
    assert [len(part[1]) for part in parts] == [4, 3]
    assert "\n".join([parts[0][0], *(rows[row] for row in sorted(rows))]) + "\n" == whole


def test_an_objective_gives_rows_of_a_study():
    scene = holonom.Scene(pendulum())
    last = scene.objective(["x", "min(y)"], "l", until=0.25)
    table = last([[0.5], [1.0], [-1.0]])
    assert table.shape == (3, 2) and np.isnan(table[2]).all()
    assert np.isnan(last([-1.0])).all()
    for length, row in zip([0.5, 1.0], table, strict=False):
        assert row.tobytes() == last([length]).tobytes()
        assert row[0] == scene.with_(l=length).simulate(until=0.25, output_step=0.25)["x"][-1]
