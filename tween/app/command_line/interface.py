"""The command line of `tween`: its commands, and the words that explain them.

Nothing here computes, and nothing that computes is imported, so that help comes at once.  The tests run every
example, and compare the choices with what the library has.
"""

from types import SimpleNamespace
from typing import Any

import click

from tween.app.command_line import completion, options, words

_SHAPE = (
    "FILE is a .svg, .csv, .json, .geojson, .npz or .npy file, - for standard input, the data of an SVG path, or "
    "gallery:NAME, letter:X, pair:NAME/source, see tween gallery."
)
_CURVE_FILES = ".svg, .csv, .json, .geojson, .npz or .npy"
_STATUS = "Exit status: 0 done, or yes; 1 the answer is no; 2 bad input or usage."


def _examples(lines: str, *more: str) -> str:
    r"""Format the end of a help; \b keeps lines as they are."""
    listed = "\n".join(f"  {line}" for line in lines.strip().splitlines())
    return "\n\n".join([f"\b\nExamples:\n{listed}", *more])


def _run(name: str, chosen: dict[str, Any]) -> int:
    from tween.app.command_line import commands, stages  # here, as they import the kernels

    with stages.announcing():
        status: int = getattr(commands, name)(SimpleNamespace(**chosen))
        return status


# The commands


class _AsWanted(click.Group):
    """Commands stand in the order in which a newcomer wants them, which is that of this file."""

    def list_commands(self, context: click.Context) -> list[str]:
        return list(self.commands)


