"""Section 6: morphs between incompatible triangulations, by pivots and flips."""

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.stats import rankdata

from experiments.claims.ledger import Finding, Numbers, claim
from experiments.claims.rules import every, more, more_pairs
from experiments.claims.shared import PARAMETERS, Floats, turns
from experiments.store import rng_for
from experiments.subjects import BETWEEN, both, polygon
from tween import Morph, Triangulation, decompose, morph
from tween.geometry.dual_tree import hops
from tween.morphing.incompatible.flip_sequence import crossing_counts
from tween.morphing.incompatible.pivots import spine
from tween.triangulating.flips import flip_in_place


@claim(
    "6",
    '"We perform edge flips gradually when the shape morphs and becomes more and more convex."',
    "every",
    "a curve to its disk; the number of reflex vertices never grows from frame to frame",
    ("experiments/claims/section_6.py",),
    condition="from start to end, not from frame to frame",
)
def becomes_more_convex(x: Numbers) -> Finding:
    c = x.curves
    grows, left = c.reflex_grows.sum(), c.reflex_late.sum() / c.reflex_start.sum()
    return Finding(
        f"it grows at some step on {grows} of {len(c)} curves; {left:.0%} of all reflex vertices are left at t = "
        f"{PARAMETERS['late']}, {c.reflex_end.sum()} at the end",
        (every(len(c) - grows, len(c)),),
        (every((c.reflex_end == 0).sum(), len(c)),),
    )


def reflex_vertices(m: Morph) -> dict[str, int]:
    """Reflex vertices at the start, late and at the end of a morph, and whether their number grows at some step."""
    reflex = (turns(m) < 0).sum(axis=0)
    return {
        "reflex_start": int(reflex[0]),
        "reflex_late": int(reflex[round(PARAMETERS["late"] * (len(reflex) - 1))]),
        "reflex_end": int(reflex[-1]),
        "reflex_grows": bool((np.diff(reflex) > 0).any()),
    }


@claim(
    "6.1",
    'Pruning finds "the path between the two farthest leaf nodes of the graph", the spine',
    "every",
    "a triangulation, remeshed or random; what pruning leaves is as long as the longest path of the dual tree",
    (
        "tests/morphing/incompatible/test_pivots.py::test_the_spine_is_what_pruning_as_printed_leaves",
        "experiments/claims/section_6.py",
    ),
)
def spine_joins_the_farthest_leaves(x: Numbers) -> Finding:
    drawn, longest = x.curves.spines.sum(), x.curves.spines_longest.sum()
    return Finding(f"{longest:,} of {drawn:,} triangulations", (every(longest, drawn),))


def spines(drawn: list[Triangulation]) -> dict[str, int]:
    """How many spines there are, and how many are as long as the longest path between leaves."""
    longest = [hops(T, int(np.argmax(hops(T, 0)))).max() + 1 for T in drawn]
    found = [len(spine(T)) for T in drawn]
    return {"spines": len(found), "spines_longest": int(np.sum(np.equal(found, longest)))}


@claim(
    "6.1",
    '"The triangles corresponding to the leaf nodes of the dual graph represents visually important features of the '
    'shape"',
    "more",
    "a curve; where the leaves of the remeshed triangulation have their third vertices, the outline bends more within "
    "5 % of its length than at its other vertices, on the average",
    ("experiments/claims/section_6.py",),
    figure="figure_09_pivots.png",
)
def leaves_are_features(x: Numbers) -> Finding:
    place, random = x.curves.leaf_place, x.curves.leaf_place_random
    return Finding(
        f"on {(place > 0.5).sum()} of {len(place)} curves; among all vertices of a curve, 1 the sharpest, leaves lie "
        f"at {place.median():.2f} in the median, leaves of random triangulations at {random.median():.2f}",
        (more((place > 0.5).sum(), (place < 0.5).sum()),),
    )


def leaves(T: Triangulation, drawn: list[Triangulation]) -> dict[str, float]:
    """Where leaves' third vertices lie among all vertices by how the outline bends about them; 0 flattest, 1 "
    "sharpest."""
    bends = bending(T.points, PARAMETERS["feature"])
    order = (rankdata(bends) - 0.5) / len(bends)
    places = [float(order[leaf_vertices(S)].mean()) for S in (T, *drawn)]
    return {"leaf_place": places[0], "leaf_place_random": float(np.median(places[1:]))}


