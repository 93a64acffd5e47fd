"""Shapes drawn layer over layer, side by side in rows: what several figures and the animations share."""

from collections.abc import Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure, SubFigure
from matplotlib.path import Path
from numpy.typing import NDArray

from experiments.figures.registry import WIDTH
from tween import Morph, Triangulation
from tween import plot as draw
from tween.geometry.dual_tree import along_longest_path, hops

SHAPES = 7  # in a row
TIMES = np.linspace(0, 1, SHAPES)
ALPHA = 0.55  # opacity of one layer
EDGE = (0.45, 0.45, 0.45, 0.4)


def places(T: Triangulation) -> NDArray[np.float64]:
    """Where each vertex lies along the longest path of the dual tree, from 0 to 1: the mean of its triangles."""
    along = along_longest_path(T)
    total = np.bincount(T.triangles.ravel(), weights=np.repeat(along, 3), minlength=len(T))
    return np.asarray(total / (T.degrees - 1) / max(1, along.max()))


def draw_layers(
    ax: Axes, T: Triangulation, place: NDArray[np.float64], first: int, outline: float = 1.0, inner: float = 0.25
) -> None:
    """Draw the triangles one over the other, from those at a vertex on, so that upper layers veil lower ones.

    Flips come and go but vertices stay, so a triangle has the colour of the mean place of its corners.
    """
    colors = plt.get_cmap("turbo")(0.08 + 0.84 * place[T.triangles].mean(axis=1), alpha=ALPHA)
    start = int(np.flatnonzero((T.triangles == first).any(axis=1))[0])
    art: list[tuple[Path, Any, Any, float]] = []
    for row in np.argsort(hops(T, start), kind="stable"):
        corners = T.triangles[row]
        art.append((Path(T.points[[*corners, corners[0]]]), colors[row], EDGE, inner))
        sides = zip(corners, np.roll(corners, -1), strict=True)
        art += [(Path(T.points[[a, b]]), "none", draw.INK, outline) for a, b in sides if b == (a + 1) % len(T)]
    paths, faces, edges, widths = zip(*art, strict=True)
    drawn = PathCollection(paths, facecolors=faces, edgecolors=edges, linewidths=widths)
    drawn.set_capstyle("round")
    ax.add_collection(drawn)


def bottom(m: Morph) -> int:
    """The vertex from which layers are stacked: the pivot, or one at an end of the source's spine."""
    end = m.alignment.source.triangles[m.alignment.source_spine[0]]
    return int(end.min()) if m.alignment.pivot is None else m.alignment.pivot


def draw_row(
    axes: Sequence[Axes],
    m: Morph,
    dots: Sequence[int] = (0, SHAPES - 1),
    mark: int | None = None,
    sizes: Sequence[float] = (1.0,) * SHAPES,
    inner: float = 0.25,
) -> None:
    """Draw shapes of a morph in even steps of time, each as large as its axes allow; dot the pivot in some.

    Below stand the time and the scale: how many times as large as the source a shape is drawn.  The source stands
    in axes of the first size.
    """
    place, shapes = places(m.source), m.at(TIMES)
    mark = m.alignment.pivot if mark is None else mark
    scales = [size / reach(points) for size, points in zip(sizes, shapes, strict=True)]
    for number, (ax, t, points) in enumerate(zip(axes, TIMES, shapes, strict=True)):
        draw_layers(ax, Triangulation(points, m.triangles_at(t)), place, bottom(m), inner=inner)
        if mark is not None and number in dots:
            ax.scatter(points[mark, 0], points[mark, 1], s=16, color=draw.PIVOT, linewidths=0, zorder=5)
        fit(ax, points)
        label = time_label(t) + scale_label(scales[number] / scales[0])
        ax.text(0.5, -0.02, label, transform=ax.transAxes, ha="center", va="top", fontsize=7)


def strip(m: Morph) -> Figure:
    """One morph for itself, source and target larger than the shapes between."""
    figure, axes = plt.subplots(1, SHAPES, figsize=(WIDTH + 1, 1.7), width_ratios=[1.5, *[1] * (SHAPES - 2), 1.5])
    draw_row(axes, m, sizes=[1.5, *[1] * (SHAPES - 2), 1.5])
    for ax in axes:
        ax.set_anchor("S")  # so that the times stand on one line
    return figure


def reach(points: NDArray[np.float64]) -> float:
    """The side of the smallest upright square about points."""
    return float(np.ptp(points, axis=0).max())


def fit(ax: Axes, points: NDArray[np.float64]) -> None:
    """Show a square about the points, without axes."""
    (x, y), half = (points.min(axis=0) + points.max(axis=0)) / 2, 0.54 * reach(points)
    ax.set(xlim=(x - half, x + half), ylim=(y - half, y + half), aspect="equal")
    ax.set_axis_off()


def bands(figure: Figure, heights: Sequence[float]) -> list[SubFigure]:
    """Divide a figure into bands, one below the other."""
    grid = figure.add_gridspec(len(heights), 1, height_ratios=heights)
    return [figure.add_subfigure(grid[row, 0]) for row in range(len(heights))]


def write_above(part: SubFigure, text: str) -> None:
    """The heading of a band."""
    part.suptitle(text, x=0.01, ha="left", fontsize=9)


def scale_label(scale: float) -> str:
    """A scale to two digits, zeros too; nothing where it is that of the source, or nearly."""
    return "" if abs(scale - 1) < 0.05 else f"  × {scale:#.2g}".rstrip(".")


def time_label(t: float) -> str:
    """A time to two digits, small ones to more."""
    return f"t = {t:.2g}" if t in (0, 1) else f"t = {t:.3f}" if t < 0.1 else f"t = {t:.2f}"
