"""Laying triangles out: the root's base, the ends, and every triangle over its base."""

import numpy as np
import pytest
from hypothesis import given
from strategies import disks

from tween.geometry.triangulation import Triangulation
from tween.morphing.compatible.layout import root_base
from tween.morphing.compatible.leg import Leg

TIMES = np.linspace(0, 1, 41)


def complex_(points):
    return points @ np.array([1, 1j])


def test_the_base_turns_and_grows_evenly():
    e = root_base(np.array([0, 2, 0j]), np.array([0, 4j, 0]), False, TIMES)
    assert np.allclose(np.abs(e), 2 + 2 * TIMES) and np.allclose(np.angle(e), TIMES * np.pi / 2)


def test_along_metric_its_square_grows_evenly():
    e = root_base(np.array([0, 2, 0j]), np.array([0, 4, 0j]), True, TIMES)
    assert np.allclose(np.abs(e) ** 2, 4 + 12 * TIMES)


@pytest.mark.parametrize("nudge", [0.0, 1e-12, -1e-12])
@pytest.mark.parametrize("angle", [0.0, 1.0, -2.5])
def test_half_a_turn_is_the_same_motion_in_reverse(angle, nudge):
    first = np.array([0, np.exp(1j * angle), 0j])
    last = np.array([0, 1.5 * np.exp(1j * (angle + np.pi + nudge)), 0j])
    there, back = root_base(first, last, False, TIMES), root_base(last, first, False, TIMES)
    assert np.allclose(there, back[::-1], atol=1e-11)


@given(disks(low=4, high=30))
def test_ends_are_exact_and_all_shapes_follow_their_third_vertices(T: Triangulation):
    D = T.on_disk()
    leg = Leg(T, D.points, "linear", 0)
    shapes = leg.at(TIMES)
    assert (shapes[0] == T.points).all() and (shapes[-1] == D.points).all()
    a, b, c = np.moveaxis(complex_(shapes[:, leg._corners]), 2, 0)
    z = (c - a) / (b - a)
    wanted = (1 - TIMES[:, None]) * z[0] + TIMES[:, None] * z[-1]
    assert np.abs(z - wanted)[:, 1:].max(initial=0) < 1e-6 * np.abs(z).max()


@given(disks(low=4, high=30))
def test_the_centre_of_the_root_moves_straight(T: Triangulation):
    leg = Leg(T, T.on_disk().points, "slide", 0)
    centre = complex_(leg.at(TIMES))[:, leg._corners[0]].mean(axis=1)
    straight = (1 - TIMES) * centre[0] + TIMES * centre[-1]
    assert np.abs(centre - straight).max() < 1e-9 * np.ptp(T.points)
