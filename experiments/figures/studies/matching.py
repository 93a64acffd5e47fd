"""Matching in pictures: the pairs of Figure 11 the paper's way and matched, and all pairs by method."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from numpy.typing import NDArray

from experiments.figures.registry import WIDTH, drawing
from experiments.figures.rows import TIMES, draw_layers, places, time_label
from experiments.measures import swelling
from experiments.store import RESULTS
from tween import Morph, Triangulation, area_matrix, gallery, morph, paper_morph
from tween import plot as draw

# Of a pair in the first figure, in inches: room for labels left, above, below and between shapes; narrowest, tallest.
MARGIN, ABOVE, BELOW, GAP, COLUMN, TALLEST = 0.95, 0.24, 0.24, 0.1, 0.5, 1.2
LABELS = {
    "paper": "paper, as printed",
    "paper_guaranteed": "paper, guaranteed",
    "common": "common triangulation",
    "matched": "matched",
    "straight": "straight lines",
    "edge_angle": "edges and angles",
    "as_rigid_as_possible": "as rigid as possible",
    "straight_matched": "straight lines",
    "edge_angle_matched": "edges and angles",
    "as_rigid_as_possible_matched": "as rigid as possible",
}
PANELS = {"AR_1e-4": "AR at 1e-4", "Var": "Var", "swelling": "swelling", "path_length": "path length"}
TICKS = {"Var": [1e-10, 1], "swelling": [1, 10, 100], "path_length": [0.3, 1, 3, 10]}


@drawing(
    "matching_pairs",
    "ours",
    """The seven pairs of Figure 11 in even steps of time: above as printed in the paper, with pivots matched, edges
    flipped and the root placing the shapes; below matched, placed steadily.  All shapes of a pair have one scale.
    A colour is a place along the source; it stays with the vertices.  "area up to": the largest area on the way
    over that of the larger end, where it is larger.  Where the triangulations are incompatible the paper's source
    melts into a disk.""",
)
def matching_pairs() -> Figure:
    """The seven pairs of the gallery, the paper's way and matched."""
    layouts = {name: _Layout(paper_morph(*gallery.pair(name)), morph(*gallery.pair(name))) for name in gallery.pairs()}
    total = sum(layout.height for layout in layouts.values())
    figure = plt.figure(figsize=(WIDTH, total))
    figure.set_layout_engine("none")
    top = total
    for number, (name, layout) in enumerate(layouts.items(), start=1):
        top -= layout.height
        ax = figure.add_axes((0, top / total, 1, layout.height / total))
        ax.set(xlim=(0, WIDTH), ylim=(0, layout.height))  # inches
        ax.set_axis_off()
        layout.draw(ax)
        ax.text(0.05, layout.height - 0.04, f"{number}  {name.replace('_', ' ')}", va="top", fontsize=9)
    return figure


class _Layout:
    """Where the shapes of two morphs stand, one above the other, at one scale; in inches."""

    def __init__(self, *morphs: Morph) -> None:
        self._morphs, self._shapes = morphs, [m.at(TIMES) for m in morphs]
        sizes = np.array([np.ptp(shapes, axis=1) for shapes in self._shapes])
        widths, heights = sizes[..., 0].max(axis=0), sizes[..., 1].max(axis=1)
        scales = np.geomspace(1e-3, 1e3, 2000) / widths.max()
        room = np.maximum(scales[:, None] * widths + GAP, COLUMN).sum(axis=1)
        fits = (room <= WIDTH - MARGIN) & (scales * heights.sum() <= TALLEST)
        self._scale = scales[fits].max()
        columns = np.maximum(self._scale * widths + GAP, COLUMN)
        self._x = MARGIN + (np.cumsum(columns) - columns / 2) * (WIDTH - MARGIN) / columns.sum()
        above, below = self._scale * heights
        self._y = BELOW + below + GAP + above / 2, BELOW + below / 2
        self.height = BELOW + below + GAP + above + ABOVE

    def draw(self, ax: Axes) -> None:
        for m, shapes, y, label in zip(self._morphs, self._shapes, self._y, ("paper", "matched"), strict=True):
            colors, first = places(m.source), int(m.source.triangles[m.alignment.source_spine[0]].min())
            for t, x, points in zip(TIMES, self._x, shapes, strict=True):
                middle = (points.min(axis=0) + points.max(axis=0)) / 2
                placed = Triangulation(self._scale * (points - middle) + [x, y], m.triangles_at(t))
                draw_layers(ax, placed, colors, first, outline=0.7)
            ax.text(0.2, y, f"{label}\n{_facts(m)}", va="center", fontsize=7)
        for t, x in zip(TIMES, self._x, strict=True):
            ax.text(x, 0.06, time_label(t), ha="center", fontsize=7)


