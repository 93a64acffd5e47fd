"""Polygons and rings of shapely are curves, and nothing of them is lost in silence."""

import numpy as np
import pytest
import shapely

import tween
from tween.errors import CurveError
from tween.geometry.rings import ring_points

BOX = shapely.box(0, 0, 4, 1)
HOLED = shapely.box(0, 0, 10, 10) - shapely.box(1, 1, 2, 2)


@pytest.mark.parametrize(
    "shape",
    [
        BOX,
        BOX.exterior,
        shapely.LineString(BOX.exterior.coords),
        shapely.MultiPolygon([BOX]),
        shapely.GeometryCollection([BOX]),
        shapely.Polygon([(x, y, 7) for x, y in BOX.exterior.coords]),
        BOX.reverse(),
    ],
    ids=lambda shape: shape.geom_type,
)
def test_a_shape_of_one_ring_is_the_curve_of_its_points(shape: shapely.Geometry) -> None:
    curve = tween.Curve(shape)
    assert {tuple(p) for p in curve.points.tolist()} == {(0, 0), (4, 0), (4, 1), (0, 1)}
    assert (len(curve), curve.area) == (4, 4.0)
    assert tween.decompose(shape)


def test_morphs_and_cleaning_take_them_too() -> None:
    m = tween.morph(BOX, shapely.box(0, 0, 1, 4))
    assert m(0.0).tolist() == tween.Curve(BOX).points.tolist()
    assert tween.clean(BOX, smooth=0).area == 4


@pytest.mark.parametrize(
    ("shape", "words"),
    [
        (HOLED, "the Polygon has 1 hole, expected none; take its exterior"),
        (shapely.MultiPolygon([HOLED]), "has 1 hole"),
        (shapely.MultiPolygon([BOX, shapely.box(9, 9, 10, 10)]), "the MultiPolygon has 2 parts, expected one"),
        (shapely.Polygon(), "the Polygon is empty"),
        (shapely.Point(1, 2), "a Point is no curve"),
        (shapely.MultiPoint([(0, 0), (1, 1)]), "has 2 parts"),
    ],
    ids=lambda value: getattr(value, "geom_type", ""),
)
def test_a_shape_of_more_than_one_ring_is_refused_with_what_to_take(shape: shapely.Geometry, words: str) -> None:
    for take in (tween.Curve, tween.decompose, tween.clean):
        with pytest.raises(CurveError, match=words):
            take(shape)
    if shape is HOLED:
        assert tween.Curve(shape.exterior).area == 100
        assert tween.Curve(shape.interiors[0]).area == 1


def test_anything_else_is_left_as_it_is() -> None:
    points = np.eye(2)
    assert ring_points(points) is points
