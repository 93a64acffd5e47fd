"""Matching: against exhaustive search, and what a match must not depend on."""

from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from math import inf, sqrt

import numpy as np
import pytest
from oracle import turning_number, valid_triangulations

from tween.measuring.certificate import verify
from tween.morphing.matching.match import match

# Exhaustive search: its own code, exact signs, every correspondence written down


class Ring:
    """Vertices and candidates of a curve with whole or half coordinates, in order."""

    def __init__(self, points, candidates):
        n = len(points)
        p = [(Fraction(x), Fraction(y)) for x, y in points]
        area = sum(p[i][0] * p[i - n + 1][1] - p[i - n + 1][0] * p[i][1] for i in range(n)) / 2
        self.scale = 1 / sqrt(area)
        self.points, self.is_vertex = [], []
        for i in range(n):
            a, b = p[i], p[i - n + 1]
            for k in range(candidates + 1):
                t = Fraction(k, candidates + 1)
                self.points.append((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
                self.is_vertex.append(k == 0)

    def next_places(self, x):
        """Positions ahead of x on the same closed edge, counted on beyond the last one."""
        y = x + 1
        while True:
            yield y
            if self.is_vertex[y % len(self.points)]:
                return
            y += 1

    def area(self, i, j, k):
        a, b, c = (self.points[x % len(self.points)] for x in (i, j, k))
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    def corners(self, *places):
        return [complex(*map(float, self.points[x % len(self.points)])) * self.scale for x in places]


def correspondences(S: Ring, T: Ring) -> Iterator[list[tuple[int, int]]]:
    """All lists of nodes that use every vertex of both rings."""

    def go_on(nodes):
        (x, a), end = nodes[-1], (len(S.points), nodes[0][1] + len(T.points))
        for y in S.next_places(x):
            for b in T.next_places(a):
                if (y, b) == end:
                    yield nodes
                elif y < end[0] and b < end[1] and (S.is_vertex[y] or T.is_vertex[b % len(T.points)]):
                    yield from go_on([*nodes, (y, b)])

    for start in range(len(T.points)):
        yield from go_on([(0, start)])


def dirichlet(p, q):
    """Half the sum of cot(angle) * |image of the opposite side|**2."""
    total = 0.0
    for s in range(3):
        u, w = p[s - 1] - p[s], p[s - 2] - p[s]
        cot = (u * w.conjugate()).real / abs((u * w.conjugate()).imag)
        total += 0.5 * cot * abs(q[s - 1] - q[s - 2]) ** 2
    return total


def least_energy(points, others, candidates) -> float:
    S, T = Ring(points, candidates), Ring(others, candidates)

    @cache
    def triangle(i, k, j, a, c, b):
        if S.area(i, k, j) <= 0 or T.area(a, c, b) <= 0:
            return inf
        p, q = S.corners(i, k, j), T.corners(a, c, b)
        return dirichlet(p, q) + dirichlet(q, p)

    @cache
    def between(nodes):
        """Least energy over all triangulations of a run of nodes, its first and last joined by a side."""
        if len(nodes) == 2:
            return 0.0
        (i, a), (j, b) = nodes[0], nodes[-1]
        best = inf
        for m in range(1, len(nodes) - 1):
            cost = triangle(i, nodes[m][0], j, a, nodes[m][1], b)
            if cost < best:
                best = min(best, cost + between(nodes[: m + 1]) + between(nodes[m:]))
        return best

    return min((between(tuple(nodes)) for nodes in correspondences(S, T) if len(nodes) > 2), default=inf)


def random_curve(rng, n):
    """A polygon with small even coordinates that bounds a disk."""
    while True:
        points = 2 * rng.integers(-8, 9, (n, 2))
        try:
            if turning_number(points) == -1:
                points = points[::-1]
            if turning_number(points) == 1 and valid_triangulations(points):
                return points
        except (AssertionError, ZeroDivisionError):
            continue


def check(a):
    """Every rule of a complete match, exactly."""
    assert a.complete
    assert (a.source.triangles == a.target.triangles).all()
    assert verify(a.source.points, a.source.triangles).valid
    assert verify(a.target.points, a.target.triangles).valid
    assert a.energy >= 4.0
    for rows, arc in ((a.source_vertices, a.source_arc), (a.target_vertices, a.target_arc)):
        used = rows[rows >= 0]
        assert (np.sort(used) == np.arange(len(used))).all()
        assert np.sum(np.diff(np.append(arc, arc[0])) < 0) == 1
    assert ((a.source_vertices >= 0) | (a.target_vertices >= 0)).all()


@pytest.mark.parametrize("seed", range(12))
def test_without_candidates_no_correspondence_and_triangulation_has_less_energy(seed):
    rng = np.random.default_rng(seed)
    n = 3 + seed % 5
    p, q = random_curve(rng, n), random_curve(rng, n)
    least, a = least_energy(p, q, 0), match(p, q, candidates=0)
    assert a.complete == (least < inf)
    if a.complete:
        check(a)
        assert a.exact
        assert a.energy == pytest.approx(least, rel=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_with_candidates_no_insertion_has_less_energy_either(seed):
    rng = np.random.default_rng(100 + seed)
    p, q = random_curve(rng, 3 + seed % 2), random_curve(rng, 3 + seed // 2 % 2)
    least, a = least_energy(p, q, 1), match(p, q, candidates=1)
    assert a.complete == (least < inf)
    if a.complete:
        check(a)
        assert a.energy == pytest.approx(least, rel=1e-9)