def _facts(m: Morph) -> str:
    flips = f"{len(m.events)} flips" if m.events else "no flips"
    swollen = swelling(area_matrix(m))
    return f"{flips}\narea up to {swollen:.1f}" if swollen >= 1.05 else flips


@drawing(
    "matching_study",
    "ours",
    """All 561 pairs of 34 curves by method: median (dot), middle half (thick) and range (thin) of rank and variance
    of the areas, the largest area over that of the larger end, and the mean length of the vertices' paths in widths
    of the larger end; right, the share of pairs all of whose 61 frames bound an immersed disk.  Methods of others
    use the paper's correspondence, and the matched one.""",
)
def matching_study() -> Figure:
    table = pd.read_csv(RESULTS / "matching_summary.csv").set_index(["measure", "method"])
    figure, axes = plt.subplots(1, len(PANELS) + 1, figsize=(WIDTH, 3.3), sharey=True)
    y = np.arange(len(LABELS)) + 0.6 * (np.arange(len(LABELS)) >= 4) + 0.6 * (np.arange(len(LABELS)) >= 7)
    colors = [draw.SOURCE if method == "matched" else draw.RANDOM for method in LABELS]
    for ax, (measure, title) in zip(axes, PANELS.items(), strict=False):
        of = table.loc[measure].reindex(LABELS)
        ax.hlines(y, of["min"], of["max"], color=colors, linewidth=0.8)
        ax.hlines(y, of["q25"], of["q75"], color=colors, linewidth=4)
        ax.scatter(of["median"], y, s=24, color=colors, edgecolors="white", linewidths=0.6, zorder=3)
        ax.set_title(title, fontsize=8.5)
        if measure in TICKS:
            ax.set(xscale="log", xticks=TICKS[measure])
            ax.xaxis.set_minor_locator(NullLocator())
    axes[2].set_xticks(TICKS["swelling"], ["1", "10", "100"])
    axes[3].set_xticks(TICKS["path_length"], ["0.3", "1", "3", "10"])
    of = table.loc["all_disks"].reindex(LABELS)
    axes[-1].hlines(y, of.low, of.high, color=colors, linewidth=0.8)
    axes[-1].scatter(of.share, y, s=24, color=colors, edgecolors="white", linewidths=0.6, zorder=3)
    axes[-1].set(xlim=(-0.08, 1.08), xticks=[0, 0.5, 1])
    axes[-1].set_title("share valid", fontsize=8.5)
    _name_rows(axes[0], y)
    return figure


def _name_rows(ax: Axes, y: NDArray[np.float64]) -> None:
    """Name the methods, and the correspondences that those of others stand on."""
    ax.set_yticks(y, list(LABELS.values()))
    ax.set_ylim(y[-1] + 0.6, -0.6)
    outside: dict[str, Any] = {
        "transform": ax.get_yaxis_transform(),
        "fontsize": 7,
        "color": "0.35",
        "ha": "right",
        "va": "center",
    }
    for row, text in ((4, "on the paper's correspondence"), (7, "on the matched correspondence")):
        ax.text(-0.06, y[row] - 0.78, text, style="italic", **outside)
