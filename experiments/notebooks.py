"""Run every notebook from top to bottom and keep its outputs in the file."""

import sys

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError
from tqdm import tqdm

from experiments.store import ROOT, write_text

FOLDER = ROOT / "notebooks"


def execute(text: str) -> str:
    """The notebook with fresh outputs; no times are recorded, so that equal outputs are equal bytes."""
    notebook = nbformat.reads(text, as_version=4)
    client = NotebookClient(notebook, timeout=600, record_timing=False, resources={"metadata": {"path": FOLDER}})
    client.execute()
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
    notebook.metadata = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    return nbformat.writes(notebook) + "\n"


def main() -> int:
    for path in tqdm(sorted(FOLDER.glob("*.ipynb")), desc="notebooks", unit="notebook", disable=None):
        try:
            write_text(path, execute(path.read_text(encoding="utf-8")))
        except CellExecutionError as error:
            print(f"notebooks: {path.name} failed and is left as it was\n{error}", file=sys.stderr)
            return 1
        print(f"notebooks: {path.name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
