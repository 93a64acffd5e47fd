"""Which of two shapes comes first, whatever the place, turn and size in which both are given.

A morph is computed from the shape that comes first, and reversed where the caller wants it the other way.  If that
were decided by coordinates, turning both shapes could exchange them, and every tie on the way would be broken
otherwise.  So it is decided by what a similarity of both leaves as it is: counts, and which of the two is longer,
larger, or has the longer edge.  Lengths of the two are compared with each other; one that is larger by less than a few
roundings is not larger.

    vertices   perimeter   area   longest edge   second moment about the centre   shortest edge   sum of squared turns

Shapes that agree in all of these are compared edge by edge and turn by turn, from where those read smallest.
Where no edge and no turn differs, one shape is the other, turned and moved.  Then the one from which the other is
reached by a left turn comes first; where that is none, the one from which the other lies ahead, seen along the first
of those edges.  What is left are equal shapes in the same place, and half a turn, which leads to the same from either
side.  There, and only there, the order of their bytes decides.
"""

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween.geometry.triangulation import Triangulation

_SAME = 1e-9  # relative, or radians; less is no difference
_GRID = 2.0**30  # parts of the length of a curve, and of half a turn, to which edges and turns are rounded


def shape_key(T: Triangulation, origin: NDArray[np.int64]) -> NDArray[np.float64]:
    """What two shapes are compared by, in order of weight.

    Parameters
    ----------
    T : Triangulation
    origin : ndarray of int, shape (n,)
        -1 for vertices that were inserted: they do not count.

    Returns
    -------
    ndarray of float64, shape (7,)
        None of them depends on place, turn or numbering; a similarity of two shapes keeps the quotients.
    """
    return _key_of(_points(T, origin))


@lru_cache(maxsize=8)  # both shapes of many morphs between triangulations of the same two curves
def _key_of(points: bytes) -> NDArray[np.float64]:
    z = np.frombuffer(points, "<f8").reshape(-1, 2) @ np.array([1.0, 1.0j])
    z = z - z.mean()
    edges = np.roll(z, -1) - z
    lengths = np.abs(edges)
    area = 0.5 * float((z.real * np.roll(z.imag, -1) - z.imag * np.roll(z.real, -1)).sum())
    turns = float((np.angle(edges / np.roll(edges, 1)) ** 2).sum())
    moment = float(np.sqrt((np.abs(z) ** 2).sum()))
    key = np.array([len(z), lengths.sum(), np.sqrt(abs(area)), lengths.max(), moment, lengths.min(), turns])
    key.setflags(write=False)
    return key


def comes_later(
    first: Triangulation, first_origin: NDArray[np.int64], second: Triangulation, second_origin: NDArray[np.int64]
) -> bool:
    """Tell whether the second of two shapes comes first.

    Parameters
    ----------
    first, second : Triangulation
    first_origin, second_origin : ndarray of int, shape (n,)
        -1 for vertices that were inserted.

    Returns
    -------
    bool

    Examples
    --------
    >>> small = Triangulation([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    >>> large, every = small.moved(2 * small.points), np.arange(3)
    >>> comes_later(large, every, small, every), comes_later(small, every, large, every)
    (True, False)
    """
    one, other = shape_key(first, first_origin), shape_key(second, second_origin)
    for p, q in zip(one.tolist(), other.tolist(), strict=True):
        if abs(p - q) > _SAME * max(abs(p), abs(q)):
            return p > q
    z, w = (_outline(T, origin) for T, origin in ((first, first_origin), (second, second_origin)))
    starts, texts = zip(*(_smallest(curve) for curve in (z, w)), strict=True)
    later = _differs(*texts) or _differs(first.canonical, second.canonical)
    later = later or _turned_or_moved(z, w, z[(starts[0] + 1) % len(z)] - z[starts[0]])
    return later > 0 if later else _bytes(first, first_origin) > _bytes(second, second_origin)


def _outline(T: Triangulation, origin: NDArray[np.int64]) -> NDArray[np.complex128]:
    return T.points[origin >= 0] @ np.array([1.0, 1.0j])


def _smallest(z: NDArray[np.complex128]) -> tuple[int, NDArray[np.float64]]:
    """The vertex from which the edges and turns of a curve, rounded, read smallest; and these, (n, 2), from there."""
    edges = np.roll(z, -1) - z
    lengths, turns = np.abs(edges), np.angle(edges / np.roll(edges, 1))
    read = np.round(_GRID * np.stack([lengths / lengths.sum(), turns / np.pi], axis=1))
    rank, step = np.unique(read, axis=0, return_inverse=True)[1].ravel(), 1
    while step < len(z) and rank.max() < len(z) - 1:  # ranks of twice as long stretches from those of two neighbours
        pairs = np.stack([rank, np.roll(rank, -step)], axis=1)
        rank, step = np.unique(pairs, axis=0, return_inverse=True)[1].ravel(), 2 * step
    start = int(rank.argmin())
    return start, np.roll(read, -start, axis=0)


def _differs(one: NDArray[Any], other: NDArray[Any]) -> int:
    """1 or -1 where the first number that differs is larger or smaller; 0 where none differs."""
    p, q = one.ravel(), other.ravel()
    different = np.flatnonzero(p != q)
    return 0 if not len(different) else 1 if p[different[0]] > q[different[0]] else -1


def _turned_or_moved(z: NDArray[np.complex128], w: NDArray[np.complex128], edge: complex) -> int:
    """1 or -1 where the second curve is the first one turned to the right or left, or else lies behind or ahead."""
    size = float(np.abs(z - z.mean()).max())
    turn = float(np.angle(np.vdot(z - z.mean(), w - w.mean())))
    if _SAME < abs(turn) < np.pi - _SAME:
        return 1 if turn < 0 else -1
    step = complex((w.mean() - z.mean()) * np.conj(edge) / abs(edge))
    for ahead in (step.real, step.imag):
        if abs(turn) < 1 and abs(ahead) > _SAME * size:
            return 1 if ahead < 0 else -1
    return 0


def _points(T: Triangulation, origin: NDArray[np.int64]) -> bytes:
    return T.points[origin >= 0].astype("<f8").tobytes()


def _bytes(T: Triangulation, origin: NDArray[np.int64]) -> tuple[bytes, bytes]:
    return _points(T, origin), T.canonical.tobytes()
