"""Table 1 explained: on which shapes remeshing pays, what the rank counts, and where the paper's factors fall."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from experiments.figures.registry import WIDTH, drawing
from experiments.store import RESULTS
from experiments.studies.grid import PARAMETERS, RANKS
from experiments.studies.grid_law import factors, fitting_half, predicted, ranks_and_counts
from experiments.subjects import PAPER
from tween import plot as draw

LOOKS: dict[str, dict[str, Any]] = {  # markers tell the kinds apart where there is no colour
    "star": {"marker": "*", "s": 34, "color": draw.TREE, "linewidths": 0, "label": "stars"},
    "overlapping": {"marker": "P", "s": 22, "color": draw.TREE, "linewidths": 0, "label": "overlapping stars"},
    "blob": {"marker": "o", "s": 16, "color": draw.TARGET, "linewidths": 0, "label": "blobs"},
    "constructed": {"marker": "D", "s": 14, "color": "0.25", "linewidths": 0, "label": "gallery"},
    "letter": {"marker": "s", "s": 11, "color": draw.RANDOM, "linewidths": 0, "label": "letters"},
    "strip": {"marker": "v", "s": 22, "color": draw.SOURCE, "linewidths": 0, "label": "strips"},
}
PATHS: dict[str, dict[str, Any]] = {"slide": {"color": draw.SOURCE}, "linear": {"color": draw.TARGET}}
PACES: dict[str, dict[str, Any]] = {"time": {"linestyle": "-"}, "speed": {"linestyle": ":"}}
N, PACE = PARAMETERS["n"], "time"


def tables() -> tuple[pd.DataFrame, pd.DataFrame]:
    """Ranks and counts to the disk at the usual n and pace; and shapes, stars told apart."""
    disk, shapes = (pd.read_csv(RESULTS / f"grid_{name}.csv") for name in ("disk", "shapes"))
    rows = ranks_and_counts(disk, shapes)
    shapes["look"] = shapes.kind.where(~shapes.curve.str.endswith("over"), "overlapping")
    return rows[(rows.n == N) & (rows.pace == PACE)], shapes[shapes.n == N].set_index("curve")


def papers_factors() -> dict[int, float]:
    """Row of Figure 11 -> arbitrary over remeshed, as the paper prints them."""
    ranks = zip(PAPER["curve"], PAPER["AR_arbitrary"], PAPER["AR_remeshed"], strict=True)
    return {int(name.split()[-1]): y / x for name, y, x in ranks}


@drawing(
    "table_1_factor",
    "Table 1",
    """When remeshing pays, on the way to the disk: the rank of arbitrary triangulations (median of a uniform sample)
    over that of the remeshed one; each mark is a curve of 96 vertices, the thinner the shape the farther to the right.
    Above 1 the remeshed triangulation is the better one. Lines at the right: the paper's four factors. 100 frames,
    pace: time.""",
)
def table_1_factor() -> Figure:
    rows, shapes = tables()
    figure, axes = plt.subplots(2, 3, figsize=(WIDTH, 4.6), sharex=True, sharey=True)
    for line, path in zip(axes, PATHS, strict=True):
        for ax, rtol in zip(line, ("1e-4", "1e-6", "1e-9"), strict=True):
            _by_shape(ax, np.exp(factors(rows[rows.path == path], f"AR_{rtol}")), shapes)
            ax.set_title(f"{path}, tolerance {rtol}")
    axes[0, 0].set(xscale="log", yscale="log", ylim=(0.33, 6.2), xlim=(0.95, 45))
    _plain_ticks(axes[0, 0], [1, 3, 10, 30], [0.5, 1, 2, 4])
    figure.supxlabel("isoperimetric ratio, length² / (4 π area): 1 for a circle", fontsize=9)
    figure.supylabel("AR, arbitrary / remeshed", fontsize=9)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=6, handletextpad=0.1)
    return figure


def _by_shape(ax: Axes, factor: "pd.Series[float]", shapes: pd.DataFrame) -> None:
    for label, look in LOOKS.items():
        some = shapes.index[shapes.look == label].intersection(factor.index)
        ax.scatter(shapes.isoperimetric[some], factor[some], zorder=3, **look)
    ax.axhline(1, color="0.7", linewidth=0.8, zorder=0)
    for row, value in papers_factors().items():
        ax.plot([0.9, 1], [value, value], color=draw.FAILURE, linewidth=1, transform=ax.get_yaxis_transform())
        shift = {4: -3, 7: 3}.get(row, 0)
        ax.annotate(
            f"row {row}",
            (0.89, value),
            (0, shift),
            xycoords=ax.get_yaxis_transform(),
            textcoords="offset points",
            ha="right",
            va="center",
            fontsize=6.5,
            color=draw.FAILURE,
        )


def _plain_ticks(ax: Axes, x: list[float], y: list[float]) -> None:
    ax.set_xticks(x, [f"{value:g}" for value in x])
    ax.set_yticks(y, [f"{value:g}" for value in y])
    ax.minorticks_off()


@drawing(
    "table_1_law",
    "Table 1",
    """What the rank counts. Left: along slide the rank grows like a power of the number of triangles that slide;
    remeshed and arbitrary triangulations follow one law, fitted on one half of the curves. Middle: the factor that
    the law predicts on the other half, beside the factor found; marks tell the kinds of curve as in the figure of
    shapes. Right: along linear the height of the rooted tree bounds the rank loosely and predicts little. 96
    vertices, 100 frames, pace: time.""",
)
def table_1_law() -> Figure:
    rows, shapes = tables()
    laws = (
        pd.read_csv(RESULTS / "grid_law.csv").query(f"n == {N} and pace == {PACE!r}").set_index(["path", "rank", "law"])
    )
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(WIDTH, 2.9))
    rank = "AR_1e-9"
    _counts(left, rows[rows.path == "slide"], "slides", rank, laws.loc[("slide", rank, "slides")])
    left.set(
        xlabel="triangles that slide", ylabel="AR at tolerance 1e-9", title="slide", xlim=(-3, None), ylim=(0, 100)
    )
    _predictions(middle, rows[rows.path == "slide"], shapes, rank, laws.loc[("slide", rank, "slides")])
    middle.set(xlabel="factor predicted", ylabel="factor found", title="slide, other half of the curves")
    _counts(right, rows[rows.path == "linear"], "height", rank, laws.loc[("linear", rank, "height")])
    right.set(xlabel="height of the rooted tree", ylabel="AR at tolerance 1e-9", title="linear", ylim=(0, 100))
    left.legend(loc="lower right", fontsize=7)
    return figure


def _counts(ax: Axes, rows: pd.DataFrame, count: str, rank: str, law: "pd.Series[Any]") -> None:
    for remeshed, color in ((False, draw.RANDOM), (True, draw.SOURCE)):
        some = rows[(rows.triangulation == "remeshed") == remeshed]
        label = "remeshed" if remeshed else "arbitrary"
        ax.scatter(
            some[count], some[rank].astype(float), s=8, color=color, linewidths=0, zorder=2 + remeshed, label=label
        )
    x = np.linspace(0, rows[count].max(), 200)
    ax.plot(x, _law(law, x), color="0.15", linewidth=1.2, zorder=4, label="law")


def _law(law: "pd.Series[Any]", x: Any) -> Any:
    return predicted((law.scale, law.power), x)


def _predictions(ax: Axes, rows: pd.DataFrame, shapes: pd.DataFrame, rank: str, law: "pd.Series[Any]") -> None:
    half = fitting_half(list(shapes.index))
    others = rows[~rows.curve.isin(half)].assign(law=lambda r: _law(law, r.slides))
    found, told = np.exp(factors(others, rank)), np.exp(factors(others, "law"))
    for label, look in LOOKS.items():
        some = shapes.index[shapes.look == label].intersection(found.index)
        ax.scatter(told[some], found[some], zorder=3, **(look | {"label": None}))
    ax.plot([0.3, 6], [0.3, 6], color="0.7", linewidth=0.8, zorder=0)
    ax.set(xscale="log", yscale="log", xlim=(0.3, 6), ylim=(0.3, 6))
    _plain_ticks(ax, [0.5, 1, 2, 4], [0.5, 1, 2, 4])


@drawing(
    "table_1_columns",
    "Table 1",
    """The paper's four columns on our stand-ins, from curve to curve: AR of arbitrary over AR of remeshed
    triangulations, by the tolerance of the rank. Where the remeshed triangulations are compatible (rows 1 and 3)
    and the arbitrary ones, one drawn for each curve, have to be flipped, the factor is about 3, along linear at
    every tolerance. Where both are flipped (rows 4 and 7) it is about 1. With triangulations common to both curves
    there is none. The band is the paper's factor, 20 % up and down; medians of 24 draws, 100 frames.""",
)
def table_1_columns() -> Figure:
    pairs = pd.read_csv(RESULTS / "grid_pairs.csv").query(f"n == 0 and frames == {PARAMETERS['default_frames']}")
    ranks = [rank for rank in RANKS if pairs[rank].isna().mean() < 0.2 and rank != "AR_single"]
    figure, axes = plt.subplots(1, 4, figsize=(WIDTH, 2.9), sharey=True)
    for ax, (row, paper) in zip(axes, papers_factors().items(), strict=True):
        ax.axhspan(paper / 1.2, paper * 1.2, color=draw.FAILURE, alpha=0.13, linewidth=0, label="paper, within 20 %")
        ax.axhline(1, color="0.75", linewidth=0.8, zorder=0)
        some = pairs[pairs.row == row].set_index(["path", "pace", "triangulation"]).sort_index()
        for path, color in PATHS.items():
            for pace, line in PACES.items():
                of = some.loc[(path, pace)][ranks].astype(float)
                ratio = of.loc["own_median"] / of.loc["remeshed"]
                ax.plot(range(len(ranks)), ratio, label=f"{path}, pace {pace}", **color, **line)
            if "common_median" in of.index:
                ratio = of.loc["common_median"] / of.loc["remeshed"]
                ax.plot(range(len(ranks)), ratio, linestyle="--", linewidth=0.9, label=f"{path}, common", **color)
        ax.set_title(f"row {row}")
        ax.set_xticks(range(len(ranks)), [rank.removeprefix("AR_") for rank in ranks], rotation=90, fontsize=7)
    axes[0].set(yscale="log", ylim=(0.4, 6), ylabel="AR, arbitrary / remeshed")
    axes[0].set_yticks([0.5, 1, 2, 4], ["0.5", "1", "2", "4"])
    axes[0].minorticks_off()
    figure.supxlabel("tolerance of the rank", fontsize=9)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=4, fontsize=7.5)
    return figure
