"""Noisy strokes become curves, nothing moves by more than was asked, and what was changed is said."""

import json
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from noisy_strokes import KINDS, SHAPES, Fault, diagonal, noisy, outline, refused, twenty
from numpy.typing import NDArray

from tween import Curve, CurveError, clean, decompose, gallery
from tween.geometry.curve import turning_number

SQUARE = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])


def size_of(p: NDArray[np.float64]) -> float:
    return 2 * float(shapely.minimum_bounding_radius(shapely.multipoints(p)))


def rows_left(p: NDArray[np.float64], curve: Any) -> NDArray[np.bool_]:
    """Say which rows were not dropped."""
    left = np.ones(len(p), dtype=bool)
    for piece in curve.changes.dropped:
        rows = np.arange(len(p))
        first, last = piece.first, piece.last
        left &= ~((rows >= first) & (rows <= last) if first <= last else (rows >= first) | (rows <= last))
    return left


def distances(p: NDArray[np.float64], curve: Curve) -> NDArray[np.float64]:
    return np.asarray(shapely.distance(shapely.points(p), shapely.linearrings(curve.points)))


# Strokes become curves


@pytest.mark.slow
def test_at_least_18_of_20_noisy_strokes_bound_a_disk_and_the_others_say_why() -> None:
    good = 0
    for name, p in twenty():
        curve = clean(p)
        good += bool(decompose(curve.points))
        assert curve.changes.bounds_disk == bool(decompose(curve.points)), name
        assert curve.changes.within and curve.changes.smoothing <= size_of(p) / 20
        assert curve.changes.bounds_disk or curve.changes.reason in str(curve.changes)
    assert good >= 18


@pytest.mark.slow
@pytest.mark.parametrize("index", range(5))
def test_strokes_that_tremble_so_much_that_they_turn_many_times_become_curves(index: int) -> None:
    turns, p = refused()[index]
    assert len(p) == 3000 and turning_number(p) == turns
    curve = clean(p, smooth=0.03 * size_of(p))
    assert decompose(curve.points)
    assert curve.changes.within


def test_a_smoothed_circle_is_rounder_than_the_stroke() -> None:
    t = 2 * np.pi * np.arange(600) / 600
    circle = np.stack([np.cos(t), np.sin(t)], axis=1)
    p = circle + np.random.default_rng(0).normal(0, 0.02, circle.shape)
    curve = clean(p, smooth=0.12)
    assert np.hypot(*curve.points.T).std() < 0.4 * np.hypot(*p.T).std()
    assert abs(np.hypot(*curve.points.T).mean() - 1) < 0.02


# Bounds


@pytest.mark.slow
@settings(max_examples=25)
@given(st.sampled_from(SHAPES), st.sampled_from(KINDS), st.integers(0, 99), st.floats(0.002, 0.06))
def test_nothing_is_farther_from_the_curve_than_was_asked_or_it_is_said(
    name: str, fault: Fault, seed: int, share: float
) -> None:
    p = noisy(name, fault._replace(points=600), seed)
    asked = share * size_of(p)
    curve = clean(p, smooth=asked)
    changes = curve.changes
    left = rows_left(p, curve)
    slack = 1e-9 * asked
    assert distances(p[left], curve).max() <= changes.moved + slack
    stroke = shapely.linearrings(p)
    # The edges that join what is left where a piece was dropped are no part of the stroke; their length is bounded.
    assert shapely.distance(shapely.points(curve.points), stroke).max() <= max(changes.moved, changes.gap) + asked
    assert changes.smoothing <= asked
    assert changes.within == (not changes.beyond)
    if changes.within:
        assert changes.moved <= asked + slack
        assert all(d.reach <= max(asked, changes.close * (d.kind == "end")) + slack for d in changes.dropped)
    else:
        assert "more than was asked" in str(changes)


def test_what_cannot_be_kept_within_the_smoothing_is_said() -> None:
    p = outline("ell", 900)[:-1]
    coarse = clean(p, smooth=1e-4 * diagonal(p), vertices=12)
    assert len(coarse) == 12 and not coarse.changes.within
    assert "the curve is up to" in coarse.changes.beyond[0]
    spike = clean([[0, 0], [1, 0], [1, 1], [0.5, 1], [0.5, 3], [0.5, 1], [0, 1]], smooth=0)
    assert not spike.changes.within
    assert max(piece.reach for piece in spike.changes.dropped) == 2
    assert "spike at (0.5, 3) reached out by 2" in str(spike.changes)


