"""The choice of the root: what it does to the shapes, where the paper's lies among all, and rank against height."""

from collections.abc import Iterable

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from experiments.figures.registry import WIDTH, drawing
from experiments.figures.studies.table_1 import SELECTION
from experiments.store import RESULTS
from experiments.subjects import shapes
from tween import Triangulation, area_matrix, gallery, paper_morph, triangulate
from tween import plot as draw
from tween.geometry.dual_tree import disk_center, hops

TIMES = np.linspace(0, 1, 5)


@drawing(
    "root_shapes",
    "Section 7, discussion",
    """One morph, path linear, from two roots (magenta).  From the triangle closest to the disk's centre, the paper's
    choice, the shape swells on the way; from the end of the strip it shrinks, and its other end most.  Below, the first
    with every shape scaled to the area of the source.  The curve is ours; the paper shows no such comparison.""",
)
def root_shapes() -> Figure:
    """One morph from the paper's root, from a leaf, and from the paper's root at constant area."""
    T = triangulate(gallery.curve("horseshoe"))
    centre = disk_center(T, T.on_disk())
    leaf = int(np.argmax(hops(T, centre)))
    figure, ax = plt.subplots(figsize=(WIDTH, 4.2))
    step = 2.6 * np.ptp(T.points, axis=0).max()
    rows = [("the paper's\nroot", centre, False, 0.0), ("a root\nat an end", leaf, False, -1.0)]
    for label, root, scaled, height in [*rows, ("the paper's\nroot, scaled", centre, True, -1.75)]:
        m = paper_morph(T, T.on_disk(), path="linear", root=root)
        areas = area_matrix(m, len(TIMES)).sum(axis=0)
        for i, (shape, area) in enumerate(zip(m.at(TIMES), areas, strict=True)):
            drawn = shape / np.sqrt(area) if scaled else shape
            middle, top = (drawn.min(axis=0) + drawn.max(axis=0)) / 2, np.ptp(drawn[:, 1]) / 2
            _shape(ax, T.moved(drawn - middle + np.array([i, height]) * step), root)
            text = f"area {1 if scaled else area:.2f}" if 0 < TIMES[i] < 1 else ""
            ax.text(i * step, height * step + top + 0.06 * step, text, ha="center", va="bottom", fontsize=8)
        ax.text(-0.3 * step, height * step, label, ha="right", va="center", fontsize=8)
    for i, t in enumerate(TIMES):
        ax.text(i * step, -2.15 * step, f"t = {t:.2g}", ha="center", va="top", fontsize=8)
    ax.set(xlim=(-0.9 * step, 4.3 * step), ylim=(-2.3 * step, 0.65 * step))
    return figure


def _shape(ax: Axes, T: Triangulation, root: int) -> None:
    """The triangles, the root's filled and marked by a dot: at the end of a strip it is small."""
    draw.draw_triangulation(T, ax)
    corners = T.points[T.triangles[root]]
    ax.add_collection(PolyCollection([corners], facecolors=draw.PIVOT, linewidths=0, zorder=4))
    x, y = corners.mean(axis=0)
    ax.scatter(x, y, s=9, color=draw.PIVOT, linewidths=0, zorder=5)


@drawing(
    "root_choice",
    "Section 7, discussion",
    """Where the paper's root, the triangle closest to the disk's centre, lies among all roots of a curve, path slide,
    on some of our curves, fat ones above and thin ones below; beside it the centre of the dual tree.  Var is the
    paper's measure; for the last two panels every shape is scaled to the area of the source.  On most curves the
    paper's root has a low rank and one of the largest Var of all; with the scale held its Var and its excursions are
    mostly below the median.""",
)
def root_choice() -> Figure:
    return choice(SELECTION)


@drawing(
    "root_choice_all",
    "Section 7, supplement",
    """As the figure before, every curve: where the paper's root lies among all roots, path slide.""",
)
def root_choice_all() -> Figure:
    return choice(shapes())


def choice(names: Iterable[str]) -> Figure:
    """Where the paper's root lies among all roots, curve by curve."""
    table = pd.read_csv(RESULTS / "roots.csv", keep_default_na=False).set_index("curve").loc[list(names)].reset_index()
    titles = {
        "AR_1e-4 slide": "AR at 1e-4",
        "Var slide": "Var",
        "Var_scaled slide": "Var, scaled",
        "excursion_scaled slide": "excursion, scaled",
    }
    height = 1.1 + 0.145 * table.curve.nunique()
    figure, axes = plt.subplots(1, len(titles), figsize=(WIDTH, height), sharey=True)
    for ax, (measure, title) in zip(axes, titles.items(), strict=True):
        _distributions(ax, table, measure)
        ax.set_title(title)
    for ax in axes[1:3]:
        ax.set(xscale="log", xlim=(3e-12, 1), xticks=[1e-9, 1e-6, 1e-3])
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=5)
    return figure


