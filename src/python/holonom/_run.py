"""Finished runs."""

from __future__ import annotations

import functools
import html
import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._answer import Answer, unknown, warn

if TYPE_CHECKING:
    import pandas

    from ._scene import Scene

#: An array of numbers.
Array = NDArray[np.float64]


class Columns(Mapping[str, Array]):
    """Named columns over the rows of a run: views of one array, `rows`, of which nothing is copied."""

    def __init__(self, columns: list[str], rows: Array) -> None:
        self.columns = columns
        self.rows = rows

    def __getitem__(self, name: str) -> Array:
        try:
            column: Array = self.rows[:, self.columns.index(name)]
        except ValueError:
            raise KeyError(unknown("column", name, self.columns)) from None
        return column

    def __getattr__(self, name: str) -> Array:
        if name.startswith("_") or name in ("columns", "rows"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name for name in self.columns if name.isidentifier())]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({len(self.rows)} rows of {', '.join(self.columns)})"

    def to_pandas(self) -> pandas.DataFrame:
        """Returns a data frame of all columns."""
        import pandas

        return pandas.DataFrame(self.rows, columns=self.columns)


class Run(Columns):
    """A run: its rows, drift, energies and summary.

    ``run["beta"]`` is a column: time ``t``, a coordinate, a velocity, a multiplier or an output. At a jump there are two
    rows of the same time.
    """

    #: Units of the outputs, by name.
    units: dict[str, str]
    #: Largest constraint residual at each row: `position`, `velocity` and `acceleration`.
    drift: Columns
    #: `kinetic`, `potential`, `work` and the `error` of their balance, J; None where there is no potential.
    energy: Columns | None
    #: The summary as the command line prints it.
    text: str

    def __init__(self, scene: Scene, found: Mapping[str, Any]) -> None:
        super().__init__(found["columns"], found["rows"])
        self.scene = scene
        self.units = dict(found["units"])
        self.text = found["text"]
        self.drift = Columns(["position", "velocity", "acceleration"], found["drift"])
        energy = found["energy"]
        self.energy = None if energy is None else Columns(["kinetic", "potential", "work", "error"], energy)
        self._sizes: tuple[int, int, int] = found["sizes"]
        self._json: str = found["summary"]

    @property
    def t(self) -> Array:
        """Times of the rows, s."""
        return self._part(0, 1)[:, 0]

    @property
    def q(self) -> Array:
        """Coordinates, a row each time."""
        return self._part(1, self._sizes[0])

    @property
    def v(self) -> Array:
        """Velocities, a row each time."""
        return self._part(1 + self._sizes[0], self._sizes[1])

    @property
    def lambda_(self) -> Array:
        """Multipliers, a row each time."""
        return self._part(1 + self._sizes[0] + self._sizes[1], self._sizes[2])

    def _part(self, first: int, count: int) -> Array:
        part: Array = self.rows[:, first : first + count]
        return part

    @functools.cached_property
    def summary(self) -> Answer:
        """The contents of ``summary.json``: method, work, drift, energy, warnings and the last state."""
        return Answer(json.loads(self._json), self.text)

    @property
    def error(self) -> Answer | None:
        """Error bars of the outputs; None without ``check_error=True``."""
        found: Answer | None = self.summary.error
        return found

    def restart(self, *, until: float, **options: object) -> Run:
        """Goes on from the end to a later time; the rows begin at that end.

        A run that was interrupted, or has fixed steps, goes on bit by bit as one longer run would have. Another one does
        so within the error of the method. Keywords are the options of ``holonom simulate``.
        """
        return self.scene._simulate({"until": until, **options}, start=self._json)

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"

    def __repr__(self) -> str:
        return self.text.strip()


def finished(scene: Scene, found: Mapping[str, Any], stacklevel: int) -> Run:
    """Returns a run, or raises the error that ended it with the run in `partial`."""
    run = Run(scene, found)
    error = found["raised"]
    if error is None and found["failure"] is None:
        warn(found["warnings"], stacklevel + 1)
        return run
    if error is None:
        error = _core.RunError(found["failure"])
    error.partial = run
    raise error
