"""The compiled part. Its functions take the words of the command line, and texts in the place of files by their paths."""

from collections.abc import Sequence
from typing import Any

__version__: str

class HolonomError(Exception):
    """Base of all errors of holonom."""

class SceneError(HolonomError):
    """Bad input: the element, what was found, and what would be right."""

class RunError(HolonomError):
    """The run failed. What it computed until then is in `partial`, or None."""

    partial: Any

def command(
    words: Sequence[str], given: Sequence[tuple[str, str]], folder: str
) -> tuple[str | None, str, list[str], bool, BaseException | None]:
    """Calls a command with the texts `given` in the place of files; its own files go to `folder`.

    Returns the result as JSON and as text, the warnings and errors, true if the command failed, and the exception of a
    signal after which the command ended by itself.
    """

def main(words: Sequence[str]) -> int:
    """Runs the command line of these words, the program first, and returns its exit code."""

def simulate(words: Sequence[str], given: Sequence[tuple[str, str]]) -> dict[str, Any]:
    """Simulates with the texts `given` in the place of files. `words` are the scene and the options of `simulate`."""

def describe(words: Sequence[str], given: Sequence[tuple[str, str]]) -> str:
    """Reads and assembles a scene; returns its names, parameters and warnings as JSON."""
