"""Figure 11 and the gallery: the curves and the pairs of curves."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from experiments.figures.registry import drawing
from tween import gallery, morph
from tween import plot as draw

TIMES = np.linspace(0, 1, 7)


@drawing(
    "figure_11_pairs",
    "Figure 11",
    """The seven pairs of the gallery, each shape as large as the others; dots mark matched pivots.""",
)
def figure_11() -> Figure:
    """The seven pairs of the gallery, each shape as large as the others; dots mark matched pivots."""
    figure, axes = plt.subplots(7, 1, figsize=(7.2, 9.0))
    for ax, name in zip(axes, gallery.pairs(), strict=True):
        m = morph(*gallery.pair(name), strategy="paper")
        draw.draw_filmstrip(m, TIMES, ax, labels=False, one_scale=False, mark=m.alignment.pivot)
        ax.set_anchor("W")
        ax.set_title(f"{name.replace('_', ' ')}: {len(m.events) or 'no'} flips", loc="left", fontsize=8)
    return figure


@drawing(
    "gallery",
    "ours",
    """Every curve of the gallery and every letter, layers shown by transparency.""",
)
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
