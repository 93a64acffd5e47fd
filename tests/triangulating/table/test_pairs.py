"""The kernels of the table, through the classes that call them: least cost, uniform samples, walks."""

from collections import Counter
from collections.abc import Callable
from itertools import combinations
from math import comb
from typing import Any
from unittest.mock import Mock

import numpy as np
import oracle
import pytest
from numpy.typing import NDArray
from scipy.stats import chisquare
from strategies import parabola, random_polygons, strip

from tween import Curve, Decomposition, Triangulation, decompose
from tween.gallery import curve
from tween.triangulating.costs import distortion
from tween.triangulating.table.pairs import find_pair, find_pairs
from tween.triangulating.table.splits import Table


def key(T: Triangulation) -> oracle.Triangles:
    return oracle.as_set(T.triangles)


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


@pytest.mark.parametrize("combine", ["sum", "max"])
@pytest.mark.parametrize("value", [0.0, 1.0, float("inf"), float("-inf")])
def test_of_equally_good_splits_the_smallest_apex_is_taken(value: float, combine: Any) -> None:
    d = decompose(curve("horseshoe"))
    T = d.optimal(lambda triangles: np.full(len(triangles), value), combine)
    assert key(T) == key(d.arbitrary("first"))


def test_costs_are_asked_for_in_blocks_without_changing_the_optimum(monkeypatch: pytest.MonkeyPatch) -> None:
    d = decompose(curve("two_loops"))
    whole = d.optimal(random_costs(d.curves[0].points))
    for block in (1, 7, 1000):
        monkeypatch.setattr("tween.triangulating.table.splits._AT_ONCE", block)
        cost = Mock(wraps=random_costs(d.curves[0].points))
        assert d.optimal(cost).triangles.tolist() == whole.triangles.tolist()
        assert max(len(asked) for (asked,), _ in cost.call_args_list) <= block


# Samples and walks


def test_the_first_split_takes_the_smallest_apex_and_the_last_the_largest() -> None:
    d = decompose(parabola(6))
    assert key(d.arbitrary("first")) == {(0, 1, 5), (1, 2, 5), (2, 3, 5), (3, 4, 5)}
    assert key(d.arbitrary("last")) == {(0, 4, 5), (0, 3, 4), (0, 2, 3), (0, 1, 2)}


def counted(d: Decomposition, draws: int, seed: int) -> list[int]:
    """Return how often each triangulation was drawn, those that never were included."""
    seen = Counter(T.canonical.tobytes() for T in d.sample(np.random.default_rng(seed), draws))
    assert len(seen) <= d.count
    return list(seen.values()) + [0] * (d.count - len(seen))


def overlapping() -> Curve:
    """Return a strip around the origin that lies over its own start, with some hundreds of triangulations."""
    angles = np.radians(55) * np.arange(9)
    return Curve(strip(angles, np.linspace(0.3, 0.5, 9), np.linspace(1, 1.5, 9)))


@pytest.mark.parametrize(
    "c", [Curve(parabola(8)), Curve(parabola(9)), overlapping()], ids=["132", "429", "overlapping"]
)
def test_samples_are_uniform(c: Curve) -> None:
    d = decompose(c)
    assert 100 < d.count < 1000
    assert chisquare(counted(d, 30 * d.count, seed=6)).pvalue > 0.001


def test_the_overlapping_curve_crosses_itself() -> None:
    assert overlapping().crossings.proper.sum() >= 2


def test_counts_beyond_all_doubles_are_sampled_too() -> None:
    d = decompose(parabola(600))
    first, second = d.sample(np.random.default_rng(0), 2)
    assert key(first.validate()) != key(second.validate())


# Pairs


@pytest.mark.parametrize("name", ["horseshoe", "five_disks"])
def test_a_pair_is_found_at_its_place_and_what_does_not_hold_nowhere(name: str) -> None:
    points = curve(name).points
    n = len(points)
    first, last, ends = find_pairs(points[None], 2**28)
    places = {(i, int(ends[p])): p for i in range(n - 1) for p in range(first[i], last[i])}
    assert 2 * n < len(places) < n * (n - 1) // 2
    for i, j in combinations(range(n), 2):
        assert find_pair(first, last, ends, i, j) == places.get((i, j), -1)


def test_rows_of_the_table_are_ascending_and_edges_of_the_curve_hold() -> None:
    points = curve("five_disks").points
    first, last, ends = find_pairs(points[None], 2**28)
    for i in range(len(points) - 1):
        row = ends[first[i] : last[i]]
        assert row[0] == i + 1
        assert (np.diff(row) > 0).all()


@pytest.mark.parametrize("most", [50, 300, 1000])
def test_the_search_for_pairs_gives_up_soon_after_there_are_too_many(most: int) -> None:
    points = parabola(100)  # 4950 pairs hold
    assert most < len(find_pairs(points[None], most)[2]) <= most + 100


# Counting in floats


@pytest.mark.parametrize("n", [3, 10, 100, 600])
def test_weights_beyond_all_doubles_are_those_of_exact_counting(n: int) -> None:
    table = Table(parabola(n)[None])
    mantissa, exponent = (float(x[table.graph.whole]) for x in table.weights)
    exact = comb(2 * n - 4, n - 2) // (n - 1)
    shift = max(0, exact.bit_length() - 60)
    assert 0.5 <= mantissa < 1
    assert np.ldexp(mantissa, int(exponent) - shift) == pytest.approx(exact >> shift, rel=1e-12)