def leaf_vertices(T: Triangulation) -> NDArray[np.int64]:
    """The vertices that only one triangle has."""
    return np.flatnonzero(T.degrees == 2)


def bending(points: Floats, share: float) -> Floats:
    """By what angle the outline turns left within a share of its length about each vertex."""
    edges = (np.roll(points, -1, axis=0) - points) @ np.array([1, 1j])
    turn = np.angle(edges / np.roll(edges, 1))
    along = np.cumsum(np.abs(edges)) - np.abs(edges)
    apart = np.abs(along[:, None] - along) / np.abs(edges).sum()
    return np.asarray((np.minimum(apart, 1 - apart) <= share / 2) @ turn)


PIVOTS = "a pair of curves; against the best of four random renumberings, and the mean of the four pairings of pivots: "
PIVOT_EVIDENCE = (
    "experiments/studies/pivots.py",
    "tests/morphing/test_alignment.py::test_pivots_match_and_of_the_four_pairings_none_crosses_less",
)


def against_pivots(x: Numbers, measure: str) -> dict[str, pd.Series]:
    """By how much matched pivots are less than other ways to match, a row a pair of curves."""
    table = x.table("pivots")
    ends = table.pair.where(table.pair.str.contains(BETWEEN), table.pair + f" 1{BETWEEN}" + table.pair + " 2")
    table[["source", "target"]] = ends.str.split(BETWEEN, expand=True).to_numpy()
    wide = table.pivot(index=["source", "target"], columns="match", values=measure)
    return {match: wide[match] - wide["pivots"] for match in wide if match != "pivots"}


def told(x: Numbers, measure: str) -> str:
    """On how many pairs matched pivots have less, and more."""
    others = ("four random, best", "four pairings, mean", "as drawn", "fewest crossings")
    change = against_pivots(x, measure)
    counts = ", ".join(f"{(change[o] > 0).sum()} and {(change[o] < 0).sum()} ({o})" for o in others)
    return f"{measure.replace('_', ' ')} less and more on {counts}"


@claim(
    "6.1 (3, Figure 9)",
    '"This significantly reduces the incompatibility in the triangulation"',
    "more",
    PIVOTS + "fewer flips",
    PIVOT_EVIDENCE,
    figure="figure_09_pivots.png",
)
def pivots_help(x: Numbers) -> Finding:
    flips = against_pivots(x, "flips")
    parts = ("four random, best", "four pairings, mean")
    return Finding(
        f"of {len(flips['as drawn'])} pairs: {told(x, 'flips')}; {told(x, 'crossings')}, by which the pairing is "
        f"chosen",
        tuple(more_pairs(flips[part], part) for part in parts),
    )


@claim(
    "6.1 (6)",
    '"Pivot triangles capture in some sense, the semantics of the shape and hence has proved critical for morphing." '
    '"This alignment of features improve the quality of the morph."',
    "more",
    PIVOTS + "smaller AR (1e-4), and smaller Var",
    PIVOT_EVIDENCE,
    figure="figure_09_pivots.png",
)
def pivots_are_critical(x: Numbers) -> Finding:
    change = {word: against_pivots(x, measure) for word, measure in (("AR", "AR_1e-4"), ("Var", "Var"))}
    parts = ("four random, best", "four pairings, mean")
    return Finding(
        f"of {len(change['Var']['as drawn'])} pairs: {told(x, 'AR_1e-4')}; {told(x, 'Var')}",
        tuple(more_pairs(change[word][part], f"{word}, {part}") for word in change for part in parts),
    )


