"""Scenes written in code."""

from __future__ import annotations

import copy
from typing import Any

from ._answer import unknown
from ._scene import Scene


class Builder:
    """A scene written in code: the keys of a scene file, with the same checks.

    >>> from holonom import Builder
    >>> scene = (
    ...     Builder("pendulum", 2)
    ...     .gravity(0, -9.81)
    ...     .parameter("l", 1)
    ...     .marker("ground", "O", [0, 0])
    ...     .body("bob", "point_mass", mass=1, initial={"position": ["l", 0]})
    ...     .joint("rod", "distance", between=["ground.O", "bob"], length="l")
    ...     .output("height", "position", of="bob", component="y")
    ...     .scene(l=2)
    ... )
    >>> scene.name, scene.parameters, scene.outputs
    ('pendulum', {'l': 2.0}, {'height': 'm'})

    Values are numbers, or expressions over the parameters as text. A key that is a word of Python takes a ``_`` at its
    end. Each method changes the builder and returns it.
    """

    def __init__(self, name: str, dimension: int) -> None:
        self._keys: dict[str, Any] = {"name": name, "dimension": dimension, "bodies": []}

    def with_(self, **keys: Any) -> Builder:
        """Sets keys of the scene that have no method of their own, such as ``assembly={"hold": ["crank.angle"]}``."""
        self._keys.update(_plain(keys))
        return self

    def gravity(self, *components: float | str) -> Builder:
        """Sets the acceleration of gravity, m/s^2."""
        self._keys["gravity"] = list(components)
        return self

    def parameter(self, name: str, value: float | str) -> Builder:
        """Adds a parameter: a number, or an expression over others."""
        self._keys.setdefault("parameters", {})[name] = value
        return self

    def marker(self, of: str, name: str, marker: Any) -> Builder:
        """Adds a marker of a body that is there, or of ``ground``: its position, or a dict with an orientation."""
        bodies = {body["name"]: body for body in self._keys["bodies"]}
        if of != "ground" and of not in bodies:
            raise ValueError(unknown("body", of, ["ground", *bodies]))
        owner = self._keys.setdefault("ground", {}) if of == "ground" else bodies[of]
        owner.setdefault("markers", {})[name] = marker
        return self

    def body(self, name: str, type: str, /, **keys: Any) -> Builder:
        """Adds a body."""
        return self._element("bodies", {"name": name, "type": type, **_plain(keys)})

    def joint(self, name: str, type: str, /, **keys: Any) -> Builder:
        """Adds a joint."""
        return self._element("joints", {"name": name, "type": type, **_plain(keys)})

    def force(self, name: str, type: str, /, **keys: Any) -> Builder:
        """Adds a force. The type ``python`` takes a function: see `Scene`."""
        return self._element("forces", {"name": name, "type": type, **_plain(keys)})

    def input(self, name: str, /, **keys: Any) -> Builder:
        """Adds an input, such as ``input("u", force="push", component="x")``."""
        return self._element("inputs", {"name": name, **_plain(keys)})

    def output(self, name: str, measure: str, /, **keys: Any) -> Builder:
        """Adds an output of a quantity, such as ``position``."""
        return self._element("outputs", {"name": name, "measure": measure, **_plain(keys)})

    def simulation(self, **settings: Any) -> Builder:
        """Sets how the scene is simulated, such as ``t_end=2.0``."""
        self._keys.setdefault("simulation", {}).update(_plain(settings))
        return self

    def to_dict(self) -> dict[str, Any]:
        """Returns the scene as a file has it."""
        return copy.deepcopy(self._keys)

    def scene(self, **parameters: float | str) -> Scene:
        """Returns the scene; keywords replace its parameters."""
        return Scene(self.to_dict(), parameters=parameters)

    def _element(self, list: str, element: dict[str, Any]) -> Builder:
        self._keys.setdefault(list, []).append(element)
        return self


def _plain(keys: dict[str, Any]) -> dict[str, Any]:
    """Names of keys without the ``_`` behind words of Python."""
    return {key.rstrip("_"): value for key, value in keys.items()}
