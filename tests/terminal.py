"""What tests of the command share: how it is run, its commands, and a curve that bounds no disk."""

from collections.abc import Callable
from typing import Any

import click
import numpy as np

from tween.app.command_line.interface import command_line

EIGHT = [[0, 0], [2, 2], [2, 0], [0, 2]]
KEPT = b"what stood there before"
Run = Callable[..., tuple[int, str, str]]
COMMANDS: dict[str, click.Command] = {"": command_line, **command_line.commands}


def write_points(name: str, points: Any) -> None:
    np.savetxt(name, points, delimiter=",")


def parsed(command: str, line: str) -> dict[str, Any]:
    """What words become, or the `click.UsageError` that refuses them."""
    context = COMMANDS[command].make_context(f"tween {command}", line.split())
    return context.params
