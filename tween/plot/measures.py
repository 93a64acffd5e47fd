"""Pictures of what is measured: winding numbers, areas and their singular values, sums of angles.

As in `tween.plot`, every function draws into the axes it is given, or the current ones, and returns those axes.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import LogNorm, to_rgb
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path
from numpy.typing import ArrayLike, NDArray
from shapely.ops import polylabel

from tween.colors import FAILURE, INK, SOURCE
from tween.geometry.curve import Curve, as_curve
from tween.geometry.triangulation import Triangulation
from tween.measuring.metrics import angle_sums, area_matrix, rank_of, singular_values
from tween.morphing.morph import Morph
from tween.plot.shapes import regions

_LABEL_ROOM, _LEAST_ROOM = 0.022, 0.006  # radius that a number needs, and the first of its kind, in picture sizes
_SMALLEST = 1e-4  # area that has its own shade, as a share of the largest
_FLOOR = 1e-13  # singular values below this share of the largest are rounding, and not shown
_TIE = 1e-9  # radians


def draw_winding(
    shape: Triangulation | Curve | ArrayLike, ax: Axes | None = None, color: str = SOURCE, labels: bool = True
) -> Axes:
    """Draw how often a curve winds about each region: one shade and one number each.

    Parameters
    ----------
    shape : Triangulation, Curve or array_like of shape (n, 2)
    ax : Axes, optional
    color : colour
        Of regions about which the curve winds counter-clockwise.  Those that it goes round clockwise, which no
        boundary of an immersed disk does, have the colour of failure.
    labels : bool
        Whether to write the numbers, wherever there is room.

    Returns
    -------
    Axes

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from tween import gallery
    >>> ax = draw_winding(gallery.curve("horseshoe"), Figure().add_subplot())
    >>> sorted({text.get_text() for text in ax.texts})
    ['0', '1', '2']
    """
    ax = plt.gca() if ax is None else ax
    points = as_curve(shape).points
    found = list(regions(points))
    most = max((abs(winding) for _, winding in found), default=0)
    for outline, winding in found:
        ax.add_patch(PathPatch(outline, facecolor=_shade(winding, most, color), linewidth=0))
    closed = np.concatenate([points, points[:1]])
    ax.add_collection(LineCollection([closed], colors=INK, linewidths=1.0, capstyle="round"))
    if labels:
        _number(ax, found, most, color, float(np.ptp(points, axis=0).max()))
    ax.set_aspect("equal")
    ax.margins(0.04)
    ax.autoscale_view()
    ax.set_axis_off()
    return ax


def _shade(winding: int, most: int, color: str) -> tuple[float, float, float]:
    """From a pale tint for 1 over the colour itself to a darker one for the most; white for 0."""
    if winding == 0:
        return (1.0, 1.0, 1.0)
    depth = 0.25 + 1.05 * (abs(winding) - 1) / max(2, most - 1)
    pure = np.array(to_rgb(color if winding > 0 else FAILURE))
    red, green, blue = (1 - depth * (1 - pure) if depth <= 1 else pure * (2 - depth)).tolist()
    return red, green, blue


def _number(ax: Axes, found: list[tuple[Path, int]], most: int, color: str, extent: float) -> None:
    """Write the winding numbers, where there is most room first."""
    rooms = [(*_room(outline), winding) for outline, winding in found]
    written = set()
    for place, radius, winding in sorted(rooms, key=lambda room: -room[1]):
        if radius >= (_LABEL_ROOM if winding in written else _LEAST_ROOM) * extent:
            written.add(winding)
            ink = "white" if np.mean(_shade(winding, most, color)) < 0.5 else INK
            ax.annotate(str(winding), place, ha="center", va="center", fontsize=9, color=ink)


def _room(outline: Path) -> tuple[tuple[float, float], float]:
    """The middle and the radius of the largest circle in a region, roughly."""
    exterior, *holes = outline.to_polygons()
    face = shapely.Polygon(exterior, holes)
    middle = polylabel(face, tolerance=0.02 * face.area**0.5)
    return (middle.x, middle.y), float(face.boundary.distance(middle))


def draw_area_matrix(m: Morph | NDArray[np.float64], ax: Axes | None = None, frames: int = 100) -> Axes:
    """Draw the areas of all triangles over time; a row is a triangle.

    Parameters
    ----------
    m : Morph or ndarray of float64, shape (n-2, frames)
        A matrix is one that `tween.area_matrix` made.
    ax : Axes, optional
    frames : int
        Columns for a morph.

    Returns
    -------
    Axes
        With a colour bar beside them.  Shades are logarithmic, down to 1e-4 of the largest area.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from tween import gallery, morph, triangulate
    >>> T = triangulate(gallery.curve("ess"))
    >>> ax = draw_area_matrix(morph(T, T.on_disk()), Figure().add_subplot(), frames=20)
    >>> ax.images[0].get_array().shape
    (92, 20)

    References
    ----------
    Mukherjee and Gopi, Section 7.
    """
    ax = plt.gca() if ax is None else ax
    A = _areas(m, frames)
    rows, columns = A.shape
    margin = 0.5 / max(1, columns - 1)
    norm = LogNorm(max(_SMALLEST * A.max(), A[A > 0].min()), A.max(), clip=True)
    extent = (-margin, 1 + margin, rows - 0.5, -0.5)
    image = ax.imshow(A, norm=norm, aspect="auto", interpolation="nearest", extent=extent)
    ax.set(xlabel="t", ylabel="triangle", xticks=[0, 0.5, 1], xticklabels=["0", "0.5", "1"])
    ax.figure.colorbar(image, ax=ax, label="area / the source's")
    return ax


def _areas(m: Morph | NDArray[np.float64], frames: int) -> NDArray[np.float64]:
    if isinstance(m, Morph):
        return area_matrix(m, frames)
    A = np.asarray(m, dtype=np.float64)
    if A.ndim != 2 or not (A > 0).any():
        raise ValueError(f"m has shape {A.shape}, expected a Morph or a matrix of areas, a row a triangle")
    return A


def draw_singular_values(
    m: Morph | NDArray[np.float64],
    ax: Axes | None = None,
    frames: int = 100,
    rtols: Sequence[float] = (1e-4, 1e-6, 1e-9),
) -> Axes:
    """Draw the singular values of an area matrix, and its rank at some tolerances.

    Parameters
    ----------
    m : Morph or ndarray of float64, shape (n-2, frames)
        A matrix is one that `tween.area_matrix` made.
    ax : Axes, optional
    frames : int
        Columns for a morph.
    rtols : sequence of float
        Each is a line; the singular values above it, as shares of the largest, are the rank.

    Returns
    -------
    Axes

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from tween import gallery, morph, triangulate
    >>> T = triangulate(gallery.curve("ess"))
    >>> ax = draw_singular_values(morph(T, T.on_disk(), path="area"), Figure().add_subplot(), rtols=[1e-6])
    >>> [text.get_text() for text in ax.texts]
    ['rank 2 at 1e-06']

    References
    ----------
    Mukherjee and Gopi, Section 7.
    """
    ax = plt.gca() if ax is None else ax
    values = singular_values(_areas(m, frames))
    shares = values / values[0]
    ax.semilogy(np.arange(1, len(shares) + 1), shares, "o", color=INK, markersize=3, markeredgewidth=0)
    for rtol in rtols:
        ax.axhline(rtol, color="0.7", linewidth=0.8, zorder=0)
        label = f"rank {rank_of(values, rtol)} at {rtol:.0e}"
        ax.text(1.02, rtol, label, transform=ax.get_yaxis_transform(), va="center", fontsize=8)
    ax.set(xlabel="k", ylabel="singular value k / the largest", xlim=(0, len(shares) + 1))
    ax.set_ylim(bottom=max(_FLOOR, ax.get_ylim()[0]))
    return ax


def draw_angle_sums(m: Morph, ax: Axes | None = None, frames: int = 200) -> Axes:
    """Draw the sum of angles at every vertex over time, with the line of 2 pi that none may reach.

    Parameters
    ----------
    m : Morph
    ax : Axes, optional
    frames : int
        Evenly spaced times at which the sums are computed, besides the times of flips.

    Returns
    -------
    Axes
        The vertex that comes closest to 2 pi, or gets farthest beyond it, is drawn strong and named.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from tween import gallery, morph, triangulate
    >>> T = triangulate(gallery.curve("ess"))
    >>> ax = draw_angle_sums(morph(T, T.on_disk()), Figure().add_subplot())
    >>> float(ax.get_ylim()[1]) > 2 * np.pi
    True
    """
    ax = plt.gca() if ax is None else ax
    times = np.unique([*np.linspace(0, 1, frames), *(event.time for event in m.events)])
    sums = angle_sums(m, times)
    v, k = (int(i[0]) for i in np.nonzero(sums > sums.max() - _TIE))  # the first of equals, however they are rounded
    top = 1.1 * max(2 * np.pi, float(sums.max()))
    lines = [np.stack([times, row], axis=1) for row in (*sums, sums[v])]
    widths = [0.5] * len(sums) + [1.6]
    ax.add_collection(LineCollection(lines, colors=["0.72"] * len(sums) + [INK], linewidths=widths))
    beyond = ax.add_collection(LineCollection(lines, colors=FAILURE, linewidths=widths, zorder=2.5))
    beyond.set_clip_path(Rectangle((0, 2 * np.pi), 1, top, transform=ax.transData))
    ax.axhline(2 * np.pi, color=FAILURE, linewidth=0.9, linestyle="--", zorder=1)
    label = f"vertex {v}: {sums[v, k] / np.pi:.3f} π"
    ax.annotate(
        label,
        (float(times[k]), float(sums[v, k])),
        (0, 3),
        textcoords="offset points",
        ha="left" if times[k] < 0.5 else "right",
        va="bottom",
        fontsize=8,
        color=FAILURE if sums[v, k] >= 2 * np.pi else INK,
    )
    ax.set(xlim=(0, 1), ylim=(0, top), xlabel="t", ylabel="sum of angles at a vertex")
    ax.set(xticks=[0, 0.5, 1], xticklabels=["0", "0.5", "1"], yticks=np.pi * np.arange(3), yticklabels=["0", "π", "2π"])
    return ax
