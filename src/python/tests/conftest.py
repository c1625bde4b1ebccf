"""Scenes that several tests use."""

from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[3]


@pytest.fixture
def models():
    """The folder of the shipped scenes."""
    return REPOSITORY / "models"


def pendulum(**more):
    """A point mass on a massless rod of length l that starts level."""
    scene = {
        "name": "pendulum",
        "dimension": 2,
        "gravity": [0, -9.81],
        "parameters": {"l": 1},
        "bodies": [{"name": "bob", "type": "point_mass", "mass": 1, "initial": {"position": ["l", 0]}}],
        "joints": [{"name": "rod", "type": "distance", "between": ["ground", "bob"], "length": "l"}],
        "outputs": [
            {"name": "x", "measure": "position", "of": "bob", "component": "x"},
            {"name": "y", "measure": "position", "of": "bob", "component": "y"},
        ],
        "simulation": {"t_end": 1, "integrator": "dop853", "rtol": 1e-10, "atol": 1e-10},
    }
    return {**scene, **more}


def oscillator(law, **more):
    """A free mass of 1 kg that starts at x = 1 m and is held to the ground by a law in Python."""
    scene = {
        "name": "oscillator",
        "dimension": 2,
        "bodies": [{"name": "mass", "type": "point_mass", "mass": 1, "initial": {"position": [1, 0]}}],
        "forces": [{"name": "law", "type": "python", "between": ["ground", "mass"], "function": law}],
        "simulation": {"t_end": 1, "integrator": "dop853", "rtol": 1e-10, "atol": 1e-10},
    }
    return {**scene, **more}
