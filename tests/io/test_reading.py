"""Curves are read from every format, one of several by its choice, and what is not used is said."""

import io
import json
import sys
from pathlib import Path

import numpy as np
import pytest
from files import FIXTURES, complaint, saved
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from malformed import MALFORMED, SQUARE, npy, npz, svg

from tween.errors import CurveError, FileError, NotUsedWarning
from tween.io.formats.svg_path import MOST_POINTS
from tween.io.reading import read_curve, read_curves, read_stroke, stroke
from tween.triangulating.decomposition import decompose

FEW = settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])

# Reading


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.csv", "0,0\n1,0\n1,1\n0,1\n"),
        ("a.csv", "x,y\r\n0,0\r\n1,0\r\n1,1\r\n0,1\r\n"),
        ("a.csv", "x [mm], y [mm]\n0,0\n1,0\n1,1\n0,1\n"),
        ("a.csv", '"x";"y"\n0;0\n1;0\n1;1\n0;1'),
        ("a.CSV", "# made by hand\n\n 0 0\n1\t0\n  1   1e0\n0 1\n\n"),
        ("a.csv", "\ufeffx,y\n0,0\n1,0\n1,1\n0,1\n0,0\n"),
        ("a.csv", "0,0\n0,0\n1,0\n1,1\n1,1\n1,1\n0,1\n0,0\n0,0"),
        ("a.json", "[[0, 0], [1, 0], [1, 1.0], [0, 1]]"),
        ("a.json", '\ufeff{"points": [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]}'),
        ("a.json", '{"curves": {"square": [[0, 0], [1, 0], [1, 1], [0, 1]]}}'),
        ("a.json", '{"type": "LineString", "coordinates": [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]}'),
        ("a.geojson", '{"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]]}'),
        ("a.svg", svg('<path d="M0 0H1V-1H0z"/>')),
        ("a.svg", svg('<rect y="-1" width="1" height="1"/><defs><circle r="3"/></defs>')),
        (
            "a.svg",
            '<?xml version="1.0" encoding="UTF-16"?><svg><polygon points="0,0 1,0 1-1 0-1"/></svg>'.encode("utf-16"),
        ),
        ("a.npz", npz(points=np.array(SQUARE))),
        ("a.npz", npz(square=np.array(SQUARE, dtype=np.float32))),
        ("a.npy", npy(np.asfortranarray(np.array(SQUARE, dtype=">i4")))),
    ],
)
def test_a_square_is_read_from_every_format(tmp_path, name, content):
    curve = read_curve(saved(tmp_path, name, content))
    corners = {tuple(p) for p in curve.points.tolist()}
    assert corners == {tuple(p) for p in SQUARE}
    assert len(curve) == 4


# Nothing is lost in silence


def test_a_hole_of_a_polygon_is_a_curve_of_its_own():
    """Its area was once left in: 100 instead of 99."""
    with pytest.warns(NotUsedWarning, match="not used: 1 Point, 1 empty feature, heights"):
        curves = read_curves(FIXTURES / "regions.geojson")
    assert {name: curve.points.tolist() for name, curve in curves.items()} == {
        "island.outer": [[0, 0], [4, 0], [4, 3]],
        "island.hole1": [[1, 0.5], [2, 0.5], [2, 1]],
        "7": [[0, 0], [1, 0], [1, 1]],
    }


RING, HOLE = [[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]], [[1, 1], [2, 1], [2, 2], [1, 2], [1, 1]]
FAR = [[20, 0], [21, 0], [21, 1], [20, 0]]


@pytest.mark.parametrize(
    ("geometry", "parts"),
    [
        (
            {"type": "Polygon", "coordinates": [RING, HOLE]},
            {"outer": "outer ring of a Polygon with 1 hole", "hole1": "hole of a Polygon"},
        ),
        (
            {"type": "MultiPolygon", "coordinates": [[RING], [FAR]]},
            {"part1": "part 1 of a MultiPolygon of 2", "part2": "part 2 of a MultiPolygon of 2"},
        ),
        (
            {"type": "MultiLineString", "coordinates": [RING, FAR]},
            {"part1": "part 1 of a MultiLineString of 2", "part2": "part 2 of a MultiLineString of 2"},
        ),
    ],
)
def test_of_a_geometry_of_several_parts_one_has_to_be_chosen(tmp_path, geometry, parts):
    feature = {"type": "Feature", "properties": {}, "geometry": geometry}
    for content in (geometry, feature, {"type": "FeatureCollection", "features": [feature]}):
        path = saved(tmp_path, "a.geojson", json.dumps(content))
        message = complaint(path, read_curve)
        assert message.startswith("holds 2 curves, expected the choice of one by id or place")
        for name, part in parts.items():
            assert f"{name!r} ({part})" in message
        first = next(iter(parts))
        assert len(read_curve(path, first)) == 4
        assert list(read_curves(path)) == list(parts)


