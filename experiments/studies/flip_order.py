r"""The paper's second open question: is there an order of flips that finishes early?

Under the paper's matching, on 60 pairs that need flips, drawn with the seed: when has the source's flow, and the
target's, done its last flip (u, v; 0 the shape, 1 its disk), by the order of the flips?

    sequential  the paper's sequence, each flip waiting for the one before it
    partial     the same flips, each waiting only for those that touch its triangles
    greedy      no sequence: any flip that removes crossings with the other triangulation, as soon as it is possible,
                the one that removes most first
    divided     the paper's sequence cut in two: the source's flow does the first k flips, the target's undoes the rest,
                and the two meet under the same triangles; the k, and the direction, for which the later of the two
                times is least

A morph has to go as far as the smaller of u and v; divided, as far as the later of its two times.  Rule, stated before
the numbers: an order finishes earlier than the paper's where this is smaller by more than 0.01; it answers the question
if it does so on two thirds of the pairs.

**How early can any order be?**  Along the path "angle" there is a lower bound from the source alone.

*Lemma.*  Let theta_i(t) be the interior angle of the moving shape at vertex i.  Along "angle" it is the linear function
(1 - t) theta_i(0) + t theta_i(1), theta_i(1) being that of the disk, whatever flips happen on the way.
*Proof.*  On a leg every angle of every triangle changes linearly towards its value on the disk, so the sum at vertex i
does too, towards theta_i(1).  A flip in a convex quadrilateral changes no point, hence no interior angle.  After it
the next leg starts at the angle that was reached and leads to the same disk; a linear function that is started again
from one of its own values, towards the same end, is the same linear function.

*Bound.*  Let ij be a diagonal of the other triangulation, valid in the shape at time u.  The triangles on one side of
it form a disk whose corners are i, j and the m vertices strictly between them, so their angles add up to m pi.  The
whole interior angle of each vertex between is among them, and i and j have positive angles, so

    sum over the vertices between i and j of (pi - theta_v(u)) > 0:        that part of the curve turns left in all.

The left side is linear in u and known from the source and its disk.  Where it is not positive at 0, u is larger than
its root.  The bound is the largest of these roots over both sides of all diagonals.  With one vertex between, it says
that a reflex vertex has to become convex before it can be an ear.  Where the bound is positive, some diagonal is not
valid in the source itself, so that u > 0 along every path.

Writes results/flip_order.csv, a row a pair and path, and results/flip_order_summary.csv.
"""

from itertools import count
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from experiments import subjects
from experiments.store import RESULTS, compute, rng_for, write_csv
from tween import Triangulation
from tween.choices import ORDERS, Path
from tween.geometry.predicates import orient2d
from tween.morphing.alignment import align
from tween.morphing.compatible.leg import Leg, root_triangle
from tween.morphing.incompatible.flip_sequence import FlipSequence, count_crossings, crossing_counts, flip_sequence
from tween.morphing.incompatible.flow import Flow, first_convex
from tween.triangulating.flips import flip_in_place, half_edge

PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "pairs": 60,
    "paths": ["slide", "angle"],
    "earlier": 0.01,
    "resamples": 2000,
}
ROOT = "disk-center"
STEP = 1 / 512  # as in `Flow`: a shorter spell of convexity may be missed
SIXTEENTHS = np.arange(1, 17) / 16
AT_BOUND = 1e-6  # times are found to 2e-9 of a leg, and written to six digits
WAYS = ("sequential", "partial", "greedy", "divided")


def sample() -> list[str]:
    """The first 60 pairs with crossings in a random order of all pairs."""
    pairs = subjects.pairs()
    drawn = rng_for(PARAMETERS["seed"], "flip order").permutation(len(pairs)).tolist()
    with_flips = (pairs[i] for i in drawn if align(*subjects.both(pairs[i])).crossings)
    return [pair for pair, _ in zip(with_flips, range(PARAMETERS["pairs"]), strict=False)]


# The lower bound


