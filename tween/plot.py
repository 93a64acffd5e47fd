"""Pictures of curves, triangulations, dual trees and morphs, as if drawn by one hand.

Every function draws into the axes it is given, or the current ones, and returns those axes.  One colour
stands for one idea everywhere:

    SOURCE   the first shape         TREE     dual tree, spine       RANDOM   random triangulations
    TARGET   the second shape        PIVOT    pivots, roots          FAILURE  what is wrong
"""

from collections.abc import Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from numpy.typing import ArrayLike, NDArray

from tween.curve import Curve
from tween.morph import Morph, triangulate
from tween.triangulation import Triangulation

SOURCE, TARGET, TREE, PIVOT, RANDOM, FAILURE = "#0072B2", "#E69F00", "#009E73", "#AA3377", "0.55", "#D1261B"
INK, EDGE = "0.15", "0.45"


def use_style() -> None:
    """Set the project's matplotlib style for all figures that follow.

    Examples
    --------
    >>> use_style()
    """
    plt.style.use(Path(__file__).with_name("tween.mplstyle"))


def draw_shape(
    shape: Triangulation | Curve | ArrayLike, ax: Axes | None = None, color: str = SOURCE, alpha: float = 0.35
) -> Axes:
    """Draw an immersed disk, its overlaps darker, with its boundary.

    Parameters
    ----------
    shape : Triangulation, Curve or array_like of shape (n, 2)
    ax : Axes, optional
    color : colour
    alpha : float
        Opacity of one layer of the disk.

    Returns
    -------
    Axes

    Examples
    --------
    >>> from tween import gallery
    >>> ax = draw_shape(gallery.curve("horseshoe"))
    """
    ax = _axes(ax)
    T = triangulate(shape)
    _fill(ax, T.points[T.triangles], color, alpha)
    ax.add_collection(LineCollection([_closed(T.points)], colors=color, linewidths=1.2, capstyle="round"))
    return _frame(ax)


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
    """Give each triangle the colour of its place along the curve, the same in every frame.

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
    place = np.sort(T.triangles, axis=1)[:, 1] / len(T)
    return np.asarray(plt.get_cmap("turbo")(0.08 + 0.84 * place))


def draw_dual_tree(T: Triangulation, ax: Axes | None = None, color: str = TREE, simplified: bool = False) -> Axes:
    """Draw the dual tree through the centres of mass of the triangles.

    Parameters
    ----------
    T : Triangulation
    ax : Axes, optional
    color : colour
    simplified : bool
        Mark only leaves (rings) and internal nodes (dots), and let the paths between them be lines.

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
    ax.add_collection(
        LineCollection(list(nodes[T.dual]), colors=color, linewidths=1.6 if simplified else 0.9, zorder=3)
    )
    degree = np.bincount(T.dual.ravel(), minlength=len(nodes))
    if simplified:
        ax.scatter(*_xy(nodes[degree == 1]), s=16, facecolors="white", edgecolors=color, linewidths=1.2, zorder=4)
        ax.scatter(*_xy(nodes[degree == 3]), s=20, color=color, linewidths=0, zorder=4)
    else:
        ax.scatter(*_xy(nodes), s=4, color=color, linewidths=0, zorder=4)
    return _frame(ax)


def draw_filmstrip(
    m: Morph, times: Sequence[float] | NDArray[np.float64], ax: Axes | None = None, labels: bool = True
) -> Axes:
    """Draw shapes of a morph side by side at one scale, triangles coloured by identity.

    Parameters
    ----------
    m : Morph
    times : sequence of float
    ax : Axes, optional
    labels : bool
        Whether to write the time below each shape.

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
    width, height = (high - low).max(axis=0)
    gap = 0.12 * width
    for i, (t, shape) in enumerate(zip(times, shapes, strict=True)):
        place = np.array([i * (width + gap), 0.0])
        _draw(ax, shape - (low[i] + high[i]) / 2 + place, m.triangles_at(t), identity_colors(m.source), 0.35)
        if labels:
            ax.text(float(place[0]), -0.5 * height - gap, f"t = {t:.2g}", ha="center", va="top", fontsize=8)
    if labels:
        ax.set_ylim(-0.5 * height - 0.32 * width, 0.5 * height + 0.05 * width)
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
    ax.add_collection(LineCollection(list(edges), colors=EDGE, linewidths=0.35))
    ax.add_collection(LineCollection([_closed(points)], colors=INK, linewidths=1.0, capstyle="round"))
    return _frame(ax)


def _frame(ax: Axes) -> Axes:
    ax.set_aspect("equal")
    ax.margins(0.04)
    ax.autoscale_view()
    ax.set_axis_off()
    return ax
