"""The examples of the guide and the types of the package."""

import ast
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from conftest import REPOSITORY

import holonom

#: Packages whose examples run where they are installed, with a word of these.
OPTIONAL = {"control": "to_control", "openmdao": "import openmdao"}

USER = """
import holonom
scene = holonom.Scene("andrews.json", c0=4000)
run = scene.simulate(until=0.03, method="auto")
largest: float = run["beta"].max()
reveal_type(run.q)
reveal_type(run.restart(until=1).summary)
try:
    scene.simulate()
except holonom.RunError as error:
    print(error.partial)
"""


@pytest.mark.parametrize("text", ["README.md", "src/guide/python.md"])
def test_examples_run(text, tmp_path, monkeypatch):
    """The blocks of Python are one program, in a folder with the shipped scenes."""
    shutil.copytree(REPOSITORY / "models", tmp_path / "models")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```", (REPOSITORY / text).read_text(), re.MULTILINE | re.DOTALL)
    assert blocks
    names = {"__name__": "example"}
    for block in blocks:
        if any(word in block and not find_spec(package) for package, word in OPTIONAL.items()):
            continue
        exec(compile(block, text, "exec"), names)


def test_types_are_checked(tmp_path):
    pytest.importorskip("mypy")
    user = tmp_path / "user.py"
    user.write_text(USER)
    for checked in (["-p", "holonom"], [str(user)]):
        found = subprocess.run(
            [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", *checked],
            cwd=tmp_path, capture_output=True, text=True, check=False,
        )
        assert found.returncode == 0, found.stdout
    assert "ndarray" in found.stdout and "holonom._answer.Answer" in found.stdout


def test_the_stub_says_what_the_compiled_part_says():
    stub = ast.parse((Path(holonom.__file__).parent / "_core.pyi").read_text())
    said = {node.name: ast.get_docstring(node) for node in stub.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
    assert {"__version__", *said} == {name for name in dir(holonom._core) if not name.startswith("__") or name == "__version__"}
    for name, text in said.items():
        assert " ".join(text.split()) == " ".join(getattr(holonom._core, name).__doc__.split())
