"""Spines, pivots, correspondences, and triangulations of least cost."""

from functools import cache
from itertools import product
from typing import Any

import numpy as np
import oracle
import pytest
from numpy.typing import NDArray

from tween import Curve, NotSelfOverlappingError, Triangulation, decompose, triangulate
from tween.errors import IncompatibleError
from tween.gallery import curve, letter, random_disk
from tween.morphing.alignment import Alignment, align
from tween.triangulating.costs import distortion

EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]
PAIRS = [
    ("arrow", "ell"),
    ("horseshoe", "loop"),
    ("two_disks", "five_disks"),
    ("comb", "winding_3"),
    ("pretzel", "convex"),
    ("spiral_2", "three_lobes"),
    ("e", "l"),
    ("Q", "c"),
]
every_pair = pytest.mark.parametrize("pair", PAIRS, ids="-".join)


def shape(name: str) -> Curve:
    return letter(name) if len(name) == 1 else curve(name)


@cache
def aligned(pair: tuple[str, str]) -> Alignment:
    return align(*map(shape, pair))


def filled(c: Curve, n: int) -> Triangulation:
    return triangulate(c if len(c) == n else c.insert_vertices(n))


def key(T: Triangulation) -> oracle.Triangles:
    return oracle.as_set(T.triangles)


def corners(T: Triangulation, rows: NDArray[np.int64]) -> list[frozenset[int]]:
    return [frozenset(T.triangles[t].tolist()) for t in rows]


# Alignments


def naive_pivots(T: Triangulation) -> list[int]:
    """Return the vertices of the two ends of the spine that no other triangle has."""
    rest = oracle.spine(T.triangles)
    return [min(rest[i] - rest[j]) for i, j in ((0, 1), (-1, -2))]


def naive_crossings(S: Triangulation, T: Triangulation, shift: int) -> int:
    """Count the pairs of diagonals, those of S renumbered, whose ends interleave."""
    (a, b), (c, d) = (np.sort(x, axis=1).T for x in ((S.diagonals + shift) % len(S), T.diagonals))
    a, b = a[:, None], b[:, None]
    return int(((a < c) & (c < b) & (b < d) | (c < a) & (a < d) & (d < b)).sum())


@every_pair
def test_pivots_match_and_of_the_four_pairings_none_crosses_less(pair: tuple[str, str]) -> None:
    a, n = aligned(pair), max(len(shape(name)) for name in pair)
    S, T = (filled(shape(name), n) for name in pair)
    assert key(a.source) == key(S) and key(a.target.rolled(-a.shift)) == key(T)
    pairings = [(i, (j - i) % n) for i, j in product(naive_pivots(S), naive_pivots(T))]
    assert (a.pivot, a.shift) in pairings
    assert a.crossings == naive_crossings(S, T, a.shift) == min(naive_crossings(S, T, k) for _, k in pairings)
    for U, rows in ((a.source, a.source_spine), (a.target.rolled(-a.shift), a.target_spine)):
        assert corners(U, rows) == oracle.spine(U.triangles)


@every_pair
def test_the_pivot_is_the_free_vertex_of_an_end_of_both_spines(pair: tuple[str, str]) -> None:
    a = aligned(pair)
    for T, rows in ((a.source, a.source_spine), (a.target, a.target_spine)):
        along = corners(T, rows)
        assert a.pivot in (along[0] - along[1]) | (along[-1] - along[-2])


