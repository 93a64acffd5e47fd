"""The named curves of the gallery, and the pairs of them that are made to be morphed.

All but `.ribbon` put their points on a grid, so that coordinates do not depend on the last bit of a
platform's sine, midpoints of edges are exact, and a mirror image is one exactly.

Legend: ``n`` vertices of a curve, ``m`` of a spine; ``t`` a parameter along a path; ``z = x + iy``.
"""

from collections.abc import Callable, Mapping
from difflib import get_close_matches
from functools import cache
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.errors import CurveError
from tween.gallery.generators import evenly, on_grid, ribbon, xy, zigzag
from tween.gallery.handwriting import spine_of
from tween.geometry.curve import Curve

_Floats = NDArray[np.float64]
_Complexes = NDArray[np.complex128]
_Entry = TypeVar("_Entry")

_CAP = 3  # points of a rounded end
_FINE = 2400  # points of a path before it is resampled
_ZIGZAG = 90  # vertices of the strips that share a triangulation


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
    return Curve(on_grid(_entry("curve", name, _CURVES)[1]()))


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
    return _entry("curve", name, _CURVES)[0]


def pairs() -> tuple[str, ...]:
    """List the named pairs, the rows of our Figure 11.

    Returns
    -------
    tuple of str
        The remeshed triangulations of the first three are compatible, those of the others are not.

    Examples
    --------
    >>> len(pairs())
    7

    References
    ----------
    Mukherjee and Gopi, Figure 11, whose curves are unpublished.
    """
    return tuple(_PAIRS)


@cache
def pair(name: str) -> tuple[Curve, Curve]:
    """Make a named pair of curves.

    Parameters
    ----------
    name : str
        One of `pairs`.

    Returns
    -------
    source, target : Curve

    Raises
    ------
    CurveError
        Where there is no such name; the message lists those there are.

    Examples
    --------
    >>> pair("ell_to_two_loops")
    (Curve(47 vertices, turning number 1), Curve(122 vertices, turning number 1))
    """
    return _entry("pair", name, _PAIRS)[1]()


def describe_pair(name: str) -> str:
    """Say in one sentence what a named pair shows.

    Parameters
    ----------
    name : str
        One of `pairs`.

    Returns
    -------
    str

    Raises
    ------
    CurveError
        Where there is no such name; the message lists those there are.

    Examples
    --------
    >>> describe_pair("e_to_l")
    'A handwritten e becomes an l: both cross themselves.'
    """
    return _entry("pair", name, _PAIRS)[0]


# Named curves


def _strip(spine: Callable[[_Floats], _Complexes], start: float, stop: float, m: int, width: float) -> _Floats:
    return ribbon(evenly(xy(spine(np.linspace(start, stop, _FINE))), m), width, _CAP).points


def _spiral(turns: float, m: int) -> _Floats:
    return _strip(lambda t: (0.9 + t) * _unit(t), 0, turns, m, 0.66)


def _rolling(t: _Floats) -> _Complexes:
    """The way of a point far outside the rim of a rolling wheel: one loop a turn."""
    return 3.2 * t - 1.6j * _unit(-t)


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
    "loop": ("A ribbon that makes a loop and crosses itself.", lambda: _strip(_rolling, -0.5, 0.45, 40, 0.8)),
    "two_loops": ("A ribbon that makes two loops, one after the other.", lambda: _strip(_rolling, -0.5, 1.45, 58, 0.8)),
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


def _entry(kind: str, name: str, entries: Mapping[str, _Entry]) -> _Entry:
    if name not in entries:
        close = get_close_matches(name, entries, 1)
        meant = f" (did you mean {close[0]!r}?)" if close else ""
        raise CurveError(f"there is no {kind} {name!r}{meant}; expected one of {', '.join(entries)}")
    return entries[name]


def _ends(first: str, second: str) -> tuple[Curve, Curve]:
    return curve(first), curve(second)


def _zigzag(path: _Floats, width: float) -> Curve:
    return Curve(on_grid(zigzag(evenly(path, _ZIGZAG), width).points))


def _path(spine: Callable[[_Floats], _Complexes], start: float, stop: float) -> _Floats:
    return xy(spine(np.linspace(start, stop, _FINE)))


_PAIRS: dict[str, tuple[str, Callable[[], tuple[Curve, Curve]]]] = {
    "spiral_to_ess": (
        "A spiral unwinds and bends the other way, to an S.",
        lambda: (
            _zigzag(_path(lambda t: (1.6 + 1.4 * t) * _unit(t), 0, 1.4), 1.0),
            _zigzag(_path(lambda t: -2.4 * np.sin(2 * t) + 4.2j * np.sin(t), -2.2, 2.2), 1.1),
        ),
    ),
    "horseshoe_to_loop": (
        "A horseshoe whose ends overlap turns into a ribbon with a loop.",
        lambda: (
            _zigzag(_path(lambda t: (2 - 0.75 * t) * (1.06j * _unit(t) + 0.12j * _unit(-t)), -0.64, 0.64), 1.2),
            _zigzag(_path(_rolling, -0.5, 0.45), 0.8),
        ),
    ),
    "e_to_l": (
        "A handwritten e becomes an l: both cross themselves.",
        lambda: (_zigzag(spine_of("e", _FINE), 1.1), _zigzag(spine_of("l", _FINE), 1.1)),
    ),
    "lobes_to_spiral": (
        "A clover of three overlapping lobes becomes a spiral strip.",
        lambda: _ends("three_lobes", "spiral_2"),
    ),
    "ell_to_two_loops": (
        "A simple letter L becomes a ribbon that overlaps itself twice.",
        lambda: _ends("ell", "two_loops"),
    ),
    "arrow_to_horseshoe": (
        "An arrow becomes an overlapped horseshoe; the tail of one is an end of the other.",
        lambda: _ends("arrow", "horseshoe"),
    ),
    "comb_to_winding": (
        "A comb of six teeth becomes a ramp that covers part of the plane three times.",
        lambda: _ends("comb", "winding_3"),
    ),
}


# Paths


def _unit(turns: _Floats) -> _Complexes:
    return np.exp(2j * np.pi * turns)


def _closed(z: _Complexes, n: int) -> _Floats:
    return evenly(xy(np.append(z, z[0])), n + 1)[:-1]


def _outline(corners: ArrayLike, step: float) -> _Floats:
    """Divide the sides of a polygon evenly, into pieces of about the given length."""
    start = np.asarray(corners)
    side = np.roll(start, -1) - start
    pieces = np.maximum(1, np.round(np.abs(side) / step)).astype(int)
    return xy(np.concatenate([a + d * np.arange(k) / k for a, d, k in zip(start, side, pieces, strict=True)]))
