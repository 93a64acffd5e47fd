"""Searches over seeds that go on where they were interrupted: a file of JSON lines, appended seed by seed."""

import argparse
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

Row = dict[str, Any]


def asked(description: str) -> tuple[Path, range]:
    """Read from the command line where to write, and which seeds to look at."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("out", type=Path)
    parser.add_argument("--seeds", type=int, nargs=2, default=(0, 1000))
    arguments = parser.parse_args()
    return arguments.out, range(*arguments.seeds)


def collected(out: Path, seeds: range, rows_of: Callable[[int], list[Row]]) -> list[Row]:
    """The rows that a file holds, and those of the seeds that are not in it yet, which are appended.

    Parameters
    ----------
    out : Path
        Of JSON lines, each with its "seed".
    seeds : range
    rows_of : callable
        From a seed to its rows, at least one.

    Returns
    -------
    list of dict
    """
    rows: list[Row] = [json.loads(line) for line in out.read_text().splitlines()] if out.exists() else []
    done = {row["seed"] for row in rows}
    with out.open("a") as file:
        for seed in seeds:
            if seed not in done:
                found = rows_of(seed)
                file.write("".join(json.dumps(row) + "\n" for row in found))
                file.flush()
                rows += found
    return rows