def test_a_polygon_of_one_ring_and_a_multipolygon_of_one_part_are_one_curve(tmp_path):
    for geometry in ({"type": "Polygon", "coordinates": [RING]}, {"type": "MultiPolygon", "coordinates": [[RING]]}):
        path = saved(tmp_path, "a.geojson", json.dumps({"type": "Feature", "id": "a", "geometry": geometry}))
        assert list(read_curves(path)) == ["a"]
        assert read_curve(path).area == 100


@pytest.mark.parametrize(
    ("name", "content", "unused"),
    [
        ("a.svg", svg('<path d="M0 0h1v1z"/><text>a</text><text>b</text><image/>'), "2 texts, 1 image"),
        ("a.svg", svg('<path d="M0 0h1v1z"/><line x2="4"/>'), "1 line"),
        ("a.svg", svg('<style>path{display:none}</style><path d="M0 0h1v1z"/>'), "1 style sheet"),
        ("a.svg", svg('<path d="M0 0h1v1z"/><g display="none"><path d="M0 0h1v1z"/></g>'), "1 hidden element"),
        ("a.svg", svg('<path d="M0 0h1v1z"/><path d="M0 0z"/>'), "1 empty shape"),
        ("a.json", '{"points": [[0, 0], [1, 0], [1, 1]], "triangles": [[0, 1, 2]]}', "'triangles'"),
        ("a.npz", npz(points=np.array(SQUARE), triangles=np.zeros((2, 3))), "'triangles'"),
        ("a.csv", "id,x,y,speed\n1,0,0,3\n2,1,0,4\n3,1,1,5\n", "column 'speed'"),
        ("a.geojson", '{"type": "LineString", "coordinates": [[0, 0, 5], [1, 0, 5], [1, 1, 5]]}', "heights"),
    ],
)
def test_what_a_file_holds_and_nobody_uses_is_said(tmp_path, name, content, unused):
    path = saved(tmp_path, name, content)
    for read in (read_curve, read_curves):
        with pytest.warns(NotUsedWarning) as caught:
            read(path)
        assert [str(warning.message) for warning in caught] == [f"{path}: not used: {unused}"]


# Chosen


@pytest.mark.filterwarnings("ignore::tween.errors.NotUsedWarning")
def test_a_curve_is_chosen_by_id_or_place():
    path = FIXTURES / "layers.svg"
    first, second = read_curve(path, "two.1"), read_curve(path, 2)
    assert np.array_equal(first.points, second.points)
    assert np.array_equal(read_curve(path, "2").points, second.points)
    assert len(read_curve(path, "7", tolerance=1.0)) < len(read_curve(path, "7", tolerance=1e-3))


def test_an_id_goes_before_a_place_and_no_curve_is_lost_to_an_id_that_occurs_twice(tmp_path):
    triangles = [f'<path id="{name}" d="M0 0h{i + 1}v1z"/>' for i, name in enumerate(["1", "a", "a", ""])]
    path = saved(tmp_path, "a.svg", svg("".join(triangles)))
    assert {name: curve.points[:, 0].max() for name, curve in read_curves(path).items()} == {
        "1": 1,
        "a": 2,
        "2": 3,
        "3": 4,
    }
    assert read_curve(path, "1").points[:, 0].max() == 1
    assert read_curve(path, 1).points[:, 0].max() == 2
    twice = saved(tmp_path, "b.svg", svg('<path id="1" d="M0 0h1v1z"/><path d="M0 0h2v1z"/>'))
    assert list(read_curves(twice)) == ["1", "1'"]


@pytest.mark.parametrize("select", [None, "zz", 100, -1, "100", "-1", "", "9" * 99])
def test_of_many_curves_an_error_lists_ten(tmp_path, select):
    path = saved(tmp_path, "a.svg", svg("".join(f'<path id="p{i}" d="M0 0h1v1z"/>' for i in range(100))))
    with pytest.raises(FileError, match=r"a\.svg: holds .* expected .*: 'p0', 'p1', .*, 'p9', and 90 more$"):
        read_curve(path, select)
    assert len(read_curves(path)) == 100


