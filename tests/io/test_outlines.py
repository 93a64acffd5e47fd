"""Of what a file holds one line is chosen, by names of which no two are equal."""

import numpy as np
import pytest
from files import saved
from malformed import svg

from tween.errors import FileError, NotUsedWarning
from tween.io.formats.content import Outline, Pen
from tween.io.outlines import contents, curve_of, label, pen_hint, read_outline, warn_of

TRIANGLE = '<path id="{}" d="M0 0h1v1z"/>'
CIRCLE = '<circle id="nose" r="1"/>'


def test_names_are_ids_or_places_and_no_two_are_equal(tmp_path):
    path = saved(tmp_path, "a.svg", svg("".join(TRIANGLE.format(name) for name in ("2", "a", "a", ""))))
    assert [outline.name for outline in contents(path).outlines] == ["2", "a", "2'", "3"]


def test_circles_that_only_mark_places_are_no_choice(tmp_path):
    path = saved(tmp_path, "a.svg", svg(TRIANGLE.format("a") + CIRCLE))
    with pytest.raises(FileError, match="holds 2 curves"):
        read_outline(path)
    assert read_outline(path, marked=True).name == "a"
    assert read_outline(path, "nose").name == "nose"


def test_the_style_of_a_line_is_that_of_its_groups_unless_it_has_its_own(tmp_path):
    inner = '<path d="M0 0h1v1" style="stroke-width:2 ; stroke-linecap : round" stroke="inherit"/>'
    outer = f'<g fill="none" stroke="red" stroke-width="5" stroke-linejoin="bevel" transform="scale(3)">{inner}</g>'
    outline = read_outline(saved(tmp_path, "a.svg", svg(outer)), width=6)
    assert outline.pen._replace(width=6.0) == Pen(6.0, "round", "bevel", 4.0, alone=True)
    assert outline.pen.width == pytest.approx(6)
    bare = read_outline(saved(tmp_path, "b.svg", svg('<path d="M0 0h1v1" stroke-width="2"/>')))
    assert bare.pen == Pen()


@pytest.mark.parametrize("width", ["2px", " 2 ", "0.0208333in"])
def test_widths_have_units(tmp_path, width):
    line = f'<path d="M0 0h1v1" fill="none" stroke="red" stroke-width="{width}"/>'
    assert read_outline(saved(tmp_path, "a.svg", svg(line)), width=2).pen.width == pytest.approx(2, rel=1e-4)


@pytest.mark.parametrize("style", ["stroke-width:10%", "stroke-width:wide", "stroke-miterlimit:x", ";;:", "stroke"])
def test_a_style_that_cannot_be_read_is_as_none(tmp_path, style):
    line = f'<path d="M0 0h1v1" fill="none" stroke="red" style="{style}"/>'
    assert read_outline(saved(tmp_path, "a.svg", svg(line)), width=2).pen.limit == 4.0


def test_hints_and_labels_are_short():
    assert len(pen_hint(Outline("a" * 1000, np.zeros((2, 2)), Pen(1 / 3)))) < 140
    assert "0.333333 wide" in pen_hint(Outline("", np.zeros((2, 2)), Pen(1 / 3)))
    assert len(label("M0 0" + "L1 1" * 1000)) < 60


def test_what_is_not_used_is_one_warning_or_none():
    warn_of("a.svg", [])
    with pytest.warns(NotUsedWarning, match=r"^a\.svg: not used: 1 text, 2 images$"):
        warn_of("a.svg", ["1 text", "2 images"])


def test_a_curve_is_made_of_points_that_are_repeated():
    assert len(curve_of(np.array([[0.0, 0], [0, 0], [1, 0], [1, 1], [1, 1], [0, 0]]))) == 3
