"""This file runs the notebooks as a reader would."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.mark.parametrize("file", sorted((Path(__file__).parent.parent / "notebooks").glob("*.ipynb")), ids=lambda file: file.stem)
def test_a_notebook_runs_to_its_end(file: Path) -> None:
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    notebook = nbformat.read(file, as_version=4)
    nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
    assert any(cell.get("outputs") for cell in notebook.cells)
