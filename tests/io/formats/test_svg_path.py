"""Path data: segments end where their commands say, and polylines keep to the tolerance."""

import itertools

import numpy as np
import pytest
import shapely
from fontTools.pens.recordingPen import RecordingPen
from fontTools.svgLib.path import parse_path as other_parser
from hypothesis import given
from hypothesis import strategies as st

from tween.errors import FileError
from tween.io.formats.svg_path import checked, flattened, numbers, polygon, rectangle

IDENTITY = np.eye(3)


coordinates = st.floats(-100, 100).map(lambda x: round(x, 3))


def polylines(d, tolerance=1e-3, matrix=IDENTITY):
    return flattened(checked(d), matrix, tolerance)


def farthest(points, line):
    return float(shapely.distance(shapely.points(points), shapely.LineString(line)).max())


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


# Lists of numbers


finite = st.floats(allow_nan=False, allow_infinity=False)


@given(st.lists(finite), st.sampled_from([" ", ",", " , ", "\n"]))
def test_numbers_are_read_back_exactly(values, separator):
    assert numbers(separator.join(map(repr, values))) == values


@given(st.lists(st.integers(-99, -1)))
def test_a_sign_separates_numbers(values):
    assert numbers("".join(map(str, values))) == values


@pytest.mark.parametrize("text", ["1 2 x", "1;2", "nan", "inf", "1e999", "1 2px", "\u0661"])
def test_what_is_no_list_of_finite_numbers_is_refused(text):
    with pytest.raises(FileError, match="expected numbers"):
        numbers(text)


@given(st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=9), st.booleans())
def test_a_polygon_written_as_path_data_is_read_back_exactly(points, closed):
    (line,) = polylines(polygon([x for p in points for x in p], closed))
    expected = np.array([*points, *points[:closed]]) * [1, -1]
    assert np.array_equal(line, expected)


def test_an_odd_number_of_coordinates_is_refused_and_none_make_no_path():
    assert polygon([], closed=True) == ""
    with pytest.raises(FileError, match="3 coordinates, expected an even number"):
        polygon([1.0, 2.0, 3.0], closed=False)
