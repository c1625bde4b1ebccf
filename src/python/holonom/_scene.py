"""Scenes."""

from __future__ import annotations

import functools
import io
import json
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._answer import Answer, call, warn, word, words
from ._functions import address, keep, with_laws
from ._linear import LinearModel, LinearMotion, model
from ._run import Run, finished

#: The names under which commands read a scene that is no file, the summary of a run, and the variants of a study.
_SCENE = "<scene>"
_RUN = "<run>"
_VARIANTS = "<variants>"


class Scene:
    """A mechanism with its settings: a scene file, or a dict with the same contents.

    Keywords are values of its parameters, as numbers or as expressions. A parameter that is no name of Python goes into
    `parameters`. A file is read anew by each command.

    A force of type ``python`` in a dict takes a function as its law::

        {"name": "drag", "type": "python", "between": ["ground", "bob"],
         "function": lambda t, r, v: [-0.1 * v[0], -0.1 * v[1]]}

    It returns the force on the second marker, N, from the time and from the position and velocity of the second marker
    relative to the first, in world axes. The first marker gets the opposite force. Each call costs a microsecond or two,
    so an expression in the scene is faster. A list has a function for each component, of Python or compiled:
    ``double f(double t, const double *r, const double *v)``, by ctypes or as a ``cfunc`` of Numba.

    >>> import holonom
    >>> scene = holonom.Scene(holonom.command("generate", "chain", n=2))
    >>> scene.name, len(scene.q)
    ('chain_2', 6)
    """

    def __init__(
        self,
        scene: str | os.PathLike[str] | Mapping[str, Any],
        *,
        parameters: Mapping[str, float | str] | None = None,
        **more: float | str,
    ) -> None:
        self._functions: list[Callable[..., Any]] = []
        self._path = _SCENE if isinstance(scene, Mapping) else os.fspath(scene)
        self._text = json.dumps(with_laws(scene), default=self._plain) if isinstance(scene, Mapping) else None
        self._given = {**(parameters or {}), **more}
        self._source: Any = scene
        warn(self._described["warnings"], stacklevel=2)

    @functools.cached_property
    def _described(self) -> dict[str, Any]:
        described: dict[str, Any] = json.loads(_core.describe(self._words({}), self._texts()))
        return described

    @property
    def name(self) -> str:
        """Name of the scene."""
        return str(self._described["name"])

    @property
    def parameters(self) -> dict[str, float]:
        """Values of all parameters."""
        return dict(self._described["parameters"])

    @property
    def q(self) -> list[str]:
        """Names of the coordinates."""
        return list(self._described["q"])

    @property
    def v(self) -> list[str]:
        """Names of the velocities."""
        return list(self._described["v"])

    @property
    def lambda_(self) -> list[str]:
        """Names of the multipliers."""
        return list(self._described["lambda"])

    @property
    def outputs(self) -> dict[str, str]:
        """Units of the outputs, by name."""
        return dict(self._described["outputs"])

    @property
    def inputs(self) -> dict[str, str]:
        """Units of the inputs, by name."""
        return dict(self._described["inputs"])

    def with_(self, parameters: Mapping[str, float | str] | None = None, **more: float | str) -> Scene:
        """Returns the scene with other values of some parameters, which are checked when it is used.

        >>> import holonom
        >>> scene = holonom.Scene({"name": "m", "dimension": 2, "parameters": {"m": 1},
        ...     "bodies": [{"name": "b", "type": "point_mass", "mass": "m"}]})
        >>> scene.with_(m=2).parameters
        {'m': 2.0}
        """
        changed = object.__new__(type(self))
        given = {**self._given, **(parameters or {}), **more}
        changed.__dict__.update({**self.__dict__, "_given": given})
        changed.__dict__.pop("_described", None)
        return changed

    def simulate(self, **options: object) -> Run:
        """Simulates; keywords are the options of ``holonom simulate``.

        The usual ones are `until`, `output_step`, `rtol`, `atol`, `step`, `method="auto"`, `formulation`, `integrator`,
        `projection`, `equilibrium`, `outputs_only` and `check_error`. Other threads of Python go on meanwhile. Ctrl-C
        ends the run.
        """
        return self._simulate(options)

    def _simulate(self, options: Mapping[str, object], start: str | None = None) -> Run:
        texts = self._texts()
        if start is not None:
            texts.append((_RUN, start))
            options = {**options, "start": _RUN}
        return finished(self, _core.simulate(self._words(options), texts), stacklevel=3)

    @overload
    def linearize(self, *, along: str, **options: object) -> LinearMotion: ...
    @overload
    def linearize(self, *, at: Sequence[float], along: None = None, **options: object) -> list[LinearModel]: ...
    @overload
    def linearize(self, *, at: float | None = None, along: None = None, **options: object) -> LinearModel: ...
    def linearize(self, **options: object) -> Any:
        """Returns the linear model at the start or ``at=T``, or a list of them ``at=[T, ...]``.

        ``along="A..B:N"`` returns the linear time-varying model. Others are `equilibrium`, `chart`, `method` and the other
        options of ``holonom linearize``.
        """
        found = self._call("linearize", options)
        return [model(one) for one in found] if isinstance(found, list) else model(found)

    def check(self, **options: object) -> Answer:
        """Returns what was modelled: coordinates, constraints, rank, redundancy. See ``holonom check --help``."""
        found: Answer = self._call("check", options)
        return found

    def static(self, **options: object) -> Answer:
        """Returns the static equilibrium that belongs to the start."""
        found: Answer = self.check(static=True, **options).equilibrium
        return found

    def loci(self, **options: object) -> Any:
        """Returns eigenvalues along the motion, or over a parameter. See ``holonom loci --help``."""
        return self._call("loci", options)

    def bode(self, **options: object) -> Any:
        """Returns frequency responses. See ``holonom bode --help``."""
        return self._call("bode", options)

    def validate(self, **options: object) -> Any:
        """Checks linear models by perturbed simulations. See ``holonom validate --help``."""
        return self._call("validate", options)

    def transition(self, **options: object) -> Any:
        """Returns the growth of small changes along the motion. See ``holonom transition --help``."""
        return self._call("transition", options)

    def drift(self, **options: object) -> Any:
        """Compares the drift under every stabilization. See ``holonom drift --help``."""
        return self._call("drift", options)

    def tradeoff(self, **options: object) -> Any:
        """Measures the cost of each method for its accuracy. See ``holonom tradeoff --help``."""
        return self._call("tradeoff", options)

    def simplify(self, **options: object) -> Any:
        """Finds the least model within a bound, such as ``within="5%"``. See ``holonom simplify --help``."""
        return self._call("simplify", options)

    def stress(self, **options: object) -> Any:
        """Maps what steps, gains, masses and stiffness the scene takes. See ``holonom stress --help``."""
        return self._call("stress", options)

    def kinematics(self, values: str, **options: object) -> Any:
        """Assembles the scene at many values of a parameter, such as ``"travel=-0.08..0.08:81"``."""
        return self._call("kinematics", options, values)

    def study(self, **options: object) -> Any:
        """Runs variants and records numbers of each, such as ``vary="l=1..2:5"``. See ``holonom study --help``."""
        return self._call("study", options)

    def objective(
        self, record: str | Sequence[str], names: str | Sequence[str], **options: object
    ) -> Objective:
        """Returns a function of values of the parameters `names`, for an optimizer. See `Objective`."""
        return Objective(self, _listed(record), _listed(names), options)

    def plot(self, **options: object) -> Any:
        """Draws the mechanism; the figures are in `files`. See ``holonom plot --help``."""
        return self._call("plot", options)

    def command(self, name: str, *arguments: object, **options: object) -> Any:
        """Calls any command of the command line on the scene, as `holonom.command` does."""
        return self._call(name, options, *map(str, arguments))

    def _call(
        self, name: str, options: Mapping[str, object], *arguments: str, texts: Sequence[tuple[str, str]] = ()
    ) -> Any:
        return call(name, [*self._words({}), *arguments], options, [*self._texts(), *texts], stacklevel=4)

    def _words(self, options: Mapping[str, object]) -> list[str]:
        """The scene, its parameters and options as words of the command line."""
        set_ = {name: word(value) for name, value in self._given.items()}
        return [self._path, *words({"set": set_}), *words(options)]

    def _texts(self) -> list[tuple[str, str]]:
        return [] if self._text is None else [(_SCENE, self._text)]

    def _plain(self, value: Any) -> Any:
        """A value that JSON does not know: arrays and numbers of NumPy, functions."""
        if address(value) is not None:
            raise TypeError("a compiled function gives one component of a force: write a list with one for each axis")
        if callable(value):
            self._functions.append(value)
            return keep(value)
        if hasattr(value, "tolist"):
            return value.tolist()
        raise TypeError(f"a scene cannot have a {type(value).__name__}: {value!r}")

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._source, self._given)

    def __repr__(self) -> str:
        given = "".join(f", {name}={value!r}" for name, value in self._given.items())
        return f"<holonom.Scene {self.name}{given}>"


