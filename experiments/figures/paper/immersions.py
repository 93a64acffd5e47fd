"""Figures 1, 2, 3 and 5: immersions of a disk and their triangulations."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle
from numpy.typing import NDArray

from experiments.figures.registry import SEED, drawing
from experiments.store import rng_for
from tween import Curve, Triangulation, compatible_shift, decompose, gallery, paper_morph, triangulate
from tween import plot as draw
from tween.triangulating.flips import flip, locally_delaunay

_Floats = NDArray[np.float64]

TEN = [(0, 0), (7, -3), (-13, -12), (10, -15), (13, 0), (9, 9), (-7, 8), (-16, 0), (-9, -16), (3, -10)]
"""A self-overlapping curve of ten vertices: it winds around a hole, and its two ends lie over each other."""

STRETCHING = (0, 0.3, 0.6, 0.85, 1)
TWISTING = (0, 0.45, 0.65, 0.85, 1)


@drawing(
    "figure_01_stretched_twisted",
    "Figure 1",
    """A disk, blue on its front and red on its back.  Above, as in the paper but with a curve of ours, it is stretched
    until it overlaps itself, and only its front is ever seen: its boundary, on the right, is a self-overlapping curve.
    Below, which the paper does not draw, its right half is turned over: the back shows, and the boundary is no such
    curve.""",
)
def figure_1() -> Figure:
    """A disk stretched and overlapped, and one that is twisted."""
    T = triangulate(gallery.curve("horseshoe"))
    m = paper_morph(T.on_disk(), T)
    rows = [[[(m(t), draw.SOURCE)] for t in STRETCHING], [_sides(t) for t in TWISTING]]
    boundaries = (T.points, _turned_over(1)[:-1])
    figure, axes = plt.subplots(2, 6, figsize=(7.2, 2.7))
    for row, shapes, boundary, word in zip(axes, rows, boundaries, ("stretched", "twisted"), strict=True):
        for ax, shape in zip(row, shapes, strict=False):
            for points, color in shape:
                draw.draw_shape(points, ax, color)
        row[-1].plot(*np.append(boundary, boundary[:1], axis=0).T, color=draw.INK)
        row[-1].set_axis_off()
        row[-1].set_aspect("equal")
        row[0].set_title(word, loc="left")
        row[-1].set_title(f"turning\nnumber {Curve(boundary).turning_number}", fontsize=8)
    return figure


def _turned_over(t: float) -> _Floats:
    """A closed disk whose cross-sections turn over from left to right, in the end by half a turn."""
    angle = np.linspace(-np.pi, np.pi, 121)
    x = np.cos(angle)
    return np.stack([x, np.sin(angle) * np.cos(t * np.pi * (x + 1) / 2)], axis=1)


def _sides(t: float) -> list[tuple[_Floats, str]]:
    """The part of the turned disk that shows its front, and the part that shows its back."""
    p = _turned_over(t)[:-1]
    edge = 1 / t - 1 if t > 0 else np.inf  # the cross-section that is seen edge on
    if edge >= 1:
        return [(p, draw.SOURCE)]
    front, back = p[p[:, 0] < edge - 1e-9], p[p[:, 0] > edge + 1e-9]
    front = np.insert(front, (len(front) + 1) // 2, (edge, 0), axis=0)
    return [(front, draw.SOURCE), (np.insert(back, 0, (edge, 0), axis=0), draw.FAILURE)]


@drawing(
    "figure_02_compatible",
    "Figure 2",
    """Left and centre: compatible triangulations of a disk and of a self-overlapping curve.  As in the paper, vertex i
    on the left is vertex (i + 8) mod 10 + 1 in the centre; triangles that correspond have one colour.  Right: another
    triangulation of that curve, compatible with neither, for vertex 1 has degree 5, and no vertex has in the others.
    The shapes are ours.""",
)
def figure_2() -> Figure:
    """Two compatible triangulations of ten vertices, and one that is compatible with neither."""
    wanted = {"centre": (4, 6, 2, 3, 3, 3, 4, 4, 2, 3), "right": (5, 4, 2, 3, 4, 3, 4, 3, 2, 4)}
    found = {tuple(T.degrees.tolist()): T for T in decompose(TEN).sample(rng_for(SEED, "figure 2"), 1000)}
    centre, right = (found[wanted[place]] for place in ("centre", "right"))
    left = centre.rolled(-1)
    left = left.moved(_ring(10))
    assert compatible_shift(left, centre) == 9 and compatible_shift(left, right) is None
    figure, axes = plt.subplots(1, 3, figsize=(7.2, 2.6))
    for ax, T, title in zip(axes, (left, centre, right), ("a disk", "compatible", "incompatible"), strict=True):
        draw.draw_triangulation(T, ax, colors="0.7" if T is right else draw.identity_colors(left), alpha=0.45)
        _number(T, ax, 5)
        ax.set_title(title)
        ax.set_anchor("N")
    return figure


def _ring(n: int) -> _Floats:
    """Vertices of a regular polygon, the first at the top."""
    angle = np.pi / 2 + 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _number(T: Triangulation, ax: Axes, marked: int) -> None:
    """Write the vertices' numbers, from 1 as in the paper, and mark those of one degree."""
    for i, ((x, y), degree) in enumerate(zip(T.points, T.degrees, strict=True), 1):
        color = draw.FAILURE if degree == marked else draw.INK
        ax.scatter(x, y, s=75, facecolors="white", edgecolors=color, linewidths=0.8, zorder=4)
        ax.text(x, y, str(i), color=color, fontsize=6.5, ha="center", va="center_baseline", zorder=5)


