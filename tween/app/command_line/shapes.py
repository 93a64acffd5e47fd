"""Shapes by the words that people type: files, and the curves that come with tween.

drawing.svg         a file                      gallery:horseshoe   a named curve
-                   standard input              letter:S            handwriting
M0 0H9V9Z           the data of an SVG path     pair:e_to_l/source  an end of a named pair
"""

from difflib import get_close_matches
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween import gallery
from tween.app.command_line import curve_names
from tween.app.command_line.stages import say
from tween.errors import FileError, NotSelfOverlappingError
from tween.geometry.curve import Curve
from tween.io.formats.content import Outline
from tween.io.formats.whole_files import naming
from tween.io.outlines import curve_of, label, pen_hint, read_outline
from tween.io.pens import drawn
from tween.triangulating.decomposition import decompose
from tween.triangulating.repair.cleaning import clean


class Reading(NamedTuple):
    """How files are to be read.

    Attributes
    ----------
    tolerance : float or None
        How far the polygon may lie from the curves of an SVG file, in its units, see `tween.read_curve`.
    pen : float or None
        How wide to draw the line that the file holds, see `tween.io.read_stroke`; without it, the line is the curve
        itself.
    smooth : float or None
        By how much anything may be moved, see `tween.clean`; without it, nothing is cleaned.
    marked : bool
        Whether circles that have an id only mark places, see `tween.io.read_marks`.
    lines : bool
        Whether the pen draws lines only: what is closed and filled stays the outline that it is.
    """

    tolerance: float | None = None
    pen: float | None = None
    smooth: float | None = None
    marked: bool = False
    lines: bool = False


_PLAIN = Reading()


class Shape(NamedTuple):
    """A curve, and where it comes from.

    Attributes
    ----------
    word : str
        As it was typed.
    curve : Curve
    hint : str
        What might have been meant instead; empty where nothing seems amiss.
    """

    word: str
    curve: Curve
    hint: str = ""

    def fault(self, place: str = "") -> NotSelfOverlappingError:
        """Return the error that says why the curve bounds no disk, and what would mend it.

        Parameters
        ----------
        place : str
            Which of several shapes it is.

        Returns
        -------
        NotSelfOverlappingError
        """
        summary = decompose(self.curve).explain().summary
        hint = f" {self.hint[0].upper()}{self.hint[1:]}." if self.hint else ""
        name = f"{label(self.word)} ({place})" if place else label(self.word)
        return NotSelfOverlappingError(f"{name}: {summary[0].lower()}{summary[1:]}{hint}")


def read_shape(word: str, select: str | None = None, how: Reading = _PLAIN) -> Shape:
    """Read a curve from a file, or take one that comes with tween.

    Parameters
    ----------
    word : str
        A path, "-", path data, ``gallery:NAME``, ``letter:X`` or ``pair:NAME/source``.
    select : str, optional
        Which curve of a file that has several.
    how : Reading

    Returns
    -------
    Shape

    Raises
    ------
    FileError
        Where there is no such file, or no curve in it.
    CurveError
        Where there is no curve of that name, or the points are none that tween can treat.

    Examples
    --------
    >>> read_shape("letter:e").curve
    Curve(62 vertices, turning number 1)
    """
    found = _found(word, select, how)
    if how.lines and how.pen is not None and _is_filled(found):
        say(f"tween: note: {label(word)}: not drawn with the pen, as it is filled")
        how = how._replace(pen=None)
    with naming(label(word)):
        if how.smooth is not None:
            curve = _cleaned(word, _points(found, how), how.smooth)
        else:
            curve = found if isinstance(found, Curve) else _curve(found, how.pen)
    return Shape(word, curve, _hint(found) if how.pen is None else "")


def read_points(word: str, select: str | None = None, how: Reading = _PLAIN) -> NDArray[np.float64]:
    """Read the points of a stroke, which need not be those of a curve.

    Parameters
    ----------
    word, select, how
        As in `read_shape`.

    Returns
    -------
    ndarray of float64, shape (k, 2)

    Raises
    ------
    FileError, CurveError
        As `read_shape`.
    """
    found = _found(word, select, how)
    with naming(label(word)):
        return _points(found, how)


def _points(found: Curve | Outline, how: Reading) -> NDArray[np.float64]:
    if isinstance(found, Curve) or how.pen is None:
        return found.points
    return drawn(found.points, how.pen, found.pen).points


def _is_filled(found: Curve | Outline) -> bool:
    return isinstance(found, Outline) and not found.pen.alone and bool((found.points[0] == found.points[-1]).all())


def _hint(found: Curve | Outline) -> str:
    if isinstance(found, Curve) or not (found.pen.alone and found.pen.width):
        return ""
    return f"perhaps the line is meant: {pen_hint(found)}"


def _found(word: str, select: str | None, how: Reading) -> Curve | Outline:
    if curve_names.is_full(word):
        if select is not None:
            raise FileError(f"{word} is one curve: there is nothing to select by {select!r}")
        return curve_names.named(word)
    if word != "-" and not Path(word[:4000]).exists():
        _check_name(word)
    return read_outline(word, select, how.tolerance, how.pen, how.marked)


def _check_name(word: str) -> None:
    """Refuse what is no file and looks like the name of a curve that comes with tween."""
    if word in gallery.names():
        raise FileError(f"there is no file {word!r}; the curve that comes with tween is gallery:{word}")
    full = curve_names.every_name()
    by_name = {name.partition(":")[2]: name for name in full if not name.startswith("letter:")}
    by_name |= {name: name for name in full}
    close = get_close_matches(word, by_name, 1, 0.75)
    if close and not Path(word).suffix:
        raise FileError(f"there is no file {word!r}; did you mean {by_name[close[0]]}?")


def _curve(outline: Outline, pen: float | None) -> Curve:
    return curve_of(outline.points) if pen is None else drawn(outline.points, pen, outline.pen)


def _cleaned(word: str, points: NDArray[np.float64], smooth: float) -> Curve:
    curve = clean(points, smooth)
    dropped = f", {len(curve.changes.dropped)} pieces dropped" if curve.changes.dropped else ""
    say(f"tween: note: {label(word)}: {str(curve.changes).splitlines()[0]}{dropped}")
    return curve
