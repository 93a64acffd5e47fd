"""Keyframes: the shapes that a sequence passes through, and how each is matched with the next.

A place on a keyframe is counted along its curve: vertex v is at v, and v + s is the share s of the way from there to
the next vertex.  Places are *unrolled*: once around a curve of N vertices is N, so that lists of places rise.

A `Bridge` is what a match gives between two keyframes: *nodes*, each a place on either, and triangles of the nodes.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween.errors import CurveError, NotSelfOverlappingError, TweenError
from tween.geometry.curve import Curve, as_curve
from tween.geometry.triangulation import Triangulation
from tween.morphing.keyframes.subdivision import subdivided
from tween.morphing.matching.given import MOST_DISKS
from tween.morphing.matching.match import Match, match
from tween.triangulating.decomposition import decompose
from tween.triangulating.flips import remesh

_INCOMPLETE = 1e6  # energy that is added where a match is not complete: any other choice of disks is better

_Floats = NDArray[np.float64]
_Ints = NDArray[np.int64]


class Keyframe:
    """A shape that a sequence passes through.

    Parameters
    ----------
    shape : Triangulation, Curve or array_like of shape (n, 2)
    name : str
        What messages call it.

    Attributes
    ----------
    points : ndarray of float64, shape (n, 2)
    rows : ndarray of int, shape (n,)
        Row of the input that each vertex is.
    disks : list of Triangulation
        The immersed disks that may be meant.

    Raises
    ------
    CurveError
        Where the input is no curve.
    NotSelfOverlappingError
        Where the curve bounds no immersed disk.
    """

    def __init__(self, shape: Any, name: str) -> None:
        self.name = name
        if isinstance(shape, Triangulation):
            self.rows, self.disks = np.arange(len(shape)), [remesh(shape.validate())]
        else:
            try:
                curve = as_curve(shape)
            except CurveError as error:
                raise CurveError(f"{name}: {error}") from None
            self.rows = np.arange(len(curve)) if isinstance(shape, Curve) else curve.origin.astype(np.int64)
            answer = decompose(curve)
            if not answer:
                raise NotSelfOverlappingError(f"{name} bounds no immersed disk: {answer.reason}")
            self.disks = [remesh(T) for T in answer.immersions()[:MOST_DISKS]]
        self.points = self.disks[0].points

    def __len__(self) -> int:
        return len(self.points)

    def vertex(self, row: int) -> int:
        """Which vertex a row of the input is."""
        found = np.flatnonzero(self.rows == row)
        return int(found[0]) if len(found) else -1

    def with_vertices(self, disk: int, places: _Floats) -> tuple[Triangulation, _Ints, _Ints]:
        """A disk with vertices at some places, too; which vertex each of its vertices was; and the vertices there."""
        n = len(self)
        every = np.unique(np.concatenate([np.arange(n), places % n]))
        vertices = np.searchsorted(every, np.arange(n))
        triangles = subdivided(self.disks[disk].triangles, vertices, len(every))
        own = np.full(len(every), -1)
        own[vertices] = np.arange(n)
        return Triangulation(self.at(every), triangles), own, np.searchsorted(every, places % n)

    def at(self, places: _Floats) -> _Floats:
        """The points at places, those of vertices exactly; shape (k, 2)."""
        vertex = np.floor(places)
        share = (places - vertex)[:, None]
        here = vertex.astype(np.int64) % len(self)
        a, b = self.points[here], self.points[(here + 1) % len(self)]
        return np.asarray(a + share * (b - a))


@dataclass(frozen=True)
class Bridge:
    """Two keyframes matched.

    Attributes
    ----------
    source, target : ndarray of float64, shape (m,)
        The place of each node on both, unrolled: rising, by less than once around.
    source_points, target_points : ndarray of float64, shape (m, 2)
    first, last : ndarray of int, shape (m-2, 3)
        Triangles of the nodes in the source and in the target; the same ones, unless flips have to do the rest.
    energy : float
    """

    source: _Floats
    target: _Floats
    source_points: _Floats
    target_points: _Floats
    first: _Ints
    last: _Ints
    energy: float

    @property
    def complete(self) -> bool:
        """Whether both keyframes have the same triangles."""
        return self.first is self.last or np.array_equal(self.first, self.last)

    def reversed(self) -> "Bridge":
        """From the target to the source."""
        return Bridge(
            self.target, self.source, self.target_points, self.source_points, self.last, self.first, self.energy
        )


def bridged(found: Match, source: Keyframe, target: Keyframe) -> Bridge:
    """Turn a match into places.

    Parameters
    ----------
    found : Match
        Of disks of the two keyframes.
    source, target : Keyframe

    Returns
    -------
    Bridge
    """
    return _bridged(found, found.source_vertices, found.target_vertices, source, target)


def _bridged(
    found: Match, source_vertices: _Ints, target_vertices: _Ints, source: Keyframe, target: Keyframe
) -> Bridge:
    return Bridge(
        _places(source_vertices, found.source.points, source),
        _places(target_vertices, found.target.points, target),
        found.source.points,
        found.target.points,
        found.source.triangles,
        found.source.triangles if found.complete else found.target.triangles,
        found.energy,
    )


def _places(vertices: _Ints, points: _Floats, keyframe: Keyframe) -> _Floats:
    """The places of vertices, and of points inserted between them (-1), unrolled."""
    n, start = len(keyframe), int(np.flatnonzero(vertices >= 0)[0])
    vertices, points = np.roll(vertices, -start), np.roll(points, -start, axis=0)
    before = vertices[np.maximum.accumulate(np.where(vertices >= 0, np.arange(len(vertices)), 0))]
    a, b = keyframe.points[before], keyframe.points[(before + 1) % n]
    share = np.hypot(*(points - a).T) / np.hypot(*(b - a).T)
    places = before + np.where(vertices >= 0, 0.0, share)
    places += n * np.cumsum(np.concatenate([[0], np.diff(before) < 0]))
    wrapped = np.roll(places, start)
    wrapped[:start] -= n
    return np.asarray(wrapped - n * np.floor(wrapped[0] / n))


class Matcher:
    """Matches neighbouring keyframes, each pair of disks once.

    Parameters
    ----------
    keyframes : list of Keyframe
    landmarks : sequence of sequence of int
        Rows that have to correspond, one of each keyframe.

    Attributes
    ----------
    keyframes : list of Keyframe
    free : bool
        Whether there are no landmarks.
    """

    def __init__(self, keyframes: list[Keyframe], landmarks: Sequence[Sequence[int]]) -> None:
        self.keyframes, self.free = keyframes, not len(landmarks)
        self._pairs = [[k.vertex(row[i]) for row in landmarks] for i, k in enumerate(keyframes)]
        self._found: dict[tuple[int, int, int], Match] = {}

    def match(self, leg: int, disks: tuple[int, int]) -> Match:
        """Match keyframe `leg` with the next one, the first after the last, given which disks are meant."""
        key = (leg, *disks)
        if key not in self._found:
            after = (leg + 1) % len(self.keyframes)
            pairs = list(zip(self._pairs[leg], self._pairs[after], strict=True))
            T, U = self.keyframes[leg].disks[disks[0]], self.keyframes[after].disks[disks[1]]
            self._found[key] = match(T, U, pairs or None)
        return self._found[key]

    def bridge(self, leg: int, disks: Sequence[int]) -> Bridge:
        """The match as places; `disks` has the choice for every keyframe."""
        after = (leg + 1) % len(self.keyframes)
        found = self.match(leg, (disks[leg], disks[after]))
        return bridged(found, self.keyframes[leg], self.keyframes[after])

    def anew(self, leg: int, disks: Sequence[int], source: _Floats, target: _Floats) -> Bridge | None:
        """The match that has places on one keyframe correspond to places on the next; None where there is none."""
        after = (leg + 1) % len(self.keyframes)
        ends = [(self.keyframes[leg], disks[leg], source), (self.keyframes[after], disks[after], target)]
        with suppress(TweenError):
            grown = [keyframe.with_vertices(disk, places) for keyframe, disk, places in ends]
            pairs = np.stack([vertices for _, _, vertices in grown], axis=1)
            found = match(grown[0][0], grown[1][0], pairs.tolist())
            if found.complete:
                first, last = (
                    np.where(vertices < 0, -1, own[vertices])
                    for (_, own, _), vertices in zip(grown, (found.source_vertices, found.target_vertices), strict=True)
                )
                return _bridged(found, first, last, ends[0][0], ends[1][0])
        return None

    def energy(self, leg: int, disks: tuple[int, int]) -> float:
        """The energy of a match, and much more where it is not complete."""
        found = self.match(leg, disks)
        return found.energy if found.complete else found.energy + _INCOMPLETE


def choose_disks(counts: Sequence[int], energy: Callable[[int, tuple[int, int]], float], loop: bool) -> list[int]:
    """Choose one of the disks of every keyframe, so that the energies of all legs add up to least.

    Parameters
    ----------
    counts : sequence of int
        Disks of each keyframe.
    energy : callable
        Of leg i, from disk a of keyframe i to disk b of the next one: ``energy(i, (a, b))``.  It is asked only where a
        choice depends on it.
    loop : bool
        Whether there is a leg from the last keyframe to the first.

    Returns
    -------
    list of int

    Examples
    --------
    >>> choose_disks([2, 2, 1], lambda leg, disks: [[[5, 9], [9, 4]], [[1], [3]]][leg][disks[0]][disks[1]], loop=False)
    [0, 0, 0]
    """
    if max(counts) == 1:
        return [0] * len(counts)
    around = [*counts, counts[0]] if loop else [*counts]
    best: tuple[float, list[int]] = (np.inf, [0] * len(counts))
    for start in range(counts[0]) if loop else [None]:
        path = _least_path(around, energy, start)
        best = min(best, path, key=lambda found: found[0])
    return best[1][: len(counts)]


def _least_path(
    counts: Sequence[int], energy: Callable[[int, tuple[int, int]], float], fixed: int | None
) -> tuple[float, list[int]]:
    """The least sum and its choices, one disk a keyframe; where one is fixed, the first and the last are that one."""
    starts = range(counts[0]) if fixed is None else [fixed]
    paths: dict[int, tuple[float, list[int]]] = {a: (0.0, [a]) for a in starts}
    for leg, (_, after) in enumerate(pairwise(counts)):
        last = fixed is not None and leg == len(counts) - 2
        grown = {}
        for b in [fixed] if last and fixed is not None else range(after):
            options = [(cost + energy(leg, (a, b)), [*chosen, b]) for a, (cost, chosen) in paths.items()]
            grown[b] = min(options, key=lambda found: found[0])
        paths = grown
    return min(paths.values(), key=lambda found: found[0])
