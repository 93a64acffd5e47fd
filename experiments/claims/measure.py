"""Small measurements for the ledger of claims, where no other study has the number.

`measure` gives a table for each kind of part: every curve on its way to the disk (what swaps, remeshing, slivers,
lengths and areas do), frames of morphs that know the boundary only, flips on the way to the disk, flip sequences by
the letter of the paper, third vertices drawn at random, degree sequences, and the size of the table.  Nothing is
written; `experiments.claims` puts the numbers into sentences.

Legend: ``T`` a triangulation, ``D`` the disk; ``a b c`` corners of a triangle, ab its base; ``z = (c-a)/(b-a)``.
"""

from collections.abc import Callable
from itertools import combinations
from math import comb
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.stats import spearmanr

import tween
from experiments.baselines import edge_angle, straight
from experiments.flips import flip_graph, polygon
from experiments.store import compute, rng_for
from experiments.table1 import shape, shapes
from tween import Triangulation, area_matrix, decompose, gallery, morph, verify
from tween.geometry.dual_tree import disk_center, hops, rooted
from tween.morphing.compatible.paths import Path, slides, third_vertices
from tween.morphing.incompatible.flip_sequence import crossing_counts, flip_sequence
from tween.morphing.incompatible.flow import Flow, Order
from tween.triangulating.costs import smallest_angle
from tween.triangulating.flips import flip, flip_in_place

PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "frames": 101,
    "boundary_frames": 21,
    "draws": 40,
    "swaps": 100,
    "sliver_degrees": 5,
    "noticeable": 1.01,
    "every_pair": 20,
    "late": 0.9,
    "rings": [10, 20, 40],
    "ring_pairs": 200,
    "thirds": 100_000,
    "degrees_up_to": 9,
    "convex": [32, 64, 128],
}
_Floats = NDArray[np.float64]


def parts() -> list[str]:
    pairs = [f"{a} - {b}" for a, b in combinations(shapes(), 2)]
    return [
        *(f"curve: {name}" for name in shapes()),
        *(f"boundary: {name}" for name in (*shapes(), *gallery.pairs())),
        *(f"flow: {pair}" for pair in pairs[:: PARAMETERS["every_pair"]]),
        *(f"ring: {n}" for n in PARAMETERS["rings"]),
        *(f"degrees: {n}" for n in range(4, PARAMETERS["degrees_up_to"] + 1)),
        *(f"table: {n}" for n in PARAMETERS["convex"]),
        *(f"thirds: {spread}" for spread in ("uniform", "normal")),
    ]


def work(part: str) -> dict[str, Any]:
    kind, rest = part.split(": ")
    return {"kind": kind, "part": rest} | WORK[kind](rest)


def measure() -> dict[str, pd.DataFrame]:
    """A table for each kind of part."""
    rows = compute("claims", PARAMETERS, parts(), work)
    return {kind: pd.DataFrame([row for row in rows if row["kind"] == kind]).set_index("part") for kind in WORK}


# Every curve to its disk


def curve_to_disk(name: str) -> dict[str, Any]:
    """Everything about one curve, its triangulations and its morphs to the disk."""
    rng = rng_for(PARAMETERS["seed"], f"claims {name}")
    d = decompose(shape(name))
    T, drawn = tween.remesh(d.arbitrary()), d.sample(rng, PARAMETERS["draws"])
    D = T.on_disk()
    return {
        "n": len(T),
        "swaps_valid": swapped(drawn[0], rng),
        **remeshed_one_by_one(drawn[0]),
        **best_angle(d, T.points),
        **trees(T, drawn),
        **slivers_and_places(T, drawn, D),
        **on_the_way(T, D),
        **{f"{path}_{k}": v for path in ("linear", "slide") for k, v in lengths_and_areas(T, D, path).items()},
    }


def swapped(T: Triangulation, rng: np.random.Generator) -> int:
    """How many of a series of random valid swaps leave a valid triangulation."""
    valid = 0
    for _ in range(PARAMETERS["swaps"]):
        T = flip(T, tuple(rng.choice(T.diagonals[tween.flips.flippable(T)]).tolist()))
        valid += verify(T.points, T.triangles).valid
    return valid


