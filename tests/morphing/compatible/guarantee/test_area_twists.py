"""Twists of the path "area": areas stay linear, ends stay, and vertices keep below a full turn."""

import numpy as np
import pytest

from tween import gallery
from tween.gallery import random_disk
from tween.morphing.compatible.guarantee.area_twists import kept_below_full_turn, straight_area_path
from tween.morphing.compatible.leg import Leg, root_triangle
from tween.triangulating.decomposition import triangulate

TIMES = np.linspace(0, 1, 101)


def leg_of(T, guarantee=True):
    return Leg(T, T.on_disk().points, "area", 0, guarantee=guarantee)


def areas(leg):
    p = leg.at(TIMES)[:, leg.source.triangles] @ np.array([1, 1j])
    return ((p[..., 1] - p[..., 0]).conj() * (p[..., 2] - p[..., 0])).imag


@pytest.mark.parametrize("seed", range(6))
def test_areas_are_linear_however_the_path_is_twisted(seed):
    T = random_disk(24, np.random.default_rng(seed))
    leg = leg_of(T)
    A = areas(leg)
    straight = (1 - TIMES[:, None]) * A[0] + TIMES[:, None] * A[-1]
    blended = np.zeros(len(A[0]), dtype=bool)
    blended[leg._tree.order] = leg.area_path.blend > 0
    error = np.abs(A - straight).max(axis=0) / np.abs(A).max(axis=0)
    if not blended.any():
        assert error.max() < 1e-9
    else:  # what hangs on a blended triangle keeps its own area
        assert error[~blended].max(initial=0) < 1e-9 < error[blended].max()


def test_a_path_without_need_is_left_as_it_is():
    T = triangulate(gallery.curve("ess"))
    plain, kept = leg_of(T, guarantee=False), leg_of(T)
    assert all(np.array_equal(a, b) for a, b in zip(plain.area_path, kept.area_path, strict=True))


def test_twists_leave_the_ends_and_room_at_the_base():
    rng = np.random.default_rng(1)
    first, last = (rng.dirichlet([2, 2, 2], 50) * np.pi for _ in range(2))
    path = straight_area_path(np.ones((50, 2)), first, last)
    twisted = path.twisted(rng.normal(scale=10, size=(50, 2)))
    for before, after in ((path.above, twisted.above), (path.below, twisted.below)):
        assert (after[:, [0, 3]] == before[:, [0, 3]]).all()
        assert (after > 0).all()
    assert np.allclose(twisted.above + twisted.below, 2 * np.pi)


def test_without_twists_that_help_all_triangles_in_doubt_are_blended_and_it_ends():
    rng = np.random.default_rng(2)
    first, last = (rng.dirichlet([2, 2, 2], 3) * np.pi for _ in range(2))
    corners = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]])
    path = straight_area_path(np.ones((3, 2)), first, last)
    found = kept_below_full_turn(
        path, corners, np.full((2, 5), 0.1), lambda t, p: np.ones((3, 3, len(t))), lambda p: np.arange(5) == 4
    )
    assert found.blend.tolist() == [0, 0, 1]


@pytest.mark.parametrize("letter", ["L", "O", "Z"])
def test_letters_whose_areas_change_quickly_close_to_the_disk_are_proved_without_blending(letter):
    T = triangulate(gallery.letter(letter))
    leg = Leg(T, T.on_disk().points, "area", root_triangle("disk-center", T, T.on_disk()), guarantee=True)
    assert (leg.area_path.blend == 0).all()


def test_twists_that_help_less_and_less_come_to_an_end():
    corners = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]])
    thirds = np.full((3, 3), np.pi / 3)
    calls = []

    def angles_at(t, path):
        calls.append(path)
        return np.full((3, 3, len(t)), 2.5 + 1 / len(calls))

    found = kept_below_full_turn(
        straight_area_path(np.ones((3, 2)), thirds, thirds), corners, np.full((2, 5), 0.1), angles_at, lambda p: 1 < 0
    )
    assert 4000 < len(calls) < 4200
    assert (found.blend == 1).all()
