"""Matching: against exhaustive search, and what a match must not depend on."""

from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from math import inf, sqrt

import numpy as np
import pytest
from oracle import turning_number, valid_triangulations

from tween import gallery
from tween.errors import IncompatibleError
from tween.measuring.certificate import verify
from tween.morphing.matching.match import match
from tween.triangulating.decomposition import decompose

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


def agrees(p, q, candidates):
    """Whether the match has the least energy of all; both may say that there is none."""
    least, a = least_energy(p, q, candidates), match(p, q, candidates=candidates)
    assert a.complete == (least < inf)
    if a.complete:
        check(a)
        assert a.exact
        assert a.energy == pytest.approx(least, rel=1e-9)
    return a.complete


@pytest.mark.parametrize("n", range(3, 8))
def test_without_candidates_no_correspondence_and_triangulation_has_less_energy(n):
    rng = np.random.default_rng(1000 + n)
    assert sum(agrees(random_curve(rng, n), random_curve(rng, n), 0) for _ in range(28)) >= 20


@pytest.mark.parametrize("sizes", [(3, 3), (3, 4), (4, 4), (5, 3), (5, 4)])
def test_with_candidates_no_insertion_has_less_energy_either(sizes):
    rng = np.random.default_rng(2000 + 10 * sizes[0] + sizes[1])
    assert sum(agrees(random_curve(rng, sizes[0]), random_curve(rng, sizes[1]), 1) for _ in range(12)) == 12


@pytest.mark.parametrize("name", ["arrow", "horseshoe", "spiral_1", "two_disks"])
@pytest.mark.parametrize("n", [16, 20])
def test_no_other_disk_of_a_curve_that_bounds_two_matches_better(name, n):
    two, other = coarse("two_disks", n), coarse(name, n, start=5)
    assert len(list(decompose(two).immersions())) == 2
    agrees(two, other, 0)


def coarse(name, n, start=0):
    """A curve of the gallery with n of its vertices and even coordinates."""
    points = gallery.curve(name).points
    p = np.roll(2 * np.round(100 * points / np.ptp(points)), -start, axis=0)
    return p[np.round(np.arange(n) * len(p) / n).astype(int)]


# What a match must not depend on

PAIRS = [("arrow", "horseshoe"), ("two_disks", "ess"), ("P", "U"), ("comb", "spiral_2")]


def points_of(name):
    return (gallery.letter(name) if len(name) == 1 else gallery.curve(name)).points


@pytest.fixture(params=PAIRS, ids="-".join)
def pair(request):
    return [points_of(name) for name in request.param]


@pytest.fixture
def rng():
    return np.random.default_rng(14)


def similar(points, rng):
    """Moved, turned and scaled, and cut open elsewhere."""
    z = points @ [1, 1j] * rng.uniform(0.1, 10) * np.exp(1j * rng.uniform(0, 7)) + complex(*rng.normal(size=2))
    return np.roll(np.stack([z.real, z.imag], axis=1), rng.integers(len(points)), axis=0)


def test_the_energy_depends_on_no_start_no_similarity_and_no_order(pair, rng):
    p, q = pair
    a = match(p, q)
    check(a)
    assert match(q, p).energy == pytest.approx(a.energy, rel=1e-9)
    assert match(similar(p, rng), q).energy == pytest.approx(a.energy, rel=1e-9)
    assert match(p, similar(q, rng)).energy == pytest.approx(a.energy, rel=1e-9)


@pytest.mark.parametrize("exponent", [-190, -70, 70, 190])
def test_powers_of_two_change_no_bit_of_a_match(exponent):
    source, target = gallery.pair("arrow_to_horseshoe")
    plain = match(source, target)
    scaled = match(source.points * 2.0**exponent, target.points * 2.0**exponent)
    assert scaled.energy == plain.energy
    assert np.array_equal(scaled.source.points, plain.source.points * 2.0**exponent)
    assert np.array_equal(scaled.target.points, plain.target.points * 2.0**exponent)


def test_the_match_the_other_way_is_the_same_match(pair):
    p, q = pair
    a, b = match(p, q), match(q, p)
    nodes = [set(zip(m.source_arc, m.target_arc, strict=True)) for m in (a, b)]
    assert nodes[0] == {(y, x) for x, y in nodes[1]}


def test_a_curve_and_its_image_have_the_least_energy_and_each_vertex_its_own(pair, rng):
    for p in pair:
        start = int(rng.integers(len(p)))
        z = p @ [1, 1j] * 3 * np.exp(1j * rng.uniform(0, 7))
        a = match(p, np.roll(np.stack([z.real, z.imag], axis=1), -start, axis=0))
        check(a)
        assert a.energy == pytest.approx(4, abs=1e-9)
        ahead = set(((a.source_vertices - a.target_vertices) % len(p)).tolist())
        assert len(ahead) == 1 and (ahead.pop() - start) % len(p) in symmetries(p)


