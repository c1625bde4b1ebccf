"""Functions of Python that scenes name by a number."""

import itertools
from collections.abc import Callable
from typing import Any
from weakref import WeakValueDictionary

#: The functions of the scenes that exist.
kept: WeakValueDictionary[int, Callable[..., Any]] = WeakValueDictionary()
_numbers = itertools.count(1)


def keep(function: Callable[..., Any]) -> int:
    """Returns the number of a function, which stays as long as somebody holds the function."""
    number = next(_numbers)
    kept[number] = function
    return number
