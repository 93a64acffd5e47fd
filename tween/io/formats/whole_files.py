"""Whole files: read at once within a limit, and written at once or not at all.

Every error is one line that begins with the name of the file.
"""

import os
import secrets
import stat
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from tween.errors import CurveError, FileError

LARGEST_FILE = 2**27
"""Bytes that a file, or what it unpacks to, may have."""

AnyPath = str | os.PathLike[str]


@contextmanager
def naming(path: AnyPath) -> Iterator[None]:
    """Put the name of the file in front of every error, and make it one line.

    Parameters
    ----------
    path : path-like

    Yields
    ------
    None

    Raises
    ------
    CurveError
        In the place of a `CurveError`.
    FileError
        In the place of every other `ValueError`, an `OSError` and a `MemoryError`.

    Examples
    --------
    >>> with naming("drawing.svg"):
    ...     raise FileError("is no XML")
    Traceback (most recent call last):
    ...
    tween.errors.FileError: drawing.svg: is no XML
    """
    try:
        yield
    except CurveError as error:
        raise CurveError(_line(path, str(error))) from None
    except OSError as error:
        raise FileError(_line(path, error.strerror or str(error))) from None
    except MemoryError:
        raise FileError(_line(path, "needs more memory than there is")) from None
    except ValueError as error:  # a FileError, or what the system says of a name that no file can have
        raise FileError(_line(path, str(error))) from None


def _line(path: AnyPath, what: str) -> str:
    text = f"{os.fspath(path)}: {what}"
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def suffix_of(path: AnyPath, known: Mapping[str, object]) -> str:
    """Return the suffix of a file.

    Parameters
    ----------
    path : path-like
    known : mapping from str
        The suffixes to expect, in small letters.

    Returns
    -------
    str
        In small letters.

    Raises
    ------
    FileError
        Where it is none of them.

    Examples
    --------
    >>> suffix_of("A.SVG", {".svg": 0})
    '.svg'
    """
    suffix = Path(path).suffix.lower()
    if suffix not in known:
        raise FileError(f"has the suffix {suffix!r}, expected one of {', '.join(sorted(known))}")
    return suffix


def content_of(path: AnyPath) -> bytes:
    """Return the bytes of a file.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    bytes

    Raises
    ------
    FileError
        Where it is empty, larger than `LARGEST_FILE`, or no regular file: a pipe might never end.
    OSError
        Where it cannot be read.
    """
    status = os.stat(path)
    if not stat.S_ISREG(status.st_mode):
        raise FileError("is no regular file, expected one")
    check_size(status.st_size)
    return Path(path).read_bytes()


def check_size(size: int) -> None:
    """Refuse what is empty or too large to be read.

    Parameters
    ----------
    size : int
        Bytes.

    Raises
    ------
    FileError
    """
    if size == 0:
        raise FileError("is empty, expected the points of a curve or of frames")
    if size > LARGEST_FILE:
        raise FileError(f"has {size} bytes, expected at most {LARGEST_FILE}")


def write(path: AnyPath, formats: Mapping[str, Callable[[], str | bytes]]) -> Path:
    """Write a file in the format of its suffix: beside its place first, and then renamed.

    Parameters
    ----------
    path : path-like
    formats : mapping from str to function
        The content by suffix; text becomes UTF-8.

    Returns
    -------
    Path
        That of the file; of a symbolic link, what it leads to is replaced.

    Raises
    ------
    FileError
        Where the suffix is unknown or the file cannot be written; what stood there before stands there still.
    """
    with naming(path):
        content = formats[suffix_of(path, formats)]()
        place = Path(os.path.realpath(path))
        beside = place.with_name(f".{os.getpid()}-{secrets.token_hex(4)}")
        try:
            with open(beside, "xb") as file:
                file.write(content.encode() if isinstance(content, str) else content)
            os.replace(beside, place)
        finally:
            with suppress(OSError):
                beside.unlink()
    return Path(path)
