"""Brute force in exact arithmetic, written to be obviously right.  Imports nothing of tween.

Legend: ``a b c d`` points, pairs of exact numbers; a *triangulation* is a frozenset of triples i < k < j.
"""

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import cache
from itertools import combinations, pairwise
from math import comb, lcm
from typing import Any

import numpy as np
from numpy.typing import NDArray

Point = tuple[Any, Any]
Triple = tuple[int, int, int]
Triangles = frozenset[Triple]


def fractions(points: Iterable[Iterable[float]]) -> list[Point]:
    """Return the given doubles without any rounding."""
    return [(Fraction(float(x)), Fraction(float(y))) for x, y in points]


def integers(points: Iterable[Iterable[float]]) -> list[Point]:
    """Return the points times a common factor that makes all of them whole: same signs, less time."""
    exact = fractions(points)
    factor = lcm(*(x.denominator for point in exact for x in point))
    return [(int(x * factor), int(y * factor)) for x, y in exact]


def sign(x: Any) -> int:
    return (x > 0) - (x < 0)


# Predicates


def orient2d(a: Point, b: Point, c: Point) -> int:
    return sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def incircle(a: Point, b: Point, c: Point, d: Point) -> int:
    """Return the sign of the 3 by 3 determinant of the points lifted to a paraboloid, d being the origin."""
    (p, q, r), (s, t, u), (v, w, x) = [
        (e[0] - d[0], e[1] - d[1], (e[0] - d[0]) ** 2 + (e[1] - d[1]) ** 2) for e in (a, b, c)
    ]
    return sign(p * (t * x - u * w) - q * (s * x - u * v) + r * (s * w - t * v))


def meet(a: Point, b: Point, c: Point, d: Point) -> str:
    """Say how the segments ab and cd meet: "cross" (at one point inside both), "touch", or "" (not at all).

    Solves a + s (b - a) = c + t (d - c); parallel segments are compared along their common line.
    """
    u, v, w = (b[0] - a[0], b[1] - a[1]), (d[0] - c[0], d[1] - c[1]), (c[0] - a[0], c[1] - a[1])
    det = u[0] * v[1] - u[1] * v[0]
    if det:
        s, t = Fraction(w[0] * v[1] - w[1] * v[0], det), Fraction(w[0] * u[1] - w[1] * u[0], det)
        return "cross" if 0 < s < 1 and 0 < t < 1 else "touch" if 0 <= s <= 1 and 0 <= t <= 1 else ""
    if u[0] * w[1] != u[1] * w[0]:
        return ""
    along = [x * u[0] + y * u[1] for x, y in (a, b, c, d)]
    return "touch" if max(along[2:]) >= along[0] and min(along[2:]) <= along[1] else ""


# Polygons


def pseudo_angle(x: Any, y: Any) -> Fraction:
    """Return a number from 0 to 4 that grows with the direction's angle; opposite directions differ by 2."""
    share = Fraction(y, abs(x) + abs(y))
    return share % 4 if x >= 0 else 2 - share


def turns(points: Sequence[Point]) -> list[Fraction]:
    """Return the exact turn at the start of each edge, between -2 and 2 (a half turn); 2 is a spike."""
    edges = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(points, [*points[1:], points[0]], strict=True)]
    angles = [pseudo_angle(*edge) for edge in edges]
    return [2 - (2 - (angle - before)) % 4 for before, angle in zip([angles[-1], *angles[:-1]], angles, strict=True)]


def is_polygon(points: Iterable[Iterable[float]]) -> bool:
    """Say whether the points are a closed polygon without edges of zero length and without spikes."""
    p = integers(points)
    return len(p) >= 3 and all(a != b for a, b in zip(p, [*p[1:], p[0]], strict=True)) and 2 not in turns(p)


def turning_number(points: Iterable[Iterable[float]]) -> int:
    total = sum(turns(integers(points))) / 4
    assert total.denominator == 1
    return int(total)


def area(points: Iterable[Iterable[float]]) -> Fraction:
    p = fractions(points)
    return sum((a[0] * b[1] - a[1] * b[0] for a, b in zip(p, [*p[1:], p[0]], strict=True)), Fraction(0)) / 2


def crossings(points: Iterable[Iterable[float]]) -> dict[tuple[int, int], bool]:
    """Return the pairs of edges that meet, neighbours left out: True for those that cross inside both."""
    p = integers(points)
    n = len(p)
    pairs = [(i, j) for i, j in combinations(range(n), 2) if j - i not in (1, n - 1)]
    found = {(i, j): meet(p[i], p[i + 1], p[j], p[(j + 1) % n]) for i, j in pairs}
    return {pair: how == "cross" for pair, how in found.items() if how}


# Triangulations