def remeshed_one_by_one(T: Triangulation) -> dict[str, int]:
    """Flip what is not locally Delaunay until nothing is left; how many flips enlarge the sorted angles."""
    flips, larger, before = 0, 0, sorted_angles(T)
    while not (fine := tween.flips.locally_delaunay(T)).all():
        T = flip(T, tuple(T.diagonals[~fine][0].tolist()))
        after = sorted_angles(T)
        change = (after - before)[np.abs(after - before) > 1e-14]
        flips, larger, before = flips + 1, larger + bool(len(change) and change[0] > 0), after
    return {"flips": flips, "flips_larger": larger}


def sorted_angles(T: Triangulation) -> _Floats:
    z = (T.points @ np.array([1, 1j]))[T.triangles]
    return np.sort(np.angle((np.roll(z, 1, axis=1) - z) / (np.roll(z, -1, axis=1) - z)), axis=None)


def best_angle(d: tween.Decomposition, points: _Floats) -> dict[str, Any]:
    """Whether a remeshed triangulation has the largest smallest angle; how many triangles the table had to look at."""
    best, looked_at = largest_smallest_angle(d, points)
    remeshed = max(sorted_angles(T)[0] for T in d.immersions())
    return {"looked_at": looked_at, "smallest_angle_is_best": bool(best - remeshed < 1e-9)}


def largest_smallest_angle(d: tween.Decomposition, points: _Floats) -> tuple[float, int]:
    """The best of all triangulations, and how many triangles the table looks at to find it."""
    looked_at: list[int] = []
    cost = smallest_angle(points)

    def counted(triangles: NDArray[np.int64]) -> _Floats:
        looked_at.append(len(triangles))
        return cost(triangles)

    return float(sorted_angles(d.optimal(counted, "max"))[0]), looked_at[0]


def trees(T: Triangulation, drawn: list[Triangulation]) -> dict[str, Any]:
    """Branchings of dual trees, and how many spines are as long as the longest path between leaves."""
    branchings, *random = [int((np.bincount(S.dual.ravel()) == 3).sum()) for S in (T, *drawn)]
    longest = [hops(S, int(np.argmax(hops(S, 0)))).max() + 1 for S in (T, *drawn)]
    spines = [len(tween.spine(S)) for S in (T, *drawn)]
    return {
        "branchings": branchings,
        "branchings_random": float(np.median(random)),
        "spines": len(spines),
        "spines_longest": int(np.sum(np.equal(spines, longest))),
    }


def slivers_and_places(T: Triangulation, drawn: list[Triangulation], D: Triangulation) -> dict[str, float]:
    """Random triangulations: do slivers go with AR and Var, and is change more local than when remeshed?"""
    remeshed, values = morph(T, D), []
    for S in drawn:
        m = morph(S, S.moved(D.points))
        A = area_matrix(m)
        slivers = (np.degrees(-smallest_angle(S.points)(S.triangles)) < PARAMETERS["sliver_degrees"]).sum()
        own = tween.area_rank(A, 1e-4), tween.frame_variance(A), in_a_tenth(A), in_a_tenth(turns(m))
        values.append((slivers, *own))
    columns = np.array(values, dtype=np.float64).T
    return {
        "slivers_AR": float(spearmanr(columns[0], columns[1]).statistic),
        "slivers_Var": float(spearmanr(columns[0], columns[2]).statistic),
        "areas_tenth": in_a_tenth(area_matrix(remeshed)),
        "areas_tenth_random": float(np.median(columns[3])),
        "turns_tenth": in_a_tenth(turns(remeshed)),
        "turns_tenth_random": float(np.median(columns[4])),
    }


def turns(m: tween.Morph) -> _Floats:
    """The angle by which the curve turns at every vertex, (n, frames)."""
    z = m.frames(PARAMETERS["frames"]) @ np.array([1, 1j])
    edges = np.roll(z, -1, axis=1) - z
    return np.angle(edges / np.roll(edges, 1, axis=1)).T


