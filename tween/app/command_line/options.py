"""The options of the command line, by what is typed after them, and those that several commands have."""

from collections.abc import Callable, Sequence
from typing import Any

import click

from tween.app.command_line import completion, words
from tween.choices import FITS, PACES, PATHS, PLACEMENTS, STRATEGIES, STYLES

Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]


def flag(*names: str, help: str) -> Decorator:
    """An option that is on where it is typed.

    Parameters
    ----------
    names : str
        Long and short.
    help : str

    Returns
    -------
    Decorator
    """
    return click.option(*names, is_flag=True, help=help)


def value(name: str, metavar: str, help: str, read: Callable[[str], Any] = str, **more: Any) -> Decorator:
    """An option with a word after it.

    Parameters
    ----------
    name, metavar, help : str
    read : function
        Of `.words`: makes a value of the word, or refuses it.
    more
        As for ``click.option``.

    Returns
    -------
    Decorator
    """
    return click.option(name, type=read, metavar=metavar, help=help, **more)


def number(name: str, metavar: str, help: str, low: int, high: int | None = None, **more: Any) -> Decorator:
    """An option with a whole number after it.

    Parameters
    ----------
    name, metavar, help : str
    low, high : int
        The least and the greatest.
    more
        As for ``click.option``.

    Returns
    -------
    Decorator
    """
    return click.option(name, type=click.IntRange(low, high), metavar=metavar, help=help, **more)


def choice(name: str, words: Sequence[str], default: str | None, help: str) -> Decorator:
    """An option with one of some words after it.

    Parameters
    ----------
    name : str
    words : sequence of str
    default : str or None
    help : str

    Returns
    -------
    Decorator
    """
    return click.option(name, type=click.Choice(words), default=default, help=help)


def output(help: str, required: bool = False) -> Decorator:
    """The file to write.

    Parameters
    ----------
    help : str
    required : bool

    Returns
    -------
    Decorator
    """
    return click.option("-o", "--output", metavar="OUT", type=click.Path(), required=required, help=help)


def together(*decorators: Decorator) -> Decorator:
    """Several options as one.

    Parameters
    ----------
    decorators : Decorator
        The help lists them in this order.

    Returns
    -------
    Decorator
    """

    def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
        for decorator in reversed(decorators):
            function = decorator(function)
        return function

    return decorate


# Options that several commands have

file = click.argument("file", shell_complete=completion.shapes)
select = value("--select", "ID", "Which curve of a file that has several.")
json = flag("--json", help="Print one JSON object.")
pen = value("--pen", "WIDTH", "Take the file for a line, drawn with a pen that wide.", read=words.length)
tolerance = value(
    "--tolerance",
    "LENGTH",
    "How far polygons may lie from the curves of an SVG; a thousandth of their size unless given.",
    read=words.length,
)
smooth = value(
    "--smooth", "LENGTH", "Clean what is read, moving nothing by more than that, see tween clean.", read=words.distance
)
verbose = flag("-v", "--verbose", help="Say what is being done, even without a terminal.")
reading = together(tolerance, pen, smooth, verbose)
film = together(
    number("--fps", "F", "Frames a second (25).", 1, 100, default=25),
    value("--size", "S", "Longer side in pixels (480), 640x480, or small.", default="480", read=words.size),
    choice("--style", STYLES, None, "What is drawn (triangles)."),
    value("--fill", "COLOR", "Of the disk."),
    value("--stroke", "COLOR", "Of its outline; or none."),
    value("--width", "PIXELS", "Of its outline.", read=words.length),
    value("--background", "COLOR", "Or transparent (white).", default="white"),
    value("--ease", "CURVE", "As in CSS: linear, ease-in-out, ..., or cubic-bezier(x1, y1, x2, y2)."),
    flag("--no-ease", help="Start and end at full speed."),
    flag("--once", help="From the first to the last, and not back."),
)
motion = together(
    choice(
        "--path",
        PATHS,
        "metric",
        "How vertices move: metric (unless given) keeps edges between their lengths at both ends; slide and linear "
        "are the paper's, along which shapes may grow several times as large on the way.",
    ),
    click.option(
        "--guarantee/--no-guarantee",
        default=True,
        help="Keep every shape on the way the boundary of an immersed disk (on unless switched off).",
    ),
    value(
        "--root",
        "WHERE",
        "Where the motion starts: disk-center (unless given), tree-center or the number of a triangle of the first.",
        default="disk-center",
        read=words.root,
    ),
    choice(
        "--strategy",
        STRATEGIES,
        "auto",
        "Which vertices correspond, and how: the best match (matched), pivots and a triangulation valid in both "
        "(common), pivots and flips (paper), or the first of these that needs no flips (auto, unless given).",
    ),
    click.option(
        "--landmark",
        "landmarks",
        type=words.landmark,
        metavar="I:J",
        multiple=True,
        help="Vertex I of the first has to become vertex J of the second (and K of the third, I:J:K); may be given "
        "several times.",
    ),
    flag(
        "--landmarks-from-files",
        help="What bears the same id in all files has to correspond: circles of an SVG, points of a GeoJSON.",
    ),
    choice(
        "--fit", FITS, "none", "Bring the others to the place of the first, and to its area or to the size of its box."
    ),
    choice(
        "--placement",
        PLACEMENTS,
        "steady",
        "Size, place and direction of the shapes: changing evenly (steady, unless given), or as the triangle has it "
        "from which the motion starts (root).",
    ),
    choice(
        "--pace",
        PACES,
        "auto",
        "The clock: the motion's own (time), or vertices always equally fast (speed); unless given, time where there "
        "are no flips, and speed where there are.",
    ),
)
