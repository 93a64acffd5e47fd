"""Crossings: the edges of a curve that meet, and how, against all pairs of edges."""

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import Points, generic_polygons, grid_polygons

from tween import Curve
from tween.gallery import curve, names
from tween.geometry.crossings import find_crossings

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]
PENTAGRAM = [(3, 0), (-2, 2), (1, -3), (1, 3), (-2, -2)]


@given(st.one_of(grid_polygons(), grid_polygons(size=2), generic_polygons()))
def test_crossings_are_those_of_all_pairs_of_edges(points: Points) -> None:
    c = Curve(points)
    assert dict(zip(c.crossings, c.crossings.proper.tolist(), strict=True)) == oracle.crossings(c.points)
    assert list(c.crossings) == sorted(c.crossings)
    assert len(c.crossings) == len(c.crossings.crossing) + len(c.crossings.touches)


@pytest.mark.parametrize("name", names())
def test_crossings_of_the_gallery_are_those_of_all_pairs_of_edges(name: str) -> None:
    c = curve(name)
    assert dict(zip(c.crossings, c.crossings.proper.tolist(), strict=True)) == oracle.crossings(c.points)


@pytest.mark.parametrize(
    ("points", "proper", "touching"),
    [
        (SQUARE, [], []),
        (EIGHT, [[0, 2]], []),
        ([(0, 0), (4, 0), (4, 2), (2, 0), (0, 2)], [], [[0, 2], [0, 3]]),  # vertex 3 on edge 0
        ([(0, 0), (4, 0), (4, 1), (3, 0), (1, 0), (0, 1)], [], [[0, 2], [0, 3], [0, 4]]),  # edge 3 along edge 0
        ([(0, 0), (1, 1), (2, 0), (2, 2), (1, 1), (0, 2)], [], [[0, 3], [0, 4], [1, 3], [1, 4]]),  # (1, 1) twice
    ],
)
def test_touches_are_told_from_crossings(points, proper, touching) -> None:
    found = Curve(points).crossings
    assert found.crossing.tolist() == proper
    assert found.touches.tolist() == touching


def test_pentagram_edges_cross_those_that_are_no_neighbours() -> None:
    assert list(Curve(PENTAGRAM).crossings) == [(0, 2), (0, 3), (1, 3), (1, 4), (2, 4)]


def test_a_polygon_with_spikes_has_crossings_too() -> None:
    spiked = np.array([(0, 0), (4, 0), (4, 4), (2, 4), (2, -2), (2, 4), (0, 4)], dtype=np.float64)
    found = find_crossings(spiked)
    assert found.crossing.tolist() == [[0, 3], [0, 4]]
    assert found.touches.tolist() == [[2, 4], [2, 5], [3, 5]]  # at the foot of the spike


def test_the_pairs_cannot_be_changed() -> None:
    found = find_crossings(np.array(EIGHT, dtype=np.float64))
    for array in (found.pairs, found.proper):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
