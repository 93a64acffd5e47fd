"""What AR and Var go with, and how low they can be made."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from experiments.figures.registry import WIDTH, drawing
from experiments.store import RESULTS
from tween import plot as draw

SCOPES = {
    "methods of one pair": ["path_length", "swelling", "invalid"],
    "triangulations of one curve": ["energy", "path_length", "swelling"],
}
WORDS = {
    "path_length": "length of paths",
    "swelling": "swelling",
    "invalid": "frames without a disk",
    "energy": "energy of the map",
}
COLORS = {"AR_1e-4": draw.SOURCE, "Var": draw.TARGET}
FOUND = {
    "random, median": ("median of 1,000", "o"),
    "Var, best random": ("best of 1,000", "s"),
    "Var, search from best random": ("local search from it", "D"),
}


@drawing(
    "quality",
    "ours",
    """Left, what AR (at 1e-4) and Var go with: rank correlations with what is bad about a morph, medians over 561 pairs
    of curves with nine or ten morphs each, and over ten curves with 200 random triangulations each; lines are 95 %
    intervals.  A perfect measure would lie at 1.  Right, ten curves, a row each, morphed to their disks along slide:
    Var, and the energy of the map, over those of the remeshed triangulation, for random triangulations and
    for what a local search for the least Var finds.""",
)
def quality() -> Figure:
    figure, (ax, first, second) = plt.subplots(1, 3, figsize=(WIDTH, 3.1), width_ratios=[1.5, 1, 1])
    correlations(ax)
    table = pd.read_csv(RESULTS / "quality_search.csv").pivot(index="curve", columns="triangulation")
    over_remeshed(first, table["Var"], "Var")
    over_remeshed(second, table["energy"], "energy")
    first.set_yticks(range(len(table)), [name.replace("_", " ") for name in table.index], fontsize=7)
    second.set_yticks([])
    second.set_xticks([1, 2, 5], ["1", "2", "5"])
    second.xaxis.set_minor_locator(NullLocator())
    figure.legend(*ax.get_legend_handles_labels(), loc="outside lower left", ncols=2, fontsize=7.5)
    figure.legend(*first.get_legend_handles_labels(), loc="outside lower right", ncols=3, fontsize=7.5)
    return figure


def correlations(ax: Axes) -> None:
    """A row a quality, in groups, with a dot and an interval for each measure."""
    table = pd.read_csv(RESULTS / "quality.csv").set_index(["scope", "quality", "measure"])
    y, ticks = 0.0, {}
    for scope, qualities in SCOPES.items():
        beside = {"facecolor": "white", "edgecolor": "none", "pad": 1}  # the line at 0 does not run through the words
        ax.text(-1.05, y - 0.75, scope, fontsize=7.5, style="italic", va="center", bbox=beside)
        for quality in qualities:
            for shift, (measure, color) in zip((-0.14, 0.14), COLORS.items(), strict=True):
                if (scope, quality, measure) in table.index:
                    row = table.loc[(scope, quality, measure)]
                    ax.hlines(y + shift, row.low, row.high, color=color, linewidth=1.6)
                    ax.scatter(row.rho, y + shift, s=22, color=color, edgecolors="white", linewidths=0.6, zorder=3)
            ticks[y] = WORDS[quality]
            y += 1
        y += 0.9
    ax.axvline(0, color="0.7", linewidth=0.8, zorder=0)
    ax.set_yticks(list(ticks), list(ticks.values()))
    ax.set(xlim=(-1.08, 1.08), ylim=(y - 1.2, -1.2), xlabel="rank correlation")
    for measure, color in COLORS.items():
        ax.scatter([], [], s=22, color=color, label=measure.replace("_", " at "))


def over_remeshed(ax: Axes, values: pd.DataFrame, name: str) -> None:
    """Each curve's values over that of its remeshed triangulation, on a logarithmic scale."""
    rows = np.arange(len(values))
    for (which, (label, marker)), shade in zip(FOUND.items(), ("0.65", "0.4", draw.TARGET), strict=True):
        ratio = (values[which] / values["remeshed"]).to_numpy()
        ax.scatter(ratio, rows, s=18, marker=marker, color=shade, label=label, linewidths=0)
    ax.axvline(1, color="0.7", linewidth=0.8, zorder=0)
    ax.set(xscale="log", ylim=(len(rows) - 0.4, -0.6), xlabel=f"{name} / remeshed")
