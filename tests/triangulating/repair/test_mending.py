"""Suggestions: every one is a curve that bounds a disk, and takes what it says."""

import numpy as np
import oracle
import pytest
from strategies import random_polygons

from tween.geometry.curve import Curve
from tween.geometry.faces import covered_area
from tween.triangulating.decomposition import decompose
from tween.triangulating.repair.mending import in_words, mend


def suggestions(points):
    curve = Curve(points)
    assert not decompose(curve)
    return mend(curve, covered_area(curve.points))


def test_of_an_eight_either_loop_may_stay_and_the_smaller_is_cut_off_first():
    found = suggestions([[0, 0], [4, 4], [4, 0], [0, 3]])
    cut, keep = (s for s in found.suggestions if s.what == "cut")
    assert cut.text.startswith("cut off the loop at") and keep.text.startswith("keep only the loop at")
    assert cut.where == keep.where and cut.share + keep.share == pytest.approx(1)
    assert (found.tried, found.possible) == (2, 2)


@pytest.mark.parametrize("kind", ["scatter", "grid"])
def test_every_suggestion_bounds_a_disk_by_exhaustive_search(kind):
    checked = 0
    for points in random_polygons(kind, 80, seed=4):
        if decompose(points):
            continue
        for s in suggestions(points).suggestions:
            p = s.curve.points
            if s.what == "cut" and len(p) <= 9 and (p == np.round(p, 6)).all():
                assert oracle.turning_number(p) == 1 and oracle.valid_triangulations(p)
            assert decompose(s.curve)
            assert 0 <= s.share <= 1 + 1e-9
            checked += 1
    assert checked > 40


def test_suggestions_stand_in_order_of_what_they_take_and_no_cut_takes_all():
    for points in random_polygons("winding", 60, seed=2):
        if decompose(points):
            continue
        cuts = [s.lost for s in suggestions(points).suggestions if s.what == "cut"]
        assert cuts == pytest.approx(sorted(cuts))


def test_a_ring_of_two_turns_needs_one_cut():
    t = np.linspace(0, 4 * np.pi, 40, endpoint=False)
    r = 1 + 0.3 * np.cos(t / 2)
    first = suggestions(np.stack([r * np.cos(t), r * np.sin(t)], axis=1)).suggestions[0]
    assert first.curve.turning_number == 1 and len(first.where) <= 1


@pytest.mark.parametrize(
    ("place", "size", "text"),
    [
        ((1e-17, 0.123456), 2.0, "(0, 0.123)"),
        ((1234.567, 0.1), 5000.0, "(1235, 0)"),
        ((1e-9, 2e-9), 1e-8, "(1e-09, 2e-09)"),
    ],
)
def test_places_are_written_as_far_as_they_matter(place, size, text):
    assert in_words(place, size) == text
