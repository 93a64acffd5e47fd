"""Curves to try things on: named ones, strips along a path, random disks, handwriting.

All but `ribbon` put their points on a grid, so that coordinates do not depend on the last bit of a
platform's sine, midpoints of edges are exact, and a mirror image is one exactly.

Legend: ``n`` vertices of a curve, ``m`` of a spine; ``t`` a parameter along a path; ``z = x + iy``.
"""

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import BSpline

from tween.curve import Curve
from tween.errors import CurveError
from tween.generators import GRID, on_grid, random_disk, ribbon, xy

__all__ = ["GRID", "PEN", "curve", "describe", "letter", "letters", "names", "random_disk", "ribbon"]

PEN = 1.1
"""Width of the pen for letters, in units of the Hershey fonts, whose capitals are 21 units high."""

_Floats = NDArray[np.float64]
_Complexes = NDArray[np.complex128]

_CAP = 3  # points of a rounded end
_FINE = 2400  # points of a path before it is resampled


_LETTERS = "CDIJLOPQRSUVZcdeloz"
_BASE_LINE = 9  # of the font, whose y runs down
_STEP = 1.3  # between points along a letter
_NARROWING = 0.75 ** np.arange(20)  # of the pen, down to 0.005


def names() -> tuple[str, ...]:
    """List the named curves, simple ones first.

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> names()[:3]
    ('convex', 'arrow', 'ell')
    """
    return tuple(_CURVES)


@cache
def curve(name: str) -> Curve:
    """Make a named curve; each bounds an immersed disk.

    Parameters
    ----------
    name : str
        One of `names`.

    Returns
    -------
    Curve
        40 to 130 vertices, 1 to 10 units across.

    Raises
    ------
    CurveError
        Where there is no such name; the message lists those there are.

    Examples
    --------
    >>> curve("horseshoe")
    Curve(90 vertices, turning number 1)
    """
    return Curve(on_grid(_entry(name)[1]()))


