"""The filled table: nothing for a curve and itself, the same from both sides, dearer where stretch is."""

import numpy as np
import pytest

from tween.gallery import random_disk
from tween.morphing.matching.given import Landmarks
from tween.morphing.matching.levels import first_level
from tween.morphing.matching.shape import Shape

NO_LANDMARKS = Landmarks(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))


def shape(n: int, seed: int) -> Shape:
    return Shape(random_disk(n, np.random.default_rng(seed)), np.zeros(n, dtype=bool))


def least(S: Shape, T: Shape, stretch: float = 0.0) -> float:
    return first_level(S, T, (len(S), len(T)), (1, 1), NO_LANDMARKS, stretch)[0].cost


@pytest.mark.parametrize("seed", range(4))
def test_a_curve_and_itself_cost_nothing(seed: int) -> None:
    assert least(shape(10, seed), shape(10, seed)) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_two_curves_cost_the_same_from_either_side(seed: int) -> None:
    S, T = shape(9, seed), shape(11, seed + 20)
    assert least(S, T) == pytest.approx(least(T, S), rel=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_a_price_of_stretch_makes_nothing_cheaper(seed: int) -> None:
    S, T = shape(9, seed), shape(11, seed + 20)
    assert 0 < least(S, T) <= least(S, T, 1.0) <= least(S, T, 4.0)
