"""Figures 9 and 10: pivots and flips."""

from functools import cache
from itertools import pairwise
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure, SubFigure
from numpy.typing import NDArray

from experiments.figures.registry import WIDTH, drawing
from experiments.figures.rows import SHAPES, bands, draw_row, fit, write_above
from tween import Triangulation, gallery, paper_morph
from tween import plot as draw
from tween.morphing.alignment import align
from tween.morphing.incompatible.flip_sequence import flip_sequence
from tween.morphing.incompatible.flow import Flow
from tween.triangulating.flips import flip

PAIR = "arrow_to_horseshoe"
FLIPPED = ("lobes_to_spiral", "ell_to_two_loops", PAIR, "comb_to_winding")
LATE = 0.95  # of a flow: from here on the shape is called near its disk


class State(NamedTuple):
    """A shape of a flow at a time at which there are flips: before them, and after them."""

    time: float
    before: Triangulation
    after: Triangulation
    flips: int


class Moment(NamedTuple):
    """What a panel shows: a state, and how many flips there were since the panel before."""

    state: State
    flips: int


@cache
def flow(name: str, end: int) -> Flow:
    """The flow of the source (0) or of the target (1) of a pair to its disk, until it has the other's triangles."""
    alignment = align(*gallery.pair(name))
    shapes = (alignment.source, alignment.target)
    mine, other = shapes[end], shapes[1 - end]
    return Flow(mine, flip_sequence(mine, other), "slide", "disk-center", "sequential")


def flip_times(name: str, end: int) -> NDArray[np.float64]:
    """When the flips of a flow happen, from 0, the shape, to 1, its disk."""
    return np.array([event.time for event in flow(name, end).events])


def states(f: Flow) -> list[State]:
    """The shapes at which a flow flips, in order."""
    after = [*(piece.leg.source for piece in f.pieces), f.final]
    counts = np.bincount([stage for _, stage in f.events_by_stage()], minlength=len(after))
    times = [0.0] * len(after)
    for event, stage in f.events_by_stage():
        times[stage] = event.time
    before = [f.start, *(T.moved(later.points) for T, later in pairwise(after))]
    return [State(*row) for row in zip(times, before, after, counts.tolist(), strict=True)]


def panels(f: Flow, count: int = 5) -> list[Moment]:
    """The moments with most flips and the last one, in order; other flips count to the next of them."""
    all_states = states(f)
    kept = sorted({*np.argsort([-s.flips for s in all_states], kind="stable")[: count - 1], len(all_states) - 1})
    starts = [0, *(k + 1 for k in kept[:-1])]
    return [
        Moment(all_states[k], sum(s.flips for s in all_states[a : k + 1])) for a, k in zip(starts, kept, strict=True)
    ]


def pairs_of(edges: NDArray[np.int64]) -> set[tuple[int, ...]]:
    return set(map(tuple, np.sort(edges, axis=1).tolist()))


def draw_diagonals(ax: Axes, T: Triangulation, known: Triangulation, width: float = 0.5) -> None:
    """Draw a shape on the way: triangles that `known` lacks shaded, diagonals coloured by whose they are."""
    old = pairs_of(known.triangles)
    shade = ["0.95" if tuple(sorted(corners)) in old else "0.8" for corners in T.triangles.tolist()]
    ax.add_collection(PolyCollection(list(T.points[T.triangles]), facecolors=shade, linewidths=0, antialiaseds=False))
    first, second = (pairs_of(flow(PAIR, end).start.diagonals) for end in (0, 1))
    colors = {(True, False): draw.SOURCE, (False, True): draw.TARGET, (True, True): draw.EDGE, (False, False): draw.INK}
    edges = sorted(pairs_of(T.diagonals))
    marks = [colors[edge in first, edge in second] for edge in edges]
    ax.add_collection(LineCollection(list(T.points[np.array(edges)]), colors=marks, linewidths=width))
    ax.plot(*T.points[[*range(len(T)), 0]].T, color=draw.INK, linewidth=1.0)


