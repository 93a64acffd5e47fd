r"""From coarse to fine: one level of the matching, and the way from each to the next.

At the first level both curves are simplified and the product table is solved in full, with evenly spaced candidates.
At every further one there are more vertices, the candidates are the *images* of the other curve's vertices under the
last correspondence, and the table is narrow: a position may be matched with the few that lie around its image, and
only chords near the last triangulation take part, see `.reach`.

Legend: ``S T`` the shapes; an *arc* is a place along the whole curve, as a share of its length from vertex 0.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween.geometry.triangulation import Triangulation
from tween.morphing.matching.chords import Chords, Positions, all_pairs, find_chords, find_splits
from tween.morphing.matching.given import Landmarks
from tween.morphing.matching.kernels import Side, Windows, fill, follow, wholes
from tween.morphing.matching.reach import ON_NODE, near_pairs
from tween.morphing.matching.shape import Shape
from tween.morphing.matching.simplify import Level

_Floats = NDArray[np.float64]

SAME = 1e-10
"""Costs that differ by less are equal, and the first is taken: rounding decides nothing."""


@dataclass(frozen=True)
class Correspondence:
    """Nodes along both curves and a triangulation that both share.

    Attributes
    ----------
    source_arc, target_arc : ndarray of float64, shape (m,)
    source_vertices, target_vertices : ndarray of int, shape (m,)
        -1 where a candidate was used.
    source_points, target_points : ndarray of float64, shape (m, 2)
    triangles : ndarray of int, shape (m-2, 3)
    cost : float
        Energy above 4, price of stretch included.
    """

    source_arc: _Floats
    target_arc: _Floats
    source_vertices: NDArray[np.int64]
    target_vertices: NDArray[np.int64]
    source_points: _Floats
    target_points: _Floats
    triangles: NDArray[np.int64]
    cost: float

    @property
    def places(self) -> tuple[tuple[_Floats, _Floats], tuple[_Floats, _Floats]]:
        """Arcs and points of the nodes on the source, and on the target."""
        return (self.source_arc, self.source_points), (self.target_arc, self.target_points)

    @cached_property
    def twin(self) -> NDArray[np.int64]:
        """Half-edge across each half-edge of the triangles."""
        return Triangulation(self.source_points, self.triangles).twin.ravel()

    def to_target(self, arc: _Floats) -> _Floats:
        """Images of places on the source."""
        return _interpolated(arc, self.source_arc, self.target_arc)

    def to_source(self, arc: _Floats) -> _Floats:
        """Images of places on the target."""
        return _interpolated(arc, self.target_arc, self.source_arc)


def _interpolated(arc: _Floats, given: _Floats, wanted: _Floats) -> _Floats:
    """Between neighbouring nodes in proportion."""
    x, y = (np.append((a - a[0]) % 1.0, 1.0) for a in (given, wanted))
    return np.asarray((np.interp((arc - given[0]) % 1.0, x, y) + wanted[0]) % 1.0)


class Effort(NamedTuple):
    """How wide a level's table is.

    Attributes
    ----------
    band : int
        Positions to either side of the image.
    steps : int
        Diagonals of the last triangulation that a chord may cross.
    merge : float
        An image this near to a vertex, as a share of the distance to the next, gives way to it.
    even : int
        Evenly spaced candidates on every edge, besides the images.
    most : int
        Partners of a position, more or less.
    """

    band: int
    steps: int
    merge: float
    even: int
    most: int = 120


def first_level(
    S: Shape, T: Shape, sizes: tuple[int, int], candidates: tuple[int, int], nodes: Landmarks, stretch: float
) -> list[Correspondence]:
    """Solve the product table in full, with so many evenly spaced candidates on every edge.

    Parameters
    ----------
    S, T : Shape
    sizes : (int, int)
        Numbers of vertices to which the two are simplified.
    candidates : (int, int)
        On every edge of either.
    nodes : Landmarks
        What has to be matched.
    stretch : float
        Price of a boundary piece whose share of the curve changes.

    Returns
    -------
    list of Correspondence
        The best of each local minimum over the places of the source's first vertex, the best first.
    """
    levels = S.level(sizes[0]), T.level(sizes[1])
    places = [_even(shape.arc[level.kept], c) for shape, level, c in zip((S, T), levels, candidates, strict=True)]
    source, target = (shape.positions(level, p) for shape, level, p in zip((S, T), levels, places, strict=True))
    windows = Windows(
        np.zeros(len(source.arc), dtype=np.int64),
        np.full(len(source.arc), len(target.arc)),
        np.empty((0, 0), dtype=bool),
    )
    windows = nodes.restrict(windows, source, target, levels)
    pairs = [all_pairs(len(p.arc)) for p in (source, target)]
    return _solve((S, T), levels, (source, target), pairs, windows, stretch)


def _even(arc: _Floats, count: int) -> _Floats:
    gaps = (np.roll(arc, -1) - arc) % 1.0
    return np.asarray((arc[:, None] + gaps[:, None] * np.arange(1, count + 1) / (count + 1)).ravel() % 1.0)


def next_level(
    S: Shape,
    T: Shape,
    sizes: tuple[int, int],
    last: Correspondence,
    nodes: Landmarks,
    effort: Effort,
    stretch: float,
) -> Correspondence | None:
    """Solve the table in the neighbourhood of a coarser correspondence.

    Parameters
    ----------
    S, T : Shape
    sizes : (int, int)
        Numbers of vertices to which the two are simplified.
    last : Correspondence
        Of the coarser level.
    nodes : Landmarks
        What has to be matched.
    effort : Effort
        How wide the neighbourhood is, and how many candidates there are.
    stretch : float
        Price of a boundary piece whose share of the curve changes.

    Returns
    -------
    Correspondence or None
        None where the neighbourhood holds no common triangulation.
    """
    levels = S.level(sizes[0]), T.level(sizes[1])
    source, target = positions_at((S, T), levels, last, effort)
    windows = nodes.restrict(band_around(source, target, last, effort.band), source, target, levels)
    pairs = [
        near_pairs(p.arc, *nodes_of, last.triangles, last.twin, effort.steps, effort.most)
        for p, nodes_of in zip((source, target), last.places, strict=True)
    ]
    found = _solve((S, T), levels, (source, target), pairs, windows, stretch)
    return found[0] if found else None


def positions_at(
    shapes: tuple[Shape, Shape], levels: tuple[Level, Level], last: Correspondence, effort: Effort
) -> tuple[Positions, Positions]:
    """Place vertices and candidates on both curves: the images of the other's vertices, and evenly spaced places.

    Parameters
    ----------
    shapes : (Shape, Shape)
    levels : (Level, Level)
        The finer level.
    last : Correspondence
        Of the coarser level.
    effort : Effort

    Returns
    -------
    (Positions, Positions)
    """
    arcs = [shape.arc[level.kept] for shape, level in zip(shapes, levels, strict=True)]
    source = shapes[0].positions(levels[0], _images(last.to_source(arcs[1]), arcs[0], effort))
    target = shapes[1].positions(levels[1], _images(last.to_target(arcs[0]), arcs[1], effort))
    return source, target


def _images(images: _Floats, vertices: _Floats, effort: Effort) -> _Floats:
    """Candidates: the images, less those merged with a vertex, and evenly spaced places."""
    images = np.sort(images)
    after = (np.roll(images, -1) - images) % 1.0
    room = np.minimum(after, np.roll(after, 1))
    spread = np.minimum((np.roll(vertices, -1) - vertices) % 1.0, (vertices - np.roll(vertices, 1)) % 1.0)
    place = np.searchsorted(vertices, images)
    near = np.full(len(images), np.inf)
    for vertex in (place - 1, place % len(vertices)):
        distance = np.abs((images - vertices[vertex] + 0.5) % 1.0 - 0.5)
        near = np.minimum(near, distance / np.minimum(room, spread[vertex]).clip(1e-300))
    return np.concatenate([images[near > effort.merge], _even(vertices, effort.even)])


def band_around(source: Positions, target: Positions, last: Correspondence, band: int) -> Windows:
    """Lay a window around the image of every source position.

    Parameters
    ----------
    source, target : Positions
    last : Correspondence
        Of the coarser level.
    band : int
        Positions to either side of the image.

    Returns
    -------
    Windows
        In which nothing is said yet about what is allowed.
    """
    start, count = target.arc[0], len(target.arc)
    ahead = (target.arc - start) % 1.0
    images = (last.to_target(source.arc) - start) % 1.0
    right = np.searchsorted(ahead, images)
    to_right = np.append(ahead, 1.0)[right] - images
    nearer = images - ahead[right - 1] < to_right - ON_NODE  # what lies half-way goes to the right
    centre = np.where((right > 0) & nearer, right - 1, right)
    width = min(2 * band + 1, count)
    return Windows((centre - band) % count, np.full(len(images), width), np.empty((0, 0), dtype=bool))


def _solve(
    shapes: tuple[Shape, Shape],
    levels: tuple[Level, Level],
    positions: tuple[Positions, Positions],
    pairs: list[tuple[NDArray[np.int64], NDArray[np.int32]]],
    windows: Windows,
    stretch: float,
) -> list[Correspondence]:
    """Fill the table and read the correspondences from it."""
    sides = []
    for shape, level, place, (first, end), of_source in zip(
        shapes, levels, positions, pairs, (True, False), strict=True
    ):
        disk = shape.disk(level)
        chords = Chords(*find_chords(place, disk, first, end, of_source))
        splits, start, middle = find_splits(place, chords, disk.flat, of_source)
        sides.append(Side(chords, splits, start, middle, place.arc))
    source, target = sides
    table = fill(source, target, windows, stretch)
    cost, found = wholes(source, target, windows, table, stretch)
    answers = []
    for row in _minima(cost):
        rows = follow(source, target, windows, table, *found[row])
        answers.append(_correspondence(levels, positions, rows, float(cost[row])))
    return answers


def _minima(cost: _Floats) -> list[int]:
    """Rows where the cost is finite and no neighbour's is smaller, the cheapest first."""
    cost = np.round(cost / SAME)
    low = np.isfinite(cost) & (cost <= np.roll(cost, 1)) & (cost < np.roll(cost, -1))
    if not low.any() and np.isfinite(cost).any():
        return [int(np.argmin(cost))]
    return [int(row) for row in np.argsort(cost, kind="stable") if low[row]]


def _correspondence(
    levels: tuple[Level, Level], positions: tuple[Positions, Positions], rows: NDArray[np.int64], cost: float
) -> Correspondence:
    """Number the nodes that the triangles use along the source."""
    used, place = np.unique(rows[:, :3], return_index=True)
    partner = rows[:, 3:].ravel()[place]
    triangles = np.searchsorted(used, rows[:, :3])
    p, q = positions
    v, w = (
        np.where(place.vertex[at] < 0, -1, level.kept[place.vertex[at]])
        for place, level, at in zip(positions, levels, (used, partner), strict=True)
    )
    return Correspondence(p.arc[used], q.arc[partner], v, w, p.points[used], q.points[partner], triangles, cost)
