"""Spines as pruning as printed leaves them, their pivots, and the pairing of pivots that crosses least."""

from itertools import pairwise, product

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from strategies import convex_triangulations, disks

from tween import Triangulation, decompose, triangulate
from tween.gallery import curve, names, random_disk
from tween.morphing.incompatible.pivots import pivot_shift, pivot_vertex, spine


def corners(T: Triangulation, rows: NDArray[np.int64]) -> list[frozenset[int]]:
    return [frozenset(T.triangles[t].tolist()) for t in rows]


def check_spine(T: Triangulation) -> None:
    found = spine(T)
    assert corners(T, found) == oracle.spine(T.triangles)
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


# The pairing of pivots


def pivots(T: Triangulation) -> list[int]:
    """Return the vertices of the two ends of the spine that no other triangle of it has."""
    along = oracle.spine(T.triangles)
    return [min(along[i] - along[j]) for i, j in ((0, 1), (-1, -2))]


def crossings(S: Triangulation, T: Triangulation, shift: int) -> int:
    """Count the pairs of diagonals, those of S renumbered, whose ends interleave."""
    n, count = len(S), 0
    for (a, b), (c, d) in product(S.diagonals.tolist(), T.diagonals.tolist()):
        a_, b_ = sorted(((a + shift) % n, (b + shift) % n))
        count += (a_ < c < b_) != (a_ < d < b_) and not {a_, b_} & {c, d}
    return count


def two_of_one_size(seed: int) -> list[Triangulation]:
    rng = np.random.default_rng(seed)
    x = np.arange(rng.integers(4, 20), dtype=np.float64)
    return decompose(np.stack([x, x * x], axis=1)).sample(rng, 2)


@pytest.mark.parametrize("seed", range(60))
def test_of_the_four_pairings_of_pivots_the_first_with_fewest_crossings_is_chosen(seed: int) -> None:
    S, T = two_of_one_size(seed)
    pairings = [((j - i) % len(S), i) for i, j in product(pivots(S), pivots(T))]
    counts = [crossings(S, T, shift) for shift, _ in pairings]
    shift, pivot = pivot_shift(S, T)
    assert (shift, pivot) == pairings[counts.index(min(counts))]
    assert (pivot + shift) % len(T) in pivots(T)


def test_the_choice_among_the_pairings_makes_a_difference() -> None:
    spread = 0
    for seed in range(60):
        S, T = two_of_one_size(seed)
        counts = {crossings(S, T, (j - i) % len(S)) for i, j in product(pivots(S), pivots(T))}
        spread += len(counts) > 1
    assert spread > 30


@given(convex_triangulations(16).filter(lambda T: len(T) > 3), st.integers(0, 100))
def test_where_renumbering_keeps_the_spine_nothing_crosses(T: Triangulation, roll: int) -> None:
    S = T.rolled(roll)
    same = {frozenset((v + roll) % len(T) for v in corners) for corners in oracle.spine(S.triangles)}
    if same == set(oracle.spine(T.triangles)):  # equally short branches are pruned by their numbers
        assert crossings(S, T, pivot_shift(S, T)[0]) == 0
