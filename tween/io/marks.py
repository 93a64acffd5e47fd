"""Landmarks from files: what bears the same id in both has to correspond."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from tween.errors import FileError
from tween.geometry.curve import Curve, as_curve
from tween.io.formats.whole_files import AnyPath, naming
from tween.io.outlines import contents, label

Marks = Mapping[str, tuple[float, float]]

_FAR = 0.1  # of the size of a curve: a mark farther from every vertex marks none


def read_marks(path: AnyPath) -> dict[str, tuple[float, float]]:
    """Read the places of a file that have a name.

    Parameters
    ----------
    path : path-like
        SVG or GeoJSON.

    Returns
    -------
    dict of str to (float, float)
        The centres of an SVG's circles, the points of a GeoJSON, by their ids, with y upwards.

    Raises
    ------
    FileError
        Where the file cannot be read.
    """
    with naming(label(path)):
        return contents(path).marks


def landmarks(curves: Sequence[Curve | ArrayLike], marks: Sequence[Marks]) -> dict[str, tuple[int, ...]]:
    """Find the vertices that several curves have at the marks of the same name.

    Parameters
    ----------
    curves : sequence of Curve or array_like of shape (n, 2)
    marks : sequence of mapping of str to (float, float)
        Of each curve, as `read_marks` returns them.

    Returns
    -------
    dict of str to tuple of int
        For each name that occurs in all of them, the vertex of each curve that lies nearest; in the order in which the
        first has the names.  ``list(found.values())`` are the `landmarks` of `tween.morph` and of `tween.sequence`.

    Raises
    ------
    FileError
        Where a mark is farther from every vertex than a tenth of the curve's size, or two marks are nearest to one
        vertex.

    Examples
    --------
    >>> square, diamond = [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 0], [1, 1], [0, 2], [-1, 1]]
    >>> landmarks([square, diamond], [{"top": (1.02, 1), "nose": (0, 0)}, {"top": (0, 2), "tail": (0, 0)}])
    {'top': (2, 2)}
    """
    common = [name for name in marks[0] if all(name in others for others in marks)]
    columns = [_vertices(as_curve(curve), named, common) for curve, named in zip(curves, marks, strict=True)]
    return dict(zip(common, zip(*columns, strict=True), strict=True))


def _vertices(curve: Curve, marks: Marks, names: list[str]) -> list[int]:
    """The vertices nearest to marks, no two the same."""
    vertices = [_nearest(curve, name, marks[name]) for name in names]
    for k, vertex in enumerate(vertices):
        if vertex in vertices[:k]:
            other = names[vertices.index(vertex)]
            raise FileError(f"the marks {other!r} and {names[k]!r} are both nearest to vertex {vertex}")
    return vertices


def _nearest(curve: Curve, name: str, place: tuple[float, float]) -> int:
    """The vertex nearest to a mark."""
    distance = np.hypot(*(curve.points - place).T)
    vertex = int(distance.argmin())
    size = float(np.ptp(curve.points, axis=0).max())
    if distance[vertex] > _FAR * size:
        away = f"{distance[vertex]:.3g} from the nearest vertex of a curve of size {size:.3g}"
        raise FileError(f"the mark {name[:40]!r} is {away}, expected at most a tenth of that")
    return vertex
