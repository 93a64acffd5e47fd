"""Which of two shapes comes first, whatever the place, turn and size in which both are given.

A morph is computed from the shape that comes first, and reversed where the caller wants it the other way.  If that
were decided by coordinates, turning both shapes could exchange them, and every tie on the way would be broken
otherwise.  So it is decided by what a similarity of both leaves as it is: counts, and which of the two is longer,
larger, or has the longer edge.  Lengths of the two are compared with each other; one that is larger by less than a few
roundings is not larger.

    vertices   perimeter   area   longest edge   second moment about the centre   shortest edge   sum of squared turns

Shapes that agree in all of these are taken to be the same shape up to a similarity of one of them that keeps size.
Then, and only then, the order of their bytes decides: a morph is symmetric there, too, but which of several equally
good ones it is, as for two congruent symmetric curves, may depend on where they lie.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from tween.geometry.triangulation import Triangulation

_SAME = 1e-9  # relative; less is no difference


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
    return _bytes(first, first_origin) > _bytes(second, second_origin)


def _points(T: Triangulation, origin: NDArray[np.int64]) -> bytes:
    return T.points[origin >= 0].astype("<f8").tobytes()


def _bytes(T: Triangulation, origin: NDArray[np.int64]) -> tuple[bytes, bytes]:
    return _points(T, origin), T.canonical.tobytes()