def _distributions(ax: Axes, table: pd.DataFrame, measure: str) -> None:
    values = table.groupby("curve", sort=False)[measure].quantile([0, 0.25, 0.5, 0.75, 1]).unstack()[::-1]
    y = np.arange(len(values))
    ax.hlines(y, values[0], values[1], color="0.65", linewidth=0.8, label="all roots")
    ax.hlines(y, values[0.25], values[0.75], color="0.65", linewidth=4, label="middle half")
    ax.scatter(values[0.5], y, s=9, marker="s", color="0.3", linewidths=0, label="median", zorder=3)
    tree, paper = (_chosen(table, rule, measure)[values.index] for rule in ("tree-center", "disk-center"))
    ax.scatter(tree, y, s=12, marker="x", color=draw.TREE, linewidths=0.9, label="centre of the tree", zorder=4)
    ax.scatter(paper, y, s=24, facecolors="none", edgecolors=draw.PIVOT, label="the paper's root", zorder=5)
    ax.set_yticks(y, [name.replace("_", " ") for name in values.index], fontsize=7)
    ax.set_ylim(-0.8, len(y) - 0.2)


def _chosen(table: pd.DataFrame, rule: str, measure: str) -> pd.Series:
    """The measure of the root that a rule chooses, by curve."""
    return table[table["rules"].str.split("; ").map(lambda rules: rule in rules)].set_index("curve")[measure]


@drawing(
    "root_heights",
    "Section 7, discussion",
    """Rank of the area matrix against the height of the dual tree, each dot is a root, path linear.  Left the comb,
    at three tolerances; right all curves, at 1e-9.  The line, 2 height + 2 and no more than there are triangles, is
    a bound in exact arithmetic (bars: the exact rank of some roots); what counts at a tolerance is far less, and
    grows slowly.""",
)
def root_heights() -> Figure:
    """AR against the height of the tree, with the bound."""
    table = pd.read_csv(RESULTS / "roots.csv", keep_default_na=False)
    figure, axes = plt.subplots(1, 2, figsize=(WIDTH, 3.0))
    comb = table[table["curve"] == "comb"]
    for rtol, grey in (("1e-4", "0.7"), ("1e-6", "0.45"), ("1e-9", "0.1")):
        axes[0].scatter(comb["height"], comb[f"AR_{rtol} linear"], s=7, color=grey, linewidths=0, label=f"AR at {rtol}")
    exact = comb[comb["exact_rank"] != ""]
    axes[0].scatter(
        exact["height"], exact["exact_rank"].astype(float), s=26, marker="_", color=draw.TREE, label="exact"
    )
    heights = np.arange(comb["height"].min(), comb["height"].max() + 1)
    axes[0].plot(heights, np.minimum(2 * heights + 2, len(comb)), color=draw.TREE, linewidth=0.9, label="bound")
    axes[0].set(title="the comb", xlabel="height of the dual tree", ylabel="rank", ylim=(0, 66))
    axes[0].legend(loc="center right")
    _all_curves(axes[1], table)
    return figure


def _all_curves(ax: Axes, table: pd.DataFrame) -> None:
    paper = table[table["rules"].str.contains("disk-center")]
    ax.scatter(table["height"], table["AR_1e-9 linear"], s=4, color="0.7", linewidths=0, label="any root")
    ax.scatter(paper["height"], paper["AR_1e-9 linear"], s=16, color=draw.PIVOT, linewidths=0, label="the paper's")
    heights = np.geomspace(table["height"].min(), table["height"].max())
    ax.plot(heights, 2 * heights + 2, color=draw.TREE, linewidth=0.9, label="2 height + 2")
    ax.set(xscale="log", yscale="log", title="34 curves, AR at 1e-9", xlabel="height of the dual tree")
    ax.set_xticks([15, 30, 60, 120], ["15", "30", "60", "120"])
    ax.set_yticks([5, 10, 20, 50, 100, 200], ["5", "10", "20", "50", "100", "200"])
    ax.minorticks_off()
    ax.legend(loc="upper left")
