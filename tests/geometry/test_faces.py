"""Regions and winding numbers: exact for every place, and as large in all as the curve's area."""

from fractions import Fraction

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from strategies import Points, grid_polygons, random_polygons

from tween import Curve
from tween.geometry.faces import covered_area, faces, winding_numbers


def winding(points: NDArray[np.float64], place: NDArray[np.float64]) -> int:
    """Count signed crossings of the ray to the right, in fractions."""
    p, (q,) = oracle.fractions(points), oracle.fractions([place])
    total = 0
    for a, b in zip(p, [*p[1:], p[0]], strict=True):
        if (a[1] > q[1]) != (b[1] > q[1]):
            at = a[0] + (b[0] - a[0]) * Fraction(q[1] - a[1], b[1] - a[1])
            total += (1 if b[1] > a[1] else -1) * (at > q[0])
    return total


@given(grid_polygons(), st.integers(0, 4), st.integers(0, 4))
def test_winding_numbers_are_those_of_exact_arithmetic(points: Points, x: int, y: int) -> None:
    place = np.array([x + 0.5, y + 1 / 3])
    assert winding_numbers(points, [place]).tolist() == [winding(np.array(points), place)]


def test_a_place_beside_a_long_thin_edge_is_on_the_right_side() -> None:
    sliver = [[0, 0], [3, 1], [0, 1]]
    for k in (-1, 1):
        q = [1.5, 0.5 + k * 2.0**-53 * (1 if k > 0 else 0.5)]
        assert winding_numbers(sliver, q).tolist() == [winding(np.array(sliver), np.array(q))]


@pytest.mark.parametrize("kind", ["scatter", "winding", "strip"])
def test_regions_have_the_area_of_the_curve_and_the_winding_numbers_of_their_places(kind: str) -> None:
    for points in random_polygons(kind, 60, seed=1):
        c = Curve(points)
        found = faces(c.points)
        assert sum(f.winding * f.polygon.area for f in found) == pytest.approx(c.area, abs=1e-9)
        assert all(f.winding == winding(c.points, f.place) for f in found)
        assert covered_area(c.points) >= abs(c.area) - 1e-9


def test_many_places_are_looked_at_in_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    points = np.array([[0, 0], [2, 2], [2, 0], [0, 2]])
    places = np.random.default_rng(0).uniform(-1, 3, (50, 2))
    whole = winding_numbers(points, places)
    monkeypatch.setattr("tween.geometry.faces._AT_ONCE", 7)
    assert winding_numbers(points, places).tolist() == whole.tolist() == [winding(points, q) for q in places]
