"""Mechanisms as differential-algebraic equations: simulation, constraint drift, linear models.

>>> import holonom
>>> pendulum = holonom.Scene({
...     "name": "pendulum", "dimension": 2, "gravity": [0, -9.81], "parameters": {"l": 1},
...     "bodies": [{"name": "bob", "type": "point_mass", "mass": 1, "initial": {"position": ["l", 0]}}],
...     "joints": [{"name": "rod", "type": "distance", "between": ["ground", "bob"], "length": "l"}],
...     "outputs": [{"name": "height", "measure": "position", "of": "bob", "component": "y"}],
... }, l=2)
>>> run = pendulum.simulate(until=10, rtol=1e-10)
>>> print(run["height"].min().round(3))
-2.0
>>> bool(run.drift.position.max() < 1e-12)
True

The guide is printed by ``python -m holonom guide python``.
"""

from ._answer import Answer, HolonomWarning, command
from ._builder import Builder
from ._core import HolonomError, RunError, SceneError, __version__
from ._linear import LinearModel, LinearMotion
from ._run import Columns, Run
from ._scene import Objective, Scene

__all__ = [
    "Answer",
    "Builder",
    "Columns",
    "HolonomError",
    "HolonomWarning",
    "LinearModel",
    "LinearMotion",
    "Objective",
    "Run",
    "RunError",
    "Scene",
    "SceneError",
    "__version__",
    "command",
]
