"""Of a GeoJSON every line and every ring is an outline, and named points are marks."""

import pytest

from tween.errors import FileError
from tween.io.formats.geojson import positions, read_geojson

RING = [[0, 0], [4, 0], [0, 4], [0, 0]]


def feature(kind, coordinates, **rest):
    return {"type": "Feature", "geometry": {"type": kind, "coordinates": coordinates}, "properties": {}, **rest}


def names(*features):
    return [outline.name for outline in read_geojson({"type": "FeatureCollection", "features": [*features]}).outlines]


def test_parts_and_holes_go_by_the_name_of_their_feature():
    assert names(feature("Polygon", [RING], id="a")) == ["a"]
    assert names(feature("Polygon", [RING, RING], id="a")) == ["a.outer", "a.hole1"]
    assert names(feature("MultiPolygon", [[RING]], id="a")) == ["a"]
    assert names(feature("MultiPolygon", [[RING, RING], [RING]], id=7)) == ["7.part1.outer", "7.part1.hole1", "7.part2"]
    assert names(feature("MultiLineString", [RING, RING])) == ["part1", "part2"]


def test_a_feature_without_an_id_goes_by_the_name_among_its_properties():
    assert names(feature("LineString", RING, properties={"name": "lake", "id": 3})) == ["lake"]
    assert names(feature("LineString", RING, properties={"id": 3})) == ["3"]
    assert names(feature("LineString", RING, properties=None)) == [""]


def test_named_points_are_marks_and_others_are_not_used():
    places = feature("Point", [1, 2, 30], id="nose"), feature("Point", [3, 4]), feature("MultiPoint", [[3, 4]], id="b")
    content = read_geojson({"type": "FeatureCollection", "features": [feature("LineString", RING), *places]})
    assert content.marks == {"nose": (1.0, 2.0)}
    assert content.unused == ["1 Point", "1 MultiPoint"]


@pytest.mark.parametrize(
    "geometry",
    [
        {"type": "MultiPolygon", "coordinates": 3},
        {"type": "MultiPolygon", "coordinates": [3]},
        {"type": "MultiPolygon", "coordinates": []},
        {"type": "Polygon", "coordinates": [[]]},
        {"type": "Polygon", "coordinates": [RING, "hole"]},
        {"type": "Polygon", "coordinates": RING},
        {"type": "Point", "coordinates": None, "id": "a"},
        {"type": "GeometryCollection", "geometries": []},
        {"type": None},
    ],
)
def test_what_is_no_geometry_of_lines_is_refused_or_empty(geometry):
    try:
        content = read_geojson(geometry)
    except FileError as error:
        assert str(error)
    else:
        assert sum(len(outline.points) for outline in content.outlines) == 0


def test_positions_are_of_two_numbers_or_up_to_as_many_as_allowed():
    assert positions([[1, 2, 3]], "it", most=3).tolist() == [[1.0, 2.0]]
    for wrong in ([[1]], [[1, 2, 3]], [[True, 1]], [["1", "2"]], "12", [[1, 10**400]]):
        with pytest.raises(FileError, match=r"^it "):
            positions(wrong, "it")
