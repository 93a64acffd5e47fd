"""The table of Shor and Van Wyk: the pairs that hold, and their splits as a graph."""

from collections import Counter
from collections.abc import Iterator
from math import comb

import numpy as np
import oracle
import pytest
from numpy.typing import NDArray
from strategies import parabola, random_polygons

from tween import Curve, Triangulation, TweenError, decompose, triangulate
from tween.gallery import curve
from tween.morphing.alignment import common
from tween.triangulating.flips import locally_delaunay
from tween.triangulating.table.splits import Graph, Table, is_small


def test_too_many_splits_are_refused_before_memory_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    splits = comb(20, 3)  # one for each triple of vertices of a convex polygon
    monkeypatch.setattr("tween.triangulating.table.splits._MOST_SPLITS", splits - 1)
    d = decompose(parabola(20))
    for ask in (lambda: d.optimal(len), lambda: d.sample(np.random.default_rng(0))):
        with pytest.raises(TweenError, match=f"{splits} splits would take 0 GiB"):
            ask()
    d.arbitrary().validate()
    monkeypatch.setattr("tween.triangulating.table.splits._MOST_SPLITS", splits)
    assert decompose(parabola(20)).count == oracle.catalan(18)


def test_a_table_that_would_not_fit_is_refused_with_its_size(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tween.triangulating.table.splits._MOST_PAIRS", 1000)
    angle = 2 * np.pi * np.arange(300) / 300
    d = decompose(np.stack([np.cos(angle), np.sin(angle)], axis=1))
    assert d
    with pytest.raises(TweenError, match="table of 300 vertices would take more than"):
        _ = d.count


def test_how_many_pairs_hold_is_known_without_finding_them_all() -> None:
    polygon = np.array([[0, 0], [2, 0], [3, 1], [2, 3], [0, 2]], dtype=float)
    for most in range(12):
        assert is_small(polygon[None], most) == (most >= 10)  # every two of five vertices see each other
    T = triangulate(polygon)
    assert common(T, T, most=9) is None
    assert common(T, T, most=10) is not None


# Brute force


KINDS = ("scatter", "winding", "grid", "disk", "strip")


def spread(graph: Graph, pair: int) -> list[frozenset[tuple[int, int, int]]]:
    """All triangulations below a pair, by following every split."""
    found = []
    for s in range(graph.first[pair], graph.first[pair + 1]):
        i, j = graph.ends[pair].tolist()
        here = frozenset({(i, int(graph.apex[s]), j)})
        found += [here | a | b for a in spread(graph, graph.left[s]) for b in spread(graph, graph.right[s])]
    return found if graph.first[pair] < graph.first[pair + 1] else [frozenset()]


def tables(kind: str, count: int) -> Iterator[tuple[NDArray[np.float64], Table]]:
    for points in random_polygons(kind, count, seed=11):
        c = Curve(points)
        if c.turning_number == 1:
            yield c.points, Table(c.points[None])


@pytest.mark.parametrize("kind", KINDS)
def test_the_graph_spreads_out_into_exactly_the_triangulations_of_brute_force(kind: str) -> None:
    seen = Counter()
    for points, table in tables(kind, 150):
        truth = oracle.valid_triangulations(points)
        assert table.decomposes == bool(truth)
        seen[bool(truth)] += 1
        if truth:
            found = spread(table.graph, table.graph.whole)
            assert len(found) == len(truth)
            assert set(found) == truth
            assert {oracle.as_set(table.walk(take_last)) for take_last in (False, True)} <= truth
    assert seen[True] > 5


@pytest.mark.parametrize("kind", KINDS)
def test_every_pair_weighs_as_much_as_it_has_triangulations(kind: str) -> None:
    for _, table in tables(kind, 60):
        if table.decomposes:
            mantissas, exponents = table.weights
            assert ((mantissas >= 0.5) & (mantissas < 1)).all()
            counts = [len(spread(table.graph, pair)) for pair in range(table.graph.pairs)]
            assert np.ldexp(mantissas, exponents).tolist() == counts


@pytest.mark.parametrize("name", ["horseshoe", "five_disks", "winding_3"])
def test_children_have_smaller_numbers_and_are_the_pairs_beside_the_apex(name: str) -> None:
    graph = Table(curve(name).points[None]).graph
    parent = np.repeat(np.arange(graph.pairs), np.diff(graph.first))
    assert (np.maximum(graph.left, graph.right) < parent).all()
    i, j = graph.ends[parent].T
    np.testing.assert_array_equal(graph.ends[graph.left], np.stack([i, graph.apex], axis=1))
    np.testing.assert_array_equal(graph.ends[graph.right], np.stack([graph.apex, j], axis=1))
    assert graph.ends[graph.whole].tolist() == [0, len(curve(name)) - 1]


def test_triangles_of_splits_are_the_same_in_one_block_and_in_many() -> None:
    graph = Table(curve("horseshoe").points[None]).graph
    total = len(graph.apex)
    parent = np.repeat(np.arange(graph.pairs), np.diff(graph.first))
    whole = np.stack([graph.ends[parent, 0], graph.apex, graph.ends[parent, 1]], axis=1)
    for block in (1, 7, total):
        parts = [graph.triangles(low, min(low + block, total)) for low in range(0, total, block)]
        np.testing.assert_array_equal(np.concatenate(parts), whole)


@pytest.mark.parametrize("kind", KINDS)
def test_the_delaunay_triangulations_are_those_whose_diagonals_are_locally_delaunay(kind: str) -> None:
    for points, table in tables(kind, 60):
        truth = oracle.valid_triangulations(points)
        if kind == "grid" or not truth:  # of cocircular points, either diagonal is Delaunay, and one is taken
            continue
        legal = {t for t in truth if locally_delaunay(Triangulation(points, sorted(t))).all()}
        assert {oracle.as_set(t) for t in table.delaunay()} == legal


def test_what_two_curves_share_is_what_the_graph_of_both_holds() -> None:
    rng = np.random.default_rng(2)
    shared = 0
    for points in random_polygons("disk", 40, seed=3):
        c, other = Curve(points), Curve(points + 0.2 * rng.normal(size=points.shape))
        if other.turning_number != 1 or other.reversed_input:
            continue
        truth = oracle.valid_triangulations(c.points) & oracle.valid_triangulations(other.points)
        table = Table(np.stack([c.points, other.points]))
        assert table.decomposes == bool(truth)
        if truth:
            assert set(spread(table.graph, table.graph.whole)) == truth
            shared += 1
    assert shared > 5
