"""Commands called from Python, and their results."""

from __future__ import annotations

import difflib
import html
import io
import json
import os
import tempfile
import warnings
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core

if TYPE_CHECKING:
    import pandas


#: Names that a message lists.
_NAMED = 12


class HolonomWarning(UserWarning):
    """A reason to doubt a result, with what to do about it."""


class Answer(Mapping[str, Any]):
    """The result of a command: the contents of its JSON file, as attributes and as a mapping.

    `text` is what the command prints, and `files` has the files that it writes, by name.

    >>> from holonom import Answer
    >>> answer = Answer({"drift": {"max": 1e-9}, "final": 3})
    >>> answer.drift.max, answer["final"]
    (1e-09, 3)
    """

    def __init__(self, data: Mapping[str, Any], text: str = "", files: Mapping[str, bytes] | None = None) -> None:
        self._data = data
        self.text = text
        self.files = dict(files or {})

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or name == "_data":
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError:
            raise AttributeError(unknown("key", name, list(self))) from None

    def __getitem__(self, key: str) -> Any:
        return _wrapped(self._data[key])

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(key for key in self if key.isidentifier())]

    def to_pandas(self, name: str | None = None) -> pandas.DataFrame:
        """Returns a table that the command writes as a data frame: the first, or that of a file in `files`."""
        import pandas

        tables = [file for file in self.files if file.endswith(".csv")]
        if name is None and not tables:
            raise ValueError(f"there is no table; files are {', '.join(self.files)}")
        return pandas.read_csv(io.BytesIO(self.files[name or tables[0]]))

    def __repr__(self) -> str:
        return self.text.strip() or f"Answer({self._data})"

    def _repr_html_(self) -> str:
        figures = [data.decode() for name, data in self.files.items() if name.endswith(".svg")]
        return "\n".join([f"<pre>{html.escape(repr(self))}</pre>", *figures])


def unknown(what: str, name: str, known: list[str]) -> str:
    """Returns the message for a name that is not in the list, in the words of the command line.

    >>> from holonom._answer import unknown
    >>> print(unknown("column", "btea", ["t", "beta"]))
    there is no column `btea`
      help: did you mean `beta`?
    """
    near = difflib.get_close_matches(name, known, 1)
    more = f" and {len(known) - _NAMED} more" if len(known) > _NAMED else ""
    hint = f"did you mean `{near[0]}`?" if near else f"choose one of {', '.join(known[:_NAMED])}{more}"
    return f"there is no {what} `{name}`\n  help: {hint}"


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Answer(value)
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [Answer(item) for item in value]
    return value


def command(name: str, *arguments: object, **options: object) -> Any:
    """Calls a command of the command line; keywords are its options with ``_`` for ``-``.

    True stands for an option without a value, a list for several values, and a mapping for ``NAME=VALUE``. An option that
    is a word of Python takes a ``_`` at its end: ``from_=2``. With ``o="results"`` the files go to that folder; else they
    are in `files` of the result. A command that only prints text returns that text.

    >>> import holonom
    >>> scene = holonom.command("generate", "chain", n=3)
    >>> len(scene["bodies"])
    3
    """
    return call(name, [str(argument) for argument in arguments], options, [], stacklevel=3)


def call(
    name: str,
    arguments: Sequence[str],
    options: Mapping[str, object],
    given: Sequence[tuple[str, str]],
    *,
    stacklevel: int,
) -> Any:
    """As `command`, with texts in the place of files."""
    all_words = ["holonom", name, *arguments, *words(options)]
    with tempfile.TemporaryDirectory(prefix="holonom-") as folder:
        data, text, told, failed, raised = _core.command(all_words, given, folder)
        files = _files(Path(folder))
        whole = Path(word(options.get("o", folder)), f"{name}.json")
        if data is not None and whole.is_file():
            # Long lists are in the file alone.
            data = whole.read_text(encoding="utf-8")
    errors = [line.removeprefix("error: ") for line in told if line.startswith("error: ")]
    warn([line for line in told if line.startswith("warning: ")], stacklevel + 1)
    found = _answer(data, text, files)
    if failed and raised is None:
        raised = _core.RunError("\n".join(errors))
    if raised is not None:
        vars(raised)["partial"] = found
        raise raised
    return found


def _files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir()) if path.is_file()}


def _answer(data: str | None, text: str, files: Mapping[str, bytes]) -> Any:
    if data is None:
        try:
            return json.loads(text)
        except ValueError:
            return text
    value = json.loads(data)
    if isinstance(value, list):
        return [Answer(item, text, files) for item in value]
    return Answer(value, text, files)


def warn(lines: Sequence[str], stacklevel: int) -> None:
    """Warns with lines of the command line."""
    for line in lines:
        warnings.warn(line.removeprefix("warning: "), HolonomWarning, stacklevel=stacklevel + 1)


def words(options: Mapping[str, object]) -> list[str]:
    """Returns keywords as words of the command line.

    >>> from holonom._answer import words
    >>> words({"rtol": 1e-8, "outputs_only": True, "at": [0, 0.5], "o": "results", "set": {"l": 2}})
    ['--rtol=1e-08', '--outputs-only', '--at=0,0.5', '-o', 'results', '--set=l=2']
    """
    found: list[str] = []
    for key, value in options.items():
        name = "--" + key.rstrip("_").replace("_", "-")
        if value is True:
            found.append(name)
        elif value is False or value is None:
            continue
        elif key == "o":
            found += ["-o", word(value)]
        elif isinstance(value, Mapping):
            found += [f"{name}={label}={word(part)}" for label, part in value.items()]
        elif isinstance(value, (list, tuple)) or hasattr(value, "tolist"):
            found.append(f"{name}={_joined(value)}")
        else:
            found.append(f"{name}={word(value)}")
    return found


def _joined(value: Any) -> str:
    parts = value.tolist() if hasattr(value, "tolist") else value
    return ",".join(word(part) for part in parts) if isinstance(parts, (list, tuple)) else word(parts)


def word(value: object) -> str:
    """Returns a value as a word: numbers with all their digits."""
    if hasattr(value, "item"):
        value = value.item()
    return os.fspath(value) if isinstance(value, os.PathLike) else str(value)
