"""Explanations: what is wrong is named, and every suggestion mends it."""

import json
from collections import Counter
from collections.abc import Iterator
from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from noisy_strokes import KINDS, noisy
from numpy.typing import NDArray
from strategies import Points, grid_polygons, random_polygons

from tween import Curve, Decomposition, TweenError, clean, decompose, gallery
from tween.geometry.faces import winding_numbers
from tween.triangulating.repair.explanation import Explanation

EIGHT = [(0, 0), (4, 4), (4, 0), (0, 3)]
BAND = [(0, -1), (3, 1), (6, -1), (6, 1), (3, -1), (0, 1)]
T = 2 * np.pi * np.arange(60) / 60


def scattered() -> Iterator[NDArray[np.float64]]:
    rng = np.random.default_rng(0)
    while True:
        yield rng.normal(size=(int(rng.integers(5, 24)), 2))


def perturbed() -> Iterator[NDArray[np.float64]]:
    """Yield curves of the gallery with some vertices put elsewhere, or two of them exchanged."""
    rng = np.random.default_rng(1)
    while True:
        p = gallery.curve(str(rng.choice(gallery.names()))).points.copy()
        i, j = rng.choice(len(p), 2, replace=False)
        if rng.random() < 0.5:
            p[[i, j]] = p[[j, i]]
        else:
            p[[i, j]] += rng.normal(0, 0.2 * np.ptp(p), (2, 2))
        yield p


def hand_made() -> Iterator[NDArray[np.float64]]:
    """Yield eights, limaçons that turn 2 to 5 times, bands that are twisted, chains of bows, and trembling strokes."""
    rng = np.random.default_rng(2)
    for k in range(2, 6):
        yield np.stack([np.cos(T) + 1.3 * np.cos(k * T), np.sin(T) + 1.3 * np.sin(k * T)], axis=1)
        yield np.stack([k * np.cos(T), np.sin(k * T)], axis=1)
    for twists in range(1, 7):
        x = np.arange(twists + 1.0)
        side = (-1.0) ** x * rng.uniform(0.5, 1.5, twists + 1)
        yield np.concatenate([np.stack([x, side], axis=1), np.stack([x, -side], axis=1)[::-1]])
    for seed in range(16):
        yield noisy("ell", KINDS[seed % 5]._replace(points=300), seed)


def bounding_none(curves: Iterator[NDArray[np.float64]], count: int) -> list[Decomposition]:
    """Take the first curves that can be read and bound no disk."""
    return list(islice((d for d in map(decompose, filter(valid, curves)) if not d), count))


def valid(points: NDArray[np.float64]) -> bool:
    try:
        return bool(len(Curve(points)))
    except ValueError:
        return False


KINDS_OF_CURVES = {
    "scattered": (scattered, 60),
    "perturbed": (perturbed, 60),
    "grid": (lambda: random_polygons("grid", 500, seed=3), 30),
    "winding": (lambda: random_polygons("winding", 500, seed=3), 26),
    "hand-made": (hand_made, 24),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS_OF_CURVES)
def test_at_least_three_quarters_of_the_curves_get_a_suggestion_and_each_mends_them(kind: str) -> None:
    make, count = KINDS_OF_CURVES[kind]
    found = bounding_none(make(), count)
    assert len(found) == count
    seen: Counter[str] = Counter()
    for d in found:
        explanation = d.explain()
        seen["with a suggestion"] += bool(explanation.suggestions)
        for suggestion in explanation.suggestions:
            seen[suggestion.what] += 1
            assert decompose(suggestion.curve.points), explanation
        check(explanation)
    assert seen["with a suggestion"] >= 0.75 * count, seen
    assert sum(share for _, share in KINDS_OF_CURVES.values()) == 200


def check(explanation: Explanation) -> None:
    """What is named is there."""
    points = explanation.curve.points
    for face in explanation.negative:
        assert winding_numbers(points, face.place).tolist() == [face.winding] != [0]
    if explanation.loops:
        assert sum(1 if loop.area > 0 else -1 for loop in explanation.loops) == explanation.curve.turning_number
    cuts = [s.lost for s in explanation.suggestions if s.what == "cut"]
    assert cuts == sorted(cuts) or np.allclose(cuts, sorted(cuts), rtol=1e-8)
    assert all(0 <= s.share <= 1 + 1e-9 for s in explanation.suggestions if s.what == "cut")
    told = json.loads(json.dumps(explanation.to_dict()))
    assert told["summary"] == str(explanation).splitlines()[0]
    assert [len(s["curve"]) for s in told["suggestions"]] == [len(s.curve) for s in explanation.suggestions]


