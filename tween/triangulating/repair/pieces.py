r"""Pieces of a stroke that may be dropped: spikes, tiny loops, and what is drawn twice.

A *piece* may be dropped where its ends lie within a radius of each other, and all of it within the radius of what is
kept; so no point of the stroke is farther than that from what is left of it.

       ____/\____            ____ __ ____                 ____________
                                 (_)                      ____________\
         spike                   loop                  retraced, once there and back

Legend: ``x`` points of a closed smooth path, evenly spaced; ``m`` one of them; ``a b`` the ends of a piece around it.
"""

from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from tween.geometry.crossings import find_crossings
from tween.geometry.curve import spikes
from tween.triangulating.repair.smoothing import Path

_FOLD = -0.7  # cosine of the turn from which on a path may fold back
_WINDOW = 4  # points on either side by which turns are measured
_LONGEST = 10.0  # length of a loop, in radii: what is longer is a scribble, and not looked at

_Floats = NDArray[np.float64]


class Piece(NamedTuple):
    """A piece of a stroke.

    Attributes
    ----------
    kind : str
        "spike", "loop", "retraced", or what else is wrong with it.
    first, last : float
        Where it begins and ends, in rows of the stroke; the first may be larger on a closed one.
    """

    kind: str
    first: float
    last: float


def tidied(points: _Floats) -> NDArray[np.intp]:
    """Choose the points of a closed polygon that are left without repetitions and exact spikes.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    ndarray of int
        Ascending; fewer than three where nothing is left that has an inside.
    """
    kept = np.arange(len(points))
    while len(kept) > 2:
        p = points[kept]
        wrong = (p == np.roll(p, -1, axis=0)).all(axis=1)
        if not wrong.any():
            wrong = spikes(p)
        if not wrong.any():
            break
        kept = kept[~wrong]
    return kept


def droppable(x: Path, path: Path, radius: float, reach: float) -> list[Piece]:
    """Find pieces of a closed path that may be dropped, none of which overlaps another.

    Parameters
    ----------
    x : Path
        The path made smooth: evenly spaced, about a quarter of the radius apart.
    path : Path
        The path itself.
    radius : float
        How near to each other the ends of a piece have to come.
    reach : float
        How far the path's points in it may be from where it begins; of what is retraced, from the rest of `x`.

    Returns
    -------
    list of Piece
        Loops and spikes, the shortest first, then what is retraced.
    """
    taken = np.zeros(len(x.points), dtype=np.bool_)
    pieces = []
    for kind, a, b in [*_loops(x.points, radius), *_folds(x.points, radius)]:
        inside = np.arange(a, b + 1) % len(taken)
        if taken[inside].any():
            continue
        piece = Piece(kind, *x.places[inside[[0, -1]]].tolist())
        rows = path.points[path.between(piece.first, piece.last)]
        rest = x.points[inside[0]] if kind != "retraced" else x.points[np.arange(b, a + len(taken) + 1) % len(taken)]
        if _near(rows, rest, reach):
            taken[inside] = True
            pieces.append(piece)
    return pieces


def _near(points: _Floats, target: _Floats, radius: float) -> bool:
    """Whether all points are within a radius of a point, or of a polygonal path."""
    if target.ndim == 1:
        return bool(np.hypot(*(points - target).T).max(initial=0.0) <= radius)
    line = shapely.linestrings(target)
    shapely.prepare(line)
    return bool(shapely.dwithin(line, shapely.points(points), radius).all())


def _folds(x: _Floats, radius: float) -> list[tuple[str, int, int]]:
    """Where the path turns back beside itself: short spikes, and pieces that the rest of the path covers."""
    found = []
    for m in _turning_points(x):
        a, b = _side_by_side(x, m, radius)
        piece, rest = x[np.arange(a, b + 1) % len(x)], x[np.arange(b, a + len(x) + 1) % len(x)]
        if b - a < 2 or len(rest) < 3:
            continue
        if _near(piece, piece[0], 2 * radius):
            found.append(("spike", a, b))
        elif _near(piece, rest, radius):
            found.append(("retraced", a, b))
    return sorted(found, key=lambda f: f[2] - f[1])


def _turning_points(x: _Floats) -> list[int]:
    """Points at which the path turns most sharply, and by more than a fold needs."""
    before, after = x - np.roll(x, _WINDOW, axis=0), np.roll(x, -_WINDOW, axis=0) - x
    sizes = np.maximum(np.hypot(*before.T) * np.hypot(*after.T), np.finfo(float).tiny)
    cosine = (before * after).sum(axis=1) / sizes
    around = np.stack([np.roll(cosine, k) for k in range(-_WINDOW, _WINDOW + 1)])
    return [int(m) for m in np.flatnonzero((cosine <= around.min(axis=0)) & (cosine < _FOLD))]


def _side_by_side(x: _Floats, m: int, radius: float) -> tuple[int, int]:
    """Go from m both ways at once as long as the two ends stay within the radius of each other."""
    a = b = m
    n = len(x)
    while b - a < n // 2:
        steps = [(a - 1, b + 1), (a - 1, b), (a, b + 1)]
        gaps = [float(np.hypot(*(x[j % n] - x[i % n]))) for i, j in steps]
        best = int(np.argmin(gaps))
        if gaps[best] > radius:
            break
        a, b = steps[best]
    return a, b


def _loops(x: _Floats, radius: float) -> list[tuple[str, int, int]]:
    """The loops that stay within the radius of the place where they close, the shortest first."""
    n = len(x)
    found = []
    step = float(np.hypot(*(np.roll(x, -1, axis=0) - x).T).mean())
    longest = min(_LONGEST * radius / step, n / 2)
    for i, j in find_crossings(x).pairs.tolist():
        a, b = (i, j + 1) if j - i <= n / 2 else (j, i + 1 + n)
        if b - a - 1 > longest:
            continue
        loop = x[np.arange(a, b + 1) % n]
        if _near(loop, loop[0], 1.5 * radius + step):
            found.append(("loop", a, b))
    return sorted(found, key=lambda f: f[2] - f[1])
