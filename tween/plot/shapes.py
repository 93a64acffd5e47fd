"""Pictures of curves, triangulations, dual trees and morphs, as if drawn by one hand.

Every function draws into the axes it is given, or the current ones, and returns those axes.  One colour
stands for one idea everywhere:

    SOURCE   the first shape         TREE     dual tree, spine       RANDOM   random triangulations
    TARGET   the second shape        PIVOT    pivots, roots          FAILURE  what is wrong
"""

import pathlib
from collections.abc import Iterator, Sequence

import matplotlib.pyplot as plt
import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import ArrayLike, NDArray

from tween.colors import EDGE, INK, PIVOT, SOURCE, TREE
from tween.geometry.curve import Curve, as_curve
from tween.geometry.dual_tree import along_longest_path
from tween.geometry.triangulation import Triangulation
from tween.morphing.morph import Morph


def use_style() -> None:
    """Set the project's matplotlib style for all figures that follow.

    Examples
    --------
    >>> use_style()
    """
    plt.style.use(pathlib.Path(__file__).with_name("tween.mplstyle"))


def draw_shape(
    shape: Triangulation | Curve | ArrayLike, ax: Axes | None = None, color: str = SOURCE, alpha: float = 0.35
) -> Axes:
    """Draw a curve, filled the darker the more often it winds about a place.

    Parameters
    ----------
    shape : Triangulation, Curve or array_like of shape (n, 2)
    ax : Axes, optional
    color : colour
    alpha : float
        Opacity of one layer.

    Returns
    -------
    Axes

    Examples
    --------
    >>> from tween import gallery
    >>> ax = draw_shape(gallery.curve("horseshoe"))
    """
    ax = _axes(ax)
    points = as_curve(shape).points
    for outline, winding in regions(points):
        ax.add_patch(PathPatch(outline, facecolor=color, alpha=1 - (1 - alpha) ** abs(winding), linewidth=0))
    ax.add_collection(LineCollection([_closed(points)], colors=color, linewidths=1.2, capstyle="round"))
    return _frame(ax)


def regions(points: NDArray[np.float64]) -> Iterator[tuple[Path, int]]:
    """Find the bounded regions into which a curve divides the plane, for pictures.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Yields
    ------
    Path
        The outer boundary, then those of holes.
    int
        How often the curve winds about the region.

    Examples
    --------
    >>> [winding for _, winding in regions(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]))]
    [1]
    """
    for face in shapely.polygonize([shapely.unary_union(shapely.linearrings(points))]).geoms:
        outline = Path.make_compound_path(*(Path(np.array(r.coords)) for r in (face.exterior, *face.interiors)))
        yield outline, winding_number(points, np.array(face.representative_point().coords[0]))


def winding_number(points: NDArray[np.float64], place: NDArray[np.float64]) -> int:
    """Count how often a curve winds about a place that is not on it, for pictures.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)
    place : ndarray of float64, shape (2,)

    Returns
    -------
    int

    Examples
    --------
    >>> winding_number(np.array([[0, 0], [1, 0], [1, 1], [0, 1]]), np.array([0.5, 0.5]))
    1
    """
    a = points - place
    b = np.roll(a, -1, axis=0)
    angles = np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1))
    return round(float(angles.sum()) / (2 * np.pi))


def draw_triangulation(
    T: Triangulation, ax: Axes | None = None, colors: str | NDArray[np.float64] | None = None, alpha: float = 0.35
) -> Axes:
    """Draw the triangles of an immersed disk and its boundary.

    Parameters
    ----------
    T : Triangulation
    ax : Axes, optional
    colors : colour or ndarray of shape (n-2, 4), optional
        Of the triangles; without it, those of `identity_colors`.
    alpha : float
        Opacity of one layer of the disk.

    Returns
    -------
    Axes

    Examples
    --------
    >>> from tween import gallery, triangulate
    >>> ax = draw_triangulation(triangulate(gallery.curve("ess")))
    """
    return _draw(_axes(ax), T.points, T.triangles, identity_colors(T) if colors is None else colors, alpha)


def identity_colors(T: Triangulation) -> NDArray[np.float64]:
    """Give each triangle the colour of its place along the longest path of the dual tree.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    ndarray of float64, shape (n-2, 4)

    Examples
    --------
    >>> identity_colors(Triangulation([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])).shape
    (1, 4)
    """
    along = along_longest_path(T)
    return np.asarray(plt.get_cmap("turbo")(0.08 + 0.84 * along / max(1, along.max())))


def draw_dual_tree(T: Triangulation, ax: Axes | None = None, color: str = TREE, simplified: bool = False) -> Axes:
    """Draw the dual tree through the centres of mass of the triangles.

    Parameters
    ----------
    T : Triangulation
    ax : Axes, optional
    color : colour
    simplified : bool
        Mark only leaves (rings) and internal nodes (dots), and smooth the paths between them: a path node is passed
        from the middle of one of its diagonals to the middle of the other.

    Returns
    -------
    Axes

    Examples
    --------
    >>> from tween import gallery, triangulate
    >>> ax = draw_dual_tree(triangulate(gallery.curve("ess")), simplified=True)

    References
    ----------
    Mukherjee and Gopi, Figure 3.
    """
    ax = _axes(ax)
    nodes = T.points[T.triangles].mean(axis=1)
    lines, width = (_smoothed(T, nodes), 1.6) if simplified else (list(nodes[T.dual]), 0.9)
    ax.add_collection(LineCollection(lines, colors=color, linewidths=width, capstyle="round", zorder=3))
    degree = np.bincount(T.dual.ravel(), minlength=len(nodes))
    if simplified:
        ax.scatter(*_xy(nodes[degree == 1]), s=16, facecolors="white", edgecolors=color, linewidths=1.2, zorder=4)
        ax.scatter(*_xy(nodes[degree == 3]), s=20, color=color, linewidths=0, zorder=4)
    else:
        ax.scatter(*_xy(nodes), s=4, color=color, linewidths=0, zorder=4)
    return _frame(ax)


