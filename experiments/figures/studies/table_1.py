"""Table 1 as pictures: where the remeshed triangulation lies among random ones, and what that depends on."""

from collections.abc import Iterable, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from experiments.figures.registry import WIDTH, drawing
from experiments.measures import MEASURES
from experiments.store import RESULTS
from experiments.subjects import shapes
from tween import plot as draw

VERDICTS: dict[str, dict[str, Any]] = {  # the hatch tells the last from the first where there is no colour
    "below": {"color": draw.SOURCE},
    "equal": {"color": "0.87"},
    "above": {"facecolor": draw.FAILURE, "edgecolor": "white", "hatch": "////"},
}
VERDICT_LABELS = ("remeshed below the median of the random", "equal", "above")
DEFAULTS = {"slide", "100", "shares of the source", "spaced by arc length", "disk's centre", "median of the uniform"}
ROUTES = {"straight": "straight", "flipped": "flipped", "over the disk": "through the disk"}
# From fat to thin, every second or third of our curves.
SELECTION = (
    *("convex", "three_lobes", "five_disks", "two_disks", "ell", "arrow", "comb"),
    *("horseshoe", "loop", "ess", "winding_3", "spiral_2", "letter e", "letter R"),
)


@drawing(
    "table_1_linear",
    "Table 1",
    """Where the remeshed triangulation lies in the distribution of the random ones on the way to the disk, path linear,
    pace time, on some of our curves, fat ones above and thin ones below.""",
)
def table_1_linear() -> Figure:
    return table_1("linear", SELECTION)


@drawing(
    "table_1_linear_all",
    "Table 1, supplement",
    """As the figure before, every curve: path linear, pace time.""",
)
def table_1_linear_all() -> Figure:
    return table_1("linear", shapes())


@drawing(
    "table_1_slide",
    "Table 1",
    """Where the remeshed triangulation lies in the distribution of the random ones on the way to the disk, path slide,
    pace time, on some of our curves, fat ones above and thin ones below.""",
)
def table_1_slide() -> Figure:
    return table_1("slide", SELECTION)


@drawing(
    "table_1_slide_all",
    "Table 1, supplement",
    """As the figure before, every curve: path slide, pace time.""",
)
def table_1_slide_all() -> Figure:
    return table_1("slide", shapes())


def table_1(path: str, names: Iterable[str]) -> Figure:
    """Where the remeshed triangulation lies in the distribution of the random ones, curve by curve."""
    table = pd.read_csv(RESULTS / "table_1_to_disk.csv").set_index("curve").loc[list(names)].reset_index()
    figure, axes = plt.subplots(1, 3, figsize=(WIDTH, 1.2 + 0.145 * table.curve.nunique()), sharey=True)
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


@drawing(
    "sensitivity",
    "Table 1",
    """On how many of our 34 curves the remeshed triangulation has a smaller, an equal or a larger measure than the
    median random one, on the way to the disk. Above: the rank along four paths, by its tolerance. Below: one thing
    at a time set otherwise, the default in bold; right of each bar the ratio random / remeshed, its median over the
    curves (in the last block: the ratio of the triangulation that is named to the remeshed one). Tolerance and path
    decide; frames, disk, root and unit hardly matter; and no median of the rank reaches 2. Pace: time.""",
)
def sensitivity() -> Figure:
    table = pd.read_csv(RESULTS / "sensitivity.csv", dtype={"setting": str})
    others = table[~table.setting.isin(DEFAULTS) | (table.factor == "path")]
    figure = plt.figure(figsize=(WIDTH, 8.4))
    top, rest = figure.subfigures(2, 1, height_ratios=[1, 3.2], squeeze=False)[:, 0]
    for ax, path in zip(top.subplots(1, 4, sharey=True), ("slide", "linear", "angle", "metric"), strict=True):
        _by_tolerance(ax, table[(table.factor == "path") & (table.setting == path) & (table.measure != "Var")])
        ax.set_title(f"AR, path {path}")
    top.axes[0].set_ylabel("curves")
    for ax, measure in zip(rest.subplots(1, 3, sharey=True), ("AR_1e-4", "AR_1e-9", "Var"), strict=True):
        _by_setting(ax, others[others.measure == measure])
        ax.set_title(measure.replace("_", " at tolerance "))
    _name_settings(rest.axes[0], others[others.measure == "Var"])
    handles = [Patch(label=label, **look) for label, look in zip(VERDICT_LABELS, VERDICTS.values(), strict=True)]
    rest.legend(handles=handles, loc="outside lower center", ncols=3)
    return figure


