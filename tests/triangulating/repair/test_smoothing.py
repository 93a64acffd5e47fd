"""Paths made smooth: places told apart from points, and the tube that no point leaves."""

import numpy as np
import pytest

from tween.triangulating.repair.smoothing import Path, smoothed

OPEN = Path(np.array([[0.0, 0], [4, 0], [4, 3]]), np.array([0.0, 1, 2]))
CLOSED = Path(np.array([[0.0, 0], [4, 0], [4, 3]]), np.array([0.0, 1, 2]), 3.0)


def test_a_closed_path_has_one_edge_more():
    assert OPEN.steps.tolist() == [4, 3] and OPEN.length == 7
    assert CLOSED.steps.tolist() == [4, 3, 5] and CLOSED.length == 12
    assert CLOSED.ring_places.tolist() == [0, 1, 2, 3]


def test_points_at_places_lie_between_rows_and_come_again_after_a_period():
    assert OPEN.at([0.5, 2]).tolist() == [[2, 0], [4, 3]]
    assert CLOSED.at([2.5, 5.5, -0.5]).tolist() == [[2, 1.5]] * 3


@pytest.mark.parametrize("path", [OPEN, CLOSED], ids=["open", "closed"])
def test_points_taken_evenly_are_on_the_path_and_equally_far_apart_along_it(path):
    m = 29
    even = path.evenly(m)
    assert np.allclose(path.at(even.places), even.points)
    along = np.interp(even.places, path.ring_places, np.append(0, np.cumsum(path.steps)))
    assert np.allclose(np.diff(along), path.length / (m if path.period else m - 1))


def test_what_is_left_out_is_replaced_by_an_edge():
    left = OPEN.without(0.5, 1.5)
    assert left.points.tolist() == [[0, 0], [2, 0], [4, 1.5], [4, 3]]
    assert left.places.tolist() == [0, 0.5, 1.5, 2]
    around = CLOSED.without(2.5, 0.5)  # the piece with row 0 in it
    assert around.points.tolist() == [[2, 0], [4, 0], [4, 3], [2, 1.5]]


def test_between_goes_on_beyond_the_end_of_a_closed_path():
    assert CLOSED.between(1.5, 3.2).tolist() == [True, False, True]
    assert CLOSED.between(0.5, 1.5).tolist() == [False, True, False]


def trembling(closed, amount, seed=0):
    t = np.linspace(0, 2 * np.pi, 800, endpoint=not closed)
    z = np.exp(1j * t) if closed else t + 1j * np.sin(t)
    z = z + amount * (np.random.default_rng(seed).normal(size=(800, 2)) @ [1, 1j])
    return Path(np.stack([z.real, z.imag], axis=1), np.arange(800.0), 800.0 * closed)


@pytest.mark.parametrize("closed", [False, True], ids=["open", "closed"])
@pytest.mark.parametrize("radius", [0.02, 0.1, 0.5])
def test_no_point_moves_by_more_than_the_radius(closed, radius):
    path = trembling(closed, 0.03)
    x = smoothed(path, radius)
    assert np.hypot(*(x.points - path.at(x.places)).T).max() <= radius * (1 + 1e-12)


def test_a_trembling_circle_becomes_nearly_as_short_as_the_circle():
    path = trembling(True, 0.02)
    assert path.length > 4 * np.pi
    assert smoothed(path, 0.1).length == pytest.approx(2 * np.pi, rel=0.05)
