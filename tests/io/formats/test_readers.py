"""What readers take from bytes, and the one line by which they refuse the rest."""

import json

import numpy as np
import pytest
from files import complaint, named, saved
from hypothesis import given
from hypothesis import strategies as st
from malformed import SQUARE, npz
from strategies import exact_doubles

from tween.errors import FileError
from tween.io.formats.readers import points_of, read_arrays, read_json
from tween.io.frames import read_frames


def test_frames_without_times_are_read(tmp_path):
    path = saved(tmp_path, "frames.npz", npz(frames=np.array([SQUARE]), triangles=np.array([[0, 1, 2], [0, 2, 3]])))
    frames, triangles, times = read_frames(path)
    assert frames.shape == (1, 4, 2)
    assert triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert times is None


FRAMES = {"frames": np.array([SQUARE] * 3), "triangles": np.array([[0, 1, 2], [0, 2, 3]]), "times": np.arange(3.0)}


@pytest.mark.parametrize(
    "change",
    [
        {"frames": None},
        {"frames": np.zeros((4, 2))},
        {"frames": np.zeros((0, 4, 2))},
        {"frames": np.zeros((3, 2, 2))},
        {"frames": np.full((3, 4, 2), np.nan)},
        {"frames": np.zeros((3, 4, 2), dtype=bool)},
        {"triangles": np.zeros((3, 3), dtype=int)},
        {"triangles": np.zeros((2, 2, 3), dtype=int)},
        {"triangles": np.zeros((2, 3))},
        {"triangles": np.array([[0, 1, 2], [0, 2, 4]])},
        {"triangles": np.array([[0, 1, 2], [0, 2, -1]])},
        {"times": np.arange(4.0)},
        {"times": np.array([0, np.inf, 1])},
    ],
)
@pytest.mark.parametrize("suffix", [".json", ".npz"])
def test_malformed_frames_are_answered_by_one_line(tmp_path, change, suffix):
    arrays = {name: array for name, array in {**FRAMES, **change}.items() if array is not None}
    text = json.dumps({name: array.tolist() for name, array in arrays.items()})
    path = saved(tmp_path, f"frames{suffix}", npz(**arrays) if suffix == ".npz" else text)
    assert complaint(path, read_frames)


def test_frames_may_come_without_triangles_and_times(tmp_path):
    frames, triangles, times = read_frames(saved(tmp_path, "frames.npz", npz(frames=FRAMES["frames"])))
    assert np.array_equal(frames, FRAMES["frames"])
    assert triangles is None and times is None


@pytest.mark.parametrize("content", ["[1, 2]", "{}", '{"frames": [[1], [2, 3]], "triangles": []}', "", "null"])
def test_what_holds_no_frames_is_answered_by_one_line(tmp_path, content):
    assert complaint(saved(tmp_path, "frames.json", content), read_frames)


# From bytes

points = st.lists(st.tuples(exact_doubles, exact_doubles), min_size=1, max_size=6)


@given(st.dictionaries(st.text(), points))
def test_curves_of_json_keep_their_names_and_their_order(curves):
    found = named(read_json(json.dumps({"curves": curves}).encode()))
    assert [name for name, _ in found] == list(curves)
    assert all(np.array_equal(a, b) for (_, a), b in zip(found, curves.values(), strict=True))


@given(points)
def test_all_ways_to_write_one_curve_in_json_are_read_alike(rows):
    ways = [rows, {"points": rows}, {"curves": {"a": rows}}, {"type": "LineString", "coordinates": rows}]
    ways.append({"type": "Feature", "properties": {}, "geometry": ways[-1]})
    ways.append({"type": "FeatureCollection", "features": [ways[-1]]})
    for way in ways:
        ((_, found),) = named(read_json(json.dumps(way).encode()))
        assert np.array_equal(found, rows)


@pytest.mark.parametrize("data", [b"", b"{", b"NaN", b"[NaN]", b"\xff", b"1e400", b"[" * 10**5])
def test_what_is_no_json_of_points_is_refused(data):
    with pytest.raises(FileError):
        read_json(data)


@given(st.binary(max_size=200))
def test_no_bytes_are_read_as_arrays_by_accident(data):
    for suffix in (".npz", ".npy"):
        with pytest.raises(FileError):
            read_arrays(data, suffix)


def test_of_several_arrays_the_points_count_or_else_all():
    square, other = np.array(SQUARE, dtype=float), np.zeros((5, 2), dtype=np.int8)
    assert [name for name, _ in named(points_of({"a": square, "b": other}))] == ["a", "b"]
    ((name, found),) = named(points_of({"a": other, "points": square}))
    assert name == ""
    assert np.array_equal(found, square)
    assert points_of({"b": other}).outlines[0].points.dtype == np.float64
    with pytest.raises(FileError, match=r"array 'c' has shape \(3,\), expected \(n, 2\)"):
        points_of({"c": np.zeros(3)})
