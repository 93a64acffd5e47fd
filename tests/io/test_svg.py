"""Outlines are found where SVG says they are, and curves lie within the tolerance of their polylines."""

import itertools
from pathlib import Path

import numpy as np
import pytest
import shapely
from fontTools.pens.recordingPen import RecordingPen
from fontTools.svgLib.path import parse_path as other_parser
from hypothesis import given
from hypothesis import strategies as st

from tween.errors import FileError
from tween.io.svg import MOST_ELEMENTS, read_svg
from tween.io.svg_path import checked, flattened, numbers, rectangle
from tween.io.writers import drawing
from tween.plot.shapes import SOURCE

FIXTURES = Path(__file__).parent / "fixtures"
IDENTITY = np.eye(3)

coordinates = st.floats(-100, 100).map(lambda x: round(x, 3))


def svg(content):
    return f'<svg xmlns="http://www.w3.org/2000/svg">{content}</svg>'.encode()


def polylines(d, tolerance=1e-3, matrix=IDENTITY):
    return flattened(checked(d), matrix, tolerance)


def farthest(points, line):
    return float(shapely.distance(shapely.points(points), shapely.LineString(line)).max())


# Path data


@st.composite
def straight_paths(draw):
    """Path data of straight segments, as text, and the subpaths that they are, by hand."""
    text, lines, x, y, closed = "", [], 0.0, 0.0, True
    for letter in ["M", *draw(st.lists(st.sampled_from("MmLlHhVvZz"), min_size=1, max_size=12))]:
        p, q = draw(coordinates), draw(coordinates)
        given_numbers = {"H": [p], "V": [q], "Z": []}.get(letter.upper(), [p, q])
        text += (
            draw(st.sampled_from(["", " ", "\n"]))
            + letter
            + draw(st.sampled_from([" ", ","])).join(map(repr, given_numbers))
        )
        if closed and letter not in "Mm":
            lines.append([(x, y)])
        if letter in "Zz":
            x, y = lines[-1][0]
        else:
            relative = letter.islower()
            x = x if letter == "v" or letter == "V" else (x if relative else 0.0) + p
            y = y if letter == "h" or letter == "H" else (y if relative else 0.0) + q
        if letter in "Mm":
            lines.append([])
        lines[-1].append((x, y))
        closed = letter in "Zz"
    return text, lines


@given(straight_paths())
def test_straight_segments_end_where_their_commands_say(path):
    d, expected = path
    found = polylines(d)
    assert len(found) == len(expected)
    for line, points in zip(found, expected, strict=True):
        assert np.array_equal(line, np.array(points) * [1, -1])


@given(st.lists(st.tuples(st.sampled_from("CcSsQqTtAaLl"), st.tuples(*[coordinates] * 6)), min_size=1, max_size=6))
def test_curves_agree_with_those_of_another_parser(commands):
    counts = {"C": 6, "S": 4, "Q": 4, "T": 2, "L": 2}
    d = "M1 2"
    for letter, values in commands:
        if letter in "Aa":
            rx, ry, turn, x, y, flags = values
            values = [1 + abs(rx), 1 + abs(ry), turn, int(flags) % 2, int(flags) // 2 % 2, x, y]
        else:
            values = values[: counts[letter.upper()]]
        d += letter + " ".join(map(repr, values))
    (line,) = polylines(d, tolerance=1e-3)
    pen = RecordingPen()
    other_parser(d, pen)
    here, size = np.zeros(2), np.ptp(line, axis=0).max() + 10
    for command, ends in pen.value:
        p = [here, *np.array(ends).reshape(-1, 2)]
        t = np.linspace(0, 1, 30)[:, None]
        for _ in range(len(p) - 1):  # de Casteljau
            p = [a + t * (b - a) for a, b in itertools.pairwise(p)]
        if command not in ("moveTo", "endPath", "closePath"):
            # The other parser makes four cubics of a circle, which are off by 3e-4 of the radius.
            assert farthest(p[0] * [1, -1], line) <= 1e-3 * size
        here = np.array(ends[-1]) if ends else here


@given(
    st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=3),
    st.sampled_from([10.0, 1.0, 1e-2, 1e-4]),
    st.tuples(*[st.floats(-3, 3)] * 4),
)
def test_a_bezier_curve_lies_within_the_tolerance_of_its_polyline(controls, tolerance, linear):
    matrix = np.array([[*linear[:2], 5], [*linear[2:], -7], [0, 0, 1]])
    d = "M0 0" + "_LQC"[len(controls)] + " ".join(f"{x!r} {y!r}" for x, y in controls)
    (line,) = polylines(d, tolerance, matrix)
    p = [np.array(c)[None] for c in [(0.0, 0.0), *controls]]
    t = np.linspace(0, 1, 500)[:, None]
    while len(p) > 1:
        p = [a + t * (b - a) for a, b in itertools.pairwise(p)]
    truth = (p[0] @ matrix[:2, :2].T + matrix[:2, 2]) * [1, -1]
    assert farthest(truth, line) <= tolerance + 1e-9


