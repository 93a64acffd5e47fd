"""Letters are immersed disks, upright, and as wide as the pen."""

import numpy as np
import pytest

from tween import gallery
from tween.errors import CurveError
from tween.geometry.curve import Curve
from tween.triangulating.decomposition import decompose

ONE_STROKE_APART = ("C", "U", "c")
CAP = 3
HAVE_STROKES = tuple(chr(i) for i in range(33, 127))


def on_grid(points):
    return bool((points / gallery.GRID == np.rint(points / gallery.GRID)).all())


def pen_width(letter):
    """Return the distance of the two corners at the start of a letter."""
    return float(np.hypot(*(letter.points[0] - letter.points[-1 - CAP])))


@pytest.mark.parametrize("char", HAVE_STROKES)
def test_every_printable_character_is_written_as_an_immersed_disk(char):
    c = gallery.letter(char)
    d = decompose(c)
    assert d, d.reason
    d.arbitrary().validate()
    assert 60 <= len(c) <= 120
    assert on_grid(c.points)


def test_at_least_twelve_letters_take_the_full_pen():
    assert len(gallery.letters()) >= 12
    for char in gallery.letters():
        assert np.array_equal(gallery.letter(char).points, gallery.letter(char, gallery.PEN).points)
        assert pen_width(gallery.letter(char)) == pytest.approx(gallery.PEN, abs=1e-5)


@pytest.mark.parametrize("char", gallery.letters())
def test_letters_cross_themselves_unless_it_is_said_that_they_do_not(char):
    assert (len(gallery.letter(char).crossings) == 0) == (char in ONE_STROKE_APART)


@pytest.mark.parametrize("char", ["A", "E", "G", "a", "b"])
def test_a_tight_bend_takes_the_widest_of_the_narrower_pens_that_fits(char):
    with pytest.raises(CurveError, match=rf"letter '{char}': spine vertex \d+: radius of curvature"):
        gallery.letter(char, gallery.PEN)
    width = pen_width(gallery.letter(char))
    narrowings = np.log(width / gallery.PEN) / np.log(0.75)
    assert narrowings == pytest.approx(round(narrowings), abs=1e-3)
    with pytest.raises(CurveError, match="take a narrower ribbon"):
        gallery.letter(char, width / 0.75)


def test_letters_are_upright():
    low, high = gallery.letter("d").points[:, 1].min(), gallery.letter("d").points[:, 1].max()
    assert -1 < low < 0
    assert high > 20  # the ascender
    assert gallery.letter("z").points[:, 1].min() < -10  # the tail
    assert gallery.letter("L").points[0] @ [0, 1] > 5  # the stroke starts at its top


@pytest.mark.parametrize(("char", "height"), [("i", 6), ("j", 18), ("t", 21)])
def test_a_letter_is_its_longest_stroke_not_its_dot_or_bar(char, height):
    assert np.ptp(gallery.letter(char).points[:, 1]) > height


@pytest.mark.parametrize("char", [" ", "", "ab", "ß"])
def test_a_character_without_a_stroke_is_answered_with_those_that_have_one(char):
    with pytest.raises(CurveError, match=r"no stroke for '.*'; expected one of ! .* A B C .* z"):
        gallery.letter(char)


@pytest.mark.parametrize("width", [0, -1, 1e-9, np.nan])
def test_a_pen_without_width_is_refused(width):
    with pytest.raises(CurveError, match=r"expected at least 0\.01"):
        gallery.letter("c", width)


def test_the_finest_pen_writes_every_character():
    for char in HAVE_STROKES:
        assert isinstance(gallery.letter(char, 0.01), Curve)
