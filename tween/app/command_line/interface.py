"""The command line of `tween`: commands, options, the words that explain them.

Nothing here computes, and nothing that computes is imported, so that help comes at once.  The tests run every
example, and compare the choices with what the library has.
"""

from types import SimpleNamespace
from typing import Any

import click

from tween.app.command_line import completion, words
from tween.app.command_line.options import as_json, file, output, pen, reading, select, several, tolerance, verbose
from tween.choices import FITS, PACES, PATHS, PLACEMENTS, STRATEGIES, STYLES

_SHAPE = (
    "FILE is a .svg, .csv, .json, .geojson, .npz or .npy file, - for standard input, the data of an SVG path, or "
    "gallery:NAME, letter:X, pair:NAME/source, see tween gallery."
)
_STATUS = "Exit status: 0 done, or yes; 1 the answer is no; 2 bad input or usage."


def _examples(lines: str, *more: str) -> str:
    r"""Format the end of a help; \b keeps lines as they are."""
    listed = "\n".join(f"  {line}" for line in lines.strip().splitlines())
    return "\n\n".join([f"\b\nExamples:\n{listed}", *more])


def _run(name: str, options: dict[str, Any]) -> int:
    from tween.app.command_line import commands, stages  # here, as they import the kernels

    with stages.announcing():
        status: int = getattr(commands, name)(SimpleNamespace(**options))
        return status


# The commands


class _InOrder(click.Group):
    """Lists its commands as they stand here, as they are wanted, and not by the alphabet."""

    def list_commands(self, _: click.Context) -> list[str]:
        return list(self.commands)


@click.group(
    "tween",
    cls=_InOrder,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    epilog=_examples(
        """
tween gallery
tween info gallery:horseshoe
tween morph gallery:horseshoe disk -o horseshoe.gif""",
        "tween COMMAND --help says more.",
        _STATUS,
    ),
)
@click.version_option(package_name="tween-immersions", message="tween %(version)s")
def command_line() -> None:
    """Recognise, triangulate and morph curves that cross themselves and yet bound a disk."""


@command_line.command(
    "info",
    short_help="Say whether a curve bounds an immersed disk, and what would mend it.",
    help=f"Say whether a curve bounds an immersed disk, what else is known of it, and what would mend it.\n\n{_SHAPE}",
    epilog=_examples(
        """
tween info gallery:two_disks
tween info letter:S --json
tween gallery pretzel -o pretzel.csv
tween info pretzel.csv -o why.svg""",
        "Exit status: 0 it bounds an immersed disk, 1 it does not, 2 bad input or usage.",
    ),
)
@file
@select
@output("Picture of what is wrong with the curve and what would mend it: .svg, .png or .pdf.")
@as_json
@click.option("--count", is_flag=True, help="Count triangulations however many vertices there are.")
@reading
def _info(**options: Any) -> int:
    return _run("info", options)


@command_line.command(
    "clean",
    short_help="Make a usable curve of a noisy stroke.",
    help=f"Make a curve that can be used of a noisy stroke, and say what that changed.\n\n{_SHAPE}",
    epilog=_examples(
        """
tween gallery arrow -o arrow.csv
tween clean arrow.csv --smooth 0.02 -o clean.svg
tween info arrow.csv --smooth 0.02""",
        "Exit status: 0 the curve bounds an immersed disk, 1 it does not, 2 bad input or usage.",
    ),
)
@file
@select
@output("File to write: .svg, .csv, .json, .geojson, .npz or .npy.", required=True)
@click.option(
    "--smooth",
    type=words.distance,
    metavar="LENGTH",
    help="How far anything may be moved, in the units of the file; a twentieth of the size unless given.",
)
@click.option("--close", type=words.distance, metavar="LENGTH", help="How near the ends have to come to be joined.")
@click.option(
    "--vertices", type=click.IntRange(3, 100_000), metavar="N", help="How many vertices the curve shall have."
)
@as_json
@several(tolerance, pen, verbose)
def _clean(**options: Any) -> int:
    return _run("clean", options)


