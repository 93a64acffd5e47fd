"""What writers write is read back exactly, and drawings show each shape in its place."""

import io
import itertools
import json

import numpy as np
import pytest
import shapely
from files import named
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from tween import gallery, triangulate
from tween.colors import SOURCE
from tween.io.formats.readers import points_of, read_arrays, read_json
from tween.io.formats.svg import read_svg
from tween.io.formats.tables import read_csv
from tween.io.formats.writers import csv_text, drawing, geojson_text, json_text, npy_bytes, npz_bytes, obj_text


def test_a_drawing_is_a_small_picture_with_the_shape_inside():
    text = drawing(np.array([[[10.0, 10.0], [30.0, 10.0], [20.0, 20.0]]]))
    assert 'width="640" height="349" viewBox="9 -21 22 12"' in text
    assert text.count("<path") == 1


def test_frames_stand_side_by_side_and_do_not_overlap():
    shape = np.array([[0.0, 0.0], [2.0, 0.0], [1.0, 1.0]])
    shapes = np.array([shape, shape + 0.5, shape * 0.5, shape, shape])
    outlines = dict(named(read_svg(drawing(shapes, np.array([[[0, 1, 2]]] * 5)).encode())))
    boxes = [shapely.box(*outlines[f"frame_{i}"].min(axis=0), *outlines[f"frame_{i}"].max(axis=0)) for i in range(5)]
    assert not any(a.intersects(b) for a, b in itertools.combinations(boxes, 2))
    assert [np.ptp(outlines[f"frame_{i}"], axis=0).tolist() for i in (0, 2)] == [[2, 1], [1, 0.5]]


def test_shapes_have_the_colour_that_sources_have_in_figures():
    assert f'fill="{SOURCE}"' in drawing(np.array([[[0.0, 0.0], [2.0, 0.0], [1.0, 1.0]]]))


# What is read back

numbers = st.floats(allow_nan=False, allow_infinity=False)
points = arrays(np.float64, st.tuples(st.integers(1, 6), st.just(2)), elements=numbers)


@given(points)
def test_every_double_comes_back_exactly_from_text_and_bytes(p):
    assert np.array_equal(json.loads(json_text(points=p))["points"], p)
    assert np.array_equal(json.loads(geojson_text(p))["coordinates"], [*p, p[0]])
    header, *rows = csv_text("x,y", *p.T).splitlines()
    assert header == "x,y"
    assert np.array_equal([[float(x) for x in row.split(",")] for row in rows], p)
    assert np.array_equal(np.load(io.BytesIO(npy_bytes(p))), p)
    assert np.array_equal(np.load(io.BytesIO(npz_bytes(points=p)))["points"], p)


@given(points)
def test_the_readers_understand_the_writers(p):
    (_, csv), (_, by_json), (_, by_npy) = (
        named(content)[0]
        for content in (
            read_csv(csv_text("x,y", *p.T).encode()),
            read_json(json_text(points=p).encode()),
            points_of(read_arrays(npz_bytes(points=p), ".npz")),
        )
    )
    for found in (csv, by_json, by_npy):
        assert np.array_equal(found, p)


@given(points)
def test_equal_arrays_make_equal_bytes(p):
    assert npz_bytes(points=p) == npz_bytes(points=p.copy())
    assert npz_bytes(points=p) != npz_bytes(points=np.concatenate([p, p]))


def test_what_is_missing_is_null_in_json():
    assert json.loads(json_text(points=np.eye(2), times=None)) == {"points": [[1, 0], [0, 1]], "times": None}


def test_obj_counts_vertices_from_1_and_lies_in_the_plane():
    T = triangulate(gallery.curve("arrow"))
    rows = [line.split() for line in obj_text(T.points, T.triangles).splitlines()]
    assert {row[3] for row in rows if row[0] == "v"} == {"0"}
    faces = [[int(v) for v in row[1:]] for row in rows if row[0] == "f"]
    assert np.array_equal(np.array(faces) - 1, T.triangles)


@pytest.mark.parametrize("name", ["ell", "five_disks"])
def test_a_drawing_has_a_triangle_for_each_and_the_outline_exactly(name):
    T = triangulate(gallery.curve(name))
    outlines = named(read_svg(drawing(T.points[None], T.triangles[None]).encode()))
    assert len(outlines) == 1 + len(T.triangles)
    assert np.array_equal(dict(outlines)["curve"][:-1], T.points)