def test_an_error_about_one_of_many_curves_names_it(tmp_path):
    path = saved(tmp_path, "a.json", json.dumps({"curves": {"good": SQUARE, "bad": SQUARE[:2]}}))
    assert len(read_curve(path, "good")) == 4
    with pytest.raises(CurveError, match="curve 'bad': a curve needs at least 3 vertices"):
        read_curves(path)


# Strokes


@pytest.mark.parametrize("tolerance", [None, 1.0, 1e-2])
def test_a_stroke_is_a_ribbon_as_wide_as_its_path_is_curved(tolerance):
    path = FIXTURES / "loop.svg"
    curve = read_stroke(path, 5, tolerance=tolerance)
    assert decompose(curve)
    assert len(curve.crossings.crossing) == 4
    assert np.hypot(*(curve.points[0] - curve.points[-1])) == pytest.approx(5)
    # The smallest radius of curvature is 14.457, in the second of the cubics.
    assert decompose(read_stroke(path, 28.8, tolerance=tolerance))


def test_a_stroke_that_is_too_wide_names_the_file_and_the_radius():
    with pytest.raises(CurveError, match=r"loop\.svg: spine vertex \d+: radius of curvature 14\.\d is not above"):
        read_stroke(FIXTURES / "loop.svg", 29, tolerance=1e-2)


def test_the_stroke_of_a_closed_path_goes_once_around(tmp_path):
    path = saved(tmp_path, "a.svg", svg('<circle id="o" r="10"/>'))
    curve = read_stroke(path, 2, select="o")
    assert decompose(curve)
    assert curve.area == pytest.approx(2 * np.pi * 20, rel=1e-2)


TURN = "M0 0H40V40"


def pen(**style):
    words = "".join(f' stroke-{key}="{value}"' for key, value in style.items())
    return svg(f'<g stroke-linecap="round"><path d="{TURN}" fill="none" stroke="#000" stroke-width="8"{words}/></g>')


@pytest.mark.parametrize(
    ("style", "area", "box"),
    [
        # Once, all were drawn with flat ends and mitred corners: an area of 640, a box of 44 x 44.
        ({"linecap": "butt"}, 640, (44, 44)),
        ({"linecap": "square"}, 640 + 2 * 32, (48, 48)),
        ({"linecap": "round"}, 640 + np.pi * 16, (48, 48)),
        ({"linecap": "butt", "linejoin": "bevel"}, 640 - 8, (44, 44)),
        ({"linecap": "butt", "linejoin": "round"}, 640 - 16 + np.pi * 4, (44, 44)),
        ({"linecap": "butt", "miterlimit": "1.2"}, 640 - 8, (44, 44)),
        ({}, 640 + np.pi * 16, (48, 48)),  # inherited from the group
    ],
)
def test_a_stroke_has_the_ends_and_the_corners_that_the_drawing_declares(tmp_path, style, area, box):
    curve = read_stroke(saved(tmp_path, "a.svg", pen(**style)), 8)
    assert decompose(curve)
    assert curve.area == pytest.approx(area, rel=3e-3)
    assert np.ptp(curve.points, axis=0) == pytest.approx(box, rel=1e-2)


def test_an_open_line_without_a_fill_suggests_its_pen(tmp_path):
    scaled = svg(f'<g transform="scale(2)"><path id="a" d="{TURN}" style="fill:none;stroke:#000;stroke-width:8"/></g>')
    path = saved(tmp_path, "a.svg", scaled)
    with pytest.warns(NotUsedWarning, match=r"not used: the pen of 'a', 16 wide \(--pen 16, or width=16 of"):
        read_curve(path)
    assert read_stroke(path, 16).area == pytest.approx(4 * 640)


@pytest.mark.parametrize("style", ["fill:red;stroke:#000", "stroke:none;fill:none", "stroke:#000"])
def test_a_filled_or_undrawn_line_suggests_no_pen(tmp_path, style):
    read_curve(saved(tmp_path, "a.svg", svg(f'<path d="{TURN}" style="{style};stroke-width:8"/>')))


# Standard input and path data


@pytest.mark.parametrize(
    "data",
    [
        b"x,y\n0,0\n1,0\n1,1\n0,1\n",
        b"[[0, 0], [1, 0], [1, 1], [0, 1]]",
        b'\xef\xbb\xbf {"points": [[0, 0], [1, 0], [1, 1], [0, 1]]}',
        b'<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H1V-1H0z"/></svg>',
        npz(points=np.array(SQUARE)),
        npy(np.array(SQUARE)),
    ],
)
def test_standard_input_is_read_by_its_first_bytes(data, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))
    assert read_curve("-").area == 1


