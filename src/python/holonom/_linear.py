"""Linear models."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._answer import Answer

if TYPE_CHECKING:
    import control

#: An array of numbers.
Array = NDArray[np.float64]


class LinearModel(Answer):
    """x' = A x + B u, y = C x + D u near a state of a motion.

    It has all that ``linear-T.json`` has, with arrays in the place of lists.
    """

    def _matrix(self, key: str, rows: int, columns: int) -> Array:
        return np.array(self._data[key], dtype=float).reshape(rows, columns)

    @property
    def A(self) -> Array:
        """Derivative of x' with respect to x."""
        return self._matrix("A", len(self.states), len(self.states))

    @property
    def B(self) -> Array:
        """Derivative of x' with respect to the inputs."""
        return self._matrix("B", len(self.states), len(self.inputs))

    @property
    def C(self) -> Array:
        """Derivative of the outputs with respect to x."""
        return self._matrix("C", len(self.outputs), len(self.states))

    @property
    def D(self) -> Array:
        """Derivative of the outputs with respect to the inputs."""
        return self._matrix("D", len(self.outputs), len(self.inputs))

    @property
    def basis(self) -> tuple[Array, Array]:
        """R and T: small changes of the coordinates are R x_q, and those of the velocities T x_q + R x_v."""
        return np.array(self._data["R"]), np.array(self._data["T"])

    @property
    def names(self) -> dict[str, list[str]]:
        """Names of the states, inputs and outputs."""
        return {key: list(self._data[key]) for key in ("states", "inputs", "outputs")}

    @property
    def eigenvalues(self) -> NDArray[np.complex128]:
        """Eigenvalues, 1/s. `modes` has more of each."""
        return np.array([complex(mode["re"], mode["im"]) for mode in self._data["eigenvalues"]])

    @property
    def modes(self) -> list[Answer]:
        """Each eigenvalue with its frequency, damping ratio, kind and participation."""
        return [Answer(mode) for mode in self._data["eigenvalues"]]

    def to_control(self) -> control.StateSpace:
        """Returns a state-space system of python-control, with names."""
        import control

        return control.ss(self.A, self.B, self.C, self.D, **self.names)


class LinearMotion(Answer):
    """The linear time-varying model along a motion: arrays whose first index is the time.

    ``t`` has the times, ``A``, ``B``, ``C``, ``D``, ``R``, ``T`` and ``Phi`` the matrices at each, and ``q``, ``v``,
    ``lambda`` the nominal motion: all arrays of ``ltv.npz``.
    """

    def __init__(self, data: Any, text: str, files: dict[str, bytes]) -> None:
        with np.load(io.BytesIO(files["ltv.npz"])) as arrays:
            super().__init__({**data, **{key: arrays[key] for key in arrays.files}}, text, files)


def model(found: Answer) -> LinearModel | LinearMotion:
    """Returns the result of `linearize` as a model."""
    kind = LinearMotion if "ltv.npz" in found.files else LinearModel
    return kind(found._data, found.text, found.files)