def _smoothed(T: Triangulation, nodes: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Segments of the dual tree through the middles of the diagonals; centres of mass at leaves and internal nodes."""
    doors: list[list[NDArray[np.float64]]] = [[] for _ in nodes]
    for (s, t), middle in zip(T.dual.tolist(), T.points[T.diagonals].mean(axis=1), strict=True):
        doors[s].append(middle)
        doors[t].append(middle)
    return [
        np.array(segment)
        for node, near in zip(nodes, doors, strict=True)
        for segment in ([near] if len(near) == 2 else [[node, middle] for middle in near])
    ]


def draw_spine(T: Triangulation, spine: NDArray[np.int64], ax: Axes | None = None, pivot: int | None = None) -> Axes:
    """Draw a spine through the centres of mass of its triangles, and the pivot vertex as a dot.

    Parameters
    ----------
    T : Triangulation
    spine : ndarray of int
        Triangles from end to end.
    ax : Axes, optional
    pivot : int, optional

    Returns
    -------
    Axes

    Examples
    --------
    >>> from tween import gallery, triangulate
    >>> from tween.morphing.incompatible.pivots import spine
    >>> T = triangulate(gallery.curve("ell"))
    >>> ax = draw_spine(T, spine(T), pivot=0)

    References
    ----------
    Mukherjee and Gopi, Section 6.1.
    """
    ax = _axes(ax)
    ax.plot(*_xy(T.points[T.triangles[spine]].mean(axis=1)), color=TREE, linewidth=1.6, zorder=3)
    if pivot is not None:
        ax.scatter(T.points[pivot, 0], T.points[pivot, 1], s=26, color=PIVOT, linewidths=0, zorder=5)
    return _frame(ax)


def draw_filmstrip(
    m: Morph,
    times: Sequence[float] | NDArray[np.float64],
    ax: Axes | None = None,
    labels: bool = True,
    mark: int | None = None,
) -> Axes:
    """Draw shapes of a morph side by side, at one scale, triangles coloured by identity.

    Parameters
    ----------
    m : Morph
    times : sequence of float
    ax : Axes, optional
    labels : bool
        Whether to write the time below each shape.
    mark : int, optional
        A vertex to mark in the first and the last shape, such as the pivot.

    Returns
    -------
    Axes

    Examples
    --------
    >>> from tween import gallery, morph, triangulate
    >>> T = triangulate(gallery.curve("ess"))
    >>> ax = draw_filmstrip(morph(T, T.on_disk()), [0, 0.5, 1])
    """
    ax = _axes(ax)
    shapes = m.at(times)
    low, high = shapes.min(axis=1), shapes.max(axis=1)
    widths, heights = (high - low).T
    gap = 0.12 * widths.max()
    lefts = np.cumsum(widths + gap) - widths
    for t, shape, corner, left, height in zip(times, shapes, low, lefts, heights, strict=True):
        place = shape - corner + [left, -0.5 * height]
        _draw(ax, place, m.triangles_at(t), identity_colors(m.source), 0.35)
        if mark is not None and t in (times[0], times[-1]):
            ax.scatter(place[mark, 0], place[mark, 1], s=14, color=PIVOT, linewidths=0, zorder=5)
    if labels:
        for t, left, width in zip(times, lefts, widths, strict=True):
            middle, below = float(left + width / 2), float(-0.55 * heights.max())
            ax.text(middle, below, f"t = {t:.2g}", ha="center", va="top", fontsize=8)
        ax.set_ylim(bottom=-0.55 * heights.max() - 0.16 * heights.max())
    return ax


def _axes(ax: Axes | None) -> Axes:
    return plt.gca() if ax is None else ax


def _xy(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    return points[:, 0], points[:, 1]


def _closed(points: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.concatenate([points, points[:1]])


def _fill(ax: Axes, polygons: NDArray[np.float64], colors: str | NDArray[np.float64], alpha: float) -> None:
    """Fill triangles without seams: smoothed edges of neighbours would show as lines."""
    ax.add_collection(PolyCollection(list(polygons), facecolors=colors, alpha=alpha, linewidths=0, antialiaseds=False))


def _draw(
    ax: Axes, points: NDArray[np.float64], triangles: NDArray[np.int64], colors: str | NDArray[np.float64], alpha: float
) -> Axes:
    corners = points[triangles]
    _fill(ax, corners, colors, alpha)
    edges = np.concatenate([corners, corners[:, :1]], axis=1)
    ax.add_collection(LineCollection(list(edges), colors=EDGE, linewidths=0.3, alpha=0.6))
    ax.add_collection(LineCollection([_closed(points)], colors=INK, linewidths=1.0, capstyle="round"))
    return _frame(ax)


def _frame(ax: Axes) -> Axes:
    ax.set_aspect("equal")
    ax.margins(0.04)
    ax.autoscale_view()
    ax.set_axis_off()
    return ax
