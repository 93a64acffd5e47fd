"""Figures 9 and 10: pivots and flips."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from experiments.figures.registry import drawing
from tween import Triangulation, gallery, morph
from tween import plot as draw

TIMES = np.linspace(0, 1, 7)


@drawing(
    "figure_09_pivots",
    "Figure 9",
    """The same two curves with and without matched pivots.""",
)
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


@drawing(
    "figure_10_flips",
    "Figure 10",
    """Flips where and when they happen: in each shape the diagonals that came since the one before.""",
)
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
