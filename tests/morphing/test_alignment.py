"""Spines, pivots, correspondences, and triangulations of least cost."""

import sys
from collections.abc import Callable
from functools import cache
from itertools import combinations, pairwise, product
from typing import Any
from unittest.mock import Mock

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from strategies import convex_triangulations, disks, random_polygons

from tween import Alignment, Curve, NotSelfOverlappingError, Triangulation, align, decompose, morph, triangulate
from tween.errors import IncompatibleError
from tween.gallery import curve, letter, names, random_disk
from tween.morphing.alignment import common
from tween.morphing.incompatible.pivots import pivot_vertex, spine
from tween.triangulating.costs import distortion
from tween.triangulating.table import is_small

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


# Spines


def naive_spine(T: Triangulation) -> list[frozenset[int]]:
    """Prune as the paper says, looking at every leaf anew each time; returns the corners of what is left.

    "First a leaf node that is closest (in terms of number of hops) to an internal node is identified.  This leaf
    node and all the edges in its path to the internal node are removed. [...] repeated until there are only two
    leaf nodes left".  Of equally close leaves the one with the smaller corners goes.
    """
    nodes = [frozenset(t) for t in T.triangles.tolist()]
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


def corners(T: Triangulation, rows: NDArray[np.int64]) -> list[frozenset[int]]:
    return [frozenset(T.triangles[t].tolist()) for t in rows]


def check_spine(T: Triangulation) -> None:
    found = spine(T)
    assert corners(T, found) == naive_spine(T)
    dual = {frozenset(edge) for edge in T.dual.tolist()}
    assert all(frozenset(step) in dual for step in pairwise(found.tolist()))
    degree = np.bincount(T.dual.ravel(), minlength=len(T.triangles))
    assert (degree[found[[0, -1]]] == (1 if len(found) > 1 else 0)).all()


@given(st.one_of(convex_triangulations(16), disks(3, 40)))
def test_the_spine_is_what_pruning_as_printed_leaves(T: Triangulation) -> None:
    check_spine(T)


@pytest.mark.parametrize("name", names())
def test_gallery_curves_have_the_spine_that_pruning_as_printed_leaves(name: str) -> None:
    check_spine(triangulate(curve(name)))


@pytest.mark.parametrize("seed", range(3))
def test_uniform_triangulations_have_the_spine_that_pruning_as_printed_leaves(seed: int) -> None:
    c = triangulate(random_disk(50, np.random.default_rng(seed))).on_disk("uniform").curve
    for T in decompose(c).sample(np.random.default_rng(seed), 20):
        check_spine(T)


@given(disks(3, 40), st.data())
def test_the_spine_and_its_pivots_do_not_depend_on_the_list(T: Triangulation, data: st.DataObject) -> None:
    order = data.draw(st.permutations(range(len(T.triangles))))
    S = Triangulation(T.points, [np.roll(T.triangles[t], i) for i, t in enumerate(order)])
    assert corners(S, spine(S)) == corners(T, spine(T))
    assert [pivot_vertex(S, t) for t in spine(S)[[0, -1]]] == [pivot_vertex(T, t) for t in spine(T)[[0, -1]]]


def test_one_triangle_and_two_are_their_own_spine() -> None:
    one = Triangulation([(0, 0), (1, 0), (0, 1)], [(1, 2, 0)])
    two = Triangulation([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 2, 3), (0, 1, 2)])
    assert (spine(one).tolist(), pivot_vertex(one, 0)) == ([0], 0)
    assert (spine(two).tolist(), [pivot_vertex(two, t) for t in spine(two)]) == ([1, 0], [1, 3])


@given(disks(4, 40))
def test_a_pivot_is_the_corner_of_an_end_that_its_neighbour_lacks(T: Triangulation) -> None:
    every = corners(T, np.arange(len(T.triangles)))
    degree = np.bincount(T.dual.ravel())
    for t in np.flatnonzero(degree == 1):
        (neighbour,) = [other for other in every if len(other & every[t]) == 2]
        assert {pivot_vertex(T, int(t))} == every[t] - neighbour


# Alignments


def naive_pivots(T: Triangulation) -> list[int]:
    """Return the vertices of the two ends of the spine that no other triangle has."""
    rest = naive_spine(T)
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
        assert corners(U, rows) == naive_spine(U)


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


# All renumberings


