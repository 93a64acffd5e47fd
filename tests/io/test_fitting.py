"""One drawing fitted to another: by area, by box, or not at all."""

import numpy as np
import pytest

from tween import Curve, gallery, triangulate
from tween.io import fit

FAR = [[100, 0], [300, 0], [300, 200], [100, 200]]


def test_by_area_sizes_and_centres_are_equal() -> None:
    curve, to = gallery.letter("e"), gallery.curve("arrow")
    fitted = fit(curve, to)
    assert fitted.area == pytest.approx(to.area)
    np.testing.assert_allclose(fitted.points.mean(axis=0), to.points.mean(axis=0), atol=1e-9)
    assert len(fitted) == len(curve)


def test_by_box_the_curve_fills_the_box_in_one_direction_and_fits_in_the_other() -> None:
    curve, to = gallery.letter("L"), Curve(FAR)
    fitted = fit(curve, to, by="box")
    sides = np.ptp(fitted.points, axis=0)
    assert sides.max() == pytest.approx(200) and (sides <= 200 * (1 + 1e-12)).all()
    np.testing.assert_allclose(fitted.points.min(axis=0) + fitted.points.max(axis=0), [400, 200])


@pytest.mark.parametrize("by", ["area", "box"])
def test_shapes_are_only_moved_and_scaled(by) -> None:
    curve = gallery.curve("ess")
    fitted = fit(curve, FAR, by=by)
    here, there = ((c.points - c.points[0]) @ [1, 1j] for c in (curve, fitted))
    np.testing.assert_allclose(there[1:] / here[1:], abs(there[1] / here[1]), rtol=1e-9)


def test_without_fitting_a_curve_stays_itself() -> None:
    curve = gallery.curve("ess")
    assert fit(curve, FAR, by="none") is curve


def test_a_triangulation_stands_for_its_curve() -> None:
    T = triangulate(FAR)
    np.testing.assert_array_equal(fit(gallery.curve("ess"), T).points, fit(gallery.curve("ess"), FAR).points)


def test_what_cannot_be_fitted_is_refused() -> None:
    with pytest.raises(ValueError, match="by is 'size', expected one of area, box, none"):
        fit(FAR, FAR, by="size")  # type: ignore[arg-type]
    eight = [[0, 0], [2, 2], [2, 0], [0, 2]]
    with pytest.raises(ValueError, match=r"the areas are 0 and 40000, expected positive ones; by='box'"):
        fit(eight, FAR)
    assert np.ptp(fit(eight, FAR, by="box").points, axis=0).tolist() == [200, 200]