@pytest.mark.parametrize("data", [b"", b"\0\0", b"{", b"hello"])
def test_standard_input_that_is_no_curve_is_answered_by_one_line(data, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))
    with pytest.raises((FileError, CurveError), match=r"^standard input: [^\n]+$"):
        read_curve("-")


@pytest.mark.parametrize(("data", "count"), [("M0 0H4V-3Z", 3), (" m 0,0 4 0 0 -3", 3), ("M0-1L1.5.3 2 2z", 3)])
def test_the_data_of_a_path_stand_for_a_file(data, count):
    assert len(read_curve(data)) == count


@pytest.mark.parametrize("data", ["M0 0", "M0 0L1 0 1", "M0 0H1V1ZM5 5H6V6Z"])
def test_faulty_data_of_a_path_are_answered_by_one_line(data):
    with pytest.raises((FileError, CurveError), match=r"^path data M0 0[^\n]*: [^\n]+$"):
        read_curve(data)


@pytest.mark.parametrize("name", ["m1.csv", "M 1.svg", "m.npz"])
def test_a_name_of_a_file_is_no_path_data(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FileError, match="No such file"):
        read_curve(name)


# Malformed files


def test_there_are_enough_kinds_of_malformed_files():
    assert len(MALFORMED) >= 100


@pytest.mark.parametrize("kind", MALFORMED)
def test_a_malformed_file_is_answered_by_one_line(tmp_path, kind):
    suffix, content = MALFORMED[kind]
    path = saved(tmp_path, f"malformed{suffix}", content)
    assert complaint(path, read_curve)
    if len(content) < 10_000:  # the others take a second each
        assert complaint(path, read_curves)
        assert complaint(path, lambda p: read_stroke(p, 1e300))


@pytest.mark.parametrize("tolerance", [0, -1, float("nan"), float("inf")])
def test_a_tolerance_is_a_positive_length(tolerance):
    with pytest.raises(FileError, match="tolerance"):
        read_curve(FIXTURES / "loop.svg", tolerance=tolerance)


def test_a_tolerance_that_takes_too_many_points_is_refused():
    with pytest.raises(FileError, match=f"more than {MOST_POINTS} points"):
        read_curve(FIXTURES / "loop.svg", tolerance=1e-15)


VALID = [
    (".svg", (FIXTURES / "layers.svg").read_bytes()),
    (".svg", (FIXTURES / "loop.svg").read_bytes()),
    (".csv", b"x,y\n0,0\n1,0\n1,1\n0,1\n"),
    (".geojson", (FIXTURES / "regions.geojson").read_bytes()),
    (".npz", npz(points=np.array(SQUARE))),
    (".npy", npy(np.array(SQUARE))),
]


@pytest.mark.filterwarnings("ignore::tween.errors.NotUsedWarning")
@settings(FEW, max_examples=300)
@given(
    st.sampled_from(VALID),
    st.lists(st.tuples(st.floats(0, 1, exclude_max=True), st.binary(max_size=3)), max_size=4),
    st.floats(0, 1),
)
def test_damage_is_read_or_answered_by_one_line(tmp_path, valid, changes, end):
    suffix, data = valid
    for place, new in changes:
        at = int(place * len(data))
        data = data[:at] + new + data[at + len(new) :]
    data = data[: int(len(data) * end)] if end < 0.5 else data
    path = saved(tmp_path, f"damaged{suffix}", data)
    try:
        read_curves(path)
    except (FileError, CurveError) as error:
        assert str(error).startswith(f"{path}: ")
        assert str(error).isprintable()


# Failing to write


def test_a_stroke_of_path_data_is_that_of_a_file(tmp_path: Path) -> None:
    data = "M10 80C40 80 90 70 90 40S70 5 55 20s0 50 35 50a20 20 0 0 0 20-20v-20"
    path = tmp_path / "loop.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{data}"/></svg>')
    for tolerance in (None, 0.5):
        drawn = stroke(data, 6, tolerance)
        np.testing.assert_array_equal(drawn.points, read_stroke(path, 6, tolerance=tolerance).points)
    assert len(drawn.crossings) > 0
    assert len(stroke(data, 6, cap=4)) == len(stroke(data, 6)) + 8


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ("", "0 lines"),
        ("M0 0L1 1M2 2L3 3", "2 lines"),
        ("M0 0L1 frog", "path data"),
        ("M0 0L1e400 1", "path data"),
        ("M0 0L1 0L1 1", "too|width|radius"),
    ],
)
def test_what_is_no_single_line_is_refused(data: str, words: str) -> None:
    with pytest.raises(CurveError, match=words):
        stroke(data, 3)
