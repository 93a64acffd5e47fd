"""What all commands share: outputs refused before the work, and what is being done said on standard error."""

import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

from numba.core import event

from tween.errors import FileError, NotUsedWarning

PATIENCE = 3.0
"""Seconds after which it is said that kernels are being compiled."""

_WHY_LONG = "compiling kernels, which takes up to a minute, once; tween warmup does it beforehand"


def check_output(output: str | None, suffixes: Sequence[str], inputs: Sequence[str]) -> None:
    """Refuse before the work what could not be written after it.

    Parameters
    ----------
    output : str or None
        Path of the file; None where there is to be none.
    suffixes : sequence of str
        Those that can be written.
    inputs : sequence of str
        Files that must not be overwritten, among other words.

    Raises
    ------
    FileError

    Examples
    --------
    >>> check_output("out.docx", [".gif", ".png"], [])
    Traceback (most recent call last):
    ...
    tween.errors.FileError: cannot write out.docx: expected a name that ends in one of .gif, .png
    """
    if output is None:
        return
    path = Path(output)
    if path.suffix.lower() not in suffixes:
        raise FileError(f"cannot write {output}: expected a name that ends in one of {', '.join(suffixes)}")
    if not path.parent.is_dir():
        raise FileError(f"cannot write {output}: there is no folder {str(path.parent)!r}")
    if path.is_dir():
        raise FileError(f"cannot write {output}: it is a folder")
    for word in inputs:
        if path.exists() and Path(word).exists() and path.samefile(word):
            raise FileError(f"cannot write {output}: it is the input, which would be lost")


@contextmanager
def announcing() -> Iterator[None]:
    """Say on stderr what of a file is not used, and that kernels are being compiled where that takes long.

    Yields
    ------
    None
    """
    with warnings.catch_warnings(), event.install_listener("numba:compile", _Compiling()) as compiling:
        others = warnings.showwarning
        warnings.simplefilter("always", NotUsedWarning)
        warnings.showwarning = partial(_shown, others)
        try:
            yield
        finally:
            compiling.stop()


def _shown(others: Callable[..., None], message: Warning | str, category: type[Warning], *where: Any) -> None:
    if issubclass(category, NotUsedWarning):
        say(f"tween: note: {message}")
    else:
        others(message, category, *where)


@contextmanager
def stage(verbose: bool, doing: str) -> Iterator[None]:
    """Say on stderr what is being done.

    Parameters
    ----------
    verbose : bool
        Whether to say so without a terminal, too.
    doing : str

    Yields
    ------
    None
    """
    if verbose or sys.stderr.isatty():
        say(f"{doing} ...")
    yield


def say(line: str) -> None:
    """Print a line on stderr.

    Parameters
    ----------
    line : str
    """
    print("".join(c if c.isprintable() else "?" for c in line), file=sys.stderr, flush=True)


class _Compiling(event.Listener):
    """Says once that kernels are compiled, when that has gone on for a while."""

    def __init__(self) -> None:
        self._depth = 0
        self._timer: threading.Timer | None = None
        self._due = False

    def on_start(self, _: Any) -> None:
        self._depth += 1
        if self._timer is None:
            self._timer = threading.Timer(PATIENCE, self._after_a_while)
            self._timer.daemon = True
            self._timer.start()
        elif self._due:
            self._say()

    def on_end(self, _: Any) -> None:
        self._depth -= 1

    def stop(self) -> None:
        if self._timer is not None:
            self._timer.cancel()

    def _after_a_while(self) -> None:
        if self._depth:
            self._say()
        else:
            self._due = True  # when the next kernel is compiled

    def _say(self) -> None:
        self._due = False
        say(_WHY_LONG)