@command_line.command(
    "triangulate",
    short_help="Triangulate the immersed disk that a curve bounds.",
    help=f"Triangulate the immersed disk that a curve bounds.\n\n{_SHAPE}",
    epilog=_examples("""
tween triangulate gallery:horseshoe
tween triangulate gallery:horseshoe -o horseshoe.svg
tween triangulate letter:e --random 1 -o e.obj"""),
)
@file
@select
@output("File to write: .obj, .json, .npz or .svg.")
@click.option(
    "--random",
    type=click.IntRange(min=0),
    metavar="SEED",
    help="Draw one of all, uniformly, instead of constrained Delaunay.",
)
@click.option("--arbitrary", is_flag=True, help="Take the first that the table of Shor and Van Wyk has.")
@reading
def _triangulate(**options: Any) -> int:
    if options["arbitrary"] and options["random"] is not None:
        raise click.UsageError("--arbitrary is not allowed with --random")
    return _run("triangulate", options)


@command_line.command(
    "morph",
    short_help="Morph one curve into another, or into a disk.",
    help="Morph one curve into another, through several, or into a disk, and write the frames.\n\n"
    f"{_SHAPE}  With two curves, the word disk is the disk of the same area.  Of more than two curves the first may be "
    "named again at the end: that makes a loop.",
    epilog=_examples(
        """
tween morph gallery:horseshoe disk -o horseshoe.gif
tween morph letter:e letter:l -o e_to_l.html --frames 30 --certify
tween morph gallery:arrow gallery:ell -o arrow.gif --landmark 0:12
tween morph letter:a letter:b letter:c letter:a -o loop.gif --size small
tween morph gallery:arrow gallery:ell -o frames.npz --path slide --no-guarantee --strategy paper""",
        "The same in Python:",
        '\b\n  tween.morph(A, B, path="metric", guarantee=True, strategy="auto", placement="steady")',
        "Exit status: 0 written, 1 written but refuted by --certify, 2 bad input or usage.",
    ),
)
@click.argument("shapes", metavar="FILE FILE...", nargs=-1, required=True, shell_complete=completion.shapes)
@click.option("--select-source", metavar="ID", help="Which curve of the first file.")
@click.option("--select-target", metavar="ID", help="Which curve of the last file.")
@output(
    "File to write: an animation (.gif, .png, .webp, .svg, .mp4, .html), pictures (frame_%04d.png), or the numbers "
    "(.npz, .json, .csv).",
    required=True,
)
@reading
@click.option(
    "--path",
    type=click.Choice(PATHS),
    default="metric",
    help="How vertices move: metric (unless given) keeps edges between their lengths at both ends; slide and linear "
    "are the paper's, along which shapes may grow several times as large on the way.",
)
@click.option(
    "--guarantee/--no-guarantee",
    default=True,
    help="Keep every shape on the way the boundary of an immersed disk (on unless switched off).",
)
@click.option(
    "--root",
    type=words.root,
    default="disk-center",
    metavar="WHERE",
    help="Where the motion starts: disk-center (unless given), tree-center or the number of a triangle of the first.",
)
@click.option(
    "--strategy",
    type=click.Choice(STRATEGIES),
    default="auto",
    help="Which vertices correspond, and how: the best match (matched), pivots and a triangulation valid in both "
    "(common), pivots and flips (paper), or the first of these that needs no flips (auto, unless given).",
)
@click.option(
    "--landmark",
    "landmarks",
    type=words.landmark,
    multiple=True,
    metavar="I:J",
    help="Vertex I of the first has to become vertex J of the second (and K of the third, I:J:K); may be given several "
    "times.",
)
@click.option(
    "--landmarks-from-files",
    is_flag=True,
    help="What bears the same id in all files has to correspond: circles of an SVG, points of a GeoJSON.",
)
@click.option(
    "--fit",
    type=click.Choice(FITS),
    default="none",
    help="Bring the others to the place of the first, and to its area or to the size of its box.",
)
@click.option(
    "--placement",
    type=click.Choice(PLACEMENTS),
    default="steady",
    help="Size, place and direction of the shapes: changing evenly (steady, unless given), or as the triangle has it "
    "from which the motion starts (root).",
)
@click.option(
    "--pace",
    type=click.Choice(PACES),
    default="auto",
    help="The clock: the motion's own (time), or vertices always equally fast (speed); unless given, time where there "
    "are no flips, and speed where there are.",
)
@click.option("--certify", is_flag=True, help="Check the shapes exactly, independently of the morph.")
@click.option(
    "--frames",
    type=click.IntRange(min=2),
    metavar="K",
    help="How many there are, with those on the way back; 60 on the way there, or 30 a leg, unless given.",
)
@click.option("--fps", type=click.IntRange(1, 100), default=25, metavar="F", help="Frames a second (25).")
@click.option(
    "--size", type=words.size, default="480", metavar="S", help="Longer side in pixels (480), 640x480, or small."
)
@click.option("--style", type=click.Choice(STYLES), help="What is drawn (triangles).")
@click.option("--fill", metavar="COLOR", help="Of the disk.")
@click.option("--stroke", metavar="COLOR", help="Of its outline; or none.")
@click.option("--width", type=words.length, metavar="PIXELS", help="Of its outline.")
@click.option("--background", default="white", metavar="COLOR", help="Or transparent (white).")
@click.option("--ease", metavar="CURVE", help="As in CSS: linear, ease-in-out, ..., or cubic-bezier(x1, y1, x2, y2).")
@click.option("--no-ease", is_flag=True, help="Start and end at full speed.")
@click.option("--once", is_flag=True, help="From the first to the last, and not back.")
def _morph(**options: Any) -> int:
    if len(options["shapes"]) < 2:
        raise click.UsageError("one curve is given, expected two at least, or a curve and the word disk")
    if options["ease"] is not None and options["no_ease"]:
        raise click.UsageError("--no-ease is not allowed with --ease")
    return _run("morph", options)


