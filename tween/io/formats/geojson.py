"""The outlines of a GeoJSON: lines and rings, each ring by itself, so that no hole and no part is lost."""

import reprlib
from collections import Counter
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween.errors import FileError
from tween.io.formats.content import Content, Outline
from tween.plural import counted

_LINES, _AREAS = ("LineString", "MultiLineString"), ("Polygon", "MultiPolygon")
_NAMING = ("name", "id")  # of a feature's properties, where it has no id


def read_geojson(content: dict[str, Any]) -> Content:
    """Find the outlines and the named points of a GeoJSON.

    Parameters
    ----------
    content : dict
        A geometry, a feature, or a collection of features.

    Returns
    -------
    Content
        A line string, or a polygon without holes, is an outline by the id of its feature.  Where it has several parts
        each is an outline of its own: ``ID.outer`` and ``ID.hole1`` of a polygon, ``ID.part1`` and so on of several.
        A feature without an id goes by the "name" or "id" among its properties.

    Raises
    ------
    FileError
        Saying what was found instead.

    Examples
    --------
    >>> ring = [[0, 0], [4, 0], [0, 4], [0, 0]]
    >>> hole = [[1, 1], [2, 1], [1, 2], [1, 1]]
    >>> found = read_geojson({"type": "Polygon", "coordinates": [ring, hole]})
    >>> [(outline.name, outline.part) for outline in found.outlines]
    [('outer', 'outer ring of a Polygon with 1 hole'), ('hole1', 'hole of a Polygon')]
    """
    features = content.get("features") if content["type"] == "FeatureCollection" else [content]
    if not isinstance(features, list) or not all(isinstance(feature, dict) for feature in features):
        raise FileError(f"has {reprlib.repr(features)} as features, expected a list of GeoJSON features")
    outlines: list[Outline] = []
    marks: dict[str, tuple[float, float]] = {}
    unused: Counter[str] = Counter()
    has_heights = False
    for feature in features:
        geometry = feature.get("geometry") if feature.get("type") == "Feature" else feature
        kind = geometry.get("type") if isinstance(geometry, dict) else None
        name = _name(feature)
        if kind in (*_LINES, *_AREAS):
            outlines += _outlines(kind, geometry.get("coordinates"), name)
            has_heights |= _has_heights(geometry.get("coordinates"))
        elif kind == "Point" and name:
            marks[name] = _place(geometry.get("coordinates"))
        else:
            unused["empty feature" if kind is None else str(kind)[:40]] += 1
    if not outlines:
        raise FileError(f"is GeoJSON of type {reprlib.repr(content['type'])}, expected a LineString or Polygon in it")
    others = [counted(number, kind) for kind, number in unused.items()]
    return Content(outlines, others + ["heights"] * has_heights, marks)


def _name(feature: dict[str, Any]) -> str:
    properties = feature.get("properties")
    given = [feature.get("id"), *(properties.get(key) for key in _NAMING if isinstance(properties, dict))]
    return next((str(name) for name in given if isinstance(name, str | int) and name != ""), "")


def _outlines(kind: str, coordinates: Any, name: str) -> Iterator[Outline]:
    """Every line or ring, by its name, and what it is of something larger."""
    several = kind.startswith("Multi")
    members = coordinates if several else [coordinates]
    if not isinstance(members, list):
        raise FileError(f"the {kind} is {reprlib.repr(members)}, expected a list")
    for p, member in enumerate(members, 1):
        labels = [f"part{p}"] if several and len(members) > 1 else []
        part = f"part {p} of a {kind} of {len(members)}" if labels else ""
        if kind in _LINES:
            yield Outline(".".join([name, *labels]).strip("."), positions(member, f"the {kind}", most=4), part=part)
            continue
        rings = member if isinstance(member, list) else []
        for r, ring in enumerate(rings or [member]):
            label = [f"hole{r}" if r else "outer"] if len(rings) > 1 else []
            role = f"hole of a {kind}" if r else f"outer ring of a {kind} with {counted(len(rings) - 1, 'hole')}"
            points = positions(ring, f"the {kind}", most=4)
            yield Outline(".".join([name, *labels, *label]).strip("."), points, part=role if label else part)


def _has_heights(coordinates: Any) -> bool:
    while isinstance(coordinates, list) and coordinates and isinstance(coordinates[0], list):
        coordinates = coordinates[0]
    return isinstance(coordinates, list) and len(coordinates) > 2


def _place(coordinates: Any) -> tuple[float, float]:
    x, y = positions([coordinates], "a Point", most=4)[0].tolist()
    return x, y


def positions(value: Any, where: str, most: int = 2) -> NDArray[np.float64]:
    """Read a list of positions.

    Parameters
    ----------
    value : object
        To be a list of lists of two numbers.
    where : str
        What it is, for an error.
    most : int
        How many numbers a position may have; the first two count.

    Returns
    -------
    ndarray of float64, shape (n, 2)

    Raises
    ------
    FileError
        Naming the position.

    Examples
    --------
    >>> positions([[1, 2], [3, 4, 5]], "the line", most=3).tolist()
    [[1.0, 2.0], [3.0, 4.0]]
    """
    if not isinstance(value, list):
        raise FileError(f"{where} is {reprlib.repr(value)}, expected a list of points [x, y]")
    for i, row in enumerate(value):
        if not (isinstance(row, list) and 2 <= len(row) <= most and all(type(c) in (int, float) for c in row)):
            raise FileError(f"{where} has {reprlib.repr(row)} as point {i}, expected [x, y]")
    try:
        return np.array([row[:2] for row in value], dtype=np.float64).reshape(-1, 2)
    except OverflowError:
        raise FileError(f"{where} has an integer that is too large for a double") from None
