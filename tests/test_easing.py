"""Easing: the curves of CSS, their inverses, and what is refused."""

import numpy as np
import pytest

from tween.easing import EASES, Ease, as_ease

TIMES = np.linspace(0.0, 1.0, 101)


@pytest.mark.parametrize("ease", [*EASES.values(), Ease(0.0, 1.0, 1.0, 0.0), Ease(1.0, 0.0, 0.0, 1.0)], ids=str)
def test_an_ease_goes_from_0_to_1_without_turning_back_and_has_an_inverse(ease: Ease) -> None:
    way = ease.at(TIMES)
    assert (way[0], way[-1]) == (0.0, 1.0)
    assert (np.diff(way) >= 0).all()
    assert np.abs(ease.at(ease.when(way)) - way).max() < 1e-12


def test_the_curves_are_those_of_a_browser() -> None:
    # What is known of the named curves at half time, to four digits.
    assert as_ease("ease").at(np.array([0.5]))[0] == pytest.approx(0.8024, abs=1e-4)
    assert as_ease("ease-in").at(np.array([0.5]))[0] == pytest.approx(0.3154, abs=1e-4)
    assert as_ease("ease-out").at(np.array([0.5]))[0] == pytest.approx(0.6846, abs=1e-4)


def test_smooth_is_the_bezier_curve_of_its_numbers() -> None:
    near = Ease(1 / 3, 1e-18, 2 / 3, 1.0)  # not the same numbers, so that the general formula is used
    assert np.abs(as_ease("smooth").at(TIMES) - near.at(TIMES)).max() < 1e-12
    assert np.abs(as_ease("smooth").when(TIMES) - near.when(TIMES)).max() < 1e-7


def test_an_ease_has_several_spellings() -> None:
    assert as_ease(True) == as_ease("smooth")
    assert as_ease(False) == as_ease("linear") == as_ease((0, 0, 1, 1))
    assert as_ease(" cubic-bezier(.25,.1,.25,1) ") == as_ease("ease") == as_ease(as_ease("ease"))


@pytest.mark.parametrize(
    "value",
    ["bounce", "cubic-bezier(1, 2)", "cubic-bezier(a, 0, 1, 1)", "cubic-bezier(0, -0.5, 1, 1)", 3, None, (0, 0, 2, 1)],
)
def test_what_is_no_ease_is_refused(value: object) -> None:
    with pytest.raises(ValueError, match=r"ease is .*, expected"):
        as_ease(value)  # type: ignore[arg-type]