@drawing(
    "figure_03_dual_graphs",
    "Figure 3",
    """Dual trees of two self-overlapping curves of ours, and their simplifications: rings are leaves, dots are
    branchings, and the paths between them are smoothed.  On the left of a triangulation drawn at random, on the right
    of the remeshed one, whose tree shows how the disk was deformed.""",
)
def figure_3() -> Figure:
    """Dual graphs and their simplifications: an arbitrary triangulation and the remeshed one."""
    figure, axes = plt.subplots(2, 4, figsize=(7.2, 3.6))
    for row, name in zip(axes, ("pretzel", "three_lobes"), strict=True):
        curve = gallery.curve(name)
        random = decompose(curve).sample(rng_for(SEED, "figure 3"))
        for pair, T, label in zip(row.reshape(2, 2), (random, triangulate(curve)), ("random", "remeshed"), strict=True):
            draw.draw_triangulation(T, pair[0], colors="0.85", alpha=0.6)
            draw.draw_dual_tree(T, pair[0])
            draw.draw_dual_tree(T, pair[1], simplified=True)
            pair[1].set(xlim=pair[0].get_xlim(), ylim=pair[0].get_ylim())
            pair[0].set_title(label if name == "pretzel" else "")
            pair[1].set_title(f"{np.sum(np.bincount(T.dual.ravel()) == 1)} leaves")
    return figure


@drawing(
    "figure_05_flip",
    "Figure 5",
    """Left: the angles that face the common edge add up to less than 180 degrees, and neither circumcircle holds the
    fourth vertex.  Centre: they add up to more, and each circle holds it.  Right: the same four vertices with the edge
    flipped.""",
)
def figure_5() -> Figure:
    """The Delaunay condition: held, broken, and mended by a flip."""
    halves = [(0, 1, 2), (0, 2, 3)]
    left = Triangulation([(0.3, -0.9), (1.5, 0.5), (-0.2, 1), (-1.3, -0.3)], halves)
    centre = Triangulation([(-1.3, 0), (0.25, -1.05), (1.3, 0.1), (-0.25, 1.1)], halves)
    figure, axes = plt.subplots(1, 3, figsize=(7.2, 2.5), sharex=True, sharey=True)
    words = ("Delaunay", "not Delaunay", "flipped")
    for ax, T, word in zip(axes, (left, centre, flip(centre, (0, 2))), words, strict=True):
        good = bool(locally_delaunay(T)[0])
        color = draw.INK if good else draw.FAILURE
        draw.draw_triangulation(T, ax, colors="0.85", alpha=0.6)
        ax.plot(*T.points[T.diagonals[0]].T, color=color, linewidth=1.6, solid_capstyle="butt")
        total = sum(_face(T, t, ax, name, good) for t, name in enumerate("αδ"))
        ax.set_title(f"{word}: α + δ = {total:.0f}°", color=color)
    axes[0].set(xlim=(-1.75, 1.75), ylim=(-1.62, 1.62))
    return figure


def _face(T: Triangulation, t: int, ax: Axes, name: str, good: bool) -> float:
    """Draw a triangle's circumcircle and name the angle that faces the diagonal; returns the angle in degrees."""
    z = T.points[T.triangles[t]] @ np.array([1, 1j])
    z = np.roll(z, -int(np.flatnonzero(T.twin[t] >= 0)[0]) - 2)  # the corner that faces the diagonal comes first
    u, v = z[1:] - z[0]
    centre = z[0] + (abs(u) ** 2 * v - abs(v) ** 2 * u) * -1j / (2 * (u.conjugate() * v).imag)
    radius, color = abs(z[0] - centre), "0.6" if good else draw.FAILURE
    ax.add_patch(Circle((centre.real, centre.imag), radius, fill=False, edgecolor=color, linewidth=0.8, linestyle="--"))
    start, stop = np.degrees(np.angle([u, v]))
    ax.add_patch(Arc((z[0].real, z[0].imag), 0.5, 0.5, theta1=start, theta2=stop, edgecolor=draw.INK, linewidth=0.8))
    place = z[0] + 0.4 * (u / abs(u) + v / abs(v)) / abs(u / abs(u) + v / abs(v))
    ax.text(place.real, place.imag, name, ha="center", va="center")
    return float((stop - start) % 360)
