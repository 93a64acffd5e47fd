"""The command `tween`: its exit statuses, and its words when something is wrong.

Its options are in `.options`.  What the commands do is in `.commands`, which is imported when one of them
is to run, as it imports the kernels.
"""

import os
import sys
from collections.abc import Sequence
from contextlib import suppress

from tween.app.command_line.options import Misuse, build_parser
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
    except (Misuse, TweenError, ValueError) as error:  # a ValueError of the library says that an option is at fault
        return _complain(str(error), MISUSE)


def _run(words: Sequence[str]) -> int:
    parser = build_parser()
    if not words:
        parser.print_help(sys.stderr)
        return MISUSE
    try:
        options = parser.parse_args(words)
    except SystemExit:  # after --help and --version
        return 0
    from tween.app.command_line import commands  # here, as it imports the kernels

    status: int = getattr(commands, options.command)(options)
    return status


def _drop_output() -> None:
    """Send what is left to nowhere: Python flushes once more when it ends, and would complain then."""
    with suppress(OSError), open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), sys.stdout.fileno())


def _complain(message: str, status: int) -> int:
    print("tween:", " ".join(message.split()), file=sys.stderr)
    return status