def in_a_tenth(values: _Floats) -> float:
    """Share of all change from column to column that happens in the tenth of the rows that change most."""
    change = np.sort(np.abs(np.diff(values, axis=1)).sum(axis=1))
    return float(change[-max(1, round(len(change) / 10)) :].sum() / change.sum())


def on_the_way(T: Triangulation, D: Triangulation) -> dict[str, Any]:
    """How near the end the shape is to the target, reflex vertices, AR along "area", edges that fall and rise."""
    m = morph(T, D)
    reflex = (turns(m) < 0).sum(axis=0)
    corners, propagates = hung(T, D)
    a, b, c = np.moveaxis((np.stack([T.points, D.points]) @ np.array([1, 1j]))[:, corners], 2, 0)
    z1, z2 = (c - a) / (b - a)
    two, slid = propagates.all(axis=1), slides(z1, z2, propagates)
    return {
        "gap_before_end": float(np.abs(m.at([1 - 1e-9])[0] - D.points).max() / np.ptp(D.points)),
        "AR_along_area": tween.area_rank(area_matrix(morph(T, D, path="area")), 1e-9),
        "reflex_start": int(reflex[0]),
        "reflex_late": int(reflex[round(PARAMETERS["late"] * (len(reflex) - 1))]),
        "reflex_end": int(reflex[-1]),
        "reflex_grows": bool((np.diff(reflex) > 0).any()),
        "two_edges": int(two.sum()),
        "two_non_monotone": int(slid.all(axis=1).sum()),
        "non_monotone": int(slid.sum()),
    }


