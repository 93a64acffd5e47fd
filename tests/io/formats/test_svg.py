"""Outlines are found where SVG says they are, and curves lie within the tolerance of their polylines."""

import numpy as np
import pytest
from files import FIXTURES, named

from tween.errors import FileError
from tween.io.formats.svg import MOST_ELEMENTS, read_svg

IDENTITY = np.eye(3)


def svg(content):
    return f'<svg xmlns="http://www.w3.org/2000/svg">{content}</svg>'.encode()


# Shapes


@pytest.mark.parametrize(
    ("shape", "box"),
    [
        ('<rect x="1" y="2" width="3" height="4"/>', (1, -6, 4, -2)),
        ('<rect width="1in" height="25.4mm" rx="auto"/>', (0, -96, 96, 0)),
        ('<rect width="6" height="4" ry="1"/>', (0, -4, 6, 0)),
        ('<circle r="2"/>', (-2, -2, 2, 2)),
        ('<ellipse cx="5" cy="1" rx="2" ry="3"/>', (3, -4, 7, 2)),
        ('<polygon points="0,0 4 0 4,5"/>', (0, -5, 4, 0)),
        ('<polyline points="0,0 4 0 4,5"/>', (0, -5, 4, 0)),
        ('<path d="M0 0h4v5"/>', (0, -5, 4, 0)),
    ],
)
def test_shapes_lie_where_their_attributes_say(shape, box):
    ((_, line),) = named(read_svg(svg(shape), 1e-6))
    assert (*line.min(axis=0), *line.max(axis=0)) == pytest.approx(box)


@pytest.mark.parametrize(
    ("transform", "image"),
    [
        ("translate(3)", (5, 1)),
        ("translate(3 4)", (5, 5)),
        ("scale(2)", (4, 2)),
        ("scale(2,-3)", (4, -3)),
        ("rotate(90)", (-1, 2)),
        ("rotate(90 1 1)", (1, 2)),
        ("skewX(45)", (3, 1)),
        ("skewY(45)", (2, 3)),
        ("matrix(1 2 3 4 5 6)", (10, 14)),
        ("translate(10), scale(2)", (14, 2)),
        (" scale(2)\ttranslate ( 10 ,0 )", (24, 2)),
    ],
)
def test_transforms_are_those_of_svg(transform, image):
    """Where the point (2, 1), y downwards, comes to lie."""
    ((_, line),) = named(read_svg(svg(f'<g transform="{transform}"><path d="M2 1 7 7"/></g>')))
    assert line[0] * [1, -1] == pytest.approx(image)


def test_a_drawing_of_layers_is_read_as_it_is_drawn():
    outlines = dict(named(read_svg((FIXTURES / "layers.svg").read_bytes())))
    assert list(outlines) == ["turned", "two.0", "two.1", "first", "second", "third", "round", "", "open"]
    assert outlines["turned"].tolist() == [[10, -22], [10, -28], [8, -28], [8, -22], [10, -22]]
    assert outlines["two.1"].tolist() == [[20, -30], [22, -30], [22, -32], [20, -30]]
    assert outlines["first"].tolist() == [[100, 0], [104, 0], [104, -3], [100, 0]]
    assert outlines["second"][0].tolist() == [0, -51]
    assert outlines["open"].tolist() == [[1, 2.5], [0.5, -3], [4, 1]]
    # The sheared ellipse: (x - y) / 4 from its centre, and y / 2.
    x, y = (outlines[""] * [1, -1]).T
    assert ((x - y - 7) / 4) ** 2 + ((y - 8) / 2) ** 2 == pytest.approx(1, abs=1e-9)


def test_five_hundred_nested_groups_are_read():
    groups = '<g transform="translate(1)">' * 500 + '<path d="M0 0 1 0 1 1z"/>' + "</g>" * 500
    ((_, line),) = named(read_svg(svg(groups)))
    assert line[0].tolist() == [500, 0]


def test_repetitions_that_multiply_are_refused():
    rows = "".join(f'<g id="a{i + 1}">' + f'<use href="#a{i}"/>' * 10 + "</g>" for i in range(9))
    with pytest.raises(FileError, match=str(MOST_ELEMENTS)):
        read_svg(svg(f'<path id="a0" d="M0 0 1 0 1 1z"/>{rows}'))
