"""A picture of why a curve bounds no disk, and of what would mend it."""

import io
from functools import partial
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Polygon
from numpy.typing import NDArray

from tween.colors import FAILURE, INK, PIVOT, TREE
from tween.io.formats.whole_files import AnyPath, write
from tween.plot.shapes import outline_of
from tween.triangulating.repair.explanation import Explanation

_MOST_MARKS = 400  # of one kind
_SIZE = 6.4  # inches
_DPI = 150
_UNDATED = {
    "svg": {"Date": None},
    "pdf": {"CreationDate": None},
    "png": {"Software": None},
}  # equal pictures, equal bytes


def draw_explanation(explanation: Explanation, ax: Axes | None = None) -> Axes:
    r"""Draw why a curve bounds no disk, and the suggestion that mends it best.

    Parameters
    ----------
    explanation : Explanation
        See `.Decomposition.explain`.
    ax : Axes, optional

    Returns
    -------
    Axes
        The curve in ink, with a dot at each crossing and a ring about each tiny loop; regions about which it winds
        clockwise in the colour of failure, as are the loops that are too many for a turning number of 1, dotted; the
        mended curve in green, and the loops that it loses dashed.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from tween import decompose
    >>> eight = decompose([[0, 0], [4, 4], [4, 0], [0, 3]])
    >>> draw_explanation(eight.explain(), Figure().add_subplot()).get_title()
    'turning number is 0, not 1\nmended: cut off the loop at (1.714, 1.714)'
    """
    ax = plt.gca() if ax is None else ax
    curve = explanation.curve
    if explanation.suggestions:
        _draw_mended(ax, explanation)
    for face in explanation.negative:
        ax.add_patch(PathPatch(outline_of(face), facecolor=FAILURE, alpha=0.45, linewidth=0, zorder=2))
    _draw_lines(ax, [curve.points], INK, 0.9, "solid", 3)
    surplus = [loop.points for loop in explanation.loops if (loop.area > 0) == (curve.turning_number > 1)]
    if curve.turning_number != 1 and surplus:
        _draw_lines(ax, surplus[:_MOST_MARKS], FAILURE, 2.0, "dotted", 4)
    _draw_marks(ax, explanation)
    ax.set_title(_title(explanation), fontsize=8)
    ax.set_aspect("equal")
    ax.margins(0.06)
    ax.autoscale_view()
    ax.set_axis_off()
    return ax


def save_explanation(path: AnyPath, explanation: Explanation) -> Path:
    """Draw why a curve bounds no disk into a file.

    Parameters
    ----------
    path : path-like
        SVG, PNG or PDF.  It is written whole or not at all.
    explanation : Explanation

    Returns
    -------
    Path
        That of the file.

    Raises
    ------
    FileError
        Where it cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from tween import decompose
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     why = decompose([[0, 0], [4, 4], [4, 0], [0, 3]]).explain()
    ...     print(save_explanation(f"{folder}/why.svg", why).read_text()[:5])
    <?xml
    """
    return write(path, {f".{kind}": partial(_picture, explanation, kind) for kind in _UNDATED})


def _picture(explanation: Explanation, kind: str) -> bytes:
    figure = Figure(figsize=(_SIZE, _SIZE), layout="constrained")
    draw_explanation(explanation, figure.add_subplot())
    stream = io.BytesIO()
    with plt.rc_context({"svg.hashsalt": "tween"}):
        figure.savefig(stream, format=kind, dpi=_DPI, metadata=_UNDATED[kind])
    return stream.getvalue()


def _draw_mended(ax: Axes, explanation: Explanation) -> None:
    best = explanation.suggestions[0]
    ax.add_patch(Polygon(best.curve.points, facecolor=TREE, alpha=0.18, linewidth=0, zorder=1))
    _draw_lines(ax, [best.curve.points], TREE, 3.2, "solid", 2)
    if best.loops:
        _draw_lines(ax, [loop for loop in best.loops if len(loop)], FAILURE, 1.4, "dashed", 5)


def _draw_marks(ax: Axes, explanation: Explanation) -> None:
    """Dots where the curve meets itself, rings about tiny loops."""
    places = explanation.places[:_MOST_MARKS]
    ax.scatter(places[:, 0], places[:, 1], s=9, color=INK, linewidths=0, zorder=6)
    tiny = np.reshape([loop.place for loop in explanation.tiny[:_MOST_MARKS]], (-1, 2))
    ax.scatter(tiny[:, 0], tiny[:, 1], s=60, facecolors="none", edgecolors=PIVOT, linewidths=1.0, zorder=6)


def _draw_lines(
    ax: Axes, polygons: list[NDArray[np.float64]], color: str, width: float, style: str, order: int
) -> None:
    closed = [np.concatenate([p, p[:1]]) for p in polygons]
    ax.add_collection(LineCollection(closed, colors=color, linewidths=width, linestyles=style, zorder=order))


def _title(explanation: Explanation) -> str:
    if explanation:
        return "bounds an immersed disk"
    best = explanation.suggestions[0].text if explanation.suggestions else ""
    return explanation.reason + (f"\nmended: {best}" if best else "")
