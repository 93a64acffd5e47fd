"""What tests of the command share: how it is run, its parsers, and a curve that bounds no disk."""

import argparse
from collections.abc import Callable
from typing import Any

import numpy as np

from tween.app.command_line.options import build_parser

EIGHT = [[0, 0], [2, 2], [2, 0], [0, 2]]
KEPT = b"what stood there before"
Run = Callable[..., tuple[int, str, str]]


def write_points(name: str, points: Any) -> None:
    np.savetxt(name, points, delimiter=",")


def parsers() -> dict[str, argparse.ArgumentParser]:
    """Every command's parser by its name, and that of all under the empty name."""
    whole = build_parser()
    subparsers = next(a for a in whole._actions if isinstance(a, argparse._SubParsersAction))
    return {"": whole, **subparsers.choices}
