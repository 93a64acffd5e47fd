"""Wishes become shapes, and files that are handed in become curves."""

import io
import json
from typing import Any

import numpy as np
import pytest
from strokes import circle, eight

from tween import gallery
from tween.app.playground.wishes import HINT, granted, handed_in
from tween.errors import TweenError

ARROW = {"name": "arrow"}


def test_a_vertex_goes_to_the_place_to_which_it_was_moved_and_the_others_stay() -> None:
    arrow = gallery.curve("arrow").points
    shape = granted({"of": ARROW, "moved": [[3, 400, 600]]}, {})
    assert shape.curve is not None
    assert np.array_equal(np.delete(shape.curve.points, 3, axis=0), np.delete(arrow, 3, axis=0))
    assert shape.placement == granted(ARROW, {}).placement
    assert shape.placement.forth(shape.curve.points[3:4]) == [400, 600]
    assert shape.moved and shape.curve.origin.tolist() == list(range(len(arrow)))


def test_changes_build_on_each_other() -> None:
    n = len(gallery.curve("arrow"))
    shorter = {"of": ARROW, "without": 0}
    moved = {"of": shorter, "moved": [[0, 300, 300], [1, 320, 300]]}
    assert len(granted(shorter, {}).curve) == len(granted(moved, {}).curve) == n - 1
    assert len(granted({"of": moved, "without": 5}, {}).curve) == n - 2


def test_a_curve_that_bounds_none_is_mended_as_suggested() -> None:
    stroke = {"stroke": eight().tolist()}
    shape = granted(stroke, {})
    assert shape.answer is not None and not shape.answer and shape.explanation is not None
    mended = granted({"of": stroke, "mended": 0}, {})
    assert mended.answer
    assert np.array_equal(mended.curve.points, shape.explanation.suggestions[0].curve.points)
    assert mended.placement == shape.placement and mended.drawn


def test_a_brief_verdict_has_neither_a_count_nor_an_explanation() -> None:
    assert granted(ARROW, {}, brief=True).words == "Bounds an immersed disk. 43 vertices, no crossings."
    assert granted({"stroke": eight().tolist()}, {}, brief=True).explanation is None
    assert granted({"of": {"stroke": eight().tolist()}, "mended": 0}, {}, brief=True).answer


def test_a_change_that_leaves_no_curve_loses_no_point() -> None:
    x, y = granted(ARROW, {}).placement.forth(gallery.curve("arrow").points[4:5])
    shape = granted({"of": {"stroke": circle().tolist()}, "moved": [[5, 0, 0], [6, 0, 0]]}, {})
    assert shape.curve is None and shape.broken is not None and len(shape.broken) == 75
    assert shape.words == "No curve: edge 5-6 has zero length: vertices 5 and 6 are both at (0, 0)."
    mended = granted({"of": {"stroke": circle().tolist()}, "moved": [[5, 0, 0], [6, x, y]]}, {})
    assert mended.curve is not None


@pytest.mark.parametrize(
    ("wish", "words"),
    [
        ({}, HINT),
        ({"name": "draw"}, HINT),
        ({"of": ARROW, "moved": [[43, 0, 0]]}, "vertex is 43, expected one of 0 to 42"),
        ({"of": ARROW, "moved": [[-1, 0, 0]]}, "vertex is -1"),
        ({"of": ARROW, "moved": [["a", 0, 0]]}, "vertex is 'a'"),
        ({"of": ARROW, "moved": [[0, 1]]}, "not enough values"),
        ({"of": ARROW, "moved": [[0, float("nan"), 1]]}, "nan"),
        ({"of": ARROW, "without": 43}, "vertex is 43"),
        ({"of": ARROW, "mended": 0}, "index out of range"),
        ({"of": {"name": "none"}, "without": 0}, "there is no curve 'none'"),
    ],
)
def test_a_wish_that_cannot_be_granted_is_answered_in_words(wish: dict[str, Any], words: str) -> None:
    shape = granted(wish, {})
    assert shape.curve is None and not shape.answer
    assert words in shape.words


# Files


def npz(points: Any) -> bytes:
    stream = io.BytesIO()
    np.savez(stream, points=points)
    return stream.getvalue()


TRIANGLE = [[0, 0], [2, 0], [0, 2]]
RING = [*TRIANGLE, TRIANGLE[0]]
SVG = b'<svg xmlns="http://www.w3.org/2000/svg"><path id="a" d="M0 0H2V2Z"/><path id="b" d="M0 0H2V2H0Z"/>%s</svg>'


@pytest.mark.parametrize(
    ("name", "data", "expected"),
    [
        ("a.csv", b"0,0\n2,0\n0,2\n", {"a.csv": 3}),
        ("a.npz", npz(TRIANGLE), {"a.npz": 3}),
        ("a.GEOJSON", json.dumps({"type": "Polygon", "coordinates": [RING]}).encode(), {"a.GEOJSON": 3}),
        ("two.svg", SVG % b"", {"two.svg: a": 3, "two.svg: b": 4}),
        ("../../etc/a.csv", b"0,0\n2,0\n0,2\n", {"a.csv": 3}),
        ("C:\\curves\\a b.csv", b"0,0\n2,0\n0,2\n", {"a b.csv": 3}),
        ("<b>.csv", b"0,0\n2,0\n0,2\n", {"_b_.csv": 3}),
    ],
)
def test_the_curves_of_a_file_go_by_its_name(name: str, data: bytes, expected: dict[str, int]) -> None:
    curves, notes = handed_in(name, data)
    assert {name: len(curve) for name, curve in curves.items()} == expected
    assert notes == ""


def test_what_of_a_file_is_not_used_is_said() -> None:
    curves, notes = handed_in("two.svg", SVG % b"<text>A</text>")
    assert len(curves) == 2
    assert notes == "two.svg: not used: 1 text"


@pytest.mark.parametrize(
    ("name", "data", "words"),
    [
        ("a.csv", b"", "a.csv: "),
        ("a.csv", b"x,y\n1,2\nfoo,bar\n", "a.csv: line 3 is 'foo,bar'"),
        ("a.svg", b"no svg", "a.svg: "),
        ("a.npz", b"PK\x03\x04", "a.npz: is no archive"),
        ("a.json", b"[[0, 0], [1, 0], [1, 0]]", "a.json: "),
        ("a.exe", b"MZ", "a.exe: "),
        ("", b"", "file"),
        (
            "a.csv",
            b"".join(b"%d,%d\n" % (i, i * i) for i in range(5001)),
            "a.csv: curve '0' has 5001 vertices, more than",
        ),
    ],
)
def test_a_file_that_holds_no_curve_is_refused_in_one_line_that_names_it_and_no_folder(
    name: str, data: bytes, words: str
) -> None:
    with pytest.raises(TweenError) as refused:
        handed_in(name, data)
    text = str(refused.value)
    assert text.startswith(words) and "\n" not in text and "tmp" not in text