def describe(name: str) -> str:
    """Say what a named curve is.

    Parameters
    ----------
    name : str
        One of `names`.

    Returns
    -------
    str
        One sentence.

    Raises
    ------
    CurveError
        Where there is no such name; the message lists those there are.

    Examples
    --------
    >>> describe("ell")
    'A tapering letter L: a single reflex corner.'
    """
    return _entry(name)[0]


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
    """Write a character with a pen: a `ribbon` along its longest stroke in the Hershey script font.

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
    spine = _handwriting(char)
    for pen in PEN * _NARROWING if width is None else [width]:
        try:
            return Curve(on_grid(ribbon(spine, pen, _CAP).points))
        except CurveError as error:
            fault = error
    raise CurveError(f"letter {char!r}: {fault}")


# Named curves


def _strip(spine: Callable[[_Floats], _Complexes], start: float, stop: float, m: int, width: float) -> _Floats:
    return ribbon(_even(xy(spine(np.linspace(start, stop, _FINE))), m), width, _CAP).points


def _spiral(turns: float, m: int) -> _Floats:
    return _strip(lambda t: (0.9 + t) * _unit(t), 0, turns, m, 0.66)


def _trochoid(stop: float, m: int) -> _Floats:
    """The way of a point far outside the rim of a rolling wheel: one loop a turn."""
    return _strip(lambda t: 3.2 * t - 1.6j * _unit(-t), -0.5, stop, m, 0.8)


def _egg() -> _Floats:
    """Tangent points, from the distance of the tangent in each direction: its second derivative stays above -2."""
    t = 2 * np.pi * np.arange(_FINE) / _FINE
    distance = 2 + 0.3 * np.cos(2 * t + 0.4) + 0.09 * np.cos(3 * t + 1)
    slope = -0.6 * np.sin(2 * t + 0.4) - 0.27 * np.sin(3 * t + 1)
    return _closed((distance + 1j * slope) * np.exp(1j * t), 48)


def _clover() -> _Floats:
    """Leaves so wide that the angle has to run back between them; then all are swept around."""
    t = 2 * np.pi * np.arange(_FINE) / _FINE
    radius = 0.6 + 1.2 * np.cos(1.5 * t) ** 8
    angle = t + 0.4 * np.sin(6 * t) + 0.8 * np.sin(3 * t) + 0.6 * radius
    return _closed(radius * np.exp(1j * angle), 96)


def _comb() -> _Floats:
    t = np.linspace(0.11, 0.41, 22)
    outer = np.where(np.arange(22) // 2 % 2, 3.2, np.linspace(4.4, 5.3, 22)) * _unit(t)
    return _outline(np.append(outer, 2.3 * _unit(t[::-3])), 0.5)


def _fourier(coefficients: dict[int, float]) -> _Floats:
    t = np.arange(96) / 96
    return xy(np.sum([c * _unit(k * t) for k, c in coefficients.items()], axis=0))


_ARROW = [-0.4j, 3 - 0.6j, 2.7 - 1.5j, 6 + 0.2j, 2.9 + 1.7j, 3.1 + 0.7j, 0.1 + 0.6j, 0.7 + 0.1j]
_ELL = [0, 4.1 + 0.2j, 4 + 1.2j, 1.5 + 1.4j, 1.2 + 5j, 0.1 + 4.9j]
_TWO_DISKS = {-1: 0.15013, 1: -0.000635, -3: 0.22576, 3: 0.632474, -5: 0.093462, 5: -0.34906}
_FIVE_DISKS = {1: -0.107563, -2: -0.126553, 4: 0.585798, -5: 0.11994, 7: -0.299042, -8: 0.115374}

_CURVES: dict[str, tuple[str, Callable[[], _Floats]]] = {
    "convex": ("An irregular convex curve, a little like an egg.", _egg),
    "arrow": ("An arrow: simple, not convex.", lambda: _outline(_ARROW, 0.4)),
    "ell": ("A tapering letter L: a single reflex corner.", lambda: _outline(_ELL, 0.37)),
    "comb": ("A bent comb of six teeth.", _comb),
    "ess": (
        "A strip in the shape of an S.",
        lambda: _strip(lambda t: -2.4 * np.sin(2 * t) + 4.2j * np.sin(t), -2.2, 2.2, 44, 1.1),
    ),
    "spiral_1": ("A strip that winds around 1.4 times, clear of itself.", lambda: _spiral(1.4, 44)),
    "spiral_2": ("A strip that winds around 2.2 times, clear of itself.", lambda: _spiral(2.2, 60)),
    "horseshoe": (
        "A horseshoe bent until its two ends lie over each other.",
        lambda: _strip(lambda t: (2 - 0.75 * t) * (1.06j * _unit(t) + 0.12j * _unit(-t)), -0.64, 0.64, 42, 1.2),
    ),
    "loop": ("A ribbon that makes a loop and crosses itself.", lambda: _trochoid(0.45, 40)),
    "two_loops": ("A ribbon that makes two loops, one after the other.", lambda: _trochoid(1.45, 58)),
    "pretzel": (
        "A ribbon tied like a pretzel: it crosses itself in the middle, and its ends reach over its bows.",
        lambda: _strip(lambda t: 4 * np.sin(1.6 * t) * np.cos(0.2 * t) + 3j * np.cos(2 * t), -2.6, 2.55, 60, 0.8),
    ),
    "three_lobes": ("A clover of three lobes, each reaching over the next.", _clover),
    "winding_3": (
        "A ramp that winds so far around that it covers a part of the plane three times.",
        lambda: _strip(lambda t: (1.2 + 0.35 * t) * _unit(t), 0, 2.6, 56, 1.3),
    ),
    "two_disks": ("A curve that, like Milnor's, bounds two different immersed disks.", lambda: _fourier(_TWO_DISKS)),
    "five_disks": ("A curve that, like Bennequin's, bounds five different ones.", lambda: _fourier(_FIVE_DISKS)),
}


def _entry(name: str) -> tuple[str, Callable[[], _Floats]]:
    if name not in _CURVES:
        raise CurveError(f"there is no curve {name!r}; expected one of {', '.join(_CURVES)}")
    return _CURVES[name]


# Paths


def _unit(turns: _Floats) -> _Complexes:
    return np.exp(2j * np.pi * turns)


def _length(path: _Floats) -> float:
    return float(np.hypot(*np.diff(path, axis=0).T).sum())


def _even(path: _Floats, m: int) -> _Floats:
    """Take m points of a path, evenly by arc length."""
    s = np.append(0.0, np.cumsum(np.hypot(*np.diff(path, axis=0).T)))
    at = np.linspace(0, s[-1], m)
    return np.stack([np.interp(at, s, path[:, 0]), np.interp(at, s, path[:, 1])], axis=1)


def _closed(z: _Complexes, n: int) -> _Floats:
    return _even(xy(np.append(z, z[0])), n + 1)[:-1]


def _outline(corners: ArrayLike, step: float) -> _Floats:
    """Divide the sides of a polygon evenly, into pieces of about the given length."""
    start = np.asarray(corners)
    side = np.roll(start, -1) - start
    pieces = np.maximum(1, np.round(np.abs(side) / step)).astype(int)
    return xy(np.concatenate([a + d * np.arange(k) / k for a, d, k in zip(start, side, pieces, strict=True)]))


# Handwriting


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
            longest[char] = np.array([0, _BASE_LINE]) + [1, -1] * max(strokes, key=_length)
    return longest


def _handwriting(char: str) -> _Floats:
    """Spine of a character: a clamped B-spline with the points of the stroke as control points."""
    if char not in _strokes():
        raise CurveError(f"the font has no stroke for {char!r}; expected one of {' '.join(_strokes())}")
    stroke = _strokes()[char]
    stroke = stroke[np.append(True, (stroke[1:] != stroke[:-1]).any(axis=1))]
    degree = min(3, len(stroke) - 1)
    knots = np.pad(np.linspace(0, 1, len(stroke) - degree + 1), degree, mode="edge")
    m = int(np.clip(_length(stroke) / _STEP, 28, 56))
    return _even(BSpline(knots, stroke, degree)(np.linspace(0, 1, _FINE)), m)
