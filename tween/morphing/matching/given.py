r"""What a matching is given: landmarks, and shapes numbered so that it does not matter where a curve starts.

Every curve is renumbered from its *canonical* vertex: the one from which its edges, with their lengths and turns, come
first in the dictionary.  That is the same vertex for a similar curve that starts elsewhere.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween.errors import IncompatibleError, NotSelfOverlappingError
from tween.geometry.curve import Curve, as_curve
from tween.geometry.triangulation import Triangulation
from tween.morphing.matching.chords import Positions
from tween.morphing.matching.kernels import Windows
from tween.morphing.matching.simplify import Level
from tween.triangulating.decomposition import decompose
from tween.triangulating.flips import remesh

MOST_DISKS = 6
"""Of the immersed disks that a curve bounds, so many are tried."""

_DIGITS = 6  # to which lengths and turns are compared

_Ints = NDArray[np.int64]


class Given:
    """A shape to be matched.

    Parameters
    ----------
    shape : Triangulation, Curve or array_like of shape (n, 2)
    name : str
        What messages call it.

    Attributes
    ----------
    disks : list of Triangulation
        Delaunay triangulations of the immersed disks that are meant, from the canonical vertex on.
    rows : ndarray of int, shape (n,)
        Row of the input that each vertex is.
    key : list of (int, int)
        Lengths and turns; equal for similar curves.

    Raises
    ------
    NotSelfOverlappingError
        Where the curve bounds no immersed disk.
    """

    def __init__(self, shape: Any, name: str) -> None:
        self.name = name
        if isinstance(shape, Triangulation):
            rows, disks = np.arange(len(shape)), [remesh(shape.validate())]
        else:
            curve = as_curve(shape)
            rows = np.arange(len(curve)) if isinstance(shape, Curve) else curve.origin.astype(np.int64)
            answer = decompose(curve)
            if not answer:
                raise NotSelfOverlappingError(f"the {name} bounds no immersed disk: {answer.reason}")
            disks = [remesh(T) for T in answer.immersions()[:MOST_DISKS]]
        edges = _edges(disks[0].points)
        self.start = _least_rotation(_ranks(edges))
        self.rows: _Ints = np.roll(rows, -self.start)
        self.disks = [T.rolled(self.start) for T in disks]
        self.key = [*map(tuple, np.roll(edges, -self.start, axis=0).tolist())]

    def __len__(self) -> int:
        return len(self.rows)

    def arc_from_input(self, arc: NDArray[np.float64], own: NDArray[np.float64]) -> NDArray[np.float64]:
        """Count arcs from row 0 of the input instead of the canonical vertex; `own` are the arcs of the vertices."""
        return (arc - own[int(np.flatnonzero(self.rows == 0)[0])]) % 1.0


def _edges(points: NDArray[np.float64]) -> _Ints:
    """Length of each edge and turn at its end, rounded to whole numbers, shape (n, 2)."""
    z = points @ np.array([1.0, 1.0j])
    edges = np.roll(z, -1) - z
    lengths = np.abs(edges) / np.abs(edges).sum()
    turns = np.angle(np.roll(edges, -1) / edges) / np.pi
    return np.stack([np.round(lengths * len(z) * 10**_DIGITS), np.round(turns * 10**_DIGITS)], axis=1).astype(np.int64)


def _ranks(rows: _Ints) -> list[int]:
    ranks: list[int] = np.unique(rows, axis=0, return_inverse=True)[1].ravel().tolist()
    return ranks


def _least_rotation(word: list[int]) -> int:
    """Where the rotation of a cyclic word begins that comes first in the dictionary; O(n).

    Two places are compared symbol by symbol; where they differ after k symbols, none of the k + 1 places from the
    larger one on can be the answer.
    """
    n, i, j, k = len(word), 0, 1, 0
    while i < n and j < n and k < n:
        x, y = word[(i + k) % n], word[(j + k) % n]
        if x == y:
            k += 1
            continue
        if x > y:
            i += k + 1
        else:
            j += k + 1
        j += i == j
        k = 0
    return min(i, j)


class Landmarks(NamedTuple):
    """Vertices that must be matched, in the shapes' own numbers.

    Attributes
    ----------
    source, target : ndarray of int64, shape (k,)
        Vertex i of one belongs to vertex i of the other.
    """

    source: NDArray[np.int64]
    target: NDArray[np.int64]

    def restrict(self, windows: Windows, source: Positions, target: Positions, levels: tuple[Level, Level]) -> Windows:
        """Say which nodes there are: one of the two a vertex, and of landmarks only their own pair."""
        wide = int(windows.width.max())
        partner = (windows.low[:, None] + np.arange(wide)) % len(target.arc)
        allowed = (source.vertex[:, None] >= 0) | (target.vertex[partner] >= 0)
        allowed &= np.arange(wide) < windows.width[:, None]
        for i, j in zip(self.source, self.target, strict=True):
            x, a = (
                np.flatnonzero(p.vertex == np.searchsorted(level.kept, v))[0]
                for p, level, v in zip((source, target), levels, (i, j), strict=True)
            )
            here = partner == a
            here[x] = ~here[x]
            allowed &= ~here
        return Windows(windows.low, windows.width, allowed)


def checked_landmarks(landmarks: Sequence[tuple[int, int]] | None, source: Given, target: Given) -> _Ints:
    """Turn pairs of rows into pairs of vertices, in order along the source.

    Parameters
    ----------
    landmarks : sequence of (int, int) or None
    source, target : Given

    Returns
    -------
    ndarray of int, shape (k, 2)

    Raises
    ------
    IncompatibleError
        Where they are no pairs of rows, a row occurs twice, or the order around the two curves differs.
    """
    given = _pairs(landmarks)
    for column, shape in enumerate((source, target)):
        for pair in given.tolist():
            if not 0 <= pair[column] < len(shape):
                raise IncompatibleError(
                    f"landmark {tuple(pair)} is out of range: the {shape.name} has vertices 0 to {len(shape) - 1}"
                )
        _check_distinct(given, column, shape.name)
    where = [np.argsort(shape.rows) for shape in (source, target)]
    pairs = np.stack([where[0][given[:, 0]], where[1][given[:, 1]]], axis=1)
    order = np.argsort(pairs[:, 0])
    _check_order(pairs[order], given[order], len(target))
    return pairs[order]


def _pairs(landmarks: Sequence[tuple[int, int]] | None) -> _Ints:
    if landmarks is None or len(landmarks) == 0:
        return np.empty((0, 2), dtype=np.int64)
    try:
        given = np.asarray(landmarks)
    except ValueError:
        given = np.empty(0)
    if given.ndim != 2 or given.shape[1] != 2 or not np.issubdtype(given.dtype, np.integer):
        raise IncompatibleError(
            f"landmarks are {landmarks!r}, expected pairs of whole numbers: a vertex of the source, one of the target"
        )
    return given.astype(np.int64)


def _check_distinct(given: _Ints, column: int, name: str) -> None:
    seen: dict[int, list[int]] = {}
    for pair in given.tolist():
        if pair[column] in seen:
            raise IncompatibleError(
                f"landmarks {tuple(seen[pair[column]])} and {tuple(pair)} both use vertex {pair[column]} of the {name};"
                " each vertex can be matched once"
            )
        seen[pair[column]] = pair


def _check_order(pairs: _Ints, given: _Ints, n: int) -> None:
    """Raise where the targets, in order along the source, go around the target more than once."""
    steps = (np.roll(pairs[:, 1], -1) - pairs[:, 1]) % n
    if len(pairs) < 3 or steps.sum() == n:
        return
    ahead = (pairs[:, 1] - pairs[0, 1]) % n
    place = int(np.flatnonzero(np.diff(ahead) < 0)[0])
    first, second = tuple(given[place].tolist()), tuple(given[place + 1].tolist())
    right = np.roll(given[np.argsort(ahead), 1], 0).tolist()
    raise IncompatibleError(
        f"landmarks {first} and {second} are not in the same order around both curves; in the order "
        f"{given[:, 0].tolist()} along the source, the vertices of the target would have to come as {right}"
    )
