"""Figures 4, 6, 7 and 8: morphs between compatible triangulations."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from experiments.figures.registry import SEED, drawing
from experiments.store import rng_for
from tween import Triangulation, area_matrix, decompose, frame_variance, gallery, morph, triangulate
from tween import plot as draw

TIMES = np.linspace(0, 1, 7)


@drawing(
    "figure_06_random_remeshed",
    "Figure 6",
    """A morph to the disk, with a triangulation drawn at random and with the remeshed one.""",
)
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