def test_without_smoothing_nothing_moves_and_origin_tells_the_rows() -> None:
    for name in gallery.names():
        p = gallery.curve(name).points
        curve = clean(p, smooth=0, close=0)
        np.testing.assert_array_equal(curve.points, p)
        assert curve.changes.moved == 0 and not curve.changes.dropped
        np.testing.assert_array_equal(curve.origin, np.arange(len(p)))


@pytest.mark.parametrize("name", gallery.names())
def test_a_curve_that_bounds_a_disk_and_does_not_tremble_is_left_alone(name: str) -> None:
    c = gallery.curve(name)
    curve = clean(c)
    assert curve.changes.bounds_disk
    np.testing.assert_array_equal(curve.points, c.points)
    assert str(curve.changes) == "not smoothed\nbounds a disk"


# Idempotence and invariance


@pytest.mark.parametrize("kind", range(5))
def test_cleaning_without_smoothing_twice_is_cleaning_once(kind: int) -> None:
    once = clean(noisy("loop", KINDS[kind]._replace(points=400), 3), smooth=0)
    again = clean(once, smooth=0, close=0)
    np.testing.assert_array_equal(again.points, once.points)
    assert again.changes.moved == 0


@pytest.mark.parametrize("kind", range(5))
def test_cleaning_a_cleaned_curve_again_moves_it_less(kind: int) -> None:
    p = noisy("horseshoe", KINDS[kind], 2)
    once = clean(p, smooth=0.03 * size_of(p))
    again = clean(once, smooth=0.03 * size_of(p))
    assert again.changes.bounds_disk
    assert again.changes.smoothing <= once.changes.smoothing
    assert again.changes.moved < once.changes.moved


@pytest.mark.parametrize("kind", range(5))
@pytest.mark.parametrize("scale", [2.0**-30, 2.0**40])
def test_another_unit_gives_the_same_curve_in_that_unit_to_the_last_bit(kind: int, scale: float) -> None:
    p = noisy("pretzel", KINDS[kind]._replace(points=700), 5)
    for smooth, close in ((None, None), (0.02 * size_of(p), 0.03 * size_of(p))):
        a = clean(p, smooth, close)
        b = clean(scale * p, smooth and scale * smooth, close and scale * close)
        np.testing.assert_array_equal(b.points, scale * a.points)
        assert b.changes.moved == scale * a.changes.moved


@pytest.mark.parametrize("kind", range(5))
def test_a_similarity_of_the_stroke_gives_the_similar_curve(kind: int) -> None:
    p = noisy("e", KINDS[kind]._replace(points=700), 1)
    turn = 3.7 * np.array([[np.cos(0.7), np.sin(0.7)], [-np.sin(0.7), np.cos(0.7)]])
    a = clean(p, vertices=150)
    b = clean(p @ turn + [20, -7], vertices=150)
    np.testing.assert_allclose(b.points, a.points @ turn + [20, -7], atol=1e-7 * size_of(p))
    assert [d.kind for d in b.changes.dropped] == [d.kind for d in a.changes.dropped]


@pytest.mark.parametrize("kind", range(5))
def test_a_mirror_image_gives_the_mirror_image(kind: int) -> None:
    p = noisy("S", KINDS[kind]._replace(points=500), 4)
    a, b = clean(p, vertices=100), clean(p * [-1, 1], vertices=100)
    assert a.reversed_input != b.reversed_input
    mirrored = np.roll(b.points[::-1], 1, axis=0) * [-1, 1]
    np.testing.assert_array_equal(mirrored, a.points)


def test_the_same_stroke_gives_the_same_curve() -> None:
    p = noisy("two_loops", KINDS[2], 6)
    np.testing.assert_array_equal(clean(p).points, clean(p.copy()).points)


# What is dropped


def test_repeated_points_are_dropped_and_counted() -> None:
    p = np.repeat(SQUARE, [1, 3, 1, 2], axis=0)
    curve = clean(np.concatenate([p, p[:1]]), smooth=0)
    np.testing.assert_array_equal(curve.points, SQUARE)
    assert curve.changes.count("repetition") == 4
    assert curve.changes.gap == 0
    assert "4 repeated points at rows 2, 3, 6, ..." in str(curve.changes)


