"""Table 1 as pictures: where the remeshed triangulation lies among random ones."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from experiments.figures.registry import drawing
from experiments.store import RESULTS
from tween import plot as draw


@drawing(
    "table_1_linear",
    "Table 1",
    """Where the remeshed triangulation lies in the distribution of the random ones, path linear.""",
)
def table_1_linear() -> Figure:
    return table_1("linear")


@drawing(
    "table_1_slide",
    "Table 1",
    """Where the remeshed triangulation lies in the distribution of the random ones, path slide.""",
)
def table_1_slide() -> Figure:
    return table_1("slide")


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
