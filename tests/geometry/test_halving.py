"""Midpoints: which edges get them, and that no rounding of theirs decides anything."""

from fractions import Fraction
from itertools import combinations

import numpy as np
import oracle
import pytest

from tween.errors import CurveError
from tween.geometry.halving import dented, halve_longest_edges

TILTED = np.array([[0.1, 0.3], [5.3, 0.7], [4.1, 3.9], [0.7, 2.3]])


def halved(points, count):
    return halve_longest_edges(points, np.arange(len(points)), count)


@pytest.mark.parametrize("count", [4, 5, 9, 30])
def test_the_given_vertices_stay_in_order_and_the_rest_are_new(count):
    points, origin = halved(TILTED, count)
    assert len(points) == count and np.sum(origin == -1) == count - 4
    assert (points[origin >= 0] == TILTED).all() and origin[origin >= 0].tolist() == [0, 1, 2, 3]


def test_no_edge_is_more_than_twice_as_long_as_one_that_was_halved():
    points, origin = halved(TILTED, 40)
    lengths = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    new = (origin == -1) | (np.roll(origin, -1) == -1)
    assert lengths.max() <= 2 * lengths[new].min() * (1 + 1e-12)


def test_of_equal_edges_the_first_is_halved():
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    assert halved(square, 5)[0].tolist() == [[0, 0], [0.5, 0], [1, 0], [1, 1], [0, 1]]


def test_an_edge_of_one_last_bit_cannot_be_halved():
    e = np.nextafter(1.0, 2.0)
    with pytest.raises(CurveError, match="too short to be halved"):
        halved(np.array([[1.0, 1], [e, 1], [e, e]]), 10)


def on_one_edge(points, origin):
    """Runs of points from one given vertex to the next."""
    given = np.flatnonzero(origin >= 0)
    for start, stop in zip(given, [*given[1:], given[0] + len(points)], strict=True):
        yield points[np.arange(start, stop + 1) % len(points)]


@pytest.mark.parametrize("scale", [1.0, 1e-8, 1e6])
def test_no_three_points_of_a_dent_are_a_counter_clockwise_triangle(scale):
    points, origin = halved(TILTED * scale, 25)
    for run in on_one_edge(dented(points, origin), origin):
        p = [tuple(map(Fraction, q)) for q in run.tolist()]
        assert all(oracle.orient2d(a, b, c) <= 0 for a, b, c in combinations(p, 3))


def test_a_dent_is_no_deeper_than_a_millionth_of_its_edge():
    points, origin = halved(TILTED, 25)
    moved = np.hypot(*(dented(points, origin) - points).T)
    assert 0 < moved.max() <= 2.0**-20 * np.hypot(*np.ptp(TILTED, axis=0))
    assert (moved[origin >= 0] == 0).all()


def test_midpoints_that_lie_on_their_edge_exactly_stay():
    square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    points, origin = halved(square, 20)
    assert (dented(points, origin) == points).all()
