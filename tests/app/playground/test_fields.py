"""Where curves are placed in a field, and what a field shows of why one bounds no disk."""

import numpy as np
import pytest
from strokes import bows, eight, twice

from tween import decompose, gallery
from tween.app.playground.fields import BOX, Placement, explained, fitting


@pytest.mark.parametrize("name", gallery.names())
def test_a_curve_fills_the_field_up_to_the_margin(name: str) -> None:
    points = gallery.curve(name).points
    placed = np.reshape(fitting(points).forth(points), (-1, 2))
    low, high = placed.min(axis=0), placed.max(axis=0)
    assert (low >= 0.06 * BOX).all() and (high <= 0.94 * BOX).all()
    assert np.ptp(placed, axis=0).max() == pytest.approx(0.88 * BOX, abs=1)
    assert abs(low + high - BOX).max() <= 2


def test_back_is_the_inverse_of_forth() -> None:
    placement = Placement(3.5, -20.0, 7.0)
    places = np.array([[0, 0], [1000, 250]])
    assert placement.forth(placement.back(places)) == places.ravel().tolist()


@pytest.mark.parametrize("points", [eight(), twice(), bows()])
def test_what_would_mend_a_curve_is_drawn_where_the_curve_is(points: np.ndarray) -> None:
    explanation = decompose(points[:-1]).explain()
    seen = explained(explanation, fitting(points))
    best = explanation.suggestions[0]
    mended = np.reshape(seen["mended"], (-1, 2))
    assert len(mended) == len(best.curve) and ((mended >= 0) & (mended <= BOX)).all()
    assert len(seen["lost"]) == len(best.loops)
    assert len(seen["places"]) == 2 * len(explanation.places)
    assert len(seen["negative"]) == len(explanation.negative)
    assert "it bounds one" in seen["advice"]


def test_loops_are_too_many_only_where_the_turning_number_is_not_1() -> None:
    assert explained(decompose(twice()[:-1]).explain(), Placement())["surplus"]
    assert not explained(decompose(bows()[:-1]).explain(), Placement())["surplus"]