def _by_tolerance(ax: Axes, table: pd.DataFrame) -> None:
    x, bottom = np.arange(len(table)), np.zeros(len(table))
    for verdict, look in VERDICTS.items():
        ax.bar(x, table[verdict], bottom=bottom, width=0.85, linewidth=0, **look)
        bottom = bottom + table[verdict].to_numpy()
    ax.set_xticks(x, table.measure.str.removeprefix("AR_").tolist(), rotation=90)
    ax.set(ylim=(0, bottom[0]), yticks=[0, bottom[0] / 2, bottom[0]], xlabel="tolerance")


def _places(table: pd.DataFrame) -> NDArray[np.float64]:
    """Heights of the bars, with room above each factor."""
    return np.asarray(-np.arange(len(table)) - 0.9 * pd.factorize(table.factor)[0])


def _by_setting(ax: Axes, table: pd.DataFrame) -> None:
    """A bar a setting, the factors in blocks, the median ratio at its right."""
    place, left = _places(table), np.zeros(len(table))
    for verdict, look in VERDICTS.items():
        ax.barh(place, table[verdict], left=left, height=0.82, linewidth=0, **look)
        left = left + table[verdict].to_numpy()
    for y, ratio in zip(place, table.ratio_median, strict=True):
        ax.text(left[0] + 0.8, y, f"{ratio:.2f}" if ratio < 9.5 else f"{ratio:.1f}", va="center", fontsize=7)
    ax.set(xlim=(0, left[0] + 6), xticks=[0, left[0] / 2, left[0]], xlabel="curves", ylim=(place.min() - 0.7, 1.2))
    ax.tick_params(axis="y", length=0)


def _name_settings(ax: Axes, table: pd.DataFrame) -> None:
    place = _places(table)
    ax.set_yticks(place, table.setting.tolist(), fontsize=7.5)
    for label in ax.get_yticklabels():
        label.set_fontweight("bold" if label.get_text() in DEFAULTS else "normal")
    for factor, y in zip(table.factor, place, strict=True):
        if y == place[table.factor == factor].max():
            ax.text(-1, y + 0.85, factor, fontsize=7.5, style="italic", color="0.45", ha="right", va="center")


@drawing(
    "table_1_slides",
    "Table 1",
    """What the rank counts.  Left: how many triangles slide, that is, follow an arc, on the way to the disk; each
    dot is a curve; the remeshed triangulation has about twice as many as random ones.  Right: rank correlation,
    over the random triangulations of a curve, between what is named above and each measure; each dot is a curve,
    the bar the median.  The number of slides goes with the rank at tight tolerances; the thinnest angle has nothing
    to do with it.""",
)
def table_1_slides() -> Figure:
    table = pd.read_csv(RESULTS / "table_1_slides.csv")
    figure = plt.figure(figsize=(WIDTH, 2.7))
    axes = figure.subplots(1, 4, width_ratios=[1.25, 1, 1, 1])
    _as_many(axes[0], table.slides_random, table.slides_remeshed, [1, 2])
    axes[0].set(xlabel="random (median)", ylabel="remeshed", title="triangles that slide")
    titles = {"slides": "triangles that slide", "thinnest": "thinnest angle", "typical": "typical angle"}
    for ax, (label, title) in zip(axes[1:], titles.items(), strict=True):
        _correlations(ax, table, label)
        ax.set_title(title)
    axes[1].set_ylabel("rank correlation with")
    for ax in axes[2:]:
        ax.tick_params(labelleft=False)
    return figure


