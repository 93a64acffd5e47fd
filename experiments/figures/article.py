"""Figures for the article alone: all curves on one sheet, and one pair as printed and matched, at one scale."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from experiments import family
from experiments.figures.registry import WIDTH, drawing
from experiments.figures.rows import bottom, draw_layers, places, time_label
from experiments.subjects import LETTER, shape, shapes
from tween import Curve, Morph, Triangulation, gallery, morph, paper_morph
from tween import plot as draw

ADDED = ("star 3 0.5", "star 5 0.8", "star 3 0.5 over", "star 5 0.5 over", "blob 0", "blob 3", "strip 4", "strip 16")
PAIR = "arrow_to_horseshoe"
TIMES = np.linspace(0, 1, 7)
COLUMNS, CELL, GAP = 14, 1.25, 0.25


@drawing(
    "article_curves",
    "ours",
    """The 15 constructed curves of the gallery and the 19 letters, and in orange eight of the 41 curves that were added
    for Table 1: stars, stars whose lobes overlap, blobs and strips.  The more layers lie over each other, the
    darker.""",
)
def article_curves() -> Figure:
    """Every curve of the pairs, and a few of those from fat to thin, each of one size."""
    figure, ax = plt.subplots(figsize=(WIDTH, WIDTH * 3 / COLUMNS))
    curves = [(shape(name), draw.INK if name.startswith(LETTER) else draw.SOURCE) for name in shapes()]
    curves += [(family.curve(name), draw.TARGET) for name in ADDED]
    for number, (curve, color) in enumerate(curves):
        row, column = divmod(number, COLUMNS)
        draw.draw_shape(Curve(centred(curve.points) + CELL * np.array([column, -row])), ax, color)
    for line in ax.collections:
        line.set(linewidths=0.7)
    whole(ax)
    return figure


def centred(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The points about the origin, in a square of side 1."""
    low, high = points.min(axis=0), points.max(axis=0)
    return np.asarray((points - (low + high) / 2) / (high - low).max())


@drawing(
    "article_morphs",
    "ours",
    """An arrow becomes a horseshoe whose ends overlap, every shape at one scale.  Top: as printed, along slide, with
    pivots (dots), flips and placement by the root; bottom: matched, along metric, placed steadily.  A colour is
    a place along the source; it stays with the vertices.""",
)
def article_morphs() -> Figure:
    """One pair as printed, and matched."""
    figure, axes = plt.subplots(2, 1, figsize=(WIDTH, 2.9), height_ratios=[1.35, 1])
    source, target = gallery.pair(PAIR)
    ways = (("as printed", paper_morph(source, target)), ("matched", morph(source, target)))
    widths = [side_by_side(ax, m) for ax, (_, m) in zip(axes, ways, strict=True)]
    for ax, (label, _) in zip(axes, ways, strict=True):
        ax.set(xlim=(0, max(widths)), aspect="equal", anchor="W")
        ax.set_title(label, loc="left", fontsize=8)
        ax.set_axis_off()
    return figure


def side_by_side(ax: Axes, m: Morph) -> float:
    """Draw shapes of a morph in even steps of time, one beside the other; returns the width that they take."""
    x, place = 0.0, places(m.source)
    shapes_then = m.at(TIMES)
    gap = GAP * float(np.ptp(shapes_then[0], axis=0).max())
    for number, (t, points) in enumerate(zip(TIMES, shapes_then, strict=True)):
        moved = points - [points[:, 0].min() - x, (points[:, 1].min() + points[:, 1].max()) / 2]
        draw_layers(ax, Triangulation(moved, m.triangles_at(t)), place, bottom(m), outline=0.7)
        if m.alignment.pivot is not None and number in (0, len(TIMES) - 1):
            px, py = moved[m.alignment.pivot]
            ax.scatter(px, py, s=10, color=draw.PIVOT, linewidths=0, zorder=5)
        end = moved[:, 0].max()
        ax.text((x + end) / 2, moved[:, 1].min() - gap / 3, time_label(t), ha="center", va="top", fontsize=7)
        x = end + gap
    ax.autoscale_view()
    return x


def whole(ax: Axes) -> None:
    """Show everything, without axes."""
    ax.autoscale_view()
    ax.set(aspect="equal")
    ax.set_axis_off()
