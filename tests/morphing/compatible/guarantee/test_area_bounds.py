"""Bounds along the path "area": no angle, rate, length or sum that is measured lies outside them.

Over long intervals a bound may be nan, which says nothing; `rounding` proves nothing from it.
"""

import numpy as np
import pytest

from tween import gallery
from tween.gallery import random_disk
from tween.morphing.compatible.guarantee.area_bounds import area_bounds, largest_sums, reach, with_ancestors
from tween.morphing.compatible.layout import root_base
from tween.morphing.compatible.leg import Leg
from tween.morphing.compatible.paths import corner_angles
from tween.triangulating.decomposition import triangulate

INSIDE = 9  # times in each interval


def leg_of(seed):
    T = triangulate(gallery.curve("three_lobes")) if seed is None else random_disk(20, np.random.default_rng(seed))
    return Leg(T, T.on_disk().points, "area", 0, guarantee=True)


def bounds(leg, z, knots, cells):
    root = np.abs(root_base(leg._start[0], leg._end[0], False, knots))
    return area_bounds(leg._children, z, root, knots, *leg.area_path, cells)


@pytest.mark.parametrize("seed", [None, *range(6)])
@pytest.mark.parametrize("knots", [np.linspace(0, 1, 17), np.linspace(0.3, 0.301, 5)], ids=["long", "short"])
def test_angles_lengths_and_sums_lie_within_their_bounds(seed, knots):
    leg = leg_of(seed)
    times = np.linspace(knots[:-1], knots[1:], INSIDE)
    _, z = leg._lay_out(knots, leg.area_path)
    every = np.ones((len(z), len(knots) - 1), dtype=bool)
    low, high, slow, fast, near, far = bounds(leg, z, knots, every)
    sums = largest_sums(leg._corners, z, high, slow, fast, knots, every)
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
    _, _, slow, fast, _, _ = bounds(leg, z, knots, np.ones((len(z), len(knots) - 1), dtype=bool))
    rise = np.diff(np.asarray(corner_angles(z)), axis=2) / np.diff(knots)
    assert (rise >= slow - 1e-9).all() and (rise <= fast + 1e-9).all()


def test_a_function_reaches_no_farther_than_its_rates_let_it():
    low, high = reach(0.0, 0.0, -1.0, 1.0, 1.0)
    assert (low, high) == (-0.5, 0.5)  # there and back
    assert reach(0.0, 1.0, 0.5, 2.0, 1.0) == (0.0, 1.0)  # rising throughout
    assert reach(0.0, 1.0, -np.inf, np.inf, 1.0) == (-np.inf, np.inf)


@pytest.mark.parametrize("seed", range(4))
def test_asked_for_some_vertices_in_some_intervals_they_are_the_same(seed):
    leg, knots = leg_of(seed), np.linspace(0, 1, 33)
    asked = np.random.default_rng(seed).random((len(leg.source), 32)) < 0.1
    cells = with_ancestors(leg._corners, leg._children, asked)
    _, z = leg._lay_out(knots, leg.area_path)
    found = []
    for some in (cells, np.ones_like(cells)):
        *known, near, far = bounds(leg, z, knots, some)
        found.append((known[1], near, far, largest_sums(leg._corners, z, *known[1:], knots, some)))
    for restricted, whole in zip(*found, strict=True):
        there = asked if len(whole) == len(asked) else cells
        there = np.broadcast_to(there[:, None], whole.shape) if whole.ndim == 3 else there
        np.testing.assert_array_equal(restricted[there], whole[there])
    assert 0.1 < cells.mean() < 0.9


def test_the_ancestors_of_a_triangle_are_those_on_the_way_to_the_root():
    leg = leg_of(0)
    asked = np.zeros((len(leg.source), 1), dtype=bool)
    last = leg._corners[-1]
    asked[last[2]] = True
    cells = np.flatnonzero(with_ancestors(leg._corners, leg._children, asked)[:, 0])
    assert cells[0] == 0 and cells[-1] == len(leg._corners) - 1
    for i in cells[1:]:  # each has a parent among them
        assert (leg._children[cells] == i).any()
    with_last = np.flatnonzero((leg._corners == last[2]).any(axis=1))
    assert set(with_last) <= set(cells)