def _as_many(ax: Axes, x: "pd.Series[float]", y: "pd.Series[float]", factors: Sequence[float]) -> None:
    """A dot for each pair of values, as large as it is frequent, and lines of equal ratio with their factors."""
    x_end, y_end = 1.12 * x.max(), 1.12 * y.max()
    for factor in factors:
        end = 0.96 * min(x_end, y_end / factor)
        ax.plot([0, end], [0, factor * end], color="0.8", linewidth=0.8, zorder=0)
        ax.annotate(f"×{factor:g}", (end, factor * end), (2, -1), textcoords="offset points", fontsize=7, color="0.45")
    places, counts = np.unique(np.stack([x, y], axis=1), axis=0, return_counts=True)
    ax.scatter(places[:, 0], places[:, 1], s=9 * counts, color=draw.SOURCE, linewidths=0)
    ax.set(xlim=(0, x_end), ylim=(0, y_end))


def _correlations(ax: Axes, table: pd.DataFrame, label: str) -> None:
    for x, measure in enumerate(MEASURES):
        values = table[f"{label}_{measure}"].dropna().sort_values()
        spread = 0.12 * np.resize([-1, 1, 0], len(values))
        ax.scatter(x + spread, values, s=7, color=draw.RANDOM, linewidths=0)
        ax.hlines(values.median(), x - 0.35, x + 0.35, color="0.15", linewidth=1.6, zorder=3)
    ax.axhline(0, color="0.8", linewidth=0.8, zorder=0)
    ax.set_xticks(range(4), [m.replace("_", " ") for m in MEASURES], rotation=90)
    ax.set(ylim=(-1, 1), yticks=[-1, 0, 1])


@drawing(
    "table_1_curve_to_curve",
    "Table 1",
    """When the factor appears: AR at tolerance 1e-4 between two curves.  Left: our stand-ins for the paper's four
    columns.  Straight to the other curve the rank is small whatever the triangulation; arbitrary ones of two curves
    have to be flipped; through the disk, the remeshed ones have a rank of nearly that size too.  Right: the pairs of
    our curves that have a common triangulation under the pivots' correspondence, straight under it, and with the
    remeshed triangulations, which have to be flipped; the larger a dot, the more pairs.  Path slide, pace speed.""",
)
def table_1_curve_to_curve() -> Figure:
    ways, flips = (pd.read_csv(RESULTS / f"table_1_curve_to_curve_{part}.csv") for part in ("ways", "flips"))
    figure = plt.figure(figsize=(WIDTH, 2.9))
    axes = figure.subplots(1, 5, width_ratios=[1, 1, 1, 1, 2.1])
    for ax, (pair, block) in zip(axes[:4], ways.groupby(["row", "pair"]), strict=True):
        _routes(ax, block)
        ax.set_title(f"row {pair[0]}")
        ax.tick_params(labelleft=pair[0] == 1)
    axes[0].set_ylabel("AR at tolerance 1e-4")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower left", ncols=3)
    _as_many(axes[4], flips["straight_AR_1e-4"], flips["flipped_AR_1e-4"], [1, 2, 4])
    axes[4].set(xlabel="straight, common triangulation", ylabel="remeshed, flipped", title=f"{len(flips)} pairs")
    return figure


def _routes(ax: Axes, table: pd.DataFrame) -> None:
    looks: dict[str, dict[str, Any]] = {
        "remeshed": {"marker": "o", "facecolors": "none", "edgecolors": draw.SOURCE, "label": "remeshed"},
        "own": {"marker": "s", "color": draw.RANDOM, "label": "random, one for each"},
        "common": {"marker": "D", "color": "0.2", "label": "random, common"},
    }
    for kind, look in looks.items():
        some = table[table.triangulation == kind]
        ax.scatter(some.way.map(list(ROUTES).index), some["AR_1e-4"], s=26, zorder=3, **look)
    ax.set_xticks(range(3), ROUTES.values(), rotation=90)
    ax.set(xlim=(-0.6, 2.6), ylim=(0, 30))
    ax.grid(axis="y", color="0.92")
