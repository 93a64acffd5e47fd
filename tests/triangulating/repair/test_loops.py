"""Loops at crossings, against exact arithmetic and the regions of the plane."""

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import Points, generic_polygons, grid_polygons, random_polygons

from tween import Curve
from tween.geometry.faces import covered_area, faces
from tween.triangulating.repair.loops import meetings, signed_area, simple_loops, split


@pytest.mark.parametrize("kind", ["scatter", "winding", "strip"])
def test_regions_loops_and_shoelace_agree_on_the_area(kind: str) -> None:
    for points in random_polygons(kind, 60, seed=1):
        c = Curve(points)
        found = faces(c.points)
        assert sum(f.winding * f.polygon.area for f in found) == pytest.approx(c.area, abs=1e-9)
        at = meetings(c)
        np.testing.assert_allclose(at.areas.sum(axis=1), c.area, atol=1e-9)
        loops = simple_loops(c, at)
        assert sum(map(signed_area, loops)) == pytest.approx(c.area, abs=1e-9)
        assert sum(int(np.sign(signed_area(loop))) for loop in loops) == c.turning_number
        for pair, place, areas in zip(at.pairs.tolist(), at.places, at.areas, strict=True):
            for part, area in zip(split(c.points, tuple(pair), place), areas, strict=True):
                assert signed_area(part) == pytest.approx(area, abs=1e-9)
                assert covered_area(part) >= abs(area) - 1e-9


@given(st.one_of(grid_polygons(), generic_polygons()))
def test_a_curve_is_split_into_polygons_wherever_it_meets_itself(points: Points) -> None:
    c = Curve(points)
    at = meetings(c)
    for pair, place in zip(at.pairs.tolist(), at.places, strict=True):
        for part in split(c.points, tuple(pair), place):
            assert len(part) < 3 or oracle.is_polygon(part.tolist())


def test_a_touching_edge_is_split_at_the_vertex_that_touches() -> None:
    c = Curve([[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]])
    at = meetings(c)
    assert at.places.tolist() == [[2, 0], [2, 0]]
    inner, outer = split(c.points, (0, 2), at.places[0])
    assert inner.tolist() == [[2, 0], [4, 0], [4, 4]]
    assert outer.tolist() == [[0, 0], [2, 0], [0, 4]]
