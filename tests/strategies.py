"""Shapes to test with: hypothesis strategies, and seeded random polygons for large samples."""

from collections.abc import Iterator

import numpy as np
import oracle
from hypothesis import strategies as st
from numpy.typing import ArrayLike, NDArray

from tween import Triangulation
from tween.gallery import random_disk
from tween.geometry.predicates import EXACT_RANGE

Points = list[tuple[float, float]]

# Numbers


def in_range(low: float, high: float) -> st.SearchStrategy[float]:
    """Doubles of both signs between two magnitudes, and 0."""
    positive = st.floats(low, high)
    return st.one_of(st.just(0.0), positive, positive.map(lambda x: -x))


unit_doubles = in_range(2.0**-60, 1.0)
exact_doubles = st.one_of(
    in_range(*EXACT_RANGE), unit_doubles, st.sampled_from([s * x for x in EXACT_RANGE for s in (1, -1)])
)


@st.composite
def nudged_grids(draw: st.DrawFn, count: int) -> Points:
    """Places of a small integer grid, at some scale, each moved by a few last bits or not at all."""
    scale, offset = 2.0 ** draw(st.integers(-150, 150)), draw(st.integers(0, 9))

    def coordinate() -> float:
        x, ulps = draw(st.integers(0, 6)) + offset, draw(st.integers(-2, 2))
        return (x + ulps * float(np.spacing(float(x)))) * scale if x else 0.0

    return [(coordinate(), coordinate()) for _ in range(count)]


# Polygons


def _lists(coordinate: st.SearchStrategy[float], low: int, high: int) -> st.SearchStrategy[Points]:
    return st.lists(st.tuples(coordinate, coordinate), min_size=low, max_size=high)


def grid_polygons(low: int = 3, high: int = 12, size: int = 4) -> st.SearchStrategy[Points]:
    """Small integers: collinear triples, overlapping edges and places visited twice abound."""
    return _lists(st.integers(0, size).map(float), low, high).filter(oracle.is_polygon)


def generic_polygons(low: int = 3, high: int = 12) -> st.SearchStrategy[Points]:
    return _lists(unit_doubles, low, high).filter(oracle.is_polygon)


def short_polygons(low: int = 3, high: int = 12) -> st.SearchStrategy[Points]:
    """Doubles with some bits to spare, so that midpoints are exact."""
    short = st.floats(2.0**-10, 1, width=32)
    return _lists(st.one_of(short, short.map(lambda x: -x)), low, high).filter(oracle.is_polygon)


def mirror_polygons(high: int = 6) -> st.SearchStrategy[Points]:
    """Exactly mirror-symmetric: cocircular quadruples abound."""
    return (
        _lists(unit_doubles, 2, high)
        .map(lambda half: half + [(-x, y) for x, y in half[::-1]])
        .filter(oracle.is_polygon)
    )


polygons = st.one_of(grid_polygons(), generic_polygons(), mirror_polygons())


# Triangulations


@st.composite
def convex_triangulations(draw: st.DrawFn, high: int = 12) -> Triangulation:
    """Any triangulation of points on a parabola."""
    n = draw(st.integers(3, high))

    def triangles(i: int, j: int) -> list[tuple[int, int, int]]:
        if j == i + 1:
            return []
        k = draw(st.integers(i + 1, j - 1))
        return [(i, k, j), *triangles(i, k), *triangles(k, j)]

    return Triangulation([(x, x * x) for x in range(n)], triangles(0, n - 1))


def disks(low: int = 3, high: int = 40) -> st.SearchStrategy[Triangulation]:
    """Random immersed disks."""
    seeds = st.tuples(st.integers(low, high), st.integers(0, 2**32 - 1))
    return seeds.map(lambda s: random_disk(s[0], np.random.default_rng(s[1])))


# Named shapes, and large samples


def parabola(n: int) -> NDArray[np.float64]:
    """Return a convex polygon, exactly."""
    x = np.arange(n, dtype=np.float64)
    return np.stack([x, x * x], axis=1)


def strip(angles: NDArray[np.float64], inner: ArrayLike, outer: ArrayLike) -> NDArray[np.float64]:
    """Return the polygon that leads around the origin at the outer radii, and back at the inner ones."""
    rays = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return np.concatenate([rays * np.reshape(outer, (-1, 1)), (rays * np.reshape(inner, (-1, 1)))[::-1]])


def random_polygons(kind: str, count: int, seed: int) -> Iterator[NDArray[np.float64]]:
    """Yield polygons of 4 to 10 vertices.

    "scatter": independent points; "winding": points around the origin, 1 to 3 times, seldom backwards;
    "grid": integers 0 to 3, so that places are visited twice and edges touch; "disk": boundaries of
    immersed disks; "strip": `strip`, about a full turn, so that many overlap themselves.
    """
    rng = np.random.default_rng(seed)
    while count:
        n = int(rng.integers(4, 11))
        if kind == "scatter":
            points = rng.normal(size=(n, 2))
        elif kind == "winding":
            angles = (np.arange(n) + rng.uniform(-0.8, 0.8, n)) * 2 * np.pi * rng.integers(1, 4) / n
            points = rng.uniform(0.2, 1, (n, 1)) * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        elif kind == "grid":
            points = rng.integers(0, 4, (n, 2)).astype(np.float64)
        elif kind == "strip":
            angles = np.cumsum(np.radians(rng.uniform(80, 110, 5)))
            points = strip(angles, rng.uniform(0.2, 0.8, 5), rng.uniform(0.8, 1.6, 5))
        else:
            points = random_disk(n, rng).points
        if oracle.is_polygon(points):
            count -= 1
            yield points
