"""The quick arc tangents and sines: as close to the exact ones as they say, everywhere that bounds ask."""

import math
from fractions import Fraction

import numpy as np
import pytest

from tween.morphing.compatible.guarantee.quick_trigonometry import ERROR, arc_tangent, sine_up_to_pi

UNIT = 2.0**-53  # of the functions of the C library, which are compared with
SIZES = np.concatenate([10.0 ** np.linspace(-300, 300, 301), 1 + np.linspace(-1, 1, 301), [0.66, 1 / 0.66]])


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_arc_tangents_are_close_for_small_and_large_numbers(sign: float) -> None:
    for y in SIZES[SIZES > 0]:
        found = np.array([arc_tangent(y, sign * x) for x in SIZES])
        exact = np.arctan2(y, sign * SIZES)
        assert (np.abs(found - exact) <= (ERROR + UNIT) * exact).all()


def test_on_the_line_the_angle_is_nothing_or_half_a_turn() -> None:
    assert arc_tangent(0.0, 2.0) == 0.0 and arc_tangent(0.0, -2.0) == math.pi


def test_what_is_not_known_stays_so() -> None:
    assert all(map(math.isnan, [arc_tangent(0.0, 0.0), arc_tangent(math.nan, 1.0), arc_tangent(1.0, math.nan)]))
    assert math.isnan(sine_up_to_pi(math.nan))


def test_sines_are_close_up_to_a_straight_angle() -> None:
    small = 10.0 ** np.linspace(-300, 0, 301)
    angles = np.concatenate([np.linspace(0, math.pi, 10_001), small, math.pi - small])
    found = np.array([sine_up_to_pi(angle) for angle in angles])
    exact = np.sin(angles)
    assert (np.abs(found - exact) <= (ERROR + UNIT) * exact).all()


def test_the_sine_of_the_double_next_to_pi_is_what_that_lacks() -> None:
    pi = Fraction("3.14159265358979323846264338327950288419716939937510")
    assert sine_up_to_pi(math.pi) == float(pi - Fraction(math.pi))
