"""Twins of half-edges: right, or refused by a message that names an edge; and what can be reached by them."""

from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import given
from strategies import disks

from tween import Triangulation
from tween.errors import TriangulationError
from tween.geometry.half_edges import reached, twins


def test_of_lists_of_triangles_those_that_break_no_rule_for_edges_have_twins() -> None:
    triples = {n: list(permutations(range(n), 3)) for n in (4, 6)}
    lists = [(4, pair) for pair in product(triples[4], repeat=2)]
    for hexagon in ([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)], [(0, 1, 2), (2, 3, 4), (4, 5, 0), (0, 2, 4)]):
        lists += [(6, (*hexagon[:row], other, *hexagon[row + 1 :])) for row in range(4) for other in triples[6]]
    fine = [twins_are_right_or_refused(n, list(triangles)) for n, triangles in lists]
    assert 10 < sum(fine) < len(fine) / 10


def twins_are_right_or_refused(n: int, triangles: list[tuple[int, ...]]) -> bool:
    """Check the twins of a list of triangles, and return whether it has any."""
    edges = [(t[s], t[(s + 1) % 3]) for t in triangles for s in range(3)]
    inner = {edge for edge in edges if (edge[1] - edge[0]) % n != 1}
    fine = len(set(edges)) == len(edges) and {(i, (i + 1) % n) for i in range(n)} <= set(edges)
    fine = fine and inner == {edge[::-1] for edge in inner}
    if fine:
        found = twins(np.array(triangles), n)
        assert found.ravel().tolist() == [edges.index(edge[::-1]) if edge in inner else -1 for edge in edges]
    else:
        with pytest.raises(TriangulationError, match=r"edge|diagonal"):
            twins(np.array(triangles), n)
    return fine


@given(disks())
def test_twins_lie_across_each_other(T: Triangulation) -> None:
    start, end = T.triangles.ravel(), np.roll(T.triangles, -1, axis=1).ravel()
    twin = T.validate().twin.ravel()
    inner = np.flatnonzero(twin >= 0)
    np.testing.assert_array_equal(twin[twin[inner]], inner)
    np.testing.assert_array_equal(start[twin[inner]], end[inner])
    np.testing.assert_array_equal(end[twin[inner]], start[inner])
    outer = np.flatnonzero(twin < 0)
    np.testing.assert_array_equal(np.sort(start[outer]), np.arange(len(T)))
    np.testing.assert_array_equal(end[outer], (start[outer] + 1) % len(T))


def test_without_one_pair_of_twins_the_triangles_fall_into_two_parts() -> None:
    twin = twins(np.array([(0, 1, 2), (0, 2, 4), (2, 3, 4), (0, 4, 5)]), 6)
    assert reached(twin).all()
    twin[2, twin[2] >= 0], twin[1, twin[1] // 3 == 2] = -1, -1
    assert reached(twin).tolist() == [True, True, False, True]
