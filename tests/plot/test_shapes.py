"""Regions and winding numbers, on which pictures rest."""

import numpy as np
import pytest
import shapely

from tween.gallery import curve
from tween.plot.shapes import regions, winding_number


@pytest.mark.parametrize("name", ["ess", "horseshoe", "winding_3", "five_disks"])
def test_regions_times_winding_numbers_are_the_area_of_the_curve(name: str) -> None:
    found = list(regions(curve(name).points))
    areas = []
    for outline, winding in found:
        exterior, *holes = outline.to_polygons()
        areas.append(winding * shapely.Polygon(exterior, holes).area)
    assert sum(areas) == pytest.approx(curve(name).area)


def test_a_curve_run_backwards_winds_the_other_way() -> None:
    points = curve("winding_3").points
    forwards, backwards = (sorted(w for _, w in regions(p)) for p in (points, points[::-1]))
    assert forwards == sorted(-w for w in backwards)


def test_nothing_winds_about_a_place_outside() -> None:
    assert winding_number(curve("five_disks").points, np.array([100.0, 0.0])) == 0
