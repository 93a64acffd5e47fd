"""The guarantee as pictures: the fan, the study, and the five paths."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from experiments.baselines import BASELINES
from experiments.figures.paper.compatible import film
from experiments.figures.registry import WIDTH, drawing
from experiments.store import RESULTS
from tween import certify, gallery, morph, triangulate
from tween import plot as draw
from tween.choices import PATHS, Path
from tween.morphing.morph import Morph
from tween.morphing.strategy import morph_compatible

TIMES = np.linspace(0, 1, 7)
KINDS = {
    "disk": "34 curves\nto the disk",
    "pair": "7 pairs of\nFigure 11",
    "letters": "25 pairs\nof letters",
    "random disk": "500 random\ndisks",
    "random pair": "50 random\npairs",
}


def hub_sums(shapes: NDArray[np.float64]) -> NDArray[np.float64]:
    """The sum of the angles of the fan's triangles at its hub, vertex 0, in multiples of pi."""
    z = (shapes[:, 1:] - shapes[:, :1]) @ np.array([1, 1j])
    return np.angle(z[:, 1:] / z[:, :-1]).sum(axis=1) / np.pi


def _fan_morph(path: Path, guarantee: bool) -> Morph:
    return morph_compatible(*gallery.fan(), path, guarantee, placement="root")


@drawing(
    "guarantee_fan",
    "ours",
    """The fan: ten triangles around a hub, steps of 60 and of 8 degrees that change places.  Left, the sum of the
    angles at the hub: along the paper's paths it passes 2 pi, with the guarantee it does not.  Right, the shape at
    t = 1/2 along slide, plain (its ends overlap beyond a full turn: it bounds no immersed disk) and guaranteed.""",
)
def guarantee_fan() -> Figure:
    source = gallery.fan()[0]
    figure, (left, *shapes) = plt.subplots(1, 3, figsize=(WIDTH, 2.5), width_ratios=(1.5, 1, 1))
    t = np.linspace(0, 1, 401)
    lines: tuple[tuple[Path, bool, str], ...] = (("linear", False, "--"), ("slide", False, "-"), ("slide", True, "-"))
    for path, guarantee, style in lines:
        sums = hub_sums(_fan_morph(path, guarantee).at(t))
        left.plot(t, sums, style, color=draw.SOURCE if guarantee else draw.FAILURE)
    left.axhline(2, color="0.4", linewidth=0.7)
    left.set(xlabel="time", ylabel="sum of angles / pi", xticks=[0, 0.5, 1])
    for text, x, y in (("linear", 0.53, 2.2), ("slide", 0.25, 2.085), ("slide, guaranteed", 0.5, 1.68)):
        left.text(x, y, text, ha="left" if text == "linear" else "center", fontsize=8)
    for ax, guarantee in zip(shapes, (False, True), strict=True):
        m = _fan_morph("slide", guarantee)
        color = draw.SOURCE if guarantee else draw.FAILURE
        draw.draw_triangulation(source.moved(m(0.5)), ax, colors=color, alpha=0.25)
        ax.set_title("guaranteed" if guarantee else "plain")
    low, high = np.min([ax.viewLim.min for ax in shapes], axis=0), np.max([ax.viewLim.max for ax in shapes], axis=0)
    for ax in shapes:
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    return figure


@drawing(
    "guarantee_study",
    "ours",
    """The share of morphs all of whose 61 frames bound an immersed disk, by the exact checker.  Open circles: the path
    as it is; filled: with the guarantee; squares: published methods of others, on the same correspondence.  Numbers:
    morphs that failed.""",
)
def guarantee_study() -> Figure:
    table = pd.read_csv(RESULTS / "guarantee_summary.csv")
    rows = [*PATHS, *BASELINES]
    figure, axes = plt.subplots(1, len(KINDS), figsize=(WIDTH, 2.9), sharey=True)
    for ax, (kind, title) in zip(axes, KINDS.items(), strict=True):
        _shares(ax, table[table.kind == kind], rows)
        ax.set_title(title, fontsize=8.5)
    axes[0].set_yticks(range(len(rows)), [row.replace("_", " ") for row in rows])
    axes[0].set_ylim(len(rows) - 0.4, -0.6)
    figure.supxlabel("share of morphs that are valid in every frame", fontsize=9)
    return figure


def _shares(ax: Axes, table: pd.DataFrame, rows: list[str]) -> None:
    for guarantee, of in table.groupby("guarantee"):
        y, share = of.path.map(rows.index).to_numpy(), (of.valid / of.morphs).to_numpy()
        ours = of.path.isin(PATHS).to_numpy()
        if guarantee:
            ax.scatter(share, y, s=16, color=draw.SOURCE, zorder=3)
            continue
        ax.scatter(share[ours], y[ours], s=42, facecolors="none", edgecolors=draw.RANDOM, zorder=2)
        ax.scatter(share[~ours], y[~ours], s=26, marker="s", color=draw.RANDOM, zorder=2)
        for x, row, failed in zip(share, y, of.morphs - of.valid, strict=True):
            if failed:
                side = 1 if x < 0.5 else -1
                ax.annotate(
                    f"{failed}",
                    (x, row),
                    (7 * side, 0),
                    textcoords="offset points",
                    ha="left" if side > 0 else "right",
                    va="center",
                    fontsize=7.5,
                )
    ax.axhline(len(PATHS) - 0.5, color="0.8", linewidth=0.6)
    ax.set(xlim=(-0.12, 1.12), xticks=[0, 0.5, 1])
    ax.grid(axis="y", color="0.92", linewidth=0.6)
    ax.set_axisbelow(True)


@drawing(
    "guarantee_paths",
    "ours",
    """One spiral on its way to the disk along five paths, all guaranteed and at one scale; linear and slide are the
    paper's.""",
)
def guarantee_paths() -> Figure:
    T = triangulate(gallery.curve("spiral_1"))
    morphs = {path: morph(T, T.on_disk(), path=path, guarantee=True) for path in PATHS}
    assert all(certify(m) for m in morphs.values())
    figure, axes = plt.subplots(len(PATHS), 1, figsize=(WIDTH, 7.2))
    film(axes, list(morphs.values()), TIMES)
    for ax, path in zip(axes, PATHS, strict=True):
        ax.set_title(path, loc="left")
    return figure