@claim(
    "6.2",
    '"Then, for each edge in this sorted sequence, we flip all the edges in the source triangulation that intersect '
    'it", which "guarantees the conversion of one triangulation to another"',
    "every",
    "a random pair of triangulations of a polygon; each crossing edge flipped once, the target is reached",
    (
        "tests/morphing/incompatible/test_flip_sequence.py::test_the_flips_lead_to_the_target_and_each_removes_a_crossing",
        "experiments/studies/flip_distance.py",
        "experiments/claims/section_6.py",
    ),
    condition="each flip is one after which one edge less crosses; the paper gives no order",
)
def flips_arrive(x: Numbers) -> Finding:
    r, small = x.checks["ring"].drop(columns="kind").sum(), x.table("flip_distance")
    return Finding(
        f"{r.once} of {r.pairs} pairs arrive if each crossing edge is flipped just once, {r.in_order} in an order "
        f"that makes one edge less cross each time, as do all {small.pairs.sum():,} pairs to n = {small.n.max()}. "
        f"{r.idle} of {r.flips:,} flips remove no crossing with the target as a whole, unless one elsewhere is allowed",
        (every(r.once, r.pairs),),
        (every(r.in_order, r.pairs),),
    )


@claim(
    "6.2",
    '"As [11] has shown, the upper bound of the number of such edge flips required is the number of intersections '
    'between the edges of the source and target triangulations."',
    "every",
    "a pair of triangulations of a polygon; a sequence of flips is no longer than the crossings",
    ("experiments/studies/flip_distance.py", "experiments/claims/section_6.py"),
)
def flips_within_crossings(x: Numbers) -> Finding:
    r, small = x.checks["ring"].drop(columns="kind").sum(), x.table("flip_distance")
    within = small.pairs[small.never_over_crossings].sum()
    last = small.iloc[-1]
    return Finding(
        f"{r.within} of {r.pairs} random pairs to n = {x.checks['ring'].index[-1]}, {within:,} of "
        f"{small.pairs.sum():,}, which are all, to n = {last.n}; there the mean is {last.crossings_mean:.2f} "
        f"crossings, {last.sequence_mean:.2f} flips, {last.distance_mean:.2f} at least",
        (every(r.within + within, r.pairs + small.pairs.sum()),),
    )


def flip_rules(size: str) -> dict[str, int]:
    """The paper's rule on random pairs of triangulations of a polygon: by its letter, and in an order that works."""
    d = decompose(polygon(int(size)))
    first, second = (d.sample(rng_for(PARAMETERS["seed"], f"ring {size} {i}"), PARAMETERS["ring_pairs"]) for i in "ab")
    rows = []
    for S, T in zip(first, second, strict=True):
        once, (found, flips, idle) = inserted_once(S, T), inserted_in_order(S, T)
        within = flips <= crossing_counts(T)[tuple(S.diagonals.T)].sum()
        arrive = [np.array_equal(U.canonical, T.canonical) for U in (once, found)]
        rows.append((1, *arrive, within, flips, idle))
    totals = np.sum(rows, axis=0).tolist()
    return dict(zip(("pairs", "once", "in_order", "within", "flips", "idle"), totals, strict=True))


def by_crossings(S: Triangulation, T: Triangulation) -> list[tuple[int, int]]:
    """The target's diagonals, fewest crossings with the source first, ties by their ends."""
    counts = crossing_counts(S)
    return sorted(map(tuple, np.sort(T.diagonals, axis=1).tolist()), key=lambda pq: (counts[pq], pq))


