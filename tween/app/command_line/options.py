"""The command line of `tween`: commands, options, the words that explain them.

Nothing here computes, and nothing that computes is imported, so that help comes at once.  The tests run every
example, and compare the choices with what the library has.
"""

import argparse
import re
from collections.abc import Callable
from contextlib import suppress
from importlib import metadata
from math import inf
from typing import Any, NoReturn

from tween.choices import PACES, PATHS, PLACEMENTS, ROOT_RULES, SIZES, STRATEGIES, STYLES

_SHAPE = (
    "a .svg, .csv, .json, .geojson, .npz or .npy file; or gallery:NAME, letter:X, pair:NAME/source, see tween gallery"
)

_EXAMPLES = """examples:
  tween gallery
  tween info gallery:horseshoe
  tween morph gallery:horseshoe disk -o horseshoe.gif

tween COMMAND --help says more.
Exit status: 0 done, or yes; 1 the answer is no; 2 bad input or usage."""

_INFO = """examples:
  tween info gallery:two_disks
  tween info letter:S --json
  tween gallery pretzel -o pretzel.csv
  tween info pretzel.csv

Exit status: 0 it bounds an immersed disk, 1 it does not, 2 bad input or usage."""

_TRIANGULATE = """examples:
  tween triangulate gallery:horseshoe
  tween triangulate gallery:horseshoe -o horseshoe.svg
  tween triangulate letter:e --random 1 -o e.obj"""

_MORPH = """examples:
  tween morph gallery:horseshoe disk -o horseshoe.gif
  tween morph letter:e letter:l -o e_to_l.html --frames 30 --certify
  tween morph gallery:arrow gallery:ell -o arrow.gif --landmark 0:12
  tween morph gallery:arrow gallery:ell -o frames.npz --path slide --no-guarantee --strategy paper

The same in Python: tween.morph(A, B, path="metric", guarantee=True, strategy="auto", placement="steady").
Exit status: 0 written, 1 written but refuted by --certify, 2 bad input or usage."""

_CERTIFY = """examples:
  tween morph gallery:horseshoe disk -o frames.npz
  tween certify frames.npz
  tween certify frames.npz --json
  tween morph letter:e letter:l -o e_to_l.svg
  tween certify e_to_l.svg

Exit status: 0 every frame, and every instant of straight motion between them, bounds an immersed
disk; 1 some do not; 2 bad input or usage."""

_GALLERY = """examples:
  tween gallery
  tween gallery --json
  tween gallery horseshoe -o horseshoe.svg
  tween gallery pair:e_to_l/target -o l.csv"""


class Misuse(Exception):
    """The command line asks for what there is not."""