def interior_angles(T: Triangulation, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The sum of the angles of the triangles at each vertex, with other points."""
    z = (points @ np.array([1, 1j]))[T.triangles]
    angles = np.angle((np.roll(z, 1, axis=1) - z) / (np.roll(z, -1, axis=1) - z))
    return np.asarray(np.bincount(T.triangles.ravel(), weights=angles.ravel(), minlength=len(T)), np.float64)


def lower_bound(T: Triangulation, other: Triangulation) -> float:
    """Before when no order of flips from T to the other triangulation can be done, along "angle"; 0 for no bound."""
    turns = [np.pi - interior_angles(T, points) for points in (T.points, T.on_disk().points)]
    sums = [np.concatenate([[0.0], np.cumsum(np.concatenate([turn, turn]))]) for turn in turns]
    i, j = np.sort(other.diagonals, axis=1).T
    start, end = (np.concatenate([s[j] - s[i + 1], s[i + len(T)] - s[j + 1]]) for s in sums)
    late = start < -1e-9  # a part that turns by nothing but rounding gives no bound
    return float((start[late] / (start[late] - end[late])).max(initial=0.0))


# Orders


def reversed_sequence(source: Triangulation, target: Triangulation) -> FlipSequence:
    """The flips from target to source, undone: from source to target, in the source's rows."""
    back = flip_sequence(target, source)
    triangles, twin = source.triangles.copy(), source.twin.copy()
    rows = []
    for out in back.into[::-1].tolist():
        h = half_edge(Triangulation(source.points, triangles)._knowing(twin), (out[0], out[1]))
        rows.append((h // 3, int(twin[h // 3, h % 3]) // 3))
        triangles, twin = triangles.copy(), twin.copy()
        flip_in_place(triangles, twin, h)
    return FlipSequence(np.array(rows).reshape(-1, 2), back.into[::-1], back.out[::-1])


def greedy(T: Triangulation, other: Triangulation, path: Path) -> tuple[float, int]:
    """When the flow is done that makes any flip that removes crossings, as soon as it can; and how many flips it makes.

    While two triangulations differ some flip removes crossings, and on the disk it is possible: so the flow ends.
    """
    counts, disk, end, flips = crossing_counts(other), T.on_disk().points, 0.0, 0
    while True:
        T, more = _flip_greedily(T, counts)
        flips += more
        quads = _useful(T, counts)[2]
        if not len(quads):
            assert count_crossings(T, other) == 0
            return end, flips
        leg = Leg(T, disk, path, root_triangle(ROOT, T))
        share, points = _first_possible(leg, quads, min(1.0, STEP / (1 - end)))
        end = 1.0 if share == 1 else end + share * (1 - end)
        T = T.moved(points)


def _useful(
    T: Triangulation, counts: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Half-edges whose flip removes crossings, how many, and the corners a, b, c, d around them."""
    h = T._inner_half_edges()
    g = T.twin.ravel()[h]
    a, b, c = (T.triangles[h // 3, (h + k) % 3] for k in range(3))
    d = T.triangles[g // 3, (g + 2) % 3]
    removed = counts[a, b] - counts[c, d]
    useful = removed > 0
    return h[useful], removed[useful], np.stack([a, b, c, d], axis=1)[useful]


def _flip_greedily(T: Triangulation, counts: NDArray[np.int64]) -> tuple[Triangulation, int]:
    """Flip, most crossings removed first, until no possible flip removes any; also how many flips that took."""
    triangles, twin = T.triangles.copy(), T.twin.copy()
    for flips in count():
        T = Triangulation(T.points, triangles)._knowing(twin)
        h, removed, quads = _useful(T, counts)
        a, b, c, d = np.moveaxis(T.points[quads], 1, 0)
        possible = (orient2d(d, b, c) > 0) & (orient2d(c, a, d) > 0)
        if not possible.any():
            return T, flips
        triangles, twin = triangles.copy(), twin.copy()
        flip_in_place(triangles, twin, int(h[possible][removed[possible].argmax()]))
    raise AssertionError


def _first_possible(leg: Leg, quads: NDArray[np.int64], step: float) -> tuple[float, NDArray[np.float64]]:
    """The first share of a leg at which one of the quads is strictly convex, to 2e-9, and the shape there."""
    low, first, no_room = 0.0, -1, np.zeros((len(quads), 2))
    while first < 0:
        shares = np.minimum(1.0, low + step * np.arange(1, 17))
        shapes = leg.at(shares)
        first = first_convex(shapes, quads, no_room)
        low = shares[-1] if first < 0 else low
    for _ in range(5):
        low, high = (shares[first - 1] if first else low), shares[first]
        shares = low + (high - low) * SIXTEENTHS
        shares[-1] = high
        shapes = leg.at(shares)
        first = first_convex(shapes, quads, no_room)
    return float(shares[first]), shapes[first]


def divided(S: Triangulation, T: Triangulation, path: Path) -> float:
    """The later of both flows' times where they meet, for the best cut of the best of two sequences."""
    best = 1.0
    for first, second in ((S, T), (T, S)):
        there, back = flip_sequence(first, second), reversed_sequence(second, first)
        u = [0.0, *(e.time for e in Flow(first, there, path, ROOT, "sequential").events)]
        v = [0.0, *(e.time for e in Flow(second, back, path, ROOT, "sequential").events)]
        best = min(best, float(np.maximum(u, v[::-1]).min()))
    return best


def work(pair: str) -> list[dict[str, Any]]:
    """The rows of one pair, a row a path."""
    a = align(*subjects.both(pair))
    ends = ((a.source, a.target), (a.target, a.source))
    sequences = [flip_sequence(S, T) for S, T in ends]
    rows = []
    for path in PARAMETERS["paths"]:
        row: dict[str, Any] = {"pair": pair, "path": path, "n": len(a.source), "crossings": a.crossings}
        row["flips"] = len(sequences[0])
        for letter, (S, T), sequence in zip("uv", ends, sequences, strict=True):
            row[f"{letter}_bound"] = lower_bound(S, T)
            for order in ORDERS:
                row[f"{letter}_{order}"] = Flow(S, sequence, path, ROOT, order).end
            row[f"{letter}_greedy"], row[f"{letter}_greedy_flips"] = greedy(S, T, path)
        row["divided"] = divided(*ends[0], path)
        rows.append(row)
    return rows


# Summary


def table(rows: list[dict[str, Any]]) -> pd.DataFrame:
    """The rows; times to six digits, and how far each way has to go."""
    result = pd.DataFrame(rows)
    for way in ("bound", "sequential", "partial", "greedy"):
        result[way] = result[[f"u_{way}", f"v_{way}"]].min(axis=1)
    columns = ["pair", "path", "n", "crossings", "flips", "u_greedy_flips", "v_greedy_flips"]
    times = [f"{letter}_{way}" for letter in "uv" for way in ("bound", *WAYS[:3])]
    result = result[[*columns, *times, "bound", *WAYS]]
    result[[*times, "bound", *WAYS]] = result[[*times, "bound", *WAYS]].astype(float).round(6)
    return result


def summary(rows: pd.DataFrame) -> pd.DataFrame:
    """How far each way has to go; on how many pairs it finishes earlier, or later, than the paper's.

    Along "angle" also in how many flows, two a pair, the time is the lower bound, so that no order finishes earlier.
    """
    found = []
    for path in PARAMETERS["paths"]:
        of = rows[rows.path == path]
        for way in ("bound", *WAYS):
            quartiles = of[way].quantile([0, 0.25, 0.5, 0.75, 1]).tolist()
            gain = of.sequential - of[way]
            row = dict(zip(("min", "q25", "median", "q75", "max"), quartiles, strict=True))
            low, high = median_interval(of[way].to_numpy(), f"{path} {way}")
            row |= {"median_low": low, "median_high": high, "at_once": int((of[way] == 0).sum())}
            if way != "bound":
                row |= {"earlier": int((gain > PARAMETERS["earlier"]).sum())}
                row |= {"later": int((gain < -PARAMETERS["earlier"]).sum())}
            if path == "angle" and way in WAYS[:3]:
                over = np.concatenate([of[f"{letter}_{way}"] - of[f"{letter}_bound"] for letter in "uv"])
                row |= {"flows_at_bound": int((over <= AT_BOUND).sum())}
            found.append({"path": path, "way": way, "pairs": len(of), **row})
    result = pd.DataFrame(found).round(4)
    counts = ["earlier", "later", "flows_at_bound"]
    result[counts] = result[counts].astype("Int64")
    return result


def median_interval(values: NDArray[np.float64], name: str) -> tuple[float, float]:
    """The 95 % bootstrap interval of a median."""
    rng = rng_for(PARAMETERS["seed"], f"flip order, {name}")
    medians = np.median(rng.choice(values, (PARAMETERS["resamples"], len(values))), axis=1)
    low, high = np.quantile(medians, [0.025, 0.975])
    return float(low), float(high)


def main() -> None:
    rows = [row for part in compute("flip_order", PARAMETERS, sample(), work) for row in part]
    found = table(rows)
    write_csv(RESULTS / "flip_order.csv", found)
    write_csv(RESULTS / "flip_order_summary.csv", summary(found))
    print(f"flip_order: {PARAMETERS['pairs']} pairs -> results/flip_order.csv, results/flip_order_summary.csv")


if __name__ == "__main__":
    main()