@pytest.mark.parametrize("name", ["arrow", "ell", "ess", "R", "g", "spiral_1", "two_disks", "comb"])
def test_vertices_moved_a_little_find_themselves(name, rng):
    """Or, where half a turn brings the curve back to itself, each its image under that."""
    p = points_of(name)
    gap = np.hypot(*(np.roll(p, -1, axis=0) - p).T).min()
    start = int(rng.integers(len(p)))
    q = np.roll(p + rng.normal(scale=0.05 * gap, size=p.shape), -start, axis=0)
    a = match(p, q)
    check(a)
    both = (a.source_vertices >= 0) & (a.target_vertices >= 0)
    ahead = (a.target_vertices[both] + start - a.source_vertices[both]) % len(p)
    turned = len(p) // 2 if name in ("ess", "two_disks") else 0
    assert max(np.sum(ahead == 0), np.sum(ahead == turned)) >= 0.99 * len(p)


@pytest.mark.parametrize("turn", [0.0, 0.4, -1.2])
@pytest.mark.parametrize("name", ["ess", "square"])
def test_a_symmetric_curve_turns_no_more_than_it_must(name, turn):
    p = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]) if name == "square" else points_of(name)
    z = p @ [1, 1j] * 2 * np.exp(1j * turn)
    a = match(p, np.stack([z.real, z.imag], axis=1))
    quarters = round(turn / (np.pi / 2)) if name == "square" else 0
    assert (a.target_vertices == (a.source_vertices - quarters) % len(p)).all()


def symmetries(p):
    """Renumberings under which a curve is its own image, or nearly."""
    z = p @ [1, 1j]
    z = (z - z.mean()) / np.linalg.norm(z - z.mean())
    return [k for k in range(len(z)) if abs(np.vdot(z, np.roll(z, -k))) > 1 - 1e-3]


ASTRAY = {"convex": "on a smooth oval, places beside a vertex match better than the vertex that was moved"}


@pytest.mark.slow
def test_on_all_curves_but_one_99_of_100_moved_vertices_find_themselves(rng):
    found = total = 0
    for name in [*gallery.names(), *gallery.letters()]:
        p = points_of(name)
        gap = np.hypot(*(np.roll(p, -1, axis=0) - p).T).min()
        a = match(p, p + rng.normal(scale=0.05 * gap, size=p.shape))
        check(a)
        both = (a.source_vertices >= 0) & (a.target_vertices >= 0)
        ahead = (a.target_vertices[both] - a.source_vertices[both]) % len(p)
        if name not in ASTRAY:
            found += max(np.sum(ahead == k) for k in symmetries(p))
            total += len(p)
    assert found >= 0.99 * total


# Landmarks, triangulations, and what has no common triangulation


def test_landmarks_are_kept_and_cost_energy(pair):
    p, q = pair
    free = match(p, q)
    used = np.flatnonzero((free.source_vertices >= 0) & (free.target_vertices >= 0))
    i, j = free.source_vertices[used[0]], (free.target_vertices[used[0]] + 2) % len(q)
    try:
        a = match(p, q, landmarks=[(i, j)])
    except IncompatibleError as error:
        assert f"({i}, {j})" in str(error)
        return
    check(a)
    assert (i, j) in set(zip(a.source_vertices, a.target_vertices, strict=True))


def test_landmarks_that_the_free_match_has_change_nothing(pair):
    free = match(*pair)
    used = np.flatnonzero((free.source_vertices >= 0) & (free.target_vertices >= 0))[::7]
    landmarks = list(zip(free.source_vertices[used].tolist(), free.target_vertices[used].tolist(), strict=True))
    a = match(*pair, landmarks=landmarks)
    check(a)
    assert set(landmarks) <= set(zip(a.source_vertices, a.target_vertices, strict=True))


def test_a_triangulation_says_which_disk_is_meant():
    curve = gallery.curve("two_disks")
    disks = decompose(curve).immersions()
    assert len(disks) == 2
    for k, T in enumerate(disks):
        assert match(T, T).energy == pytest.approx(4, abs=1e-9)
        assert match(T, disks[1 - k]).energy > 4.1
        a = match(curve, T)
        assert a.energy == pytest.approx(4, abs=1e-9)
        assert (a.source_disk, a.target_disk) == (k, 0)
