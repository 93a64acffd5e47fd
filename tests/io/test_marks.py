"""What bears the same id in two files is a landmark of both curves."""

import json

import pytest
from files import saved
from malformed import svg

from tween.errors import FileError
from tween.io.marks import landmarks, read_marks

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]


def test_the_marks_of_a_drawing_are_its_circles_with_an_id(tmp_path):
    content = '<path d="M0 0h9v9z"/><g transform="scale(2)"><circle id="nose" cx="3" cy="4" r="1"/></g><circle r="2"/>'
    path = saved(tmp_path, "a.svg", svg(content))
    assert read_marks(path) == {"nose": pytest.approx((6, -8))}


def test_the_marks_of_a_geojson_are_its_points_with_a_name(tmp_path):
    line = {"type": "LineString", "coordinates": SQUARE}
    point = {"type": "Feature", "properties": {"name": "nose"}, "geometry": {"type": "Point", "coordinates": [1, 2]}}
    features = [{"type": "Feature", "properties": {}, "geometry": line}, point]
    path = saved(tmp_path, "a.geojson", json.dumps({"type": "FeatureCollection", "features": features}))
    assert read_marks(path) == {"nose": (1.0, 2.0)}


def test_other_files_have_no_marks(tmp_path):
    assert read_marks(saved(tmp_path, "a.csv", "0,0\n1,0\n1,1\n")) == {}


def test_marks_of_one_name_are_the_nearest_vertices_of_both():
    found = landmarks([SQUARE] * 2, [{"a": (9.9, 0.3), "b": (0, 10), "c": (0, 0)}, {"b": (10, 10), "a": (0, 0)}])
    assert found == {"a": (1, 0), "b": (3, 2)}


@pytest.mark.parametrize(
    ("marks", "words"),
    [({"a": (5.0, 5.0)}, "mark 'a' is 7.07 from the nearest"), ({"a": (0, 0), "b": (0.1, 0)}, "'a' and 'b' are both")],
)
def test_a_mark_far_from_its_curve_and_two_at_one_vertex_are_refused(marks, words):
    with pytest.raises(FileError, match=words):
        landmarks([SQUARE] * 3, [marks] * 3)
