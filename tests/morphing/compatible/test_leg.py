"""A leg moves each triangle as its path says, on the base that it shares with its parent."""

from itertools import pairwise

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from strategies import disks

from tween import Triangulation
from tween.choices import PATHS
from tween.gallery import random_disk
from tween.geometry.dual_tree import disk_center, rooted, tree_center
from tween.morphing.compatible.leg import Leg, root_triangle
from tween.morphing.compatible.paths import base_angles

TIMES = np.linspace(0, 1, 9)


def complex_of(points: NDArray[np.float64]) -> NDArray[np.complex128]:
    return points @ np.array([1, 1j])


def corners_from_base(T: Triangulation, root: int) -> NDArray[np.int64]:
    """Corners a, b, c of every triangle, ab being what it shares with its parent; the root's base is its own."""
    depth, edges = oracle.distances(T.triangles, root), [set(t) for t in T.triangles.tolist()]
    rows = np.empty_like(T.triangles)
    for t, row in enumerate(T.triangles.tolist()):
        parents = [s for s in range(len(edges)) if depth[s] < depth[t] and len(edges[s] & edges[t]) == 2]
        apex = min(edges[t] - edges[parents[0]]) if parents else row[(rooted(T, root).base[t] + 2) % 3]
        rows[t] = np.roll(row, 2 - row.index(apex))
    return rows


def thirds(T: Triangulation, root: int, frames: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Where the third vertex of every triangle lies over its base from 0 to 1, (k, m)."""
    a, b, c = np.moveaxis(complex_of(frames)[:, corners_from_base(T, root)], 2, 0)
    return (c - a) / (b - a)


def linear(values: NDArray) -> NDArray:
    steps = TIMES.reshape(-1, *[1] * (values.ndim - 1))
    return (1 - steps) * values[0] + steps * values[-1]


def moving(n: int, seed: int, path: str, root: int) -> tuple[Triangulation, NDArray[np.float64]]:
    T = random_disk(n, np.random.default_rng(seed))
    return T, Leg(T, 3 * T.on_disk().points, path, root % len(T.triangles)).at(TIMES)


arguments = st.tuples(st.integers(3, 25), st.integers(0, 10**6), st.integers(0, 100))


@given(arguments, st.sampled_from(PATHS))
def test_it_leads_exactly_from_source_to_target_however_the_times_are_ordered(ends, path) -> None:
    n, seed, root = ends
    T, frames = moving(n, seed, path, root)
    np.testing.assert_array_equal(frames[[0, -1]], [T.points, 3 * T.on_disk().points])
    back = Leg(T, 3 * T.on_disk().points, path, root % len(T.triangles)).at(TIMES[::-1])
    np.testing.assert_array_equal(back[::-1], frames)


@given(arguments)
def test_along_linear_every_third_vertex_moves_evenly_over_its_base(ends) -> None:
    n, seed, root = ends
    T, frames = moving(n, seed, "linear", root)
    z = thirds(T, root % len(T.triangles), frames)
    np.testing.assert_allclose(z, linear(z), atol=1e-8 * abs(z).max())


@given(arguments)
def test_along_angle_every_angle_of_every_triangle_changes_evenly(ends) -> None:
    n, seed, root = ends
    T, frames = moving(n, seed, "angle", root)
    angles = np.array([base_angles(z) for z in thirds(T, root % len(T.triangles), frames)])
    np.testing.assert_allclose(angles, linear(angles), atol=1e-7)


@given(arguments)
def test_along_metric_the_square_of_every_edge_changes_evenly(ends) -> None:
    n, seed, root = ends
    T, frames = moving(n, seed, "metric", root)
    squares = ((frames[:, T.triangles] - frames[:, np.roll(T.triangles, 1, axis=1)]) ** 2).sum(axis=-1)
    np.testing.assert_allclose(squares, linear(squares), rtol=1e-6, atol=1e-9 * squares.max())


@given(arguments)
def test_along_area_the_area_of_every_triangle_changes_evenly(ends) -> None:
    n, seed, root = ends
    T, frames = moving(n, seed, "area", root)
    areas = np.array([Triangulation(frame, T.triangles).areas for frame in frames])
    # Not the root's, whose third vertex goes by the length of its base, too: all of them.
    np.testing.assert_allclose(areas, linear(areas), rtol=1e-6, atol=1e-9 * areas.max())


@given(arguments, st.sampled_from(PATHS))
def test_the_root_moves_as_a_whole(ends, path) -> None:
    n, seed, root = ends
    T, frames = moving(n, seed, path, root)
    a, b, c = complex_of(frames)[:, corners_from_base(T, root % len(T.triangles))[root % len(T.triangles)]].T
    centre, base = (a + b + c) / 3, b - a
    scale = np.ptp(frames)
    np.testing.assert_allclose(centre, linear(centre), atol=1e-9 * scale)
    length = abs(base) ** 2 if path == "metric" else abs(base)
    np.testing.assert_allclose(length, linear(length), rtol=1e-9)
    turns = [np.angle(after / before) for before, after in pairwise(base)]
    np.testing.assert_allclose(turns, np.mean(turns), atol=1e-7)


def test_with_the_guarantee_every_sum_of_angles_stays_below_a_full_turn() -> None:
    needed = 0
    for seed in range(20):
        T = random_disk(30, np.random.default_rng(seed))
        for path in PATHS:
            largest = []
            for guarantee in (False, True):
                leg = Leg(T, T.on_disk().points, path, 0, guarantee)
                z = complex_of(leg.at(np.linspace(0, 1, 60)))[:, T.triangles]
                angles = np.angle((np.roll(z, 1, axis=2) - z) / (np.roll(z, -1, axis=2) - z))
                sums = np.zeros((len(z), len(T)))
                np.add.at(sums.T, T.triangles.ravel(), angles.reshape(len(z), -1).T)
                largest.append(sums.max())
            assert largest[1] < 2 * np.pi
            needed += largest[0] >= 2 * np.pi
    assert needed > 0


# Roots


@given(disks(3, 30), st.data())
def test_the_root_is_the_triangle_given_or_a_centre(T: Triangulation, data: st.DataObject) -> None:
    t = data.draw(st.integers(0, len(T.triangles) - 1))
    assert root_triangle(t, T) == root_triangle(np.int64(t), T) == root_triangle(float(t), T) == t
    assert root_triangle("tree-center", T, T.on_disk()) == tree_center(T)
    assert root_triangle("disk-center", T, T.on_disk()) == disk_center(T, T.on_disk())


@pytest.mark.parametrize("root", [-1, 28, 0.5, "middle", "0"])
def test_any_other_root_is_refused_with_what_was_expected(root) -> None:
    T = random_disk(30, np.random.default_rng(0))
    with pytest.raises(ValueError, match="expected 'disk-center', 'tree-center' or a triangle from 0 to 27"):
        root_triangle(root, T)


@pytest.mark.parametrize("root", [None, True, np.True_, 1.5, float("nan"), float("inf"), "3", -1, 2, [0]])
def test_a_root_that_is_no_triangle_is_refused(root: object) -> None:
    square = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    with pytest.raises(ValueError, match="expected 'disk-center', 'tree-center' or a triangle from 0 to 1"):
        root_triangle(root, square)


@pytest.mark.parametrize("root", [1, np.int64(1), np.uint8(1), 1.0])
def test_a_root_is_any_whole_number_of_a_triangle(root: object) -> None:
    assert root_triangle(root, Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])) == 1