@settings(max_examples=40)
@given(grid_polygons())
def test_curves_that_touch_themselves_are_explained_too(points: Points) -> None:
    d = decompose(points)
    explanation = d.explain()
    assert bool(explanation) == bool(d)
    for suggestion in explanation.suggestions:
        assert decompose(suggestion.curve.points)
    if not d:
        check(explanation)


# What is named


def test_a_figure_eight_turns_one_loop_each_way() -> None:
    explanation = decompose(EIGHT).explain()
    assert "1 loop counter-clockwise less 1 clockwise" in str(explanation)
    assert [round(s.share, 2) for s in explanation.suggestions] == [0.36, 0.64]
    assert explanation.suggestions[0].curve.area == pytest.approx(max(abs(loop.area) for loop in explanation.loops))


def test_a_limacon_loses_its_inner_loop() -> None:
    explanation = decompose(
        np.stack([np.cos(T) + 1.2 * np.cos(2 * T), np.sin(T) + 1.2 * np.sin(2 * T)], axis=1)
    ).explain()
    best = explanation.suggestions[0]
    assert (best.what, best.share < 0.1, len(best.where)) == ("cut", True, 1)
    assert "Its turning number is 2: 2 loops counter-clockwise" in str(explanation)
    assert not explanation.negative


def test_a_band_that_is_twisted_twice_shows_its_back_in_the_middle() -> None:
    explanation = decompose(BAND).explain()
    (face,) = explanation.negative
    assert face.winding == -1 and face.place[0] == pytest.approx(3, abs=1)
    assert "winds clockwise about 1 region" in str(explanation)
    assert explanation.suggestions[0].share == pytest.approx(0.5)


def test_a_trembling_stroke_is_to_be_smoothed_as_it_says() -> None:
    p = noisy("ell", KINDS[0]._replace(points=1500), 0)
    explanation = decompose(p).explain()
    assert explanation.suggestions[0].what == "clean" and explanation.tiny
    best = explanation.suggestions[0]
    assert f"tween.clean(curve, smooth={best.smooth:g})" in explanation.summary
    np.testing.assert_array_equal(clean(explanation.curve, smooth=best.smooth).points, best.curve.points)
    assert any("loops that might be cut off" in words for words in explanation.unseen)


def test_a_curve_that_bounds_a_disk_needs_nothing() -> None:
    explanation = decompose(gallery.curve("pretzel")).explain()
    assert explanation and str(explanation) == "The curve bounds an immersed disk."
    assert explanation.to_dict()["bounds_disk"] is True
    assert explanation.suggestions == ()


def test_of_several_curves_the_first_that_bounds_none_is_explained() -> None:
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    assert decompose(square, EIGHT).explain().reason == "turning number is 0, not 1"
    dart, other = [(0, 0), (3, 1), (6, 0), (3, 6)], [(0, 0), (6, 0), (4, 2), (0, 6)]
    with pytest.raises(TweenError, match="each of these bounds a disk"):
        decompose(dart, other).explain()


def test_too_many_crossings_are_not_looked_at_and_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tween.triangulating.repair.explanation._MOST_CROSSINGS", 0)
    explanation = decompose(EIGHT).explain()
    assert not explanation.loops and not explanation.suggestions
    assert "Not looked at: loops and regions, as there are more than 0 crossings" in str(explanation)


@pytest.mark.parametrize("scale", [2.0**-20, 2.0**20])
def test_another_unit_gives_the_same_explanation(scale: float) -> None:
    one, other = decompose(BAND).explain(), decompose(scale * np.array(BAND)).explain()
    assert [s.share for s in other.suggestions] == [s.share for s in one.suggestions]
    for a, b in zip(one.suggestions, other.suggestions, strict=True):
        np.testing.assert_array_equal(b.curve.points, scale * a.curve.points)
