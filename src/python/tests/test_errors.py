"""Errors and warnings: the words of the command line with keywords for its options, as exceptions of Python."""

import json
import pickle
import subprocess
import sys

import pytest
from conftest import pendulum

import holonom


def told(*words):
    """The message of the command line."""
    done = subprocess.run([sys.executable, "-m", "holonom", *words], capture_output=True, text=True, check=False)
    return done.returncode, done.stderr.removeprefix("error: ").strip()


def test_a_bad_scene_is_refused_in_the_words_of_the_command_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    bad = pendulum()
    bad["joints"][0]["between"][1] = "bobb"
    (tmp_path / "bad.json").write_text(json.dumps(bad))
    with pytest.raises(holonom.SceneError) as caught:
        holonom.Scene("bad.json")
    assert told("simulate", "bad.json") == (2, str(caught.value))
    assert "did you mean `bob`?" in str(caught.value)
    with pytest.raises(holonom.SceneError, match=r"^at joints\[0\].between\[1\]"):
        holonom.Scene(bad)
    with pytest.raises(holonom.SceneError, match="no such file"):
        holonom.Scene("none.json")
    with pytest.raises(holonom.SceneError, match="there is no parameter|unknown parameter"):
        holonom.Scene(pendulum(), ll=2)


def test_options_that_do_not_exist_are_type_errors():
    scene = holonom.Scene(pendulum())
    with pytest.raises(TypeError, match="'untill' found(.|\n)*'until'"):
        scene.simulate(untill=3)
    with pytest.raises(TypeError, match="'evry'"):
        scene.loci(evry=3)
    with pytest.raises(holonom.SceneError, match="rtol.*above zero"):
        scene.simulate(rtol=-1)
    with pytest.raises(holonom.SceneError, match="there is no integrator `rk5`"):
        scene.simulate(integrator="rk5")


def test_a_failed_run_keeps_its_rows():
    falling = pendulum(parameters={"l": 1, "m": 1}, gravity=[0, "if(1 > 0, 1, 1)"])
    falling["forces"] = [{"name": "f", "type": "applied_force", "at": "bob", "force": ["1/(0.5 - t)", 0]}]
    with pytest.raises(holonom.RunError) as caught:
        holonom.Scene(falling).simulate()
    assert str(caught.value).startswith("stopped at t = ")
    assert caught.value.partial.t[-1] <= 0.5
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is holonom.RunError and str(again) == str(caught.value)
    assert (again.partial.rows == caught.value.partial.rows).all()


def test_exceptions_and_scenes_pickle():
    for kind in [holonom.HolonomError, holonom.SceneError, holonom.RunError]:
        again = pickle.loads(pickle.dumps(kind("text")))
        assert type(again) is kind and str(again) == "text"
    scene = pickle.loads(pickle.dumps(holonom.Scene(pendulum(), l=2)))
    assert scene.parameters == {"l": 2} and scene.name == "pendulum"


def test_warnings_are_those_of_python():
    guessed = pendulum()
    guessed["bodies"][0]["initial"]["position"] = [50, 0]
    with pytest.warns(holonom.HolonomWarning, match="help: ") as caught:
        scene = holonom.Scene(guessed)
    assert caught[0].filename == __file__
    with pytest.warns(holonom.HolonomWarning):
        scene.simulate(until=0.1)
