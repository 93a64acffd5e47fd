"""Strokes become curves, and curves get a verdict in plain words."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from strokes import bows, circle, eight, traced, twice

from tween import gallery
from tween.app.playground.hand_drawn import from_stroke, judge
from tween.errors import CurveError

# Strokes


def test_a_stroke_becomes_evenly_spaced_vertices() -> None:
    points = from_stroke(circle())
    edges = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    assert 60 <= len(points) <= 120
    assert np.ptp(edges) < 0.02 * edges.mean()
    assert abs(np.hypot(*(points - 500).T) - 300).max() < 5


@pytest.mark.parametrize("turns", [0.8, 0.97, 1.0, 1.02, 1.07, 1.1])
@pytest.mark.parametrize("name", ["circle", "loop", "pretzel"])
def test_a_hand_that_stops_early_or_goes_too_far_adds_no_turn(turns: float, name: str) -> None:
    stroke = circle(turns)
    if name != "circle":
        outline = traced(name)
        k = round(turns * len(outline))
        stroke = np.concatenate([outline, outline[1:]])[:k] if turns > 0.9 else outline
        stroke = stroke + np.linspace(0, 12, len(stroke))[:, None]  # beside the beginning, as hands do
    assert judge(from_stroke(stroke)).curve.turning_number == 1


def test_a_trembling_hand_is_smoothed() -> None:
    stroke = circle(k=200) + np.random.default_rng(3).normal(0, 4, (200, 2))
    points = from_stroke(stroke)
    assert not judge(stroke).answer
    assert judge(points).answer
    assert np.hypot(*(points - 500).T).std() < 2


def test_ends_that_are_far_apart_are_kept() -> None:
    stroke = np.array([[200, 800], [300, 300], [700, 300], [800, 800]])
    assert (np.ptp(from_stroke(stroke), axis=0) > [560, 470]).all()


def test_a_long_stroke_has_at_most_120_vertices_and_a_small_one_60() -> None:
    assert len(from_stroke(traced("five_disks"))) == 120
    assert len(from_stroke(0.2 * circle())) == 60


@pytest.mark.parametrize(
    ("stroke", "words"),
    [
        ([], "shape"),
        ([[1, 2, 3]], "shape"),
        ("scribble", "no list of places"),
        ([[0, 0], [float("nan"), 1]], "finite"),
        ([[5, 5]], "too short"),
        ([[5, 5], [6, 6], [5, 5]], "too short"),
    ],
)
def test_what_is_no_stroke_is_refused(stroke: Any, words: str) -> None:
    with pytest.raises(CurveError, match=words):
        from_stroke(stroke)


# Verdicts


@pytest.mark.parametrize(
    ("stroke", "words"),
    [
        (circle(), "Bounds an immersed disk. 75 vertices, no crossings, "),
        (traced("loop"), "Bounds an immersed disk. "),
        (eight(), "Bounds no disk: it turns as much to the right as to the left"),
        (twice(), "Bounds no disk: it turns 2 times"),
        (bows(), "Bounds no disk: it turns once, but"),
    ],
)
@pytest.mark.parametrize("direction", [1, -1])
def test_the_verdict_is_the_same_in_both_directions(stroke: NDArray[np.float64], words: str, direction: int) -> None:
    shape = judge(from_stroke(stroke[::direction]))
    assert shape.words.startswith(words)
    assert bool(shape.answer) == ("immersed" in words)


def test_a_clockwise_curve_is_traversed_the_other_way_and_says_so() -> None:
    assert "clockwise" not in judge(from_stroke(circle())).words
    assert "clockwise" in judge(from_stroke(circle()[::-1])).words


def test_triangulations_of_many_vertices_are_not_counted() -> None:
    ell = gallery.curve("ell")
    assert "triangulations" in judge(ell).words
    shape = judge(ell.insert_vertices(5000))
    assert shape.words == "Bounds an immersed disk. 5000 vertices, no crossings."
    assert "_full" not in vars(shape.answer)  # the whole table was not made