class _Help(argparse.RawDescriptionHelpFormatter):
    """Help whose words stand in one column beside the options."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, max_help_position=26)


class _Parser(argparse.ArgumentParser):
    """A parser that leaves it to `main` to complain."""

    def __init__(self, **options: Any) -> None:
        options.setdefault("formatter_class", _Help)
        super().__init__(**options, allow_abbrev=False)

    def error(self, message: str) -> NoReturn:
        raise Misuse(f"{message} (see {self.prog} --help)")


class _Version(argparse.Action):
    """Print the version of the package that is installed."""

    def __call__(self, *_: Any) -> None:
        print("tween", metadata.version("tween-immersions"))
        raise SystemExit(0)


def build_parser() -> argparse.ArgumentParser:
    """Make the parser of the command line.

    Returns
    -------
    ArgumentParser
        Its subparsers are named as the functions of `.commands` that they lead to.
    """
    parser = _Parser(
        prog="tween",
        description="Recognise, triangulate and morph curves that cross themselves and yet bound a disk.",
        epilog=_EXAMPLES,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(title="commands", dest="command", metavar="COMMAND", required=True)
    _add_info(commands)
    _add_triangulate(commands)
    _add_morph(commands)
    _add_certify(commands)
    _add_gallery(commands)
    return parser


def _add_info(commands: Any) -> None:
    parser = _add(commands, "info", "say whether a curve bounds an immersed disk, and what else is known of it", _INFO)
    _add_shape(parser)
    _add_json(parser)
    parser.add_argument("--count", action="store_true", help="count triangulations however many vertices there are")


def _add_triangulate(commands: Any) -> None:
    about = "triangulate the immersed disk that a curve bounds"
    parser = _add(commands, "triangulate", about, _TRIANGULATE)
    _add_shape(parser)
    parser.add_argument("-o", "--output", metavar="OUT", help="file to write: .obj, .json, .npz or .svg")
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument(
        "--random", type=_whole(0), metavar="SEED", help="draw one of all, uniformly, instead of constrained Delaunay"
    )
    kind.add_argument("--arbitrary", action="store_true", help="take the first that the table of Shor and Van Wyk has")


def _add_morph(commands: Any) -> None:
    parser = _add(commands, "morph", "morph one curve into another, or into a disk, and write the frames", _MORPH)
    parser.add_argument("source", metavar="A", help=_SHAPE)
    parser.add_argument("target", metavar="B", help="another one; or disk, for the disk of the same area")
    parser.add_argument("--select-source", metavar="ID", help="which curve of file A")
    parser.add_argument("--select-target", metavar="ID", help="which curve of file B")
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        required=True,
        help="file to write: an animation (.gif, .png, .webp, .svg, .mp4, .html) or the numbers (.npz, .json, .csv)",
    )
    _add_reading(parser)
    _add_way(parser.add_argument_group("the way"))
    _add_film(parser.add_argument_group("the film"))


def _add_way(group: Any) -> None:
    group.add_argument(
        "--path",
        choices=PATHS,
        default="metric",
        help="how vertices move: metric (unless given) keeps edges between their lengths at both ends; "
        "slide and linear are the paper's, along which shapes may grow several times as large on the way",
    )
    group.add_argument(
        "--guarantee",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="keep every shape on the way the boundary of an immersed disk (on unless switched off)",
    )
    group.add_argument(
        "--root",
        type=_number_or(*ROOT_RULES),
        default="disk-center",
        metavar="WHERE",
        help="where the motion starts: disk-center (unless given), tree-center or the number of a triangle of A",
    )
    group.add_argument(
        "--strategy",
        choices=STRATEGIES,
        default="auto",
        help="which vertices correspond, and how: the best match (matched), pivots and a triangulation valid in both "
        "(common), pivots and flips (paper), or the first of these that needs no flips (auto, unless given)",
    )
    group.add_argument(
        "--landmark",
        dest="landmarks",
        type=_landmark,
        action="append",
        metavar="I:J",
        help="vertex I of A has to become vertex J of B; may be given several times",
    )
    group.add_argument(
        "--placement",
        choices=PLACEMENTS,
        default="steady",
        help="size, place and direction of the shapes: changing evenly (steady, unless given), or as the triangle "
        "has it from which the motion starts (root)",
    )
    group.add_argument(
        "--pace",
        choices=PACES,
        default="auto",
        help="the clock: the motion's own (time), or vertices always equally fast (speed); unless given, time where "
        "there are no flips, and speed where there are",
    )
    group.add_argument("--certify", action="store_true", help="check the shapes exactly, independently of the morph")


def _add_film(group: Any) -> None:
    group.add_argument("--frames", type=_whole(2), default=60, metavar="K", help="from A to B (60)")
    group.add_argument("--fps", type=_whole(1, 100), default=25, metavar="F", help="frames a second (25)")
    group.add_argument("--size", type=_size, default=480, metavar="S", help="longer side in pixels (480), or 640x480")
    group.add_argument("--style", choices=STYLES, default="triangles", help="what is drawn (triangles)")
    group.add_argument("--no-ease", dest="ease", action="store_false", help="start and end at full speed")
    group.add_argument("--once", action="store_true", help="from A to B, and not back")


def _add_certify(commands: Any) -> None:
    about = "check exactly whether what a file plays bounds immersed disks, at every instant"
    parser = _add(commands, "certify", about, _CERTIFY)
    parser.add_argument(
        "file", metavar="FRAMES", help="frames as morph writes them: .npz, .json, .csv, .svg or .html, not pictures"
    )
    parser.add_argument("--frames-only", action="store_true", help="say nothing about the time between frames")
    _add_json(parser)


def _add_gallery(commands: Any) -> None:
    parser = _add(commands, "gallery", "list the curves that come with tween, or write one", _GALLERY)
    parser.add_argument("name", nargs="?", metavar="NAME", help="gallery:NAME, letter:X or pair:NAME/source")
    parser.add_argument(
        "-o", "--output", metavar="OUT", help="file to write: .svg, .csv, .json, .geojson, .npz or .npy"
    )
    _add_json(parser)


def _add(commands: Any, name: str, about: str, examples: str) -> argparse.ArgumentParser:
    description = about[0].upper() + about[1:] + "."
    parser: argparse.ArgumentParser = commands.add_parser(name, help=about, description=description, epilog=examples)
    return parser


def _add_shape(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=_SHAPE)
    parser.add_argument("--select", metavar="ID", help="which curve of a file that has several")
    _add_reading(parser)


def _add_json(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def _add_reading(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--tolerance",
        type=_length,
        metavar="LENGTH",
        help="how far polygons may lie from the curves of an SVG (a thousandth of their size)",
    )
    parser.add_argument(
        "--pen", type=_length, metavar="WIDTH", help="take a file for a line, drawn with a pen that wide"
    )
    parser.add_argument("-v", "--verbose", action="store_true", help="say what is being done, even without a terminal")


def _whole(least: int, most: int | None = None) -> Callable[[str], int]:
    """Make the reader of a whole number."""
    expected = f"a whole number from {least} " + ("on" if most is None else f"to {most}")

    def read(text: str) -> int:
        if not text.isdecimal() or int(text) < least or (most is not None and int(text) > most):
            raise argparse.ArgumentTypeError(f"expected {expected}, found {text!r}")
        return int(text)

    return read


def _number_or(*words: str) -> Callable[[str], str | int]:
    """Make the reader of some words or a number."""

    def read(text: str) -> str | int:
        if text in words:
            return text
        try:
            return int(text)
        except ValueError:
            expected = f"{', '.join(words)} or a whole number"
            raise argparse.ArgumentTypeError(f"expected {expected}, found {text!r}") from None

    return read


def _landmark(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"([0-9]+):([0-9]+)", text)
    if not found:
        raise argparse.ArgumentTypeError(f"expected the numbers of two vertices, such as 12:40, found {text!r}")
    return int(found[1]), int(found[2])


def _length(text: str) -> float:
    with suppress(ValueError):
        if 0 < float(text) < inf:
            return float(text)
    raise argparse.ArgumentTypeError(f"expected a positive number, found {text!r}")


def _size(text: str) -> int | tuple[int, int]:
    found = re.fullmatch(r"([0-9]{2,4})(?:x([0-9]{2,4}))?", text)
    sides = [int(side) for side in found.groups() if side] if found else []
    if not sides or not all(SIZES[0] <= side <= SIZES[1] for side in sides):
        expected = f"pixels from {SIZES[0]} to {SIZES[1]}, such as 480 or 640x480"
        raise argparse.ArgumentTypeError(f"expected {expected}, found {text!r}")
    return sides[0] if len(sides) == 1 else (sides[0], sides[1])
