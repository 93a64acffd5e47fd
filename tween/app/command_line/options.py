"""Options that several commands have."""

from collections.abc import Callable
from typing import Any

import click

from tween.app.command_line import completion, words

Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]

file = click.argument("file", shell_complete=completion.shapes)
select = click.option("--select", metavar="ID", help="Which curve of a file that has several.")
as_json = click.option("--json", is_flag=True, help="Print one JSON object.")
pen = click.option(
    "--pen",
    type=words.length,
    metavar="WIDTH",
    help="Take the file for a line, drawn with a pen that wide.",
)
tolerance = click.option(
    "--tolerance",
    type=words.length,
    metavar="LENGTH",
    help="How far polygons may lie from the curves of an SVG; a thousandth of their size unless given.",
)
smooth = click.option(
    "--smooth",
    type=words.distance,
    metavar="LENGTH",
    help="Clean what is read from files, moving nothing by more than that, see tween clean.",
)
verbose = click.option("-v", "--verbose", is_flag=True, help="Say what is being done, even without a terminal.")


def output(words: str, required: bool = False) -> Decorator:
    """Make the option that names the file to write.

    Parameters
    ----------
    words : str
        What is written, for the help.
    required : bool

    Returns
    -------
    callable
    """
    return click.option("-o", "--output", metavar="OUT", required=required, help=words, shell_complete=completion.files)


def several(*decorators: Decorator) -> Decorator:
    """Make several options one.

    Parameters
    ----------
    decorators : callable
        Of click, in the order in which the help lists them.

    Returns
    -------
    callable
    """

    def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
        for decorator in reversed(decorators):
            function = decorator(function)
        return function

    return decorate


reading = several(tolerance, pen, smooth, verbose)