@command_line.command(
    "play",
    short_help="Open a playground in the browser, to draw, match and morph in.",
    help="Open a playground in the browser: draw two curves, or choose or open them, and see one become the other.\n\n"
    f"{_SHAPE}  It is what the playground begins with.  Only this machine can reach the page, and only with the token "
    "in its address.  Ctrl-C ends it.  It needs the extra play: pip install '.[play]' in the project's folder.",
    epilog=_examples(
        """
tween play
tween play gallery:arrow
tween play drawing.svg --no-browser --port 8866""",
        "Exit status: 0 ended by Ctrl-C, 2 bad input or usage.",
    ),
)
@click.argument("file", required=False, shell_complete=completion.shapes)
@select
@click.option("--port", type=click.IntRange(1, 65535), metavar="P", help="Where to listen; any free port unless given.")
@click.option("--browser/--no-browser", default=True, help="Open a browser (unless switched off).")
@reading
def _play(**options: Any) -> int:
    return _run("play", options)


@command_line.command(
    "certify",
    short_help="Check exactly whether what a file plays bounds disks.",
    help="Check exactly whether what a file plays bounds immersed disks, at every instant.\n\n"
    "FRAMES are frames as morph writes them: .npz, .json, .csv, .svg or .html, not pictures.",
    epilog=_examples(
        """
tween morph gallery:horseshoe disk -o frames.npz
tween certify frames.npz
tween certify frames.npz --json
tween morph letter:e letter:l -o e_to_l.svg
tween certify e_to_l.svg""",
        "Exit status: 0 every frame, and every instant of straight motion between them, bounds an immersed disk; "
        "1 some do not; 2 bad input or usage.",
    ),
)
@click.argument("file", metavar="FRAMES", shell_complete=completion.files)
@click.option("--frames-only", is_flag=True, help="Say nothing about the time between frames.")
@as_json
def _certify(**options: Any) -> int:
    return _run("certify", options)


@command_line.command(
    "warmup",
    short_help="Compile all kernels, so that no first run has to.",
    help="Compile all kernels, so that no first run has to; takes a minute or two, once.",
    epilog=_examples("tween warmup"),
)
@click.option("--jobs", type=click.IntRange(1, 64), metavar="N", help="Processes at once; one for each core.")
def _warmup(**options: Any) -> int:
    return _run("warmup", options)


@command_line.command(
    "gallery",
    short_help="List the curves that come with tween, or write one.",
    help="List the curves that come with tween, or write one.\n\nNAME is gallery:NAME, letter:X or pair:NAME/source.",
    epilog=_examples("""
tween gallery
tween gallery --json
tween gallery horseshoe -o horseshoe.svg
tween gallery pair:e_to_l/target -o l.csv"""),
)
@click.argument("name", required=False, shell_complete=completion.names)
@output("File to write: .svg, .csv, .json, .geojson, .npz or .npy.")
@as_json
def _gallery(**options: Any) -> int:
    return _run("gallery", options)
