"""Bounds along the path "area": no angle, rate, length or sum that is measured lies outside them.

Over long intervals a bound may be nan, which says nothing; `rounding` proves nothing from it.
"""

import numpy as np
import pytest

from tween import gallery
from tween.gallery import random_disk
from tween.morphing.compatible.guarantee.area_bounds import area_bounds, area_third, largest_sums, reach
from tween.morphing.compatible.layout import root_base
from tween.morphing.compatible.leg import Leg
from tween.morphing.compatible.paths import corner_angles
from tween.triangulating.decomposition import triangulate

INSIDE = 9  # times in each interval


def leg_of(seed):
    T = triangulate(gallery.curve("three_lobes")) if seed is None else random_disk(20, np.random.default_rng(seed))
    return Leg(T, T.on_disk().points, "area", 0, guarantee=True)


@pytest.mark.parametrize("seed", [None, *range(6)])
@pytest.mark.parametrize("knots", [np.linspace(0, 1, 17), np.linspace(0.3, 0.301, 5)], ids=["long", "short"])
def test_angles_lengths_and_sums_lie_within_their_bounds(seed, knots):
    leg = leg_of(seed)
    times = np.linspace(knots[:-1], knots[1:], INSIDE)
    _, z = leg._lay_out(knots, leg.area_path)
    root = np.abs(root_base(leg._start[0], leg._end[0], False, knots))
    low, high, slow, fast, near, far = area_bounds(leg._children, z, root, knots, *leg.area_path)
    sums = largest_sums(leg._corners, np.asarray(corner_angles(z)), high, slow, fast, knots)
    for row in times:
        shapes, inner = leg._lay_out(row, leg.area_path)
        angles = np.asarray(corner_angles(inner))
        assert not (angles < low - 1e-12).any() and not (angles > high + 1e-12).any()
        bases = np.abs(shapes[leg._corners[:, 1]] - shapes[leg._corners[:, 0]])
        assert not (bases < near * (1 - 1e-9)).any() and not (bases > far * (1 + 1e-9)).any()
        total = np.zeros((len(shapes), len(row)))
        for corner in range(3):
            np.add.at(total, leg._corners[:, corner], angles[:, corner])
        assert not (total > sums + 1e-11).any()
    if knots[1] - knots[0] < 1e-3:
        assert all(np.isfinite(bound).all() for bound in (low, high, near, far, sums))


@pytest.mark.parametrize("seed", range(3))
def test_rates_bound_differences(seed):
    leg, knots = leg_of(seed), np.linspace(0, 1, 33)
    _, z = leg._lay_out(knots, leg.area_path)
    root = np.abs(root_base(leg._start[0], leg._end[0], False, knots))
    _, _, slow, fast, _, _ = area_bounds(leg._children, z, root, knots, *leg.area_path)
    rise = np.diff(np.asarray(corner_angles(z)), axis=2) / np.diff(knots)
    assert (rise >= slow - 1e-9).all() and (rise <= fast + 1e-9).all()


def test_a_function_reaches_no_farther_than_its_rates_let_it():
    low, high = reach(0.0, 0.0, -1.0, 1.0, 1.0)
    assert (low, high) == (-0.5, 0.5)  # there and back
    assert reach(0.0, 1.0, 0.5, 2.0, 1.0) == (0.0, 1.0)  # rising throughout
    assert reach(0.0, 1.0, -np.inf, np.inf, 1.0) == (-np.inf, np.inf)


@pytest.mark.parametrize("seed", range(4))
def test_the_third_vertex_has_the_height_of_its_area(seed):
    leg = leg_of(seed)
    path = leg.area_path
    for i in np.flatnonzero(path.blend == 0):
        for t in (0.0, 0.4, 1.0):
            z = area_third(i, 4.0, t, *path)
            assert z.imag == pytest.approx(((1 - t) * path.areas[i, 0] + t * path.areas[i, 1]) / 4.0, rel=1e-9)