def symmetric_dirichlet(points: NDArray[np.float64], images: NDArray[np.float64], triangles: Any) -> list[float]:
    """Return the distortion of each triangle by the singular values of its map, areas scaled to 1."""
    p, q = (x / np.sqrt(float(oracle.area(x))) for x in (points, images))
    energies = []
    for i, j, k in triangles:
        P, Q = (np.column_stack([x[j] - x[i], x[k] - x[i]]) for x in (p, q))
        s = np.linalg.svd(Q @ np.linalg.inv(P), compute_uv=False)
        area, image = abs(np.linalg.det(P)) / 2, abs(np.linalg.det(Q)) / 2
        energies.append(float(area * (s**2).sum() + image * (s**-2.0).sum()))
    return energies


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
            costs[shift] = sum(symmetric_dirichlet(S.points, moved, best.triangles))
    assert (not costs) == ((n, seed) == (16, 2))
    if not costs:
        with pytest.raises(IncompatibleError, match=f"no common triangulation under any of {n} renumberings"):
            align(S, T, "all")
        return
    a = align(S, T, "all")
    np.testing.assert_array_equal(a.source.validate().canonical, a.target.validate().canonical)
    assert (a.crossings, a.pivot) == (0, None)
    found = sum(symmetric_dirichlet(a.source.points, a.target.points, a.source.triangles))
    assert found == pytest.approx(min(costs.values()), rel=1e-9)
    assert a.shift in costs and costs[a.shift] == pytest.approx(min(costs.values()), rel=1e-9)
    np.testing.assert_array_equal(a.target.points, np.roll(T.points, -a.shift, axis=0))


@pytest.mark.slow
def test_where_no_renumbering_allows_a_common_triangulation_the_error_says_what_works() -> None:
    with pytest.raises(IncompatibleError, match=r"under any of 126 renumberings; shifts='pivots' needs none"):
        align(curve("three_lobes"), curve("spiral_2"), "all")


# Distortion


def sheared(points: NDArray[np.float64]) -> NDArray[np.float64]:
    return points @ np.array([[1.3, 0.4], [-0.7, 0.8]])


@given(disks(3, 20))
def test_distortion_is_the_energy_of_the_singular_values_and_symmetric(T: Triangulation) -> None:
    for image in (T.on_disk("uniform").points, sheared(T.points), 7 * T.points[:, ::-1] * [1, -1]):
        cost = distortion(T.points, image)(T.triangles)
        np.testing.assert_allclose(cost, symmetric_dirichlet(T.points, image, T.triangles), rtol=1e-6)
        np.testing.assert_allclose(cost, distortion(image, T.points)(T.triangles), rtol=1e-9)
        areas = Triangulation(T.points, T.triangles).areas / float(oracle.area(T.points))
        images = Triangulation(image, T.triangles).areas / float(oracle.area(image))
        assert (cost >= 2 * (areas + images) * (1 - 1e-9)).all()


@given(disks(3, 20), st.floats(0.01, 100), st.floats(-3, 3))
def test_similar_shapes_are_not_distorted(T: Triangulation, scale: float, angle: float) -> None:
    turn = scale * np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    cost = distortion(T.points, T.points @ turn + [3, -1])(T.triangles)
    np.testing.assert_allclose(cost, 4 * T.areas / T.areas.sum(), rtol=1e-6)
    assert cost.sum() == pytest.approx(4, rel=1e-6)


# Least cost


def random_costs(points: NDArray[np.float64]) -> Callable[[Any], Any]:
    table = np.random.default_rng(len(points)).normal(size=[len(points)] * 3)
    return lambda triangles: table[tuple(np.asarray(triangles).T)]


def longest_sides(points: NDArray[np.float64]) -> Callable[[Any], Any]:
    return lambda triangles: np.ptp(points[np.asarray(triangles)], axis=1).max(axis=1)


def to_a_parabola(points: NDArray[np.float64]) -> Callable[[Any], Any]:
    x = np.arange(len(points), dtype=np.float64)
    return distortion(points, np.stack([x, x * x], axis=1))


