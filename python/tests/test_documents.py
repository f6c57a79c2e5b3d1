# SPDX-License-Identifier: Apache-2.0
"""The examples of docs/python.md and of the notebook run in their order, and the stubs name what the package has."""

import ast
import json
import os
import re
from pathlib import Path

import pytest

import skyfit

SOURCE = Path(os.environ["SKYFIT_SOURCE_DIR"])


def test_examples_of_the_document_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = (SOURCE / "docs" / "python.md").read_text()
    examples = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert len(examples) == text.count("```python")
    names = {}
    for example in examples:
        exec(compile(example, "docs/python.md", "exec"), names)


def test_notebook_runs(tmp_path, monkeypatch):
    matplotlib = pytest.importorskip("matplotlib", reason="the notebook draws with matplotlib")
    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    notebook = json.loads((SOURCE / "docs" / "python.ipynb").read_text())
    names = {}
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert len(cells) >= 5
    for cell in cells:
        exec(compile("".join(cell["source"]), "docs/python.ipynb", "exec"), names)


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_stubs_name_what_the_package_has():
    stub = ast.parse(Path(skyfit.__file__).with_name("__init__.pyi").read_text())
    named = {node.name: node for node in stub.body if hasattr(node, "name")}
    assert public(named) == set(skyfit.__all__)
    for name, node in named.items():
        if not isinstance(node, ast.ClassDef):
            continue
        members = {one.name for one in node.body if isinstance(one, ast.FunctionDef)} | {
            one.target.id for one in node.body if isinstance(one, ast.AnnAssign)
        }
        inherited = {"get", "items", "keys", "values"} if name == "Arrays" else set()
        assert public(members) == public(dir(getattr(skyfit, name))) - inherited, name
