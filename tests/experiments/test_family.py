"""Curves from fat to thin: each bounds a disk at every number of vertices, and measures of shape are what they say."""

import numpy as np
import pytest

from experiments import family
from tween import decompose, gallery, triangulate
from tween.triangulating.compatibility import compatible_shift


@pytest.mark.parametrize("name", list(family.names()))
def test_every_curve_bounds_a_disk_with_few_vertices_and_with_many(name: str) -> None:
    for n in (24, 96):
        curve = family.at(name, n)
        assert len(curve) == n and decompose(curve)


def test_overlapping_stars_cross_themselves_and_plain_ones_do_not() -> None:
    assert len(family.curve("star 5 0.5").crossings) == 0
    assert len(family.curve("star 5 0.5 over").crossings) > 0


def test_a_curve_with_the_right_number_of_vertices_is_left_alone() -> None:
    curve = gallery.curve("ell")
    assert family.resampled(curve, len(curve)) is curve


def test_zigzags_stay_compatible() -> None:
    for name in family.ZIGZAGS:
        ends = [triangulate(end) for end in family.pair_at(name, 64)]
        assert [len(T) for T in ends] == [64, 64]
        assert compatible_shift(*ends) is not None


def test_the_isoperimetric_ratio_is_1_for_a_circle_and_grows_with_length() -> None:
    t = 2 * np.pi * np.arange(1000) / 1000
    assert family.isoperimetric(np.stack([np.cos(t), np.sin(t)], axis=1), np.pi) == pytest.approx(1, abs=1e-4)
    ratios = [
        family.isoperimetric(c.points, c.area)
        for c in (family.curve(f"strip {length}") for length in (2, 4, 8, 16, 32))
    ]
    assert ratios == sorted(ratios)


def test_the_dual_tree_of_a_strip_does_not_branch_and_that_of_a_star_does() -> None:
    assert family.branching(triangulate(family.at("strip 32", 48))) == 0
    assert family.branching(triangulate(family.at("star 7 0.5", 48))) > 0
