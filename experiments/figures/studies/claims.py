"""The ledger at a glance: a mark for the verdict on each claim."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from experiments.figures.registry import WIDTH, drawing
from experiments.store import RESULTS
from tween import plot as draw

# Told apart by shape and filling, too, where there is no colour.
MARKS: dict[str, dict[str, Any]] = {
    "holds": {"marker": "o", "color": draw.INK, "fillstyle": "full"},
    "holds under a condition": {"marker": "o", "color": draw.INK, "fillstyle": "left", "markerfacecoloralt": "white"},
    "no difference seen": {"marker": "o", "color": "0.5", "fillstyle": "none"},
    "fails": {"marker": "X", "color": draw.FAILURE, "fillstyle": "full", "markersize": 7.5},
}
SECTIONS = {"3": "Sections 1 to 4", "4": "Sections 1 to 4", "5": "Section 5", "6": "Section 6"}
REST = "Sections 7 and 8"


def by_section(claims: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """The claims of the ledger in four groups, by the section of the paper."""
    groups = claims.section.str[0].map(SECTIONS).fillna(REST)
    return {str(name): group for name, group in claims.groupby(groups, sort=False)}


@drawing(
    "verdicts",
    "ours",
    """The verdict on each claim of the paper, and on our answers to its open questions, by section.  The ledger
    has the claims in full, with their rules and numbers.""",
)
def verdicts() -> Figure:
    """Four columns of names, a mark before each."""
    groups = by_section(pd.read_csv(RESULTS / "claims.csv", keep_default_na=False))
    rows = np.reshape([len(group) for group in groups.values()], (2, 2)).max(axis=1)
    figure, axes = plt.subplots(2, 2, figsize=(WIDTH, 0.235 * rows.sum() + 0.9), height_ratios=rows)
    for ax, (name, group), most in zip(axes.flat, groups.items(), np.repeat(rows, 2), strict=True):
        _column(ax, group)
        ax.set(xlim=(-0.05, 1), ylim=(0.7 - most, 0.7))
        ax.set_title(name, loc="left")
    handles = [Line2D([], [], linestyle="", label=verdict, **style) for verdict, style in MARKS.items()]
    figure.legend(handles=handles, loc="outside upper center", ncols=4)
    return figure


def _column(ax: Axes, group: pd.DataFrame) -> None:
    names = group.id.str.replace("-", " ") + group.kind.map({"open question": " (open question)"}).fillna("")
    for y, (label, verdict) in enumerate(zip(names, group.verdict, strict=True)):
        ax.plot(0, -y, **MARKS[verdict])
        ax.text(0.05, -y, label, va="center", fontsize=8.5)
    ax.set_axis_off()
