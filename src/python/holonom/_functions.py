"""Functions of Python, and compiled ones, that scenes name by a number."""

from __future__ import annotations

import ctypes
import itertools
import struct
from _ctypes import CFuncPtr
from collections.abc import Callable, Mapping, Sequence
from typing import Any
from weakref import WeakValueDictionary

#: The functions of the scenes that exist.
kept: WeakValueDictionary[int, Callable[..., Any]] = WeakValueDictionary()
_numbers = itertools.count(1)

#: ``double f(double t, const double *r, const double *v)``; it is called without giving other threads a turn.
_COMPILED = ctypes.PYFUNCTYPE(ctypes.c_double, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p)
_PACKED = {count: struct.Struct(f"{count}d").pack for count in (2, 3)}


def keep(function: Callable[..., Any]) -> int:
    """Returns the number of a function, which stays as long as somebody holds the function."""
    number = next(_numbers)
    kept[number] = function
    return number


def address(function: Any) -> int | None:
    """Returns the address of a compiled function: a function pointer of ctypes, or a ``cfunc`` of Numba."""
    pointer = getattr(function, "ctypes", function)
    return ctypes.cast(pointer, ctypes.c_void_p).value if isinstance(pointer, CFuncPtr) else None


def law(components: Sequence[Callable[..., Any]]) -> Callable[..., Any]:
    """Returns the law (t, r, v) that has these components, which are functions of Python or compiled.

    >>> from holonom._functions import law
    >>> law([lambda t, r, v: -r[0], lambda t, r, v: -v[1]])(0, (1, 2), (3, 4))
    [-1, -4]
    """
    addresses = [address(component) for component in components]
    if None in addresses:
        return lambda t, r, v: [component(t, r, v) for component in components]
    calls = [_COMPILED(at) for at in addresses if at is not None]

    def compiled(t: float, r: Sequence[float], v: Sequence[float]) -> list[float]:
        # Bytes are passed as the pointer to them. Each call has its own, as several threads may call.
        pack = _PACKED[len(r)]
        position, velocity = pack(*r), pack(*v)
        return [call(t, position, velocity) for call in calls]

    # A pointer does not keep the library, or the function of Python behind it.
    compiled.components = components  # type: ignore[attr-defined]
    return compiled


def with_laws(scene: Mapping[str, Any]) -> Mapping[str, Any]:
    """Returns the scene with one function in the place of the components of each law."""
    forces = scene.get("forces")
    if not isinstance(forces, (list, tuple)):
        return scene
    return {**scene, "forces": [_with_law(force) for force in forces]}


def _with_law(force: Any) -> Any:
    components = force.get("function") if isinstance(force, Mapping) else None
    is_list = isinstance(components, (list, tuple)) and all(callable(one) or address(one) for one in components)
    return {**force, "function": law(components)} if is_list and components else force
