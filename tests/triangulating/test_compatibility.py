"""Compatible triangulations: the smallest renumbering, and rows matched."""

from collections import Counter
from random import Random

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import convex_triangulations

from tween import Triangulation, compatible_shift
from tween.triangulating.compatibility import match_rows


def convex(n: int, triangles: list[tuple[int, int, int]]) -> Triangulation:
    return Triangulation([(x, x * x) for x in range(n)], triangles)


@pytest.mark.parametrize("n", [3, 4, 5, 6, 7, pytest.param(8, marks=pytest.mark.slow)])
def test_the_smallest_shift_is_found_for_all_pairs_of_triangulations(n: int) -> None:
    points = [(x, x * x) for x in range(n)]
    every = [(triangles, Triangulation(points, sorted(triangles))) for triangles in oracle.triangulations(n)]
    found = Counter()
    for first, T in every:
        smallest = {oracle.shifted(first, k, n): k for k in reversed(range(n))}
        for second, S in every:
            k = compatible_shift(T, S)
            assert k == smallest.get(second)
            found[k is None] += 1
    assert found[False] >= len(every)
    assert found[True] > 0 or n < 6


@given(convex_triangulations(30), st.integers(0, 100))
def test_a_renumbered_triangulation_is_compatible(T: Triangulation, shift: int) -> None:
    n = len(T)
    R = T.rolled(shift)
    k = compatible_shift(R, T)  # vertex i of R is vertex i + shift of T
    assert k is not None and k <= shift % n
    assert oracle.shifted(oracle.as_set(R.triangles), k, n) == oracle.as_set(T.triangles)


def test_triangulations_of_different_sizes_are_not_compatible() -> None:
    square, triangle = convex(4, [(0, 1, 2), (0, 2, 3)]), convex(3, [(0, 1, 2)])
    assert compatible_shift(square, triangle) is compatible_shift(triangle, square) is None


def test_very_high_degrees_do_not_disturb_the_search() -> None:
    n = 56_000  # degrees pass through the numbers that no character has
    x = np.arange(n, dtype=np.float64)
    T = Triangulation(np.stack([x, x * x], axis=1), np.stack([0 * x, x, x + 1], axis=1)[1:-1].astype(int))
    assert compatible_shift(T, T.rolled(5)) == n - 5


@given(convex_triangulations(20), convex_triangulations(20))
def test_a_shift_there_exists_exactly_where_there_is_one_back(S: Triangulation, T: Triangulation) -> None:
    there, back = compatible_shift(S, T), compatible_shift(T, S)
    assert (there is None) == (back is None)
    if there is not None:
        assert oracle.shifted(oracle.as_set(T.triangles), -there % len(T), len(T)) == oracle.as_set(S.triangles)


@given(convex_triangulations(30), st.randoms(use_true_random=False))
def test_rows_are_found_again_whatever_their_order_and_first_corner(T: Triangulation, random: Random) -> None:
    rows = list(range(len(T.triangles)))
    random.shuffle(rows)
    wanted = np.array([np.roll(T.triangles[row], random.randrange(3)) for row in rows])
    found = match_rows(T.triangles, wanted)
    assert found.tolist() == rows
    assert match_rows(wanted, T.triangles)[found].tolist() == list(range(len(rows)))
