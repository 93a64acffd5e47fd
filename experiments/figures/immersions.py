"""Figures 1, 2, 3 and 5: immersions of a disk and their triangulations."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from experiments.figures.registry import SEED, drawing
from experiments.store import rng_for
from tween import decompose, gallery, triangulate
from tween import plot as draw


@drawing(
    "figure_03_dual_graphs",
    "Figure 3",
    """Dual trees of a spiral and their simplifications, for a triangulation drawn at random and for the
    remeshed one.""",
)
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
