"""Correspondence before anything moves: by a common triangulation, by pivots, by a match."""

import numpy as np
import pytest

from tween import gallery
from tween.errors import IncompatibleError
from tween.geometry.triangulation import Triangulation
from tween.morphing.alignment import equal_counts
from tween.morphing.correspondence import aligned, are_compatible, flipping_shift, from_match, paper_alignment
from tween.morphing.incompatible.flip_sequence import crossings_by_shift
from tween.morphing.matching.match import match
from tween.morphing.motions import Choices, between
from tween.morphing.strategy import paper_morph
from tween.triangulating.decomposition import triangulate


def shapes(*names):
    first, second, *origins = equal_counts(*map(gallery.curve, names))
    return first, second, origins


def test_only_triangulations_that_are_the_same_but_for_numbers_are_compatible():
    T = triangulate(gallery.curve("ess"))
    assert are_compatible(T, T.rolled(7)) and are_compatible(T, T.on_disk())
    assert not are_compatible(T, gallery.curve("ess"))
    assert not are_compatible(T, triangulate(gallery.curve("arrow").insert_vertices(len(T))))


@pytest.mark.parametrize("names", [("ess", "spiral_1"), ("spiral_1", "horseshoe")])
def test_a_common_triangulation_has_no_crossings_and_is_valid_in_both(names):
    first, second, origins = shapes(*names)
    found = aligned("common", first, second, origins)
    assert found.crossings == 0
    Triangulation(found.target.points, found.source.triangles).validate()


def test_where_there_is_none_common_says_so_and_what_would_help():
    first, second, origins = shapes("comb", "five_disks")
    with pytest.raises(IncompatibleError, match="strategy='matched' inserts vertices"):
        aligned("common", first, second, origins)


def test_the_paper_flips_and_auto_flips_where_there_is_nothing_common():
    first, second, origins = shapes("comb", "five_disks")
    paper, auto = (aligned(strategy, first, second, origins) for strategy in ("paper", "auto"))
    assert paper.crossings == auto.crossings > 0 and paper.shift == auto.shift


def test_the_shift_is_a_number_the_one_of_the_pivots_or_the_best_of_all():
    first, second, _ = shapes("arrow", "horseshoe")
    n = len(first)
    assert flipping_shift(first, second, n + 3) == (3, None)
    shift, pivot = flipping_shift(first, second, "pivots")
    assert 0 <= shift < n and pivot is not None
    best, none = flipping_shift(first, second, "all")
    counts = crossings_by_shift(first, second, np.arange(n))
    assert none is None and counts[best] == counts.min() <= counts[shift]


def test_a_complete_match_needs_no_flips():
    a = match(gallery.curve("arrow"), gallery.curve("horseshoe"))
    found = from_match(a)
    assert a.complete and found.crossings == 0
    assert (found.source_vertices == a.source_vertices).all()


@pytest.mark.parametrize("order", ["sequential", "partial"])
def test_many_morphs_along_one_alignment_are_those_of_the_paper(order):
    source, target = gallery.curve("ell"), gallery.curve("two_loops")
    alignment = paper_alignment(source, target)
    for path in ("slide", "linear"):
        m = between(alignment, Choices(path, False, "root", "disk-center", order))
        expected = paper_morph(source, target, path, order=order)
        assert np.array_equal(m.frames(9), expected.frames(9)) and m.events == expected.events
        assert len(m.events) > 0
