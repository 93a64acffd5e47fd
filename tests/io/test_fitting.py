"""A fitted curve stands where the other one stands, and is similar to what it was."""

import numpy as np
import pytest

from tween import gallery
from tween.choices import FITS
from tween.errors import CurveError
from tween.io.fitting import fit

LETTER, PIXELS = gallery.letter("S"), 700 * gallery.curve("horseshoe").points + [3000, -500]


def box(points):
    return points.min(axis=0), points.max(axis=0)


@pytest.mark.parametrize("by", ["area", "box"])
def test_a_fitted_curve_has_the_place_and_size_of_the_other(by):
    fitted = fit(PIXELS, LETTER, by)
    (low, high), (goal_low, goal_high) = box(fitted.points), box(LETTER.points)
    assert (low + high) / 2 == pytest.approx((goal_low + goal_high) / 2)
    if by == "area":
        assert fitted.area == pytest.approx(LETTER.area)
    else:
        assert (high - low).max() == pytest.approx((goal_high - goal_low).max())


@pytest.mark.parametrize("by", FITS)
def test_a_fitted_curve_is_similar_to_what_it_was(by):
    edges = [np.diff(points, axis=0) for points in (PIXELS, fit(PIXELS, LETTER, by).points)]
    scale = np.hypot(*edges[1].T) / np.hypot(*edges[0].T)
    assert np.allclose(scale, scale[0])
    assert np.allclose(edges[1], scale[0] * edges[0])


def test_none_leaves_the_curve_as_it_is():
    assert np.array_equal(fit(PIXELS, LETTER, "none").points, PIXELS)


def test_what_cannot_be_fitted_is_refused():
    with pytest.raises(ValueError, match="none, area, box"):
        fit(PIXELS, LETTER, "size")
    eight = [[0, 0], [2, 2], [2, 0], [0, 2]]
    with pytest.raises(CurveError, match="fit by 'box'"):
        fit(eight, LETTER, "area")
    assert np.ptp(fit(eight, LETTER, "box").points, axis=0).max() == pytest.approx(np.ptp(LETTER.points, axis=0).max())