@given(
    st.floats(0, 360),
    st.floats(10, 350),
    st.floats(0.1, 20),
    st.floats(0.1, 20),
    st.floats(-180, 180),
    st.booleans(),
    st.sampled_from([1.0, 1e-2, 1e-4]),
)
def test_an_arc_goes_the_way_its_flags_say_within_the_tolerance(start, angle, rx, ry, turn, clockwise, tolerance):
    t = np.radians(start + (1 if clockwise else -1) * np.linspace(0, angle, 400))
    truth = np.exp(1j * np.radians(turn)) * (rx * np.cos(t) + 1j * ry * np.sin(t)) + 3 - 2j
    first, last = complex(truth[0]), complex(truth[-1])
    flags = f"{int(angle > 180)}{int(clockwise)}"  # without a separator, as programs that save space write it
    d = f"M{first.real!r} {first.imag!r}A{rx!r} {ry!r} {turn!r} {flags}{last.real!r} {last.imag!r}"
    (line,) = polylines(d, tolerance)
    shape = np.stack([truth.real, -truth.imag], axis=1)
    # Near half a turn the centre moves by the root of a rounding error in the ends.
    slack = 1e-5 * max(rx, ry)
    if abs(angle - 180) > 1:
        assert farthest(shape, line) <= tolerance + slack
        assert farthest(line, shape) <= slack + 1e-3 * max(rx, ry)
    assert np.array_equal(line[[0, -1]], shape[[0, -1]])


def test_half_the_tolerance_takes_about_the_root_of_two_as_many_points():
    lengths = [len(polylines("M0 0C0 100 100 100 100 0", tolerance)[0]) for tolerance in (0.1, 0.05, 0.025)]
    assert lengths == pytest.approx([lengths[0] * 2 ** (k / 2) for k in range(3)], rel=0.1)


def test_the_tolerance_is_a_thousandth_of_the_larger_side_unless_given():
    d = "M0 0A50 50 0 0 1 100 0A50 50 0 0 1 0 0"
    assert len(flattened(d, IDENTITY)[0]) == len(flattened(d, IDENTITY, 0.1)[0])
    assert len(flattened(d, 7 * IDENTITY)[0]) == len(flattened(d, IDENTITY, 0.1)[0])


@pytest.mark.parametrize(
    "d",
    """garbage|L1 1|M|M1|M12|M0 0 1|M0 0L1|M0 0 1 1 x|M0 0H|M0 0V|M0 0Q1 1 2|M0 0S1 1|M0 0C1 1 2 2 3|M0 0Z1 1|\
M0 0 1px 2px|M 0 0 L nan 1|M0 0L1e 2|M0 0L1,,2;3|M0 0L\u0661 2|M0 0A1 1 0 2 0 3 3|M0 0A-1 1 0 0 0 3 3|\
M0 0A1 1 0 0 0 3""".split("|"),
)
def test_path_data_of_wrong_grammar_are_refused(d):
    with pytest.raises(FileError, match="path data"):
        checked(d)


