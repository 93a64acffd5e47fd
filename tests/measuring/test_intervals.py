"""Interval arithmetic: the true values, in Fractions, lie between the bounds, and these are close."""

from fractions import Fraction
from math import atan2

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tween.measuring.intervals import Interval, angle, between

numbers = st.floats(-1e6, 1e6).filter(lambda x: x == 0 or abs(x) > 1e-6)


def encloses(interval: Interval, value: Fraction) -> bool:
    return Fraction(float(interval.low[0])) <= value <= Fraction(float(interval.high[0]))


def one(x: float) -> Interval:
    return Interval.exact(np.array([x]))


@given(numbers, numbers, numbers, st.floats(0, 1))
def test_results_of_doubles_are_enclosed(x: float, y: float, z: float, t: float) -> None:
    a, b, c = map(Fraction, (x, y, z))
    assert encloses(one(x) + one(y) * one(z), a + b * c)
    assert encloses((one(x) - one(y)) * (one(x) - one(z)), (a - b) * (a - c))
    assert encloses((one(x) - one(y)).square(), (a - b) ** 2)
    assert encloses(between(one(x), one(y), np.array([t])), (1 - Fraction(t)) * a + Fraction(t) * b)
    if y > 0:
        assert encloses(one(x) / one(y), a / b)
    root = one(abs(x)).root()
    assert Fraction(float(root.low[0])) ** 2 <= abs(a) <= Fraction(float(root.high[0])) ** 2


@given(st.floats(-5, 5), st.floats(0, 3), st.floats(0, 5), st.floats(0, 3), st.floats(0, 1), st.floats(0, 1))
def test_the_argument_over_a_box_is_enclosed(x, width, y, height, s, t) -> None:
    box = angle(Interval(np.array([y]), np.array([y + height])), Interval(np.array([x]), np.array([x + width])))
    assert box.low[0] <= atan2(y + t * height, x + s * width) <= box.high[0]


def test_bounds_are_close_and_what_is_not_known_has_none() -> None:
    third = one(1.0) / one(3.0)
    assert 0 < third.high[0] - third.low[0] < 2e-16
    nowhere = one(1.0) / Interval(np.array([-1.0]), np.array([1.0]))
    assert (nowhere.low[0], nowhere.high[0]) == (-np.inf, np.inf)
    wide = Interval(np.array([-2.0]), np.array([1.0]))
    assert wide.square().low[0] == 0.0 and wide.square().high[0] == pytest.approx(4.0)
    assert (-wide).low[0] == -1.0