@pytest.mark.parametrize("combine", ["sum", "max"])
@pytest.mark.parametrize("kind", ["scatter", "winding", "grid", "disk", "strip"])
def test_the_optimum_is_the_least_over_all_triangulations(kind: str, combine: Any) -> None:
    optima = 0
    for points in random_polygons(kind, 90, seed=8):
        c = Curve(points)
        truth = oracle.valid_triangulations(c.points)
        if not truth:
            continue
        for costs in (random_costs, longest_sides, to_a_parabola):
            cost = Mock(wraps=costs(c.points))
            T = decompose(c).optimal(cost, combine)
            ((asked,), _) = cost.call_args_list[0]
            assert cost.call_count == 1
            assert sorted(map(tuple, asked.tolist())) == sorted(set().union(*truth))
            total = {t: getattr(cost(sorted(t)), combine)() for t in truth}
            assert key(T.validate()) in truth
            assert total[key(T)] == pytest.approx(min(total.values()), rel=1e-12)
        optima += len(truth) > 1
    assert optima >= 5


def test_costs_are_asked_for_in_blocks_without_changing_the_optimum(monkeypatch: pytest.MonkeyPatch) -> None:
    d = decompose(curve("two_loops"))
    whole = d.optimal(random_costs(d.curves[0].points))
    for block in (1, 7, 1000):
        monkeypatch.setattr("tween.decomposition._AT_ONCE", block)
        cost = Mock(wraps=random_costs(d.curves[0].points))
        assert d.optimal(cost).triangles.tolist() == whole.triangles.tolist()
        assert max(len(asked) for (asked,), _ in cost.call_args_list) <= block


@pytest.mark.parametrize("combine", ["sum", "max"])
@pytest.mark.parametrize("value", [0.0, 1.0, float("inf"), float("-inf")])
def test_of_equally_good_splits_the_smallest_apex_is_taken(value: float, combine: Any) -> None:
    d = decompose(curve("horseshoe"))
    T = d.optimal(lambda triangles: np.full(len(triangles), value), combine)
    assert key(T) == key(d.arbitrary("first"))


@pytest.mark.parametrize(
    ("cost", "combine", "message"),
    [
        (lambda t: np.where(t[:, 1] == 1, np.nan, 1.0), "sum", "expected .* numbers, none of them NaN"),
        (lambda t: np.ones(len(t) - 1), "sum", r"cost gave shape \(\d+,\), expected \d+ numbers"),
        (lambda t: np.ones((len(t), 1)), "max", r"cost gave shape \(\d+, 1\), expected \d+ numbers"),
        (lambda t: 1.0, "sum", r"cost gave shape \(\), expected \d+ numbers"),
        (lambda t: np.ones(len(t)), "mean", "combine is 'mean', expected 'sum' or 'max'"),
    ],
)
def test_costs_that_are_no_numbers_are_refused(cost: Any, combine: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        decompose(curve("arrow")).optimal(cost, combine)


def test_a_curve_without_a_triangulation_has_no_optimum() -> None:
    with pytest.raises(NotSelfOverlappingError, match="turning number is 0, not 1"):
        decompose(EIGHT).optimal(lambda triangles: np.ones(len(triangles)))


# What "auto" takes upon itself


def test_of_many_vertices_auto_tries_one_correspondence(monkeypatch: pytest.MonkeyPatch) -> None:
    pair = curve("arrow"), letter("c")  # common triangulations, but not as the pivots have it
    assert not morph(*pair).events
    monkeypatch.setattr(sys.modules["tween.morphing.strategy"], "_MOST_RENUMBERED", 20)
    assert morph(*pair).events
    assert not morph(*pair, strategy="common").events


def test_between_large_convex_polygons_auto_flips_rather_than_fills_the_memory() -> None:
    angle = 2 * np.pi * np.arange(600) / 600
    wide = np.stack([2 * np.cos(angle), np.sin(angle)], axis=1)
    egg = np.stack([np.cos(angle), 1.5 * np.sin(angle) + 0.1 * np.cos(3 * angle)], axis=1)
    m = morph(wide, egg)
    assert m.events
    np.testing.assert_array_equal(m(1.0), m.target.points)


def test_how_many_pairs_hold_is_known_without_finding_them_all() -> None:
    polygon = np.array([[0, 0], [2, 0], [3, 1], [2, 3], [0, 2]], dtype=float)
    for most in range(12):
        assert is_small(polygon[None], most) == (most >= 10)  # every two of five vertices see each other
    T = triangulate(polygon)
    assert common(T, T, most=9) is None
    assert common(T, T, most=10) is not None
