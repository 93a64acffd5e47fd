"""A line drawn with a pen has the ends and corners asked for, and still bounds a disk."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tween.errors import CurveError
from tween.gallery.generators import ribbon
from tween.io.formats.content import Pen
from tween.io.pens import drawn
from tween.triangulating.decomposition import decompose

ZIGZAG = np.array([[0.0, 0.0], [10.0, 0.0], [2.0, 8.0], [12.0, 9.0], [12.0, 20.0]])
CAPS, JOINS = ("butt", "round", "square"), ("miter", "round", "bevel")


def test_without_a_style_it_is_a_ribbon() -> None:
    assert np.array_equal(drawn(ZIGZAG, 1).points, ribbon(ZIGZAG, 1).points)


@pytest.mark.parametrize("cap", CAPS)
@pytest.mark.parametrize("join", JOINS)
def test_every_style_bounds_a_disk_within_the_reach_of_the_pen(cap: str, join: str) -> None:
    curve = drawn(ZIGZAG, 2, Pen(cap=cap, join=join))
    assert decompose(curve)
    reach = {"miter": 4.0, "round": 1.0, "bevel": 1.0}[join] if cap != "square" else {"miter": 4.0}.get(join, 2**0.5)
    t = np.linspace(0, 1, 400)[:, None]
    line = np.concatenate([a + t * (b - a) for a, b in itertools.pairwise(ZIGZAG)])
    distance = np.hypot(*(curve.points[:, None] - line).transpose(2, 0, 1)).min(axis=1)
    assert distance.max() <= reach + 1e-3


@given(st.floats(0.05, 3.0), st.booleans())
def test_a_corner_loses_what_the_join_cuts_off(turn: float, left: bool) -> None:
    sign = 1 if left else -1
    line = np.array([[-30.0, 0.0], [0.0, 0.0], [30 * np.cos(turn), sign * 30 * np.sin(turn)]])
    areas = {join: drawn(line, 2, Pen(join=join, limit=1e6)).area for join in JOINS}
    assert areas["miter"] == pytest.approx(120, rel=1e-9)  # what it adds outside, it takes away inside
    assert areas["bevel"] <= areas["round"] + 1e-9 <= areas["miter"] + 2e-9
    if 1 / np.cos(turn / 2) > 1.01:
        half = turn / 2
        assert areas["bevel"] == pytest.approx(120 - np.tan(half) + np.sin(half) * np.cos(half), rel=1e-9)
        assert areas["round"] == pytest.approx(120 - np.tan(half) + half, rel=2e-3)


def test_a_corner_sharper_than_the_limit_is_bevelled() -> None:
    line = np.array([[-30.0, 0.0], [0.0, 0.0], [-30.0, 12.0]])
    tip = 1 / np.sin(np.arctan2(12, 30) / 2)
    assert drawn(line, 1, Pen(limit=tip + 0.01)).points[:, 0].max() > 2
    assert np.array_equal(drawn(line, 1, Pen(limit=tip - 0.01)).points, drawn(line, 1, Pen(join="bevel")).points)


def test_a_closed_line_has_no_caps() -> None:
    ring = np.array([[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0], [0.0, 0.0]])
    assert drawn(ring, 1, Pen(cap="round")).points.tolist() == drawn(ring, 1).points.tolist()


@pytest.mark.parametrize("join", JOINS)
@pytest.mark.parametrize("width", [30.0, 0.0, -1.0, np.nan, np.inf])
def test_a_width_that_does_not_fit_is_refused(join: str, width: float) -> None:
    for cap in CAPS:
        with pytest.raises(CurveError):
            drawn(ZIGZAG, width, Pen(join=join, cap=cap))


def test_a_short_piece_between_an_outer_and_an_inner_corner_is_refused_or_a_disk() -> None:
    """A mitre lengthens its side of the piece, a bevel does not."""
    for length in (0.6, 0.9, 1.2, 2.5):
        line = np.array([[-9.0, 0.0], [0.0, 0.0], [0.0, length], [9.0, length + 1]])
        for join in JOINS:
            try:
                assert decompose(drawn(line, 2, Pen(join=join)))
            except CurveError as error:
                assert "narrower" in str(error)
