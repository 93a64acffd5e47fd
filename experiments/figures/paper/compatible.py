"""Figures 4, 6, 7 and 8: morphs between compatible triangulations.

In a film every row is a morph and every column a time.  A curve that bounds no immersed disk, whatever its
triangulation, has the colour of failure, and so have triangles that are turned over.
"""

from collections.abc import Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon
from numpy.typing import NDArray

from experiments.baselines import edge_angle, straight
from experiments.figures.registry import SEED, WIDTH, drawing
from experiments.figures.rows import SHAPES, bands, draw_row, write_above
from experiments.lengths import shrinkage
from experiments.store import rng_for
from tween import Morph, Triangulation, decompose, gallery, morph, paper_morph, triangulate
from tween import plot as draw
from tween.choices import Path
from tween.geometry.dual_tree import rooted
from tween.geometry.predicates import orient2d
from tween.morphing.compatible.paths import third_vertices

TIMES = np.linspace(0, 1, 7)
MORE_TIMES = np.linspace(0, 1, 9)
FRAMES = 61  # over which frames that fail are counted
SAMPLES = 51  # random triangulations of which Figure 6 shows the median one
SHARP = 0.2  # radians; corners of a path turn by more, steps along its arcs by less
TITLE = 0.25  # inches that a title or a line of times takes
RINGED = 1.2  # diagonals are ringed where they are shorter than at both ends by this factor
CASES = {
    "monotone:\nstraight": (0.15 + 1.55j, 0.75 + 0.6j, (False, True)),
    "not monotone:\narc, then chord": (1.75 + 0.35j, -0.2 + 1.0j, (False, True)),
    "mirrored:\nchord, then arc": (1.2 + 1.0j, -0.75 + 0.35j, (True, False)),
    "both edges:\narc after arc": (-1 + 1j, 2 + 1j, (True, True)),
}


# Measures


def bending(m: Morph, frames: int = 41) -> NDArray[np.float64]:
    """By how much the turning angle of the curve changes at each vertex, up and down together, (n,); radians."""
    z = np.ascontiguousarray(m.frames(frames)).view(np.complex128)[..., 0]
    edges = np.roll(z, -1, axis=1) - z
    turns = edges / np.roll(edges, 1, axis=1)
    change: NDArray[np.float64] = np.abs(np.angle(turns[1:] / turns[:-1])).sum(axis=0)
    return change


def share_of_tenth(amounts: NDArray[np.float64]) -> float:
    """The share of the whole that the largest tenth of the amounts make up."""
    count = max(1, round(len(amounts) / 10))
    return float(np.sort(amounts)[-count:].sum() / amounts.sum())


def common_size(source: Any, target: Any) -> tuple[Triangulation, Triangulation]:
    """Two curves with the same triangles, remeshed where that makes them so; the target scaled to the source's area."""
    m = paper_morph(source, target)
    if m.events:
        m = morph(source, target, strategy="common")
    scale = np.sqrt(m.source.areas.sum() / m.target.areas.sum())
    return m.source, m.target.moved(scale * m.target.points)


# Figures


@drawing(
    "figure_04_interiors",
    "Figure 4",
    """An S becomes a loop, both of one area.  Top: every vertex along a straight line.  Middle: lengths of edges
    and turning angles interpolated (Sederberg and others).  Bottom: triangles of the interior, path "slide": the
    arm swings around.  Red: curves that bound no immersed disk, and triangles turned over.  The paper shows a top
    and a bottom row, for two curves whose coordinates are unpublished.""",
)
def figure_4() -> Figure:
    """A morph that takes the interior into account beside two that do not."""
    source, target = common_size(gallery.curve("ess"), gallery.curve("loop"))
    rows = {
        "vertices along straight lines": straight(source, target),
        "lengths and turning angles of edges": edge_angle(source, target),
        "triangles of the interior": paper_morph(source, target, shifts=0),
    }
    figure, axes = plt.subplots(3, 1, figsize=(WIDTH, 5.0))
    film(axes, list(rows.values()), TIMES)
    for ax, (label, m) in zip(axes, rows.items(), strict=True):
        failed = sum(not decompose(points) for points in m.frames(FRAMES))
        ax.set_title(f"{label}: {failed} of {FRAMES} curves bound no disk", loc="left")
    return figure