@drawing(
    "figure_09_pivots",
    "Figure 9",
    """The same two curves with matched pivots (below) and with a correspondence a quarter of the vertices away from
    that (above). The dot is the source's pivot, at the end of the L: matched, it becomes an end of the ribbon,
    otherwise a place in its middle.  Times are even, scales beside them.  A colour is a place along the source; it
    stays with the vertices.  The paper's curves are unpublished; ours are stand-ins.""",
)
def figure_9() -> Figure:
    """The same two curves with and without matched pivots."""
    a, b = gallery.pair("ell_to_two_loops")
    matched = paper_morph(a, b)
    away = paper_morph(a, b, shifts=matched.alignment.shift + len(matched.source) // 4)
    figure = plt.figure(figsize=(WIDTH, 3.0))
    labels = ("A quarter of the vertices away", "Pivots matched")
    for part, m, label in zip(bands(figure, [1, 1]), (away, matched), labels, strict=True):
        draw_row(part.subplots(1, SHAPES), m, dots=range(SHAPES), mark=matched.alignment.pivot)
        write_above(part, f"{label}: {m.alignment.crossings} crossings, {len(m.events)} flips")
    return figure


@drawing(
    "figure_10_flips",
    "Figure 10",
    """Both shapes of a pair flow to their disks.  A diagonal is blue if the source's triangulation has it, orange if
    the target's has it, grey if both have it, black if neither: so the blue shape turns orange, and the orange one
    blue.  Shaded: triangles that are new since the panel before.  The paper's curves and times are unpublished; ours
    are stand-ins.""",
)
def figure_10() -> Figure:
    """Both flows of a pair."""
    figure = plt.figure(figsize=(WIDTH, 4.5))
    parts = bands(figure, [1, 1])
    u, v = (flow(PAIR, end).end for end in (0, 1))
    first = int(v <= u)  # the flow that is done first: the morph goes through its end
    for end, time in enumerate((u, v)):
        turns = ", where the morph turns to the other shape" if end == first else ""
        draw_flow(parts[end], end, f"{'uv'[end]} = {time:.3f}{turns}")
    return figure


@drawing(
    "figure_10_timeline",
    "Figure 10, continued",
    """When flips happen.  Above: the moment at which most flips of the arrow happen, colours as in Figure 10; the
    outlined quadrilateral becomes convex, and all others had been waiting for its flip; what they change is shaded
    beforehand too.  Below: the share of its flips that each flow has done, for the four pairs of Figure 11 that need
    flips; the last twentieth of the flow is shaded.  The paper's curves and times are unpublished; ours are
    stand-ins.""",
)
def figure_10_timeline() -> Figure:
    """The largest cascade of one flow, and when the flips of all four pairs happen."""
    figure = plt.figure(figsize=(WIDTH, 4.6))
    cascade, timeline = bands(figure, [2.5, 2.1])
    draw_cascade(cascade)
    draw_timeline(timeline)
    return figure


def draw_flow(part: SubFigure, end: int, finish: str) -> None:
    """The moments of one flow side by side, the shape before all flips first."""
    f, letter, shape = flow(PAIR, end), "uv"[end], PAIR.split("_to_")[end]
    known, shown = f.start, panels(f)
    axes = part.subplots(1, 1 + max(len(panels(flow(PAIR, other))) for other in (0, 1)))
    for ax in axes[1 + len(shown) :]:
        ax.set_axis_off()
    draw_diagonals(axes[0], f.start, f.start)
    axes[0].set_title(f"{letter} = 0\nbefore all flips", fontsize=8)
    for ax, (state, flips) in zip(axes[1:], shown, strict=False):
        draw_diagonals(ax, state.after, known)
        ax.set_title(f"{letter} = {state.time:.3f}\n{flips} flips", fontsize=8)
        known = state.after
    for ax, T in zip(axes, (f.start, *(moment.state.after for moment in shown)), strict=False):
        fit(ax, T.points)
    write_above(part, f"The {shape} flows to its disk: {len(f.events)} flips, the last at {finish}")


def draw_cascade(part: SubFigure) -> None:
    """The moment of most flips, larger: before them, after some of them, after all of them."""
    f = flow(PAIR, 0)
    stage, state = max(enumerate(states(f)), key=lambda numbered: numbered[1].flips)
    flips = [event for event, at in f.events_by_stage() if at == stage]
    some = state.before
    for event in flips[: len(flips) // 2]:
        some = flip(some, event.out)
    axes = part.subplots(1, 3)
    labels = ("before", f"after {len(flips) // 2} flips", f"after {len(flips)} flips")
    shapes = (state.before, some, state.after)
    for ax, T, known, label in zip(axes, shapes, (state.after, state.before, some), labels, strict=True):
        draw_diagonals(ax, T, known, width=0.7)
        ax.set(aspect="equal", title=label)
        ax.title.set_size(8)
        ax.margins(0.02)
        ax.set_axis_off()
    # In a triangulated disk the corners of a quadrilateral follow each other as their numbers do.
    rows = [row for row in state.before.triangles.tolist() if set(flips[0].out) <= set(row)]
    corners = sorted({vertex for row in rows for vertex in row})
    axes[0].plot(*state.before.points[[*corners, corners[0]]].T, color=draw.INK, linewidth=1.6)
    write_above(
        part, f"At u = {state.time:.3f} one quadrilateral becomes convex, and {len(flips)} flips happen in turn"
    )


def draw_timeline(part: SubFigure) -> None:
    """How many of its flips each flow has done, by time."""
    ax = part.subplots()
    ax.axvspan(LATE, 1, color="0.92", linewidth=0)
    times = {(name, end): flip_times(name, end) for name in FLIPPED for end in (0, 1)}
    for (name, end), own in times.items():
        share = np.arange(len(own) + 1) / len(own)
        color, width = (draw.SOURCE, draw.TARGET)[end], 2.2 if name == PAIR else 0.8
        label = PAIR.split("_to_")[end] if name == PAIR else ("other sources", "other targets")[end]
        ax.step([0, *own, 1], [0, *share[1:], 1], where="post", label=label, color=color, linewidth=width)
    ax.set(xlim=(-0.01, 1.005), ylim=(0, 1.02), xlabel="time of the flow, from the shape (0) to its disk (1)")
    ax.set_ylabel("share of flips done")
    handles = dict(zip(*ax.get_legend_handles_labels()[::-1], strict=True))
    ax.legend(handles.values(), handles, loc="upper left", bbox_to_anchor=(0.02, 1), ncols=2)
    flips = np.concatenate(list(times.values()))
    once, late = (flips == 0).mean(), (flips > LATE).mean()
    write_above(part, f"{len(flips)} flips in both flows of four pairs: {once:.0%} at once, {late:.0%} after {LATE}")
