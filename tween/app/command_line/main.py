"""The command `tween`: its exit statuses, and its words when something is wrong.

Its options are in `.interface`.  What the commands do is in `.commands`, which is imported when one of them
is to run, as it imports the kernels.
"""

import os
import sys
from collections.abc import Sequence
from contextlib import suppress

import click
from click.exceptions import Exit, NoSuchCommand

from tween.app.command_line import completion
from tween.app.command_line.interface import command_line
from tween.errors import TweenError

MISUSE, INTERRUPTED, NO_READER = 2, 130, 141
"""Exit statuses besides 0, for done or yes, and 1, where the answer is no."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command `tween`.

    Parameters
    ----------
    argv : sequence of str, optional
        Words after `tween`; without them, those that the program was called with.

    Returns
    -------
    int
        Exit status: 0 done, or yes; 1 the answer is no; 2 bad input or usage, said in one line on stderr; 130
        interrupted; 141 nobody reads the output.

    Examples
    --------
    >>> main(["triangulate", "gallery:horseshoe"])
    gallery:horseshoe: 90 vertices, 88 triangles (constrained Delaunay), smallest angle 9.4 degrees
    0
    """
    try:
        status = _run(sys.argv[1:] if argv is None else argv)
        sys.stdout.flush()
        return status
    except BrokenPipeError:
        _drop_output()
        return NO_READER
    except KeyboardInterrupt:
        return _complain("interrupted", INTERRUPTED)
    except OSError as error:
        if error.filename is None:  # it is the output that cannot be written
            _drop_output()
        return _complain(f"{error.filename or 'output'}: {error.strerror or error}", MISUSE)
    except MemoryError:
        return _complain("not enough memory", MISUSE)
    except click.ClickException as error:
        return _complain(_in_words(error), MISUSE)
    except (TweenError, ValueError) as error:  # a ValueError of the library says that an option is at fault
        return _complain(str(error), MISUSE)


def _run(words: Sequence[str]) -> int:
    """As `click.Command.main` does, which would put errors into words of its own."""
    answered = completion.complete(command_line)
    if answered is not None:
        return answered
    if not words:
        print(command_line.get_help(click.Context(command_line, info_name="tween")), file=sys.stderr)
        return MISUSE
    try:
        with command_line.make_context("tween", list(words)) as context:
            status: int = command_line.invoke(context)
            return status
    except Exit as end:  # after --help and --version
        return end.exit_code


def _in_words(error: click.ClickException) -> str:
    """What click says, and where to look."""
    said = error.format_message().rstrip(".")
    if isinstance(error, NoSuchCommand) and not error.possibilities:
        said += f"; expected one of {', '.join(command_line.commands)}"
    context = getattr(error, "ctx", None)
    return f"{said} (see {context.command_path if context else 'tween'} --help)"


def _drop_output() -> None:
    """Send what is left to nowhere: Python flushes once more when it ends, and would complain then."""
    with suppress(OSError), open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), sys.stdout.fileno())


def _complain(message: str, status: int) -> int:
    print("tween:", " ".join(message.split()), file=sys.stderr)
    return status
