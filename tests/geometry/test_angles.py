"""Angles of triangles: their sums, a right one, and that those facing a diagonal say whether it is locally Delaunay."""

import numpy as np
import pytest

from tween import Triangulation, decompose
from tween.gallery import curve
from tween.geometry.angles import corner_angles, facing_angles
from tween.triangulating.flips import flip, locally_delaunay

KITE = [[0, 0], [2, -1], [4, 0], [2, 1]]


@pytest.mark.parametrize("name", ["horseshoe", "five_disks"])
def test_the_angles_of_each_triangle_add_up_to_pi(name: str) -> None:
    T = decompose(curve(name)).sample(np.random.default_rng(0))
    assert corner_angles(T).sum(axis=1) == pytest.approx(np.full(len(T.triangles), np.pi))


def test_angles_stand_at_their_corners() -> None:
    T = Triangulation([[0, 0], [2, 0], [0, 2 * np.sqrt(3)]], [[1, 2, 0]])
    assert np.degrees(corner_angles(T)) == pytest.approx(np.array([[60, 30, 90]]))


def test_the_angles_facing_a_diagonal_are_those_of_the_two_vertices_off_it() -> None:
    across = Triangulation(KITE, [[0, 1, 2], [0, 2, 3]])
    off = 2 * np.arctan2(2, 1)  # at the near corners 1 and 3
    assert facing_angles(across) == pytest.approx([2 * off])
    assert facing_angles(flip(across, (0, 2))) == pytest.approx([2 * np.pi - 2 * off])


def test_they_agree_with_the_exact_test_wherever_they_are_clear() -> None:
    for T in decompose(curve("pretzel")).sample(np.random.default_rng(1), 20):
        excess = facing_angles(T) - np.pi
        clear = np.abs(excess) > 1e-9
        assert clear.mean() > 0.9
        assert np.array_equal(locally_delaunay(T)[clear], excess[clear] < 0)