@click.group(
    "tween",
    cls=_AsWanted,
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


def _command(name: str, help: str, more: str, examples: str, *end: str, short: str = "") -> options.Decorator:
    """A command; the first sentence of its help stands in the list of commands, too, unless a shorter one is given."""
    return command_line.command(
        name, short_help=short or help, help=f"{help}\n\n{more}".strip(), epilog=_examples(examples, *end)
    )


@_command(
    "info",
    "Say whether a curve bounds an immersed disk, what else is known of it, and what would mend it.",
    _SHAPE,
    """
tween info gallery:two_disks
tween info letter:S --json
tween gallery pretzel -o pretzel.csv
tween info pretzel.csv -o why.svg""",
    "Exit status: 0 it bounds an immersed disk, 1 it does not, 2 bad input or usage.",
    short="Say whether a curve bounds an immersed disk, and what would mend it.",
)
@options.file
@options.select
@options.output("Picture of what is wrong with the curve and what would mend it: .svg, .png or .pdf.")
@options.json
@options.flag("--count", help="Count triangulations however many vertices there are.")
@options.reading
def _info(**chosen: Any) -> int:
    return _run("info", chosen)


@_command(
    "clean",
    "Make a curve that can be used of a noisy stroke, and say what that changed.",
    _SHAPE,
    """
tween gallery arrow -o arrow.csv
tween clean arrow.csv --smooth 0.02 -o clean.svg
tween info arrow.csv --smooth 0.02""",
    "Exit status: 0 the curve bounds an immersed disk, 1 it does not, 2 bad input or usage.",
    short="Make a usable curve of a noisy stroke.",
)
@options.file
@options.select
@options.output(f"File to write: {_CURVE_FILES}.", required=True)
@options.value(
    "--smooth",
    "LENGTH",
    "How far anything may be moved, in the units of the file; a twentieth of the size unless given.",
    read=words.distance,
)
@options.value("--close", "LENGTH", "How near the ends have to come to be joined.", read=words.distance)
@options.number("--vertices", "N", "How many vertices the curve shall have.", 3, 100_000)
@options.json
@options.together(options.tolerance, options.pen, options.verbose)
def _clean(**chosen: Any) -> int:
    return _run("clean", chosen)


@_command(
    "triangulate",
    "Triangulate the immersed disk that a curve bounds.",
    _SHAPE,
    """
tween triangulate gallery:horseshoe
tween triangulate gallery:horseshoe -o horseshoe.svg
tween triangulate letter:e --random 1 -o e.obj""",
)
@options.file
@options.select
@options.output("File to write: .obj, .json, .npz or .svg.")
@options.number("--random", "SEED", "Draw one of all, uniformly, instead of constrained Delaunay.", 0)
@options.flag("--arbitrary", help="Take the first that the table of Shor and Van Wyk has.")
@options.reading
def _triangulate(**chosen: Any) -> int:
    if chosen["arbitrary"] and chosen["random"] is not None:
        raise click.UsageError("--arbitrary is not allowed with --random")
    return _run("triangulate", chosen)


@_command(
    "morph",
    "Morph one curve into another, through several, or into a disk, and write the frames.",
    f"{_SHAPE}  With two curves, the word disk is the disk of the same area.  Of more than two curves the first may be "
    "named again at the end: that makes a loop.",
    """
tween morph gallery:horseshoe disk -o horseshoe.gif
tween morph letter:e letter:l -o e_to_l.html --frames 30 --certify
tween morph gallery:arrow gallery:ell -o arrow.gif --landmark 0:12
tween morph letter:a letter:b letter:c letter:a -o loop.gif --size small
tween morph gallery:arrow gallery:ell -o frames.npz --path slide --no-guarantee --strategy paper""",
    "The same in Python:",
    '\b\n  tween.morph(A, B, path="metric", guarantee=True, strategy="auto", placement="steady")',
    "Exit status: 0 written, 1 written but refuted by --certify, 2 bad input or usage.",
    short="Morph one curve into another, or into a disk.",
)
@click.argument("shapes", metavar="FILE FILE...", nargs=-1, required=True, shell_complete=completion.shapes)
@options.value("--select-source", "ID", "Which curve of the first file.")
@options.value("--select-target", "ID", "Which curve of the last file.")
@options.output(
    "File to write: an animation (.gif, .png, .webp, .svg, .mp4, .html), pictures (frame_%04d.png), or the numbers "
    "(.npz, .json, .csv).",
    required=True,
)
@options.reading
@options.motion
@options.flag("--certify", help="Check the shapes exactly, independently of the morph.")
@options.number(
    "--frames",
    "K",
    "How many there are, with those on the way back; 60 on the way there, or 30 a leg, unless given.",
    2,
)
@options.film
def _morph(**chosen: Any) -> int:
    if len(chosen["shapes"]) < 2:
        raise click.UsageError("one curve is given, expected two at least, or a curve and the word disk")
    if chosen["ease"] is not None and chosen["no_ease"]:
        raise click.UsageError("--no-ease is not allowed with --ease")
    return _run("morph", chosen)


@_command(
    "play",
    "Open a playground in the browser: draw two curves, or choose or open them, and see one become the other.",
    f"{_SHAPE}  It is what the playground begins with.  Only this machine can reach the page, and only with the token "
    "in its address.  Ctrl-C ends it.  It needs the extra play: pip install '.[play]' in the project's folder.",
    """
tween play
tween play gallery:arrow
tween play drawing.svg --no-browser --port 8866""",
    "Exit status: 0 ended by Ctrl-C, 2 bad input or usage.",
    short="Open a playground in the browser, to draw, match and morph in.",
)
@click.argument("file", required=False, shell_complete=completion.shapes)
@options.select
@options.number("--port", "P", "Where to listen; any free port unless given.", 1, 65535)
@click.option("--browser/--no-browser", default=True, help="Open a browser (unless switched off).")
@options.reading
def _play(**chosen: Any) -> int:
    return _run("play", chosen)


@_command(
    "certify",
    "Check exactly whether what a file plays bounds immersed disks, at every instant.",
    "FRAMES are frames as morph writes them: .npz, .json, .csv, .svg or .html, not pictures.",
    """
tween morph gallery:horseshoe disk -o frames.npz
tween certify frames.npz
tween certify frames.npz --json
tween morph letter:e letter:l -o e_to_l.svg
tween certify e_to_l.svg""",
    "Exit status: 0 every frame, and every instant of straight motion between them, bounds an immersed disk; "
    "1 some do not; 2 bad input or usage.",
    short="Check exactly whether what a file plays bounds disks.",
)
@click.argument("file", metavar="FRAMES", type=click.Path())
@options.flag("--frames-only", help="Say nothing about the time between frames.")
@options.json
def _certify(**chosen: Any) -> int:
    return _run("certify", chosen)


@_command(
    "warmup",
    "Compile all kernels, so that no first run has to; takes a minute or two, once.",
    "",
    "tween warmup",
    short="Compile all kernels, so that no first run has to.",
)
@options.number("--jobs", "N", "Processes at once; one for each core.", 1, 64)
def _warmup(**chosen: Any) -> int:
    return _run("warmup", chosen)


@_command(
    "gallery",
    "List the curves that come with tween, or write one.",
    "NAME is gallery:NAME, letter:X or pair:NAME/source.",
    """
tween gallery
tween gallery --json
tween gallery horseshoe -o horseshoe.svg
tween gallery pair:e_to_l/target -o l.csv""",
)
@click.argument("name", required=False, shell_complete=completion.names)
@options.output(f"File to write: {_CURVE_FILES}.")
@options.json
def _gallery(**chosen: Any) -> int:
    return _run("gallery", chosen)
