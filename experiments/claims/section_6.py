"""Section 6: morphs between incompatible triangulations, by pivots and flips."""

import numpy as np
from numpy.typing import NDArray

from experiments.claims.ledger import CONDITION, HOLDS, Finding, Numbers, claim, most
from experiments.claims.shared import PARAMETERS, turns
from experiments.store import rng_for
from experiments.subjects import polygon
from tween import Morph, Triangulation, decompose
from tween.geometry.dual_tree import hops
from tween.morphing.incompatible.flip_sequence import crossing_counts
from tween.morphing.incompatible.pivots import spine
from tween.triangulating.flips import flip_in_place


@claim(
    "6",
    'On its way to the disk the shape "becomes more and more convex"',
    CONDITION,
    ("experiments/claims/section_6.py",),
    condition="from start to end; not from frame to frame, and late",
)
def becomes_more_convex(x: Numbers) -> Finding:
    c = x.curves
    grows, left = c.reflex_grows.sum(), c.reflex_late.sum() / c.reflex_start.sum()
    return bool(c.reflex_end.sum() == 0 and 3 * grows > len(c)), (
        f"reflex vertices: their number grows at some step on {grows} of {len(c)} curves; {left:.0%} are left at t = "
        f"{PARAMETERS['late']}, {c.reflex_end.sum()} at the end"
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
    'Pruning finds "the path between the two farthest leaf nodes", the spine',
    HOLDS,
    (
        "tests/morphing/incompatible/test_pivots.py::test_the_spine_is_what_pruning_as_printed_leaves",
        "experiments/claims/section_6.py",
    ),
)
def spine_joins_the_farthest_leaves(x: Numbers) -> Finding:
    every, longest = x.curves.spines.sum(), x.curves.spines_longest.sum()
    return every == longest, f"as long as the longest path of the dual tree in {longest:,} of {every:,} triangulations"


def spines(drawn: list[Triangulation]) -> dict[str, int]:
    """How many spines there are, and how many are as long as the longest path between leaves."""
    longest = [hops(T, int(np.argmax(hops(T, 0)))).max() + 1 for T in drawn]
    found = [len(spine(T)) for T in drawn]
    return {"spines": len(found), "spines_longest": int(np.sum(np.equal(found, longest)))}


@claim(
    "6.1 (Figure 9)",
    'Matching pivots "significantly reduces the incompatibility" and "helps significantly during the morphing process"',
    CONDITION,
    (
        "experiments/studies/pivots.py",
        "tests/morphing/test_alignment.py::test_pivots_match_and_of_the_four_pairings_none_crosses_less",
    ),
    "figure_09_pivots.png",
    "counted in crossings and flips; AR and Var hardly change",
)
def pivots_help(x: Numbers) -> Finding:
    wide = x.table("pivots").pivot(index="pair", columns="match")
    change = {m: wide[m]["pivots"] - wide[m]["as drawn"] for m in ("crossings", "flips", "AR_1e-4", "Var")}
    less, more = ({m: int((sign * d < 0).sum()) for m, d in change.items()} for sign in (1, -1))
    supported = most(less["crossings"], len(wide)) and not most(less["AR_1e-4"], len(wide))
    return supported, f"against the curves as drawn, {len(wide)} pairs: " + "; ".join(
        f"{m.replace('_', ' at ')} less on {less[m]}, more on {more[m]}" for m in change
    )


@claim(
    "6.2",
    'Flipping what crosses each target edge, sorted by crossings, "guarantees the conversion"; the flips required are '
    'at most "the number of intersections"',
    CONDITION,
    (
        "tests/morphing/incompatible/test_flip_sequence.py::test_the_flips_lead_to_the_target_and_each_removes_a_crossing",
        "experiments/studies/flip_distance.py",
        "experiments/claims/section_6.py",
    ),
    condition="each flip is one after which one edge less crosses; the paper gives no order",
)
def flips_arrive(x: Numbers) -> Finding:
    r, small = x.checks["ring"].drop(columns="kind").sum(), x.table("flip_distance")
    supported = r.in_order == r.within == r.pairs and r.once < r.pairs and bool(small.never_over_crossings.all())
    return supported, (
        f"{r.in_order} of {r.pairs} random pairs arrive so, within the crossings, as do all {small.pairs.sum():,} to "
        f"n = {small.n.max()}; {r.once} if each crossing edge is flipped just once. {r.idle} of {r.flips:,} flips "
        f"remove no crossing with the target as a whole, unless one elsewhere is allowed"
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
    'There are u and v at which each shape has the other\'s triangulation; "the minimum of u and v" decides',
    HOLDS,
    (
        "tests/morphing/incompatible/test_flow.py::test_the_way_leads_through_the_flow_that_is_done_first",
        "experiments/studies/pairs.py",
    ),
    "figure_10_flips.png",
)
def u_and_v_exist(x: Numbers) -> Finding:
    slide = x.table("pairs").query("path == 'slide'")
    both, least = slide[["u", "v"]].notna().all(axis=1).sum(), slide[["u", "v"]].min(axis=1)
    return both == len(slide) and bool(least.max() <= 1), (
        f"both exist for {both} of {len(slide)} pairs; the smaller is {least.median():.3f} in the median, "
        f"{least.max():.4f} at most, 0 for {(least == 0).sum()} pairs"
    )


@claim(
    "6.2 (2)",
    '"M(S1, S2) = M(S2, S1)": the morph is symmetric',
    CONDITION,
    (
        "tests/morphing/test_strategy.py::test_the_paper_s_morph_is_symmetric_where_it_does_not_flip",
        "experiments/studies/pairs.py",
    ),
    condition="both directions break ties, of which the paper speaks nowhere, in the same way; always without flips",
)
def symmetric(x: Numbers) -> Finding:
    pairs = x.table("pairs")
    same, free = pairs["symmetric_within_1e-9"], pairs.flips == 0
    others = pairs.asymmetry[~same]
    return bool(same[free].all() and 0 < same[~free].sum() < (~free).sum()), (
        f"{same.sum():,} of {len(same):,} morphs, to 1e-9 of the shapes' size, among them {same[free].sum()} of "
        f"{free.sum()} without flips; the others differ by {others.median():.3g} sizes in the median, "
        f"{others.max():.3g} at most"
    )
