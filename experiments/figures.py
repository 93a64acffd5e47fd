"""The figures: each function draws one of the paper's figures, or one of ours, and names its file."""

from collections.abc import Callable
from functools import partial

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from experiments.store import RESULTS, rng_for, save_figure
from tween import Triangulation, area_matrix, decompose, frame_variance, gallery, morph, triangulate
from tween import plot as draw

SEED = 20100
TIMES = np.linspace(0, 1, 7)


def figure_3() -> Figure:
    """Dual graphs and their simplifications: an arbitrary triangulation and the remeshed one."""
    d = decompose(gallery.curve("spiral_1"))
    rows = {"random": d.sample(rng_for(SEED, "figure 3")), "remeshed": triangulate(gallery.curve("spiral_1"))}
    figure, axes = plt.subplots(1, 4, figsize=(7.2, 2.1))
    for (label, T), pair in zip(rows.items(), axes.reshape(2, 2), strict=True):
        draw.draw_triangulation(T, pair[0], colors="0.85", alpha=0.6)
        draw.draw_dual_tree(T, pair[0])
        draw.draw_dual_tree(T, pair[1], simplified=True)
        pair[1].set(xlim=pair[0].get_xlim(), ylim=pair[0].get_ylim())
        leaves = int(np.sum(np.bincount(T.dual.ravel()) == 1))
        pair[0].set_title(f"{label}")
        pair[1].set_title(f"{leaves} leaves")
    return figure


def figure_6() -> Figure:
    """A morph to the disk with a random and with the remeshed triangulation."""
    c = gallery.curve("spiral_1")
    T = triangulate(c)
    disk = T.on_disk().points
    random = decompose(c).sample(rng_for(SEED, "figure 6"))
    figure, axes = plt.subplots(2, 1, figsize=(7.2, 3.4))
    for ax, shape, label in zip(axes, (random, T), ("random", "remeshed"), strict=True):
        m = morph(shape, Triangulation(disk, shape.triangles))
        draw.draw_filmstrip(m, TIMES, ax)
        ax.set_title(f"{label}: Var {frame_variance(area_matrix(m)):.1e}", loc="left")
    return figure