class Objective:
    """A function of values of parameters that gives the numbers of ``scene.study(record=...)``.

    One set of values gives an array of the numbers. A table with a row for each variant gives a row for each, computed
    on all cores. A variant that fails has numbers that are not a number.

    >>> import holonom
    >>> scene = holonom.Scene({"name": "m", "dimension": 2, "parameters": {"x0": 1, "v0": 1},
    ...     "bodies": [{"name": "b", "type": "point_mass", "mass": 1,
    ...                 "initial": {"position": ["x0", 0], "velocity": ["v0", 0]}}]})
    >>> position = scene.objective("b.x", "x0,v0", until=1)
    >>> position([2, 3]).round(6)
    array([5.])
    >>> position([[2, 3], [4, 5]]).round(6).tolist()
    [[5.0], [9.0]]
    """

    def __init__(self, scene: Scene, record: list[str], names: list[str], options: Mapping[str, object]) -> None:
        self.scene = scene
        self.record = record
        self.names = names
        self._options = {**options, "record": record, "list": _VARIANTS, "quiet": True, "figures": "none"}

    def __call__(self, values: Any) -> NDArray[np.float64]:
        table = np.asarray(values, dtype=float)
        rows = [",".join(map(repr, row)) for row in np.atleast_2d(table).tolist()]
        variants = "\n".join([",".join(self.names), *rows])
        try:
            found = self.scene._call("study", self._options, texts=[(_VARIANTS, variants)])
        except _core.RunError as error:
            # All failed.
            found = error.partial
        with np.load(io.BytesIO(found.files["study.npz"])) as arrays:
            numbers: NDArray[np.float64] = arrays["values"][:, len(self.names) :]
        return numbers[0] if table.ndim == 1 else numbers


def _listed(names: str | Sequence[str]) -> list[str]:
    return names.split(",") if isinstance(names, str) else list(names)


def _restored(scene: Any, parameters: Mapping[str, float | str]) -> Scene:
    return Scene(scene, parameters=parameters)
