"""Scenes written in code."""

import json

import numpy as np
import pytest
from conftest import pendulum

import holonom


def built():
    """The pendulum of the other tests."""
    return (
        holonom.Builder("pendulum", 2)
        .gravity(0, -9.81)
        .parameter("l", 1)
        .body("bob", "point_mass", mass=1, initial={"position": ["l", 0]})
        .joint("rod", "distance", between=["ground", "bob"], length="l")
        .output("x", "position", of="bob", component="x")
        .output("y", "position", of="bob", component="y")
        .simulation(t_end=1, integrator="dop853", rtol=1e-10)
        .simulation(atol=1e-10)
    )


def test_a_builder_makes_the_scene_of_a_file():
    assert built().to_dict() == pendulum()
    mine, theirs = built().scene(l=2), holonom.Scene(pendulum(), l=2)
    assert mine.simulate().rows.tobytes() == theirs.simulate().rows.tobytes()


def test_forces_inputs_and_markers():
    builder = (
        holonom.Builder("slider", 2)
        .body("block", "rigid", mass=2, inertia=1)
        .marker("block", "tip", [1, 0])
        .marker("ground", "O", [0, 0])
        .joint("rail", "prismatic", between=["ground.O", "block"])
        .force("push", "applied_force", at="block.tip", force=[3, 0])
        .input("u", force="push", component="x")
        .output("x", "position", of="block", component="x")
        .with_(assembly={"hold": []})
    )
    scene = builder.scene()
    assert scene.inputs == {"u": "N"}
    # x = F/(2 m) t^2
    assert np.isclose(scene.simulate(until=2)["x"][-1], 3 / (2 * 2) * 4)
    # A scene does not change with its builder.
    builder.body("other", "point_mass", mass=1)
    assert scene.linearize().B.shape == (2, 1)


def test_mistakes_are_told_by_place():
    with pytest.raises(ValueError, match=r"no body `blok`(.|\n)*did you mean `block`"):
        holonom.Builder("b", 2).body("block", "point_mass", mass=1).marker("blok", "A", [0, 0])
    with pytest.raises(holonom.SceneError, match=r"bodies\[0\]"):
        holonom.Builder("b", 2).body("block", "point_mass", mas=1).scene()
    assert json.loads(json.dumps(built().to_dict())) == built().to_dict()