def figure_9() -> Figure:
    """The same two curves with and without matched pivots."""
    a, b = gallery.pair("ell_to_two_loops")
    matched = morph(a, b, strategy="paper")
    away = morph(a, b, strategy="paper", shifts=matched.alignment.shift + len(matched.source) // 4)
    figure, axes = plt.subplots(2, 1, figsize=(7.2, 3.0))
    for ax, m, label in zip(axes, (away, matched), ("a quarter of the vertices away", "pivots matched"), strict=True):
        mark = matched.alignment.pivot if m is matched else None
        draw.draw_filmstrip(m, TIMES, ax, one_scale=False, mark=mark)
        ax.set_title(f"{label}: {m.alignment.crossings} crossings, {len(m.events)} flips", loc="left")
    return figure


def figure_10() -> Figure:
    """Flips where and when they happen: in each shape the diagonals that came since the one before."""
    m = morph(*gallery.pair("arrow_to_horseshoe"), strategy="paper")
    moments = np.unique([e.time for e in m.events])
    times = moments[np.linspace(0, len(moments) - 1, 5).round().astype(int)]
    figure, axes = plt.subplots(1, len(times), figsize=(7.2, 1.9))
    before = -1.0
    for ax, t in zip(axes, times, strict=True):
        points = m(t)
        fresh = [e.into for e in m.events if before < e.time <= t]
        draw.draw_triangulation(Triangulation(points, m.triangles_at(t)), ax, colors="0.85", alpha=0.6)
        ax.add_collection(LineCollection(list(points[np.array(fresh)]), colors=draw.TARGET, linewidths=0.6))
        ax.set_title(f"t = {t:.4f}\n{len(fresh)} flips", fontsize=8)
        ax.set_adjustable("datalim")
        before = t
    return figure


def figure_11() -> Figure:
    """The seven pairs of the gallery, each shape as large as the others; dots mark matched pivots."""
    figure, axes = plt.subplots(7, 1, figsize=(7.2, 9.0))
    for ax, name in zip(axes, gallery.pairs(), strict=True):
        m = morph(*gallery.pair(name), strategy="paper")
        draw.draw_filmstrip(m, TIMES, ax, labels=False, one_scale=False, mark=m.alignment.pivot)
        ax.set_anchor("W")
        ax.set_title(f"{name.replace('_', ' ')}: {len(m.events) or 'no'} flips", loc="left", fontsize=8)
    return figure


def gallery_sheet() -> Figure:
    """Every curve of the gallery and every letter, layers shown by transparency."""
    shapes = {name: gallery.curve(name) for name in gallery.names()}
    shapes |= {f"letter {letter}": gallery.letter(letter) for letter in gallery.letters()}
    columns = 7
    rows = -(-len(shapes) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(7.2, 1.15 * rows))
    for ax in axes.flat:
        ax.set_axis_off()
    for ax, (name, shape) in zip(axes.flat, shapes.items(), strict=False):
        draw.draw_shape(shape, ax)
        ax.set_title(name.replace("_", " "), fontsize=7.5)
    return figure


def table_1(path: str) -> Figure:
    """Where the remeshed triangulation lies in the distribution of the random ones, curve by curve."""
    table = pd.read_csv(RESULTS / "table1.csv")
    figure, axes = plt.subplots(1, 3, figsize=(7.2, 6.0), sharey=True)
    titles = {"AR_1e-4": "AR at tolerance 1e-4", "AR_1e-9": "AR at tolerance 1e-9", "Var": "Var"}
    for ax, (measure, title) in zip(axes, titles.items(), strict=True):
        _distributions(ax, table[table.path == path], measure)
        ax.set_title(title)
    axes[2].set(xscale="log", xticks=[1e-12, 1e-9, 1e-6, 1e-3])
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=6)
    return figure


def _distributions(ax: Axes, table: pd.DataFrame, measure: str) -> None:
    wide = table.pivot(index="curve", columns="triangulation", values=measure).reindex(table.curve.unique()[::-1])
    y = np.arange(len(wide))
    ax.hlines(y, wide.uniform_min, wide.uniform_max, color=draw.RANDOM, linewidth=0.8, label="uniform: all")
    ax.hlines(y, wide.uniform_q25, wide.uniform_q75, color=draw.RANDOM, linewidth=4, label="middle half")
    ax.scatter(wide["first"], y, s=18, marker="|", color=draw.PIVOT, label="first split", zorder=3)
    ax.scatter(wide["last"], y, s=12, marker="x", color=draw.PIVOT, linewidths=0.8, label="last split", zorder=3)
    ax.scatter(wide.uniform_median, y, s=9, marker="s", color="0.3", linewidths=0, label="median", zorder=3)
    ax.scatter(wide.remeshed, y, s=22, facecolors="none", edgecolors=draw.SOURCE, label="remeshed", zorder=4)
    ax.set_yticks(y, [name.replace("_", " ") for name in wide.index], fontsize=7)
    ax.set_ylim(-0.8, len(wide) - 0.2)
    ax.locator_params(axis="x", integer=True)


FIGURES: dict[str, Callable[[], Figure]] = {
    "figure_03_dual_graphs": figure_3,
    "figure_06_random_remeshed": figure_6,
    "figure_09_pivots": figure_9,
    "figure_10_flips": figure_10,
    "figure_11_pairs": figure_11,
    "gallery": gallery_sheet,
    "table_1_linear": partial(table_1, "linear"),
    "table_1_slide": partial(table_1, "slide"),
}


def main() -> None:
    draw.use_style()
    for name, make in FIGURES.items():
        figure = make()
        print(f"figures: {save_figure(figure, name).relative_to(RESULTS.parent)}")
        plt.close(figure)


if __name__ == "__main__":
    main()