def around(triangles: NDArray[np.int64], twin: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """A half-edge of every diagonal ab, and the corners a, b, c, d around it; its flip leads to cd."""
    h = np.flatnonzero(twin.ravel() > np.arange(twin.size))
    (t, s), (u, r) = np.divmod(h, 3), np.divmod(twin.ravel()[h], 3)
    return h, np.stack([*(triangles[t, (s + i) % 3] for i in range(3)), triangles[u, (r + 2) % 3]], axis=1)


def cross(p: int, q: int, ends: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Which chords, (k, 2), cross the chord pq, p < q."""
    return np.asarray(((ends > p) & (ends < q)).any(axis=1) & ((ends < p) | (ends > q)).any(axis=1))


def inserted_once(S: Triangulation, T: Triangulation) -> Triangulation:
    """By the letter: flip every edge that crosses a diagonal just once, in the order of the list."""
    triangles, twin = S.triangles.copy(), S.twin.copy()
    for p, q in by_crossings(S, T):
        corners = around(triangles, twin)[1]
        for edge in np.sort(corners[cross(p, q, corners[:, :2]), :2], axis=1):
            h, corners = around(triangles, twin)
            flip_in_place(triangles, twin, h[(np.sort(corners[:, :2], axis=1) == edge).all(axis=1)][0])
    return Triangulation(S.points, triangles)


def inserted_in_order(S: Triangulation, T: Triangulation) -> tuple[Triangulation, int, int]:
    """Flip always so that one edge less crosses the diagonal; how many flips, how many of them remove no crossing.

    Of these flips the one that removes most crossings with the whole target is taken.
    """
    triangles, twin = S.triangles.copy(), S.twin.copy()
    flips, idle, counts = 0, 0, crossing_counts(T)
    for p, q in by_crossings(S, T):
        while True:
            h, corners = around(triangles, twin)
            useful = cross(p, q, corners[:, :2]) & ~cross(p, q, corners[:, 2:])
            if not useful.any():
                break
            a, b, c, d = corners[useful].T
            gains = counts[a, b] - counts[c, d]
            flip_in_place(triangles, twin, h[useful][np.argmax(gains)])
            flips, idle = flips + 1, idle + int(gains.max() <= 0)
    return Triangulation(S.points, triangles), flips, idle


@claim(
    "6.2",
    '"Once the triangulation of T_2 is reached on S_1(u), for some u \\leq 1 [...]" "A similar value for v can be '
    'found at which S_2(v) allows T_1, the triangulation of S_1."',
    "every",
    "a pair of curves; u and v exist, and are 1 at most",
    (
        "tests/morphing/incompatible/test_flow.py::test_the_way_leads_through_the_flow_that_is_done_first",
        "experiments/studies/pairs.py",
    ),
    figure="figure_10_flips.png",
)
def u_and_v_exist(x: Numbers) -> Finding:
    slide = x.table("pairs").query("path == 'slide'")
    both, least = (slide[["u", "v"]] <= 1).all(axis=1).sum(), slide[["u", "v"]].min(axis=1)
    return Finding(
        f"both exist for {both} of {len(slide)} pairs; the smaller is {least.median():.3f} in the median, "
        f"{least.max():.4f} at most, 0 for {(least == 0).sum()} pairs",
        (every(both, len(slide)),),
    )


@claim(
    "6.2 (2)",
    '"Ideally, we would like the morphing function to be symmetric." "So we compute both u and v and choose the '
    'minimum of u and v."',
    "every",
    "a pair of curves and a path; M(S1, S2) as printed is M(S2, S1) backwards, to 1e-9 of the shapes' size",
    (
        "tests/morphing/test_strategy.py::test_the_paper_s_morph_is_symmetric_where_it_does_not_flip",
        "experiments/studies/pairs.py",
        "experiments/claims/section_6.py",
    ),
    condition="both directions break ties, of which the paper speaks nowhere, in the same way, as `tween.morph` does, "
    "which first decides which shape comes first",
)
def symmetric(x: Numbers) -> Finding:
    pairs, ordered = x.table("pairs"), x.checks["flow"].asymmetry
    same = pairs["symmetric_within_1e-9"]
    others = pairs.asymmetry[~same]
    return Finding(
        f"{same.sum():,} of {len(same):,} morphs as printed; the others differ by {others.median():.3g} sizes in the "
        f"median, {others.max():.3g} at most. With ties broken in the same way {(ordered <= 1e-9).sum()} of "
        f"{len(ordered)} pairs, a sample",
        (every(same.sum(), len(same)),),
        (every((ordered <= 1e-9).sum(), len(ordered)),),
    )


def asymmetry(pair: str) -> float:
    """How far `tween.morph` by the paper's strategy is from its own reverse, in sizes of the shapes."""
    source, target = both(pair)
    m, back = (
        morph(*ends, strategy="paper", path="slide", guarantee=False) for ends in ((source, target), (target, source))
    )
    shapes, returned = m.frames(PARAMETERS["boundary_frames"]), back.frames(PARAMETERS["boundary_frames"])[::-1]
    start = int(np.argmin(np.abs(returned[0] - shapes[0, 0]).sum(axis=1)))
    return float(np.abs(np.roll(returned, -start, axis=1) - shapes).max() / np.ptp(shapes[0], axis=0).max())