@drawing(
    "figure_06_random_remeshed",
    "Figure 6",
    """A ramp that covers a part of the plane three times, on its way to the disk along "slide".  Top: with a
    triangulation drawn at random, of 51 the median one by the share in its title.  Bottom: remeshed.  The share is
    that of the tenth of the vertices at which the turning angle changes most.  With the random triangulation the
    curve moves in kinks; in the paper's top row all changes happen in one small region.  Every shape is drawn as large
    as the others; beside its time stands its scale, that of the source being 1.  The paper's curve is unpublished.""",
)
def figure_6() -> Figure:
    """A morph to the disk with a random and with the remeshed triangulation."""
    T = triangulate(gallery.curve("winding_3"))
    disk = T.on_disk().points
    drawn = decompose(T.curve).sample(rng_for(SEED, "figure 6"), SAMPLES)
    morphs = [paper_morph(S, Triangulation(disk, S.triangles)) for S in drawn]
    order = np.argsort([share_of_tenth(bending(m)) for m in morphs])
    rows = {"random": morphs[order[SAMPLES // 2]], "remeshed": paper_morph(T, T.moved(disk))}
    figure = plt.figure(figsize=(WIDTH, 3.0))
    for part, (label, m) in zip(bands(figure, [1, 1]), rows.items(), strict=True):
        draw_row(part.subplots(1, SHAPES), m, dots=(), inner=0.4)
        share = share_of_tenth(bending(m))
        write_above(part, f"{label}: a tenth of the vertices does {share:.0%} of the bending")
    return figure


@drawing(
    "figure_07_paths",
    "Figure 7",
    """Top: the third vertex moves from C1 (blue) to C2 (orange) over the base AB, straight (dashed) or along "slide"
    (solid).  Propagation edges are thick; the radius of a dotted circle is the smaller of an edge's two lengths; at Ck
    the path leaves its circle, or comes to it.  Bottom: lengths of the propagation edges on the way, red where the
    straight path makes them shorter than at both ends.  The first two columns are the paper's cases, the third is the
    second mirrored in space and time.  The last one is ours: the paper says that it cannot happen.""",
)
def figure_7() -> Figure:
    """The cases of the slide path: the path above, lengths of the propagation edges over time below."""
    figure, axes = plt.subplots(2, 4, figsize=(WIDTH, 3.5), height_ratios=[1.1, 1], sharey="row", sharex="row")
    for (above, below), (label, case) in zip(axes.T, CASES.items(), strict=True):
        above.set_title(label, fontsize=8.5, pad=12)  # above C1 of the first
        _draw_ends(above, *case)
        _draw_paths(above, *case)
        _draw_lengths(below, *case)
    axes[1, 0].set_ylabel("length / base")
    axes[1, 0].legend(loc="lower left")
    return figure


@drawing(
    "figure_08_linear_slide",
    "Figure 8",
    """Two morphs, each between shapes of one area, along both of the paper's paths.  The titles say how short a
    diagonal gets on the way, as a share of the smaller of its lengths at both ends; rings mark, in each shape, the
    diagonal that has shrunk most, where that is by more than a sixth.  Upper two: remeshed triangulations, which are
    compatible.  Lower two: a common triangulation, of the pair on which the paths were found to differ most.  The
    paper's curves are unpublished.""",
)
def figure_8() -> Figure:
    """The same morphs along both of the paper's paths."""
    pairs = {"e to l": gallery.pair("e_to_l"), "L to e": (gallery.curve("ell"), gallery.letter("e"))}
    figure, axes = plt.subplots(4, 1, figsize=(WIDTH, 5.7))
    for two, (label, curves) in zip(axes.reshape(2, 2), pairs.items(), strict=True):
        shapes = common_size(*curves)
        morphs = {path: paper_morph(*shapes, path=path, shifts=0) for path in ("linear", "slide")}
        middles = film(two, list(morphs.values()), MORE_TIMES)
        for ax, (path, m) in zip(two, morphs.items(), strict=True):
            least = 1 / shrinkage(m, np.linspace(0, 1, FRAMES)).max()
            ax.set_title(f"{label}, {path}: diagonals shrink to {least:.0%}", loc="left")
            _ring_shrunk(ax, m, middles)
    return figure


# Films


def film(axes: Sequence[Axes], morphs: Sequence[Morph], times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Draw a morph in each of the axes, all on one scale, a column a time; returns the middles of the columns."""
    shapes = [_centred(m.at(times)) for m in morphs]
    widths = np.max([np.ptp(frames[..., 0], axis=1) for frames in shapes], axis=0)
    height = max(np.ptp(frames[..., 1], axis=1).max() for frames in shapes)
    gap = max(0.1 * widths.max(), 0.05 * widths.sum() / len(times))
    middles: NDArray[np.float64] = np.cumsum(widths + gap) - 0.5 * widths
    for ax, m, frames in zip(axes, morphs, shapes, strict=True):
        for t, x, points in zip(times, middles, frames, strict=True):
            _draw_frame(ax, points + np.array([x, 0.0]), m.triangles_at(t), draw.identity_colors(m.source))
        ax.set(xlim=(0, middles[-1] + 0.5 * widths[-1] + gap), ylim=(-0.54 * height, 0.54 * height), anchor="W")
    for t, x in zip(times, middles, strict=True):
        axes[-1].text(x, -0.56 * height, f"t = {t:.3g}", ha="center", va="top", fontsize=7.5)
    _fit_height(axes)
    return middles


def _fit_height(axes: Sequence[Axes]) -> None:
    """Make the figure as tall as its rows need at its width, titles and times included, so that no side is empty."""
    figure = axes[0].figure
    assert isinstance(figure, Figure)
    width = figure.get_figwidth()
    rows = [width * abs(np.ptp(ax.get_ylim()) / np.ptp(ax.get_xlim())) + TITLE for ax in figure.axes]
    figure.set_figheight(sum(rows) + TITLE)


def _centred(frames: NDArray[np.float64]) -> NDArray[np.float64]:
    """Frames, (k, n, 2), with the middle of each at the origin."""
    middles: NDArray[np.float64] = 0.5 * (frames.min(axis=1, keepdims=True) + frames.max(axis=1, keepdims=True))
    return frames - middles


def _draw_frame(ax: Axes, points: NDArray[np.float64], triangles: NDArray[np.int64], colors: Any) -> None:
    draw.draw_triangulation(Triangulation(points, triangles), ax, colors=colors)
    corners = points[triangles]
    over = corners[orient2d(*np.moveaxis(corners, 1, 0)) <= 0]
    ax.add_collection(PolyCollection(list(over), facecolors=draw.FAILURE, alpha=0.7, linewidths=0, zorder=2))
    if not decompose(points):
        outline = np.concatenate([points, points[:1]])
        ax.add_collection(LineCollection([outline], colors=draw.FAILURE, linewidths=1.2, zorder=3))


def _ring_shrunk(ax: Axes, m: Morph, middles: NDArray[np.float64]) -> None:
    """Ring, in each frame, the diagonal that has shrunk most."""
    factors, frames = shrinkage(m, MORE_TIMES), _centred(m.at(MORE_TIMES))
    for f in np.flatnonzero(factors.max(axis=1) > RINGED):
        x, y = frames[f, m.source.diagonals[factors[f].argmax()]].mean(axis=0)
        ring = Circle((x + middles[f], y), 0.06 * np.ptp(ax.get_ylim()), fill=False, clip_on=False, zorder=4)
        ring.set(edgecolor=draw.INK, linewidth=0.9)
        ax.add_patch(ring)


# For the notebook


def draw_rooted(T: Triangulation, root: int, ax: Axes | None = None) -> Axes:
    """Draw the dual tree hung from a root, and what the edges of one triangle with two children are called."""
    tree = rooted(T, root)
    parents, children = T.twin.ravel()[tree.base[tree.order[1:]]] // 3, tree.order[1:]
    ax = draw.draw_triangulation(T, ax, colors=np.where(np.arange(len(T.triangles)) == root, draw.PIVOT, "0.8"))
    middles = T.points[T.triangles].mean(axis=1)
    for parent, child in zip(parents, children, strict=True):
        arrow = {"arrowstyle": "-|>", "color": draw.TREE, "linewidth": 1.2, "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", middles[child], middles[parent], arrowprops=arrow, zorder=4)
    shown = next(t for t in children if np.sum(parents == t) == 2)
    a, b, c = T.points[np.roll(T.triangles[shown], -(tree.base[shown] % 3))]
    ax.plot(*np.transpose([a, b]), color=draw.INK, linewidth=2.6, solid_capstyle="round")
    ax.plot(*np.transpose([a, c, b]), "--", color=draw.INK, linewidth=1.8)
    for name, point in (("a", a), ("b", b), ("c", c)):
        away = 10 * (point - middles[shown]) / np.hypot(*(point - middles[shown]))
        _label(ax, name, complex(*point), (away[0], away[1]))
    return ax


# The cases of Figure 7


def _draw_ends(ax: Axes, source: complex, target: complex, propagates: tuple[bool, bool]) -> None:
    """The triangles at both ends, propagation edges thick, and the circles about the ends of the base."""
    for z, color, name in ((source, draw.SOURCE, "$C_1$"), (target, draw.TARGET, "$C_2$")):
        ax.add_patch(Polygon(_xy([0, 1, z]), facecolor=color, alpha=0.13, linewidth=0))
        ax.add_patch(Polygon(_xy([0, 1, z]), fill=False, edgecolor=color, linewidth=0.7))
        for end in _ends(propagates):
            ax.plot(*_xy([end, z]).T, color=color, linewidth=2.2, solid_capstyle="round")
        ax.plot(z.real, z.imag, "o", color=color, markersize=4, zorder=4)
        away = 9 * (z - 0.5 - 0.3j) / abs(z - 0.5 - 0.3j)
        _label(ax, name, z, (away.real, away.imag))
    for end in _ends(propagates):
        width = 2 * min(abs(source - end), abs(target - end))
        ax.add_patch(Arc((end, 0), width, width, theta1=0, theta2=180, color="0.6", linestyle=":"))
    ax.plot(*_xy([0, 1]).T, color=draw.INK, linewidth=1.6)
    _label(ax, "A", 0, (-5, -5))
    _label(ax, "B", 1, (5, -5))
    ax.set(xlim=(-1.3, 2.3), ylim=(-0.25, 1.8), aspect="equal")
    ax.set_axis_off()


def _draw_paths(ax: Axes, source: complex, target: complex, propagates: tuple[bool, bool]) -> None:
    """The straight path dashed, the slide path solid, and where it leaves its circle."""
    straightly, slide = (_path(path, source, target, propagates) for path in ("linear", "slide"))
    ax.plot(straightly.real, straightly.imag, "--", color="0.5", zorder=3)
    ax.plot(slide.real, slide.imag, color=draw.INK, zorder=3)
    steps = np.diff(slide)
    turns = np.abs(np.angle(steps[1:] / steps[:-1]))
    if turns.max() > SHARP:
        corner = slide[1 + turns.argmax()]
        ax.plot(corner.real, corner.imag, "o", color=draw.INK, markersize=3, zorder=4)
        _label(ax, "$C_k$", corner, (0, 8))


def _draw_lengths(ax: Axes, source: complex, target: complex, propagates: tuple[bool, bool]) -> None:
    """Lengths of the propagation edges over time, red where the straight path is shorter than at both ends."""
    times = np.linspace(0, 1, 201)
    for end in _ends(propagates):
        straightly, slide = (np.abs(_path(path, source, target, propagates) - end) for path in ("linear", "slide"))
        shorter = min(straightly[0], straightly[-1])
        ax.fill_between(times, np.minimum(straightly, shorter), shorter, color=draw.FAILURE, alpha=0.3, linewidth=0)
        ax.plot(times, straightly, "--", color="0.5", label="linear")
        ax.plot(times, slide, color=draw.INK, label="slide")
        late = slide[-1] > slide[0]
        _label(ax, "AB"[end] + "C", complex(late, slide.max()), (-8 if late else 9, 5))
    ax.set(xlim=(0, 1), xticks=[0, 1], ylim=(0.4, 2.4), yticks=[0.5, 1, 1.5, 2])
    ax.set_xlabel("t", labelpad=-6)


def _ends(propagates: tuple[bool, bool]) -> list[int]:
    """The ends of the base, 0 or 1, that a propagation edge leads to."""
    return [end for end in (0, 1) if propagates[end]]


def _path(path: Path, source: complex, target: complex, propagates: tuple[bool, bool]) -> NDArray[np.complex128]:
    """Where the third vertex is at 201 times."""
    ends = np.array([source]), np.array([target])
    return third_vertices(path, *ends, np.array([propagates]), np.ones(1), np.linspace(0, 1, 201))[0]


def _xy(points: Sequence[complex]) -> NDArray[np.float64]:
    z = np.asarray(points, dtype=np.complex128)
    return np.stack([z.real, z.imag], axis=1)


def _label(ax: Axes, text: str, z: complex, offset: tuple[float, float]) -> None:
    place = (complex(z).real, complex(z).imag)
    ax.annotate(text, place, offset, textcoords="offset points", ha="center", va="center", fontsize=8)
