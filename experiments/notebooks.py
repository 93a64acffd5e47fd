"""Run every notebook from top to bottom and keep its outputs in the file."""

import sys
from pathlib import Path
from typing import Any

import nbformat
from joblib import Parallel, delayed
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
        if cell.cell_type == "code":
            cell.outputs = joined(cell.outputs)
    notebook.metadata = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    return nbformat.writes(notebook) + "\n"


def joined(outputs: list[Any]) -> list[Any]:
    """Join what was printed in parts: how a kernel cuts its stream depends on the time between two prints."""
    result: list[Any] = []
    for output in outputs:
        if result and output.output_type == "stream" == result[-1].output_type and output.name == result[-1].name:
            result[-1].text += output.text
        else:
            result.append(output)
    return result


def run(path: Path) -> str:
    """Run a notebook in place; returns what went wrong, if anything did, and then the file is as it was."""
    try:
        write_text(path, execute(path.read_text(encoding="utf-8")))
    except CellExecutionError as error:
        return f"notebooks: {path.name} failed and is left as it was\n{error}"
    return ""


def main() -> int:
    paths = sorted(FOLDER.glob("*.ipynb"))
    failures = 0
    runs = Parallel(n_jobs=-1, return_as="generator")(delayed(run)(path) for path in paths)
    for path, failure in tqdm(zip(paths, runs, strict=True), desc="notebooks", total=len(paths), disable=None):
        print(failure or f"notebooks: {path.name}", file=sys.stderr if failure else sys.stdout, flush=True)
        failures += bool(failure)
    return min(failures, 1)


if __name__ == "__main__":
    sys.exit(main())
