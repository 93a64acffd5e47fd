"""The dual tree, hung from a root, and its centres."""

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import convex_triangulations, disks

from tween import Triangulation
from tween.gallery import random_disk
from tween.geometry.dual_tree import along_longest_path, disk_center, hops, rooted, tree_center

SQUARE = Triangulation([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)])
shapes = st.one_of(convex_triangulations(), disks())


@given(shapes, st.data())
def test_the_rooted_tree_lists_every_triangle_once_and_parents_first(T: Triangulation, data: st.DataObject) -> None:
    root = data.draw(st.integers(0, len(T.triangles) - 1))
    tree = rooted(T, root)
    assert sorted(tree.order.tolist()) == list(range(len(T.triangles)))
    assert tree.order[0] == root
    assert tree.depth.tolist() == hops(T, root).tolist() == oracle.distances(T.triangles, root)
    place = np.argsort(tree.order)
    for t in tree.order[1:]:
        assert tree.base[t] // 3 == t
        parent = T.twin.ravel()[tree.base[t]] // 3
        assert tree.depth[parent] == tree.depth[t] - 1
        assert place[parent] < place[t]


@given(shapes, st.data())
def test_the_base_of_the_root_does_not_depend_on_the_list(T: Triangulation, data: st.DataObject) -> None:
    root = data.draw(st.integers(0, len(T.triangles) - 1))
    order = data.draw(st.permutations(range(len(T.triangles))))
    turned = np.array([np.roll(T.triangles[t], i) for i, t in enumerate(order)])
    S = Triangulation(T.points, turned)
    ends = []
    for U, r in ((T, root), (S, order.index(root))):
        base = rooted(U, r).base[r]
        assert base // 3 == r
        ends.append((int(U.triangles[r, base % 3]), int(U.triangles[r, (base + 1) % 3])))
    assert ends[0] == ends[1]
    edges = [(int(T.triangles[root, s]), int(T.triangles[root, (s + 1) % 3])) for s in range(3)]
    outer = [(a, b) for a, b in edges if b == (a + 1) % len(T)]
    assert ends[0] == min(outer or edges)


@given(shapes)
def test_the_centre_of_the_tree_is_that_of_brute_force(T: Triangulation) -> None:
    heights = [max(oracle.distances(T.triangles, t)) for t in range(len(T.triangles))]
    central = [sorted(T.triangles[t].tolist()) for t, height in enumerate(heights) if height == min(heights)]
    assert sorted(T.triangles[tree_center(T)].tolist()) == min(central)


@given(convex_triangulations(), st.data())
def test_both_centres_do_not_depend_on_the_list(T: Triangulation, data: st.DataObject) -> None:
    order = data.draw(st.permutations(range(len(T.triangles))))
    S = Triangulation(T.points, [np.roll(T.triangles[t], i) for i, t in enumerate(order)])
    assert order[tree_center(S)] == tree_center(T)
    assert order[disk_center(S)] == disk_center(T)


def distance_to_centre(D: Triangulation, t: int) -> float:
    """Return how far the triangle is from the centre of the circle, by many points of its edges; 0 inside."""
    a, b, c = oracle.fractions(D.points[D.triangles[t]])
    if all(oracle.orient2d((0, 0), *edge) >= 0 for edge in ((a, b), (b, c), (c, a))):
        return 0.0
    z = (D.points @ np.array([1, 1j]))[D.triangles[t]]
    s = np.linspace(0, 1, 2001)
    return float(np.abs(z[:, None] * (1 - s) + np.roll(z, -1)[:, None] * s).min())


@given(st.one_of(convex_triangulations(), disks(4, 25)))
def test_the_centre_of_the_disk_holds_it_or_is_nearest(T: Triangulation) -> None:
    lengths = np.hypot(*(np.roll(T.points, -1, axis=0) - T.points).T)
    angles = 2 * np.pi * np.cumsum(np.roll(lengths, 1)) / lengths.sum()
    D = Triangulation(np.stack([np.cos(angles), np.sin(angles)], axis=1), T.triangles)
    found = distance_to_centre(D, disk_center(T))
    assert found <= min(distance_to_centre(D, t) for t in range(len(T.triangles))) + 1e-6


@given(disks(4, 25), st.data())
def test_the_order_of_the_shapes_does_not_matter(T: Triangulation, data: st.DataObject) -> None:
    others = [T.on_disk("uniform"), Triangulation(T.points * [1, 3], T.triangles), T]
    order = data.draw(st.permutations(range(3)))
    assert disk_center(*others) == disk_center(*(others[i] for i in order))


def test_uniform_fans_have_their_centre_where_it_is_seen() -> None:
    angles = 2 * np.pi * np.arange(7) / 7
    heptagon = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    T = Triangulation(heptagon, [(0, i, i + 1) for i in range(1, 6)])
    assert T.triangles[disk_center(T)].tolist() == [0, 3, 4]
    assert T.triangles[tree_center(T)].tolist() == [0, 3, 4]


def test_of_two_equally_central_triangles_the_smaller_is_taken() -> None:
    for triangles in ([(0, 1, 2), (0, 2, 3)], [(2, 3, 0), (1, 2, 0)]):
        T = Triangulation(SQUARE.points, triangles)
        for centre in (tree_center(T), disk_center(T)):
            assert sorted(T.triangles[centre].tolist()) == [0, 1, 2]


@pytest.mark.parametrize("root", [-1, 2, 100])
def test_a_root_that_does_not_exist_is_refused(root: int) -> None:
    with pytest.raises(ValueError, match=f"root is triangle {root}, expected 0 to 1"):
        rooted(SQUARE, root)


def test_a_large_tree_is_walked_without_recursion() -> None:
    T = random_disk(3000, np.random.default_rng(0))
    assert rooted(T, tree_center(T)).depth.max() == -(-max(hops(T, int(np.argmax(hops(T, 0))))) // 2)


@given(st.one_of(convex_triangulations(), disks()))
def test_hops_along_the_longest_path_start_at_its_end_of_smaller_corners(T: Triangulation) -> None:
    along = along_longest_path(T)
    every = [oracle.distances(T.triangles, t) for t in range(len(T.triangles))]
    assert along.tolist() in every
    assert along.max() == max(map(max, every))
    start, far = int(np.argmin(along)), np.flatnonzero(along == along.max())
    corners = [sorted(t) for t in T.triangles.tolist()]
    assert any(corners[start] <= corners[t] for t in far)
