"""Figure 11 and the gallery: the curves, and the pairs of curves with the shapes between them."""

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from experiments.figures.registry import WIDTH, drawing
from experiments.figures.rows import SHAPES, bands, draw_row
from experiments.subjects import shape, shapes
from tween import Morph, gallery, paper_morph
from tween import plot as draw


def title(number: int, name: str, m: Morph) -> str:
    """Number of the row, what the pair shows, how many flips."""
    return f"{number}  {gallery.describe_pair(name)}  {len(m.events) or 'No'} flips"


@drawing(
    "figure_11_pairs",
    "Figure 11",
    """Seven morphs between self-overlapping curves in even steps of time, every shape as large as the others; beside
    its time stands at which scale it is drawn, that of the source being 1.  The triangulations of the first three pairs
    are compatible; those of the last four are flipped into each other, most of it close to the disk, through which the
    morph leads.  Dots mark matched pivots.  A colour is a place along the source; it
    stays with the vertices.  Which of two layers is drawn on top means nothing.  The paper's curves are unpublished;
    ours are stand-ins, compatible in the rows where its own are.""",
)
def figure_11() -> Figure:
    """The seven pairs of the gallery, a row each."""
    figure = plt.figure(figsize=(WIDTH, 9.4), layout=ConstrainedLayoutEngine(h_pad=0.06))
    for number, (part, name) in enumerate(zip(bands(figure, [1] * 7), gallery.pairs(), strict=True), start=1):
        m = paper_morph(*gallery.pair(name))
        draw_row(part.subplots(1, SHAPES), m)
        part.suptitle(title(number, name, m), x=0.01, ha="left", fontsize=8)
    return figure


@drawing(
    "gallery",
    "ours",
    """Every curve of the gallery and every letter: the more layers lie over each other, the darker.""",
)
def gallery_sheet() -> Figure:
    """Every curve of the gallery and every letter, layers shown by transparency."""
    names, columns = list(shapes()), 7
    rows = -(-len(names) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(WIDTH, 1.15 * rows))
    for ax in axes.flat:
        ax.set_axis_off()
    for ax, name in zip(axes.flat, names, strict=False):
        draw.draw_shape(shape(name), ax)
        ax.set_title(name.replace("_", " "), fontsize=7.5)
    return figure
