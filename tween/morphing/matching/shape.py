"""A disk to be matched, at every size: its levels, and the vertices and candidates along its curve."""

import numpy as np
from numpy.typing import NDArray

from tween.geometry.triangulation import Triangulation
from tween.morphing.matching.chords import Disk, Positions, boundary, straight_lines
from tween.morphing.matching.flatness import least_flat
from tween.morphing.matching.simplify import Level, simplify

_APART = 1e-9  # of the curve's length: candidates nearer to each other than this are one
_Floats = NDArray[np.float64]


class Shape:
    """A disk to be matched, with what all levels need of it.

    Parameters
    ----------
    T : Triangulation
        Its triangles should be Delaunay: chords are walked through them.
    fixed : ndarray of bool, shape (n,)
        Vertices that stay at every level.
    sharpness : float
        See `.simplify.simplify`.
    """

    def __init__(self, T: Triangulation, fixed: NDArray[np.bool_], sharpness: float = 0.0) -> None:
        self.triangulation, self._points, self.fixed, self._sharpness = T, T.points, fixed, sharpness
        edges = np.roll(T.points, -1, axis=0) - T.points
        lengths = np.hypot(edges[:, 0], edges[:, 1])
        self.arc = (np.cumsum(lengths) - lengths) / lengths.sum()
        self.scaled = scaled(T)
        self.flat = least_flat(T)
        self._levels: dict[int, Level] = {}

    def __len__(self) -> int:
        return len(self.arc)

    def sharper(self, sharpness: float) -> "Shape":
        """The same disk, simplified in another order."""
        return self if sharpness == self._sharpness else Shape(self.triangulation, self.fixed, sharpness)

    def prepare(self, sizes: list[int]) -> None:
        """Simplify to all these numbers of vertices at once."""
        missing = sorted(set(sizes) - set(self._levels), reverse=True)
        if missing:
            found = simplify(self.triangulation, missing, self.fixed, self._sharpness)
            self._levels.update(zip(missing, found, strict=True))

    def level(self, size: int) -> Level:
        """The disk with so many vertices, or with as few as there can be."""
        self.prepare([size])
        return self._levels[size]

    def disk(self, level: Level) -> Disk:
        """The triangles of a level, for walks."""
        twin = Triangulation(self.triangulation.points[level.kept], level.triangles).twin.ravel()
        points = np.ascontiguousarray(self.triangulation.points[level.kept])
        return Disk(points, level.triangles, twin, boundary(level.triangles, twin), self.flat)

    def positions(self, level: Level, candidates: _Floats) -> Positions:
        """The vertices of a level and candidates, given by their arcs, on its edges."""
        arc, start = self.arc[level.kept], self.arc[level.kept[0]]
        ahead = np.append(arc - start, 1.0)
        places = _distinct(np.sort((candidates - start) % 1.0), ahead)
        edge = np.searchsorted(ahead, places, side="right") - 1
        share = (places - ahead[edge]) / (ahead[edge + 1] - ahead[edge])
        given, even = (self._between(points[level.kept], edge, share) for points in (self._points, self.scaled))
        inside = (given != self._points[level.kept][edge]).any(axis=1)
        inside &= (given != np.roll(self._points[level.kept], -1, axis=0)[edge]).any(axis=1)
        places, edge, given, even = places[inside], edge[inside], given[inside], even[inside]
        m, line = len(arc), straight_lines(np.ascontiguousarray(self._points[level.kept]))
        order = np.argsort(np.concatenate([ahead[:-1], places]), kind="stable")
        lines = np.concatenate([np.stack([np.roll(line, 1), line], axis=1), np.stack([line[edge]] * 2, axis=1)])
        return Positions(
            np.concatenate([self._points[level.kept], given])[order],
            np.concatenate([self.scaled[level.kept], even])[order],
            np.concatenate([np.arange(m), np.full(len(edge), -1)])[order],
            np.concatenate([np.arange(m), edge])[order],
            np.ascontiguousarray(lines[order]),
            (np.concatenate([ahead[:-1], places])[order] + start) % 1.0,
        )

    @staticmethod
    def _between(points: _Floats, edge: NDArray[np.int64], share: _Floats) -> _Floats:
        a, b = points[edge], np.roll(points, -1, axis=0)[edge]
        return np.asarray(a + share[:, None] * (b - a))


def scaled(T: Triangulation) -> _Floats:
    """Points about their centre, with the disk scaled to area 1.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    ndarray of float64, shape (n, 2)
    """
    away = T.points - T.points.mean(axis=0)
    largest = np.abs(away).max()  # so that no square overflows
    x, y = (away / largest).T
    area = 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    return np.asarray(away / largest / np.sqrt(area))


def _distinct(places: _Floats, vertices: _Floats) -> _Floats:
    """Drop places too near to the one before or to a vertex."""
    right = np.clip(np.searchsorted(vertices, places), 1, len(vertices) - 1)
    near = np.minimum(np.abs(places - vertices[right - 1]), np.abs(vertices[right] - places))
    places = places[near > _APART]
    return places[np.diff(places, prepend=-1.0) > _APART]
