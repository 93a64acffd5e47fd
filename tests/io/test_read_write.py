"""Files give back what was written, or one line that says what is wrong with them; failures destroy nothing."""

import json
from pathlib import Path

import numpy as np
import pytest
from files import FIXTURES, complaint, saved
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from malformed import MALFORMED, SQUARE, npy, npz, svg
from strategies import exact_doubles

from tween import gallery, paper_morph
from tween.errors import CurveError, FileError
from tween.geometry.curve import Curve
from tween.io.read_write import (
    read_curve,
    read_curves,
    read_frames,
    read_stroke,
    stroke,
    write_curve,
    write_frames,
    write_triangulation,
)
from tween.io.svg_path import MOST_POINTS
from tween.morphing.strategy import morph
from tween.triangulating.decomposition import decompose, triangulate
from tween.triangulating.flips import remesh

CURVE_SUFFIXES = (".svg", ".csv", ".json", ".geojson", ".npz", ".npy")
FEW = settings(max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])


# Round trips


@pytest.mark.parametrize("suffix", CURVE_SUFFIXES)
@FEW
@given(points=st.lists(st.tuples(exact_doubles, exact_doubles), min_size=3, max_size=8))
def test_a_curve_is_read_back_exactly(tmp_path, suffix, points):
    try:
        curve = Curve(points)
    except CurveError:
        assume(False)
    path = write_curve(tmp_path / f"curve{suffix}", curve)
    assert np.array_equal(read_curve(path).points, curve.points)
    assert [p.points.tolist() for p in read_curves(path).values()] == [curve.points.tolist()]


@pytest.mark.parametrize("suffix", CURVE_SUFFIXES)
def test_a_curve_of_the_gallery_is_read_back_exactly(tmp_path, suffix):
    curve = gallery.curve("pretzel")
    assert np.array_equal(read_curve(write_curve(tmp_path / f"curve{suffix}", curve)).points, curve.points)


@pytest.mark.parametrize("suffix", [".svg", ".obj", ".json", ".npz"])
def test_a_triangulation_is_written_exactly(tmp_path, suffix):
    T = triangulate(gallery.curve("horseshoe"))
    path = write_triangulation(tmp_path / f"disk{suffix}", T)
    if suffix == ".svg":
        assert np.array_equal(read_curve(path, select="curve").points, T.points)
        assert len(read_curves(path)) == 1 + len(T.triangles)
        return
    if suffix == ".obj":
        rows = [line.split() for line in path.read_text().splitlines()]
        points = np.array([row[1:3] for row in rows if row[0] == "v"], dtype=float)
        triangles = np.array([row[1:] for row in rows if row[0] == "f"], dtype=int) - 1
        assert {row[3] for row in rows if row[0] == "v"} == {"0"}
    else:
        content = json.loads(path.read_text()) if suffix == ".json" else np.load(path)
        points, triangles = np.array(content["points"]), np.array(content["triangles"])
        assert np.array_equal(read_curve(path).points, T.points)
    assert np.array_equal(points, T.points)
    assert np.array_equal(triangles, T.triangles)


@pytest.mark.parametrize("suffix", [".json", ".npz"])
@pytest.mark.parametrize("flips", [False, True])
def test_frames_are_read_back_exactly(tmp_path, suffix, flips):
    m = flipping() if flips else to_disk()
    frames, triangles, times = read_frames(write_frames(tmp_path / f"frames{suffix}", m, 7))
    assert np.array_equal(frames, m.frames(7))
    assert np.array_equal(times, np.linspace(0, 1, 7))
    assert triangles.shape == ((7,) if flips else ()) + m.source.triangles.shape
    for t, shown in zip(times, np.broadcast_to(triangles, (7, *m.source.triangles.shape)), strict=True):
        assert np.array_equal(shown, m.triangles_at(t))


def to_disk():
    T = triangulate(gallery.curve("ell"))
    return morph(T, T.on_disk())


def flipping():
    m = paper_morph(*(remesh(triangulate(gallery.curve(name))) for name in ("ell", "two_loops")))
    assert m.events
    return m


def test_frames_are_written_as_rows_and_as_a_picture(tmp_path):
    m = to_disk()
    header, *rows = write_frames(tmp_path / "frames.csv", m, 3).read_text().splitlines()
    table = np.array([row.split(",") for row in rows], dtype=float)
    assert header == "frame,time,vertex,x,y"
    assert np.array_equal(table[:, 3:].reshape(3, -1, 2), m.frames(3))
    n = len(m.source)
    assert table[[0, n, -1], :3].tolist() == [[0, 0, 0], [1, 0.5, 0], [2, 1, n - 1]]
    outlines = read_curves(write_frames(tmp_path / "frames.svg", m, 3))
    assert np.array_equal(outlines["frame_0"].points, m.source.points)


@pytest.mark.parametrize("suffix", [".svg", ".csv", ".json", ".npz"])
def test_equal_content_makes_equal_bytes(tmp_path, suffix):
    m = to_disk()
    written = [write_frames(tmp_path / f"{i}{suffix}", m, 4).read_bytes() for i in range(2)]
    assert written[0] == written[1]


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
        ("a.geojson", '{"type": "Polygon", "coordinates": [[[0, 0, 5], [1, 0, 5], [1, 1, 5], [0, 1, 5], [0, 0, 5]]]}'),
        ("a.svg", svg('<path d="M0 0H1V-1H0z"/>')),
        ("a.svg", svg('<rect y="-1" width="1" height="1"/><defs><circle r="3"/></defs>')),
        (
            "a.svg",
            '<?xml version="1.0" encoding="UTF-16"?><svg><polygon points="0,0 1,0 1-1 0-1"/></svg>'.encode("utf-16"),
        ),
        ("a.npz", npz(points=np.array(SQUARE), triangles=np.zeros((2, 3)))),
        ("a.npz", npz(square=np.array(SQUARE, dtype=np.float32))),
        ("a.npy", npy(np.asfortranarray(np.array(SQUARE, dtype=">i4")))),
    ],
)
def test_a_square_is_read_from_every_format(tmp_path, name, content):
    curve = read_curve(saved(tmp_path, name, content))
    corners = {tuple(p) for p in curve.points.tolist()}
    assert corners == {tuple(p) for p in SQUARE}
    assert len(curve) == 4


def test_regions_of_geojson_have_their_ids_and_other_geometries_are_passed_over():
    curves = read_curves(FIXTURES / "regions.geojson")
    assert {name: curve.points.tolist() for name, curve in curves.items()} == {
        "island": [[0, 0], [4, 0], [4, 3]],
        "7": [[0, 0], [1, 0], [1, 1]],
    }


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