@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("radius", [0.002, 0.006])
def test_loops_smaller_than_the_smoothing_go(side: int, radius: float) -> None:
    p = outline("ell", 900)[:-1]
    size = size_of(p)
    angle = np.linspace(0, 2 * np.pi, 14)[1:-1]
    loop = p[200] + radius * size * np.stack([np.sin(angle), side * (1 - np.cos(angle))], axis=1)
    q = np.concatenate([p[:201], loop, p[200:]])
    curve = clean(q, smooth=4 * radius * size)
    assert turning_number(q) != 1 or len(Curve(q).crossings)
    assert curve.changes.bounds_disk and curve.changes.within
    assert len(curve.crossings) == 0


def test_a_loop_larger_than_the_smoothing_stays() -> None:
    limacon = Curve(loop_inside())
    curve = clean(limacon, smooth=0.05)
    assert curve.turning_number == 2 and len(curve.crossings) == 1
    assert curve.changes.reason == "turning number is 2, not 1"
    assert "bounds no disk: turning number is 2, not 1" in str(curve.changes)


def loop_inside() -> NDArray[np.float64]:
    t = 2 * np.pi * np.arange(120) / 120
    return np.stack([np.cos(t) + 1.2 * np.cos(2 * t), np.sin(t) + 1.2 * np.sin(2 * t)], axis=1)


@pytest.mark.parametrize("share", [0.02, 0.05, 0.08])
def test_an_end_that_goes_past_the_beginning_is_cut_off(share: float) -> None:
    p = noisy("loop", Fault(0.001, wave=4, retraced=-share), 3)
    curve = clean(p, smooth=0.02 * size_of(p))
    assert curve.changes.bounds_disk and curve.changes.within
    assert curve.changes.count("end") >= 1


def test_a_start_that_is_drawn_three_times_is_dropped_once() -> None:
    p = noisy("horseshoe", Fault(0.001, wave=4, retraced=0.05), 3)
    curve = clean(p, smooth=0.02 * size_of(p))
    assert curve.changes.bounds_disk and curve.changes.within
    assert curve.changes.count("retraced") == 1


def test_a_gap_up_to_close_is_said_and_a_larger_one_too() -> None:
    p = noisy("ess", Fault(0.0005, gap=0.02), 1)
    near, far = clean(p, close=2.0), clean(p, close=0.01)
    assert "ends joined across a gap" in str(near.changes) and "more than the" not in str(near.changes)
    assert "more than the 0.01 up to which ends are sought" in str(far.changes)
    assert near.changes.gap > 0.3 and near.changes.bounds_disk


def test_the_number_of_vertices_can_be_asked_for() -> None:
    p = noisy("pretzel", KINDS[0], 1)
    assert len(clean(p, vertices=77)) == 77
    assert len(clean(SQUARE, smooth=0, vertices=9)) == 9
    assert clean(SQUARE, smooth=0, vertices=9).changes.moved == 0
    assert len(clean(SQUARE, smooth=0, vertices=3)) == 3


# What it is, and what is refused


def test_a_cleaned_curve_is_a_curve_and_its_changes_are_numbers() -> None:
    curve = clean(noisy("arrow", KINDS[4], 0))
    assert isinstance(curve, Curve) and repr(curve).startswith("CleanedCurve(")
    told = json.loads(json.dumps(curve.changes.to_dict()))
    assert told["bounds_disk"] is True and told["rows"] == 1000
    assert {piece["kind"] for piece in told["dropped"]} <= {"spike", "loop", "retraced", "end", "repetition"}


@pytest.mark.parametrize(
    ("points", "options", "words"),
    [
        ("scribble", {}, "no array of numbers"),
        ([1, 2, 3], {}, "shape"),
        ([[0, 0], [1, np.nan], [1, 1]], {}, "vertex 1 is"),
        ([[0, 0], [1, 1], [0, 0], [1, 1]], {}, "at least 3 different points, found 2"),
        ([[0, 0], [1, 1], [2, 2]], {"smooth": 0}, "only leads out and back"),
        (SQUARE, {"smooth": -1}, "smooth is -1"),
        (SQUARE, {"smooth": np.nan}, "smooth is nan"),
        (SQUARE, {"close": np.inf}, "close is inf"),
        (SQUARE, {"vertices": 2}, "at least 3"),
    ],
)
def test_what_is_no_stroke_is_refused(points: Any, options: dict[str, Any], words: str) -> None:
    with pytest.raises(CurveError, match=words):
        clean(points, **options)
