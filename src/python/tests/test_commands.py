"""The other commands, called and as a command line."""

import io
import json
import subprocess
import sys

import numpy as np
import pytest
from conftest import pendulum

import holonom


def inverted():
    """A pole of 1 m on a cart, both of 1 kg, pushed by a force: its upright state is not stable."""
    return {
        "name": "cart",
        "dimension": 2,
        "gravity": [0, -10],
        "bodies": [
            {"name": "cart", "type": "point_mass", "mass": 1, "initial": {"position": [0, 0]}},
            {"name": "tip", "type": "point_mass", "mass": 1, "initial": {"position": [0, 1]}},
        ],
        "joints": [
            {"name": "rail", "type": "point_on_line", "between": ["ground", "cart"]},
            {"name": "pole", "type": "distance", "between": ["cart", "tip"], "length": 1},
        ],
        "forces": [{"name": "push", "type": "applied_force", "at": "cart", "force": [0, 0]}],
        "inputs": [{"name": "u", "force": "push", "component": "x"}],
        "outputs": [
            {"name": "x", "measure": "position", "of": "cart", "component": "x"},
            {"name": "tip", "measure": "position", "of": "tip", "component": "x"},
        ],
        "simulation": {"t_end": 1},
    }


def test_linear_models_go_to_python_control():
    control = pytest.importorskip("control")
    model = holonom.Scene(inverted()).linearize(chart="cart.x,tip.x")
    # M x'' = u + m g s, x'' + l s'' = g s with s = (x_tip - x)/l: s'' = (M + m) g s/(M l) - u/(M l) = 20 s - u.
    assert np.allclose(np.sort(model.eigenvalues.real), [-np.sqrt(20), 0, 0, np.sqrt(20)], rtol=0, atol=1e-7)
    plant = model.to_control()
    assert plant.state_labels == model.states and plant.input_labels == ["u"] and plant.output_labels == ["x", "tip"]
    gain, _, poles = control.lqr(plant, np.eye(4), np.eye(1))
    assert gain.shape == (1, 4) and poles.real.max() < 0
    assert np.allclose(plant(1j)[0, 0], (model.C @ np.linalg.solve(1j * np.eye(4) - model.A, model.B))[0, 0])
    tangent, _ = model.basis
    assert tangent.shape == (4, 2)


def test_models_along_a_motion_are_arrays():
    scene = holonom.Scene(pendulum())
    models = scene.linearize(at=[0, 0.25])
    assert [model.t for model in models] == [0, 0.25]
    along = scene.linearize(along="0..0.5:6")
    assert along.A.shape == (6, 2, 2) and np.allclose(along.t, np.linspace(0, 0.5, 6))
    assert "linear model" in repr(along)


def test_every_command_gives_its_answer(models):
    scene = holonom.Scene(pendulum(), l=2)
    assert scene.check().degrees_of_freedom == 1
    rest = scene.static()
    assert rest.q["bob.y"] == pytest.approx(-2) and rest["lambda"]["joint.rod.length"] == pytest.approx(9.81)
    loci = scene.loci(sweep="l=1..2:3", equilibrium=True)
    assert "loci.svg" in loci.files and "<svg" in loci._repr_html_()
    # sqrt(g/l) at the three lengths.
    points = loci.branches[0].points
    assert [point.im for point in points] == pytest.approx([(9.81 / point.at) ** 0.5 for point in points])
    assert "verdict: right" in scene.validate(horizon=0.2, budget="20s").text
    assert scene.transition(lyapunov=0.5).text
    assert "bode-0.csv" in holonom.Scene(inverted()).bode(output="x", points=20).files
    assert "stabilizations.csv" in scene.drift(until=0.2).files
    assert "stress.json" in scene.stress(x="step=1e-3..1e-2:2", y="tolerance=1e-6..1e-4:2", until=0.2).files
    assert "simplified.json" in scene.simplify(within="5%", until=0.2, at_most=3).files
    assert "tradeoff.csv" in scene.tradeoff(until=0.1, budget="1s", integrator="dop853").files
    study = holonom.Scene(pendulum()).study(vary="l=1..2:3", record="x", until=0.1)
    assert "study.csv" in study.files and "3 of 3 variants" in study.text
    assert scene.kinematics("l=1..2:3").to_pandas()["x"].tolist() == [1, 1.5, 2]
    assert b"<svg" in scene.plot().files["mechanism.svg"]


def test_files_go_to_a_folder_on_request(tmp_path):
    found = holonom.Scene(pendulum()).check()
    assert found.files == {}
    holonom.Scene(pendulum()).loci(until=0.1, every=0.05, o=tmp_path / "results")
    assert (tmp_path / "results/loci.json").is_file()


def test_a_failed_check_raises_with_its_answer(models):
    with pytest.raises(holonom.RunError) as caught:
        holonom.Scene(models / "five_link_kinematics.json").kinematics("travel=0..3:4")
    assert caught.value.partial.text and "travel" in str(caught.value)


def test_the_command_line_is_the_same(tmp_path):
    (tmp_path / "pendulum.json").write_text(json.dumps(pendulum()))
    command = [sys.executable, "-m", "holonom", "check", "pendulum.json", "--json"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    called = holonom.Scene(tmp_path / "pendulum.json").check()
    assert json.loads(done.stdout) == json.loads(json.dumps(called._data))
    text = subprocess.run(command[:-1], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert text == called.text
    refused = subprocess.run([*command[:3], "nothing"], capture_output=True, text=True, check=False)
    assert refused.returncode == 2 and "unrecognized subcommand" in refused.stderr


def test_a_run_has_the_rows_of_the_command_line_bit_by_bit(models):
    scene = holonom.Scene(models / "andrews.json", c0=4000)
    files = scene.command("simulate", until=0.003).files
    run = scene.simulate(until=0.003)
    for name, part in [("trajectory", run.rows), ("drift", run.drift.rows), ("energy", run.energy.rows)]:
        table = np.loadtxt(io.BytesIO(files[f"{name}.csv"]), delimiter=",", skiprows=1, quotechar='"')
        mine = part if name == "trajectory" else np.column_stack([run.t, part])
        assert table.tobytes() == np.ascontiguousarray(mine).tobytes(), name


def test_commands_without_a_scene():
    assert "radau_iia" in holonom.command("methods").text
    assert holonom.command("guide", "python").startswith("# Python")
    assert holonom.command("schema")["$schema"]
    assert "--every" in holonom.command("loci", help=True)
