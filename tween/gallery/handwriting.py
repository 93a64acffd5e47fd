"""Handwriting: the script letters of the Hershey fonts, written with a pen of some width.

Strokes of a pen cross themselves as nothing constructed does.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline

from tween.errors import CurveError
from tween.gallery.generators import evenly, length, on_grid, ribbon
from tween.geometry.curve import Curve

PEN = 1.1
"""Width of the pen for letters, in units of the Hershey fonts, whose capitals are 21 units high."""

_Floats = NDArray[np.float64]

_CAP = 3  # points of a rounded end
_FINE = 2400  # points of a path before it is resampled
_LETTERS = "CDIJLOPQRSUVZcdeloz"
_BASE_LINE = 9  # of the font, whose y runs down
_STEP = 1.3  # between points along a letter
_FEWEST, _MOST = 28, 56  # points along a letter
_NARROWING = 0.75 ** np.arange(20)  # of the pen, down to 0.005


def letters() -> tuple[str, ...]:
    """List the letters that one stroke draws and that `letter` writes with the full `PEN`.

    Returns
    -------
    tuple of str
        All but C, U and c cross themselves.

    Examples
    --------
    >>> "".join(letters())
    'CDIJLOPQRSUVZcdeloz'
    """
    return tuple(_LETTERS)


@cache
def letter(char: str, width: float | None = None) -> Curve:
    """Write a character with a pen: a `.ribbon` along its longest stroke in the Hershey script font.

    Parameters
    ----------
    char : str
        A printable ASCII character; further strokes of it are left out.
    width : float, optional
        Width of the pen in font units (capitals are 21 high), at least 0.01.  Without it, `PEN`,
        narrowed by a quarter as often as the tightest bend asks for.

    Returns
    -------
    Curve
        60 to 120 vertices; y up, letters stand on y = 0.

    Raises
    ------
    CurveError
        Where the font has no stroke for the character, listing those it has; or where the given width
        is too large, naming the character and the vertex of the spine.

    Notes
    -----
    The drawn points control a cubic B-spline, which rounds corners and never overshoots; the spine is
    taken from it evenly by arc length.

    Examples
    --------
    >>> letter("e")
    Curve(62 vertices, turning number 1)

    References
    ----------
    A. V. Hershey, *Calligraphy for computers*, U.S. Naval Weapons Laboratory, report 2101 (1967).
    """
    if width is not None and not width >= 0.01:
        raise CurveError(f"letter {char!r}: the pen is {width:g} wide, expected at least 0.01")
    spine = spine_of(char)
    for pen in PEN * _NARROWING if width is None else [width]:
        try:
            return Curve(on_grid(ribbon(spine, pen, _CAP).points))
        except CurveError as error:
            fault = error
    raise CurveError(f"letter {char!r}: {fault}")


def spine_of(char: str, m: int | None = None) -> NDArray[np.float64]:
    """Return the path of the pen: a clamped B-spline with the points of the stroke as control points.

    Parameters
    ----------
    char : str
        A printable ASCII character; only its longest stroke counts.
    m : int, optional
        Number of points; without it, about one for every 1.3 font units.

    Returns
    -------
    ndarray of float64, shape (m, 2)
        Evenly spaced by arc length, y up.

    Raises
    ------
    CurveError
        Where the font has no stroke for the character, listing those it has.
    """
    if char not in _strokes():
        raise CurveError(f"the font has no stroke for {char!r}; expected one of {' '.join(_strokes())}")
    stroke = _strokes()[char]
    stroke = stroke[np.append(True, (stroke[1:] != stroke[:-1]).any(axis=1))]
    degree = min(3, len(stroke) - 1)
    knots = np.pad(np.linspace(0, 1, len(stroke) - degree + 1), degree, mode="edge")
    count = m or int(np.clip(length(stroke) / _STEP, _FEWEST, _MOST))
    return evenly(BSpline(knots, stroke, degree)(np.linspace(0, 1, _FINE)), count)


@cache
def _strokes() -> dict[str, _Floats]:
    """Longest stroke of every character that has one, shape (k, 2), y up."""
    from HersheyFonts import HersheyFonts  # here, as only letters need it

    font = HersheyFonts()
    font.load_default_font("scripts")
    longest = {}
    for char in map(chr, range(32, 127)):
        strokes = [np.array(stroke, dtype=np.float64) for stroke in font.strokes_for_text(char)]
        if strokes:
            longest[char] = np.array([0, _BASE_LINE]) + [1, -1] * max(strokes, key=length)
    return longest