def winding(points: NDArray[np.float64], probes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Say how often the polygon winds about each probe."""
    z = (points[:, None] - probes) @ np.array([1, 1j])
    return np.round(np.angle(np.roll(z, -1, axis=0) / z).sum(axis=0) / (2 * np.pi), 6)


def check_origins(given_: NDArray[np.float64], filled_: Triangulation, origin: NDArray[np.int64]) -> None:
    kept = origin >= 0
    np.testing.assert_array_equal(filled_.points[kept], given_[origin[kept]])
    assert sorted(origin[kept]) == list(range(len(given_)))
    assert (origin[~kept] == -1).all()
    p = oracle.fractions(filled_.points)
    for v in np.flatnonzero(~kept):
        before, after = p[v - 1], p[(v + 1) % len(p)]
        assert oracle.orient2d(before, p[v], after) == 0
        assert sum((p[v][i] - before[i]) * (after[i] - p[v][i]) for i in (0, 1)) > 0
    assert oracle.area(filled_.points) == abs(oracle.area(given_))
    probes = np.random.default_rng(0).uniform(given_.min(axis=0), given_.max(axis=0), (200, 2))
    np.testing.assert_array_equal(winding(filled_.points, probes), np.abs(winding(given_, probes)))


@every_pair
@pytest.mark.parametrize("shifts", ["pivots", 7])
def test_the_vertices_say_where_they_come_from_and_the_inserted_ones_lie_on_edges(
    pair: tuple[str, str], shifts: Any
) -> None:
    source, target = map(shape, pair)
    a = align(source, target, shifts)
    assert len(a.source) == len(a.target) == max(len(source), len(target))
    check_origins(source.points, a.source.validate(), a.source_vertices)
    check_origins(target.points, a.target.validate(), a.target_vertices)


@pytest.mark.parametrize("pair", [("arrow", "ell"), ("ell", "arrow")])
def test_clockwise_points_say_where_they_come_from(pair: tuple[str, str]) -> None:
    clockwise, target = curve(pair[0]).points[::-1], curve(pair[1]).points
    a, b = align(clockwise, target), align(target, clockwise)
    check_origins(clockwise, a.source, a.source_vertices)
    check_origins(clockwise, b.target, b.target_vertices)


def fields(a: Alignment) -> list[Any]:
    """Return all of it but the spines, whose ties are broken by numbers."""
    arrays = [a.source.points, a.target.points, a.source.canonical, a.target.canonical]
    arrays += [a.source_vertices, a.target_vertices]
    return [*(x.tolist() for x in arrays), a.shift, a.pivot, a.crossings]


@every_pair
def test_exchanging_twice_changes_nothing_and_once_agrees_with_the_alignment_the_other_way(
    pair: tuple[str, str],
) -> None:
    there, back = aligned(pair), aligned(pair[::-1])
    exchanged, twice = there.exchanged(), there.exchanged().exchanged()
    assert fields(twice) == fields(there)
    for rows, again, other in (
        (there.source_spine, twice.source_spine, exchanged.target_spine),
        (there.target_spine, twice.target_spine, exchanged.source_spine),
    ):
        assert rows.tolist() == again.tolist() == other.tolist()
    assert exchanged.crossings == naive_crossings(exchanged.source, exchanged.target, 0) == back.crossings
    S, T = back.source, back.target.rolled(-back.shift)
    counts = [naive_crossings(S, T, j - i) for i, j in product(naive_pivots(S), naive_pivots(T))]
    assert (counts.count(min(counts)) == 1) == (pair not in {("two_disks", "five_disks"), ("spiral_2", "three_lobes")})
    if counts.count(min(counts)) == 1:
        assert fields(exchanged) == fields(back)


@pytest.mark.parametrize("shift", [0, 5, -1, 1000])
def test_a_number_is_taken_for_the_shift(shift: int) -> None:
    source, target = curve("arrow"), curve("ell")
    a, n = align(source, target, shift), len(target)
    assert (a.shift, a.pivot) == (shift % n, None)
    np.testing.assert_array_equal(a.target.points, np.roll(target.points, -shift, axis=0))
    assert a.crossings == naive_crossings(filled(source, n), triangulate(target), shift)


def test_triangulations_that_were_given_are_kept() -> None:
    S, T = (decompose(curve(name)).arbitrary("last") for name in ("two_disks", "five_disks"))
    a = align(S, T)
    assert a.source is S
    assert key(a.target.rolled(-a.shift)) == key(T)


@pytest.mark.parametrize("shifts", ["pivots", "all", 3])
def test_a_curve_that_bounds_no_disk_is_refused(shifts: Any) -> None:
    for curves in ((EIGHT, curve("ell")), (curve("ell"), EIGHT)):
        with pytest.raises(NotSelfOverlappingError):
            align(*curves, shifts)


@pytest.mark.parametrize(("n", "seed"), [(3, 0), (5, 7), (8, 5), (12, 2), (16, 5), (16, 2), (24, 3)])
def test_all_renumberings_yield_the_least_distorted_common_triangulation(n: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    S, T = random_disk(n, rng).curve, random_disk(n, rng).curve
    costs = {}
    for shift in range(n):
        moved = np.roll(T.points, -shift, axis=0)
        both = decompose(S, moved)
        if both:
            best = both.optimal(distortion(S.points, moved))
            costs[shift] = sum(oracle.symmetric_dirichlet(S.points, moved, best.triangles))
    assert (not costs) == ((n, seed) == (16, 2))
    if not costs:
        with pytest.raises(IncompatibleError, match=f"no common triangulation under any of {n} renumberings"):
            align(S, T, "all")
        return
    a = align(S, T, "all")
    np.testing.assert_array_equal(a.source.validate().canonical, a.target.validate().canonical)
    assert (a.crossings, a.pivot) == (0, None)
    found = sum(oracle.symmetric_dirichlet(a.source.points, a.target.points, a.source.triangles))
    assert found == pytest.approx(min(costs.values()), rel=1e-9)
    assert a.shift in costs and costs[a.shift] == pytest.approx(min(costs.values()), rel=1e-9)
    np.testing.assert_array_equal(a.target.points, np.roll(T.points, -a.shift, axis=0))


@pytest.mark.slow
def test_where_no_renumbering_allows_a_common_triangulation_the_error_says_what_works() -> None:
    with pytest.raises(IncompatibleError, match=r"under any of 126 renumberings; shifts='pivots' needs none"):
        align(curve("three_lobes"), curve("spiral_2"), "all")