@given(st.text("MmLlHhVvCcSsQqTtAaZz0123456789.-+eE ,\n", max_size=40))
def test_of_path_data_of_right_grammar_no_number_is_left_out(d):
    try:
        found = polylines("M0 0" + d, tolerance=1e9)
    except FileError:
        return
    bare = "M0 0" + d
    if not any(letter in bare for letter in "AaEe"):
        per = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "Z": 0}
        parts = ["".join(g) for g in _split(bare)]
        segments = sum(1 if part[0] in "Zz" else len(numbers(part[1:])) // per[part[0].upper()] for part in parts)
        restarts = sum(a[0] in "Zz" and b[0] not in "Mm" for a, b in itertools.pairwise(parts))
        assert sum(map(len, found)) == segments + restarts


def _split(d):
    part = ""
    for c in d.strip():
        if c.isalpha() and part:
            yield part
            part = ""
        part += c
    yield part


def test_a_long_run_of_digits_or_spaces_is_refused_at_once():
    for d in ("M" + "1" * 10**6, "M0 0" + " " * 10**6 + "q", "M0 0A1 1 0 0 1 " + "1" * 10**6):
        with pytest.raises(FileError):
            checked(d)


# Shapes


def test_a_circle_lies_on_its_circle():
    (line,) = flattened(rectangle(0.1, 0.2, 0.6, 0.6, 0.3, 0.3), IDENTITY)
    assert np.hypot(*(line - [0.4, -0.5]).T) == pytest.approx(0.3, rel=1e-12)
    assert np.hypot(*np.diff(line, axis=0).T)[np.any(np.diff(line, axis=0), axis=1)].min() > 0.03


def test_a_round_rectangle_keeps_its_straight_sides():
    (line,) = flattened(rectangle(0.0, 0.0, 10.0, 6.0, 2.0, 9.0), IDENTITY, 1e-3)
    shape = shapely.Polygon(line)
    assert shape.bounds == (0, -6, 10, 0)
    # The radius of 9 is cut down to half the height.
    assert shape.area == pytest.approx(60 - (4 - np.pi) * 2 * 3, abs=0.05)


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
    ((_, line),) = read_svg(svg(shape), 1e-6)
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
    ((_, line),) = read_svg(svg(f'<g transform="{transform}"><path d="M2 1 7 7"/></g>'))
    assert line[0] * [1, -1] == pytest.approx(image)


def test_a_drawing_of_layers_is_read_as_it_is_drawn():
    outlines = dict(read_svg((FIXTURES / "layers.svg").read_bytes()))
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
    ((_, line),) = read_svg(svg(groups))
    assert line[0].tolist() == [500, 0]


def test_repetitions_that_multiply_are_refused():
    rows = "".join(f'<g id="a{i + 1}">' + f'<use href="#a{i}"/>' * 10 + "</g>" for i in range(9))
    with pytest.raises(FileError, match=str(MOST_ELEMENTS)):
        read_svg(svg(f'<path id="a0" d="M0 0 1 0 1 1z"/>{rows}'))


# Drawing


def test_a_drawing_is_a_small_picture_with_the_shape_inside():
    text = drawing(np.array([[[10.0, 10.0], [30.0, 10.0], [20.0, 20.0]]]))
    assert 'width="640" height="349" viewBox="9 -21 22 12"' in text
    assert text.count("<path") == 1


def test_frames_stand_side_by_side_and_do_not_overlap():
    shape = np.array([[0.0, 0.0], [2.0, 0.0], [1.0, 1.0]])
    shapes = np.array([shape, shape + 0.5, shape * 0.5, shape, shape])
    outlines = dict(read_svg(drawing(shapes, np.array([[[0, 1, 2]]] * 5)).encode()))
    boxes = [shapely.box(*outlines[f"frame_{i}"].min(axis=0), *outlines[f"frame_{i}"].max(axis=0)) for i in range(5)]
    assert not any(a.intersects(b) for a, b in itertools.combinations(boxes, 2))
    assert [np.ptp(outlines[f"frame_{i}"], axis=0).tolist() for i in (0, 2)] == [[2, 1], [1, 0.5]]


def test_shapes_have_the_colour_that_sources_have_in_figures():
    assert f'fill="{SOURCE}"' in drawing(np.array([[[0.0, 0.0], [2.0, 0.0], [1.0, 1.0]]]))