def hung(T: Triangulation, D: Triangulation) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Corners a, b, c of each triangle, ab its base, and whether ca and bc are propagation edges."""
    slots = (rooted(T, disk_center(T, D)).base[:, None] + np.arange(3)) % 3
    corners, across = (np.take_along_axis(values, slots, axis=1) for values in (T.triangles, T.twin))
    return corners, across[:, [2, 1]] >= 0


def lengths_and_areas(T: Triangulation, D: Triangulation, path: Path) -> dict[str, float]:
    """How propagation edges and areas keep between their two ends."""
    m = morph(T, D, path=path)
    corners, propagates = hung(T, D)
    a, b, c = np.moveaxis((m.frames(PARAMETERS["frames"]) @ np.array([1, 1j]))[:, corners], 2, 0)
    edges = np.abs(np.stack([c - a, c - b], axis=2))
    relative = edges / np.abs(b - a)[..., None]
    A = area_matrix(m, PARAMETERS["frames"])
    even = A[:, :1] + np.linspace(0, 1, A.shape[1]) * (A[:, -1:] - A[:, :1])
    above, below = beyond(edges[:, propagates])
    much = PARAMETERS["noticeable"]
    return {
        "edges": len(above),
        "relative": int((np.maximum(*beyond(relative[:, propagates])) > 1 + 1e-6).sum()),
        "outside": int((np.maximum(above, below) > much).sum()),
        "shorter": int((below > much).sum()),
        "farthest": float(np.maximum(above, below).max()),
        "shrinks": int((beyond(A.T)[1] > much).sum()),
        "uneven": float(np.abs(A - even).sum(axis=0).mean()),
    }


def beyond(x: _Floats) -> tuple[_Floats, _Floats]:
    """By what factors columns exceed the larger of their two ends, and fall below the smaller."""
    return x.max(axis=0) / np.maximum(x[0], x[-1]), np.minimum(x[0], x[-1]) / x.min(axis=0)


# Morphs that know the boundary only


def boundary_only(name: str) -> dict[str, Any]:
    """Frames that bound no disk whatever: a curve to its disk, or a pair, straight and by edges and angles."""
    T = None if name in gallery.pairs() else tween.triangulate(shape(name))
    m = morph(*gallery.pair(name)) if T is None else morph(T, T.on_disk())
    ways = {"straight": straight(m.source, m.target), "edge_angle": edge_angle(m.source, m.target), "slide": m}
    times = np.linspace(0, 1, PARAMETERS["boundary_frames"])
    return {k: sum(not bounds_disk(w(t), w.triangles_at(t)) for t in times) for k, w in ways.items()}


def bounds_disk(points: _Floats, triangles: NDArray[np.int64]) -> bool:
    """Whether a polygon bounds any immersed disk whose front is seen; the triangles are tried first."""
    if verify(points, triangles):
        return True
    try:
        d = decompose(points)
    except tween.CurveError:
        return False
    return bool(d) and not d.curves[0].reversed_input


# Flips


def flips_on_the_way(pair: str) -> dict[str, float]:
    """Share of late flips in both flows of a pair, and when the last one is done, in sequence and in partial order."""
    a = tween.align(*(shape(name) for name in pair.split(" - ")))
    orders: tuple[Order, ...] = ("sequential", "partial")
    result: dict[str, float] = {}
    for order in orders:
        for way, (S, T) in {"there": (a.source, a.target), "back": (a.target, a.source)}.items():
            flow = Flow(S, flip_sequence(S, T), "slide", "disk-center", order)
            late = np.mean([event.time > PARAMETERS["late"] for event in flow.events])
            result |= {f"{order}_{way}": float(late), f"{order}_{way}_end": flow.end}
    return result


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


# What needs no curve


def third_vertices_at_random(spread: str) -> dict[str, int]:
    """Pairs of third vertices: how many lengths a straight path shortens and lengthens, and what "slide" spares."""
    rng, size = rng_for(PARAMETERS["seed"], spread), PARAMETERS["thirds"]
    if spread == "uniform":
        z1, z2 = (rng.uniform(-3, 4, size) + 1j * rng.exponential(1, size) for _ in range(2))
    else:
        a, b, c = rng.standard_normal((3, 2, size)) + 1j * rng.standard_normal((3, 2, size))
        z1, z2 = (z.real + 1j * np.abs(z.imag) for z in (c - a) / (b - a))
    both = np.ones((size, 2), dtype=bool)
    slid = slides(z1, z2, both)
    one = slid[:, 0] & ~slid[:, 1]
    times = np.linspace(0, 1, PARAMETERS["frames"])
    z = third_vertices("slide", z1[one], z2[one], both[one], np.ones(one.sum()), times)
    steps = np.diff(np.abs(z - 1), axis=1)
    kept = (steps >= -1e-9).all(axis=1) | (steps <= 1e-9).all(axis=1)
    return {"pairs": size, "both": int(slid.all(axis=1).sum()), "one": int(one.sum()), "kept": int(kept.sum())}


def degree_sequences(size: str) -> dict[str, int]:
    """Pairs of triangulations of a polygon; where equal degrees and equal triangles disagree; mirror images."""
    n, found = int(size), flip_graph(int(size))[0]
    turned = [[np.roll(T.degrees, k).tolist() for k in range(n)] for T in found]
    degrees = np.unique([min(turns) for turns in turned], axis=0, return_inverse=True)[1]
    mirrored = [str(min(turn[::-1] for turn in turns)) for turns in turned]
    triangles = [min(T.rolled(k).canonical.tobytes() for k in range(n)) for T in found]
    same_degrees, same_triangles = (np.equal.outer(x, x) for x in (degrees.ravel(), np.array(triangles, dtype=object)))
    mirror = np.equal.outer([str(min(turns)) for turns in turned], mirrored)
    return {
        "pairs": len(found) ** 2,
        "disagree": int((same_degrees != same_triangles).sum()),
        "mirrored": int((mirror & ~same_degrees).sum()),
    }


def table_of_convex(size: str) -> dict[str, int]:
    """Triangles that the table of a convex polygon looks at."""
    points = polygon(int(size))
    return {"looked_at": largest_smallest_angle(decompose(points), points)[1], "triples": comb(int(size), 3)}


WORK: dict[str, Callable[[str], dict[str, Any]]] = {
    "curve": curve_to_disk,
    "boundary": boundary_only,
    "flow": flips_on_the_way,
    "ring": flip_rules,
    "thirds": third_vertices_at_random,
    "degrees": degree_sequences,
    "table": table_of_convex,
}
