"""Runs notebooks: notebook.py FILE…. They must store no output, raise nothing, and show a figure and a page."""

import sys

import nbformat
from nbclient import NotebookClient

for path in sys.argv[1:]:
    notebook = nbformat.read(path, as_version=4)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    if any(cell.outputs or cell.execution_count for cell in cells):
        sys.exit(f"{path}: outputs are stored")
    NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    shown = [kind for cell in cells for output in cell.outputs for kind in output.get("data", {})]
    figures, pages = shown.count("image/svg+xml"), shown.count("text/html")
    print(f"{path}: {len(cells)} cells, {figures} figures, {pages} pages")
    if not (figures and pages):
        sys.exit(f"{path}: no figure is shown, or no page")
