# SPDX-License-Identifier: Apache-2.0
"""check_ipynb.py FILE: exits non-zero with one line unless FILE is a valid, executed nbformat 4.5 notebook with figures."""
import json
import sys


def complaint(notebook):
    if (notebook.get("nbformat"), notebook.get("nbformat_minor")) != (4, 5):
        return "nbformat: expected 4.5"
    if notebook["metadata"]["language_info"]["name"] != "C++":
        return "metadata.language_info.name: expected C++"
    cells = notebook["cells"]
    if len({cell["id"] for cell in cells}) != len(cells):
        return "cells: expected ids of their own"
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    outputs = [output for cell in code for output in cell["outputs"]]
    if not any(output["output_type"] == "stream" for output in outputs):
        return "outputs: expected text"
    if not any("image/png" in output.get("data", {}) for output in outputs):
        return "outputs: expected a figure"
    try:
        import nbformat
    except ImportError:
        return None
    try:
        nbformat.validate(nbformat.from_dict(notebook))
    except nbformat.ValidationError as error:
        return str(error).splitlines()[0]
    return None


with open(sys.argv[1], encoding="utf-8") as file:
    problem = complaint(json.load(file))
if problem:
    sys.exit(f"{sys.argv[1]}: {problem}")
