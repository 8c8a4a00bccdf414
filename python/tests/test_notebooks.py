# SPDX-License-Identifier: Apache-2.0
"""The notebooks run from their first cell to their last."""

import json
import os
import subprocess
from pathlib import Path

import pytest

import mesamis

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))
RUN = """
import sys, nbformat
from nbclient import NotebookClient
notebook = nbformat.read(sys.argv[1], as_version=4)
NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
"""


def test_there_are_three():
    assert len(NOTEBOOKS) == 3


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_is_stored_without_outputs(notebook):
    for cell in json.loads(notebook.read_text(encoding="utf-8"))["cells"]:
        assert cell["cell_type"] == "markdown" or (cell["outputs"] == [] and cell["execution_count"] is None)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_runs(notebook, tmp_path):
    python = os.environ.get("MESAMIS_NOTEBOOK_PYTHON")
    if not python:
        pytest.skip("MESAMIS_NOTEBOOK_PYTHON names no interpreter with nbclient; scripts/python makes one")
    done = subprocess.run([python, "-c", RUN, notebook], cwd=tmp_path, capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONPATH": str(Path(mesamis.__path__[0]).parent)})
    assert done.returncode == 0, done.stderr[-3000:]