@cache
def triangulations(n: int) -> tuple[Triangles, ...]:
    """Return all triangulations of a polygon of n vertices, Catalan(n-2) many."""

    @cache
    def between(i: int, j: int) -> list[Triangles]:
        if j == i + 1:
            return [frozenset()]
        return [
            left | right | {(i, k, j)} for k in range(i + 1, j) for left in between(i, k) for right in between(k, j)
        ]

    return tuple(between(0, n - 1))


def catalan(k: int) -> int:
    """Return how many triangulations a convex polygon of k + 2 vertices has."""
    return comb(2 * k, k) // (k + 1)


def valid_triangulations(points: Iterable[Iterable[float]]) -> set[Triangles]:
    """Return those all of whose triangles are counter-clockwise; none unless the curve turns exactly once."""
    p = integers(points)
    if turning_number(p) != 1:
        return set()
    left = {ijk for ijk in combinations(range(len(p)), 3) if orient2d(*(p[v] for v in ijk)) > 0}
    return {triangles for triangles in triangulations(len(p)) if triangles <= left}


def as_set(triangles: Iterable[Iterable[int]]) -> Triangles:
    """Return triangles, as an array lists them, as a triangulation here."""
    triples = [tuple(sorted(int(v) for v in triangle)) for triangle in triangles]
    return frozenset((i, k, j) for i, k, j in triples)


def shifted(triangles: Triangles, k: int, n: int) -> Triangles:
    """Return the triangulation with k added to each vertex."""
    return as_set([[(v + k) % n for v in triangle] for triangle in triangles])


def quadrilaterals(triangles: Iterable[Iterable[int]]) -> dict[tuple[int, int], tuple[int, int]]:
    """Return, for each diagonal (a, b), a < b, the two vertices across: that to its left first."""
    across: dict[tuple[int, int], int] = {}
    for i, j, k in triangles:
        across |= {(int(i), int(j)): int(k), (int(j), int(k)): int(i), (int(k), int(i)): int(j)}
    return {(a, b): (c, across[b, a]) for (a, b), c in across.items() if a < b and (b, a) in across}


def distances(triangles: Iterable[Iterable[int]], start: int) -> list[int]:
    """Return the number of shared edges to step over from one triangle to each of the others."""
    corners = [{int(v) for v in triangle} for triangle in triangles]
    reached, front = {start: 0}, [start]
    for t in front:  # grows on the way
        fresh = [u for u in range(len(corners)) if u not in reached and len(corners[t] & corners[u]) == 2]
        reached |= dict.fromkeys(fresh, reached[t] + 1)
        front += fresh
    return [reached[t] for t in range(len(corners))]


def spine(triangles: Iterable[Iterable[int]]) -> list[frozenset[int]]:
    """Prune as the paper says, looking at every leaf anew each time; returns the corners of what is left.

    "First a leaf node that is closest (in terms of number of hops) to an internal node is identified.  This leaf
    node and all the edges in its path to the internal node are removed. [...] repeated until there are only two
    leaf nodes left".  Of equally close leaves the one with the smaller corners goes.
    """
    nodes = [frozenset(map(int, t)) for t in triangles]
    edges = {frozenset(pair) for pair in combinations(nodes, 2) if len(pair[0] & pair[1]) == 2}

    def near(node: frozenset[int]) -> list[frozenset[int]]:
        return [other for edge in edges if node in edge for other in edge - {node}]

    def way(leaf: frozenset[int]) -> list[frozenset[int]]:
        path = [leaf]
        while len(near(path[-1])) < 3:
            (following,) = set(near(path[-1])) - set(path)
            path.append(following)
        return path

    while len(leaves := [node for node in nodes if len(near(node)) == 1]) > 2:
        shortest = min(map(way, leaves), key=lambda path: (len(path), sorted(path[0])))
        edges -= {frozenset(step) for step in pairwise(shortest)}
    rest = [min(leaves or nodes, key=sorted)]
    while after := set(near(rest[-1])) - set(rest):
        rest += after
    return rest


def symmetric_dirichlet(points: NDArray[np.float64], images: NDArray[np.float64], triangles: Any) -> list[float]:
    """Return the distortion of each triangle by the singular values of its map, areas scaled to 1."""
    p, q = (x / np.sqrt(float(area(x))) for x in (points, images))
    energies = []
    for i, j, k in triangles:
        P, Q = (np.column_stack([x[j] - x[i], x[k] - x[i]]) for x in (p, q))
        s = np.linalg.svd(Q @ np.linalg.inv(P), compute_uv=False)
        size, image = abs(np.linalg.det(P)) / 2, abs(np.linalg.det(Q)) / 2
        energies.append(float(size * (s**2).sum() + image * (s**-2.0).sum()))
    return energies
