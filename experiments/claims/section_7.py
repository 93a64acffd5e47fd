"""Sections 7 and 8: what Table 1 says, where the motion starts, and when the flips happen."""

import numpy as np
import pandas as pd

from experiments.claims.ledger import QUESTION, Finding, Numbers, claim
from experiments.claims.rules import every, more, more_pairs, some
from experiments.claims.shared import PARAMETERS
from experiments.claims.table_1 import against_median
from experiments.studies.flip_order import PARAMETERS as FLIP_ORDER
from experiments.subjects import BETWEEN, both
from tween import Triangulation, area_matrix, area_rank
from tween.choices import Order
from tween.morphing.alignment import align
from tween.morphing.incompatible.flip_sequence import flip_sequence
from tween.morphing.incompatible.flow import Flow
from tween.morphing.strategy import morph_compatible


@claim(
    "7",
    '"The rank of this matrix gives us a measure of the uniformity of areas of different triangles over different '
    'morph frames." "[W]e will get a very low rank of the matrix" where areas vary uniformly.',
    "every",
    "a curve to its disk; AR says the same of remeshed and random triangulations at 1e-4 and at 1e-9; the condition: "
    "where all areas change linearly, it is 2",
    (
        "tests/morphing/compatible/guarantee/test_angle_budgets.py::test_without_budgets_the_path_of_areas_reaches_the_floor_of_both_measures",
        "experiments/studies/to_disk.py",
        "experiments/claims/section_7.py",
    ),
    condition="a tolerance is stated, and what is asked is whether areas change linearly; the paper states none",
)
def rank_measures_uniformity(x: Numbers) -> Finding:
    signs, even = against_median(x), (x.curves.AR_along_area <= 2).sum()
    turned = ((signs["AR_1e-4"] < 0) & (signs["AR_1e-9"] > 0)).sum()
    return Finding(
        f"where areas change linearly the rank is 2, on {even} of {len(x.curves)} curves; but which is better, "
        f"remeshed or random, is reversed between 1e-4 and 1e-9 on {turned} of {len(signs)}",
        (every(len(signs) - turned, len(signs)),),
        (every(even, len(x.curves)),),
    )


def rank_along_area(T: Triangulation, D: Triangulation) -> dict[str, int]:
    """AR along "area", where every area changes linearly."""
    return {"AR_along_area": area_rank(area_matrix(morph_compatible(T, D, path="area", guarantee=False)), 1e-9)}


@claim(
    "7",
    '"We have observed that different choices of the starting triangle have an effect on the quality of morphing."',
    "every",
    "a curve to its disk along slide, placed steadily so that sizes play no part; the worst root has a Var at least a "
    "tenth larger than the best",
    ("experiments/studies/root_steady.py", "experiments/studies/roots.py"),
    figure="root_choice.png",
)
def root_matters(x: Numbers) -> Finding:
    slide = x.table("root_steady").query("path == 'slide'").set_index("measure")
    AR, Var = (slide.loc[m, "max"] / slide.loc[m, "min"] for m in ("AR_1e-4", "Var"))
    peak = x.table("roots").groupby("curve")["area_max slide"].agg(["min", "max"])
    return Finding(
        f"worst root over best, medians: Var {Var.median():.2f}, AR {AR.median():.2f}; Var a tenth larger on "
        f"{(Var >= 1.1).sum()} of {len(Var)} curves, AR larger on {(AR > 1).sum()}. Placed by the root, the largest "
        f"area on the way is {peak['min'].median():.2f} times the source's from the best root and "
        f"{peak['max'].median():.2f} from the worst",
        (every((Var >= 1.1).sum(), len(Var)),),
    )


@claim(
    "7",
    '"Experimentally, we have chosen the starting triangle to be the one which lies closest to the center of the '
    'disk. This has the effect of uniformly propagating the transformation in all directions."',
    "more",
    "a curve to its disk along slide; by AR (1e-4), by the length and by the evenness of the vertices' paths, and by "
    "Var, the central root is in the best quarter of all roots rather than in the worst",
    ("experiments/studies/roots.py",),
    figure="root_choice.png",
    condition="measured by AR or by how far vertices travel, scale apart; not by Var, since shapes swell most from "
    "the middle",
)
def central_root_spreads(x: Numbers) -> Finding:
    rows = x.table("roots_summary").query("set == 'curves' and path == 'slide' and of == 'disk-center'")
    names = {"AR_1e-4": "AR", "way_scaled": "length", "unevenness_scaled": "evenness", "Var": "Var"}
    found = rows.set_index("measure").loc[list(names), ["best_quarter", "worst_quarter"]].astype(int)
    parts = tuple(more(best, worst, names[m]) for m, best, worst in found.itertuples())
    counts = ", ".join(f"{best} and {worst} by {names[m]}" for m, best, worst in found.itertuples())
    peak = rows.set_index("measure").loc["area_max", ["best_quarter", "worst_quarter"]].astype(int)
    return Finding(
        f"in the best and in the worst quarter on {counts}, of {int(rows.morphs.iloc[0])} curves; by how little "
        f"shapes swell, on {peak.best_quarter} and {peak.worst_quarter}",
        parts,
        parts[:2],
    )


@claim(
    "7",
    '"Since an edge flip is possible only if the corresponding vertex is convex, it may so happen that most of the '
    'edge flips are possible when a shape is very near to a circle in the morphing sequence."',
    "some",
    "a curve on its way to the disk under the flips of a pair; more than half of them come after 0.9 of the way",
    ("experiments/claims/section_7.py", "experiments/studies/pairs.py"),
    figure="figure_10_flips.png",
)
def flips_happen_near_the_circle(x: Numbers) -> Finding:
    flows = x.checks["flow"]
    late = {order: np.concatenate(flows[order].to_list()) for order in ("sequential", "partial")}
    share = {order: int((values > 0.5).sum()) for order, values in late.items()}
    cases = len(late["partial"])
    return Finding(
        f"in {share['sequential']} of {cases} flows in the paper's sequence, in {share['partial']} where independent "
        f"flips need not wait",
        (some(share["sequential"], cases),),
    )


def flips_on_the_way(pair: str) -> dict[str, list[float]]:
    """Shares of late flips in the flows of both curves of a pair, in sequence and in partial order."""
    a = align(*both(pair))
    orders: tuple[Order, ...] = ("sequential", "partial")
    flows = ((a.source, a.target), (a.target, a.source))
    return {order: [late_flips(S, T, order) for S, T in flows] for order in orders}


def late_flips(S: Triangulation, T: Triangulation, order: Order) -> float:
    flow = Flow(S, flip_sequence(S, T), "slide", "disk-center", order)
    return float(np.mean([event.time > PARAMETERS["late"] for event in flow.events]))


@claim(
    "7",
    '"We need a better method to align multiple features, and retriangulate the curve based on this alignment. We '
    'believe that this method can produce better morphing results."',
    "more",
    "our answer: a pair of curves, matched and triangulated together; AR (1e-4), Var and "
    "the vertices' paths are smaller than as printed",
    ("experiments/studies/matching.py", "experiments/studies/matching_sample.py"),
    figure="matching_study.png",
    kind=QUESTION,
)
def better_alignment(x: Numbers) -> Finding:
    rows = x.table("matching")
    wide = rows[rows.method.isin(["paper", "matched"])].pivot(index=["source", "target"], columns="method")
    names = {"AR_1e-4": "AR", "Var": "Var", "path_length": "paths"}
    medians = "; ".join(
        f"{word} {wide[m].matched.median():.3g} instead of {wide[m].paper.median():.3g}"
        for m, word in (names | {"swelling": "swelling"}).items()
    )
    return Finding(
        f"no flips on {(wide.flips.matched == 0).sum()} of {len(wide)} pairs; medians: {medians}",
        tuple(more_pairs(wide[m].paper - wide[m].matched, word) for m, word in names.items()),
    )


@claim(
    "7",
    '"[M]ore investigation is required for ordering of given set of edge flips (not necessarily minimum) such that '
    'all the edge flips can be completed as early as possible in the morphing process."',
    "more",
    "our answer: a pair of curves along slide; flips that wait only for those they depend "
    "on are done earlier than in the paper's sequence, by more than 0.01 of the way to the disk",
    (
        "experiments/studies/flip_order.py",
        "tests/experiments/studies/test_flip_order.py::test_no_order_is_earlier_than_the_bound",
    ),
    condition="any flip that removes crossings is made as soon as it can be; an order of the given ones hardly helps",
    kind=QUESTION,
)
def flips_can_be_early(x: Numbers) -> Finding:
    rows, angle = x.table("flip_order"), x.table("flip_order_summary").query("path == 'angle'").set_index("way")
    slide = rows[rows.path == "slide"]
    ends = pd.MultiIndex.from_tuples([tuple(pair.split(BETWEEN)) for pair in slide.pair], names=["source", "target"])
    gain = {way: (slide.sequential - slide[way]).set_axis(ends) for way in ("partial", "greedy")}
    early = {way: g.where(g.abs() > FLIP_ORDER["earlier"], 0.0) for way, g in gain.items()}
    median = slide[["sequential", "partial", "divided", "greedy"]].median()
    return Finding(
        f"the flips are finished after {median['sequential']:.2f} of the way to the disk (median of {len(slide)} "
        f"pairs, slide) in the paper's sequence, after {median['partial']:.2f} where a flip waits only for those it "
        f"depends on, after {median['divided']:.2f} where both curves flip a part. If any flip that removes a crossing "
        f"is made as soon as the shape allows, {median['greedy']:.2f} suffices; that is earlier on "
        f"{(early['greedy'] > 0).sum()} of {len(slide)} pairs. Along angle it is as early as any order can be for "
        f"{int(angle.flows_at_bound['greedy'])} of {2 * len(slide)} curves on their way to the disk",
        (more_pairs(early["partial"]),),
        (more_pairs(early["greedy"]),),
    )


@claim(
    "7",
    '"Deeper investigation is required to find the best possible starting triangle for the best morphing results."',
    "more",
    "our answer: a curve to its disk, placed steadily; the central root is better than the "
    "median root by AR (1e-4) and by Var, along slide and along linear",
    ("experiments/studies/root_steady.py",),
    figure="root_choice.png",
    kind=QUESTION,
)
def central_root_is_good(x: Numbers) -> Finding:
    table = x.table("root_steady_summary").set_index(["path", "measure"])
    few = table.loc[[(path, m) for path in ("slide", "linear") for m in ("AR_1e-4", "Var")]]
    rows = [
        (f"{m.removesuffix('_1e-4')} {path}", row) for (path, m), row in zip(few.index, few.itertuples(), strict=True)
    ]
    told = "; ".join(
        f"{word}: better on {row.below_median}, worse on {row.above_median} of {row.curves} curves, best of all on "
        f"{row.best:.0f}, worst over best {row.worst_over_best:.2f}"
        for word, row in rows
    )
    return Finding(told, tuple(more(row.below_median, row.above_median, word) for word, row in rows))


@claim(
    "8 (6)",
    '"This algorithm is guaranteed to terminate as any self-overlapping curve can be morphed to a circle and this '
    'circle, being convex, can allow the triangulations of both the source and the target self-overlapping curves."',
    "every",
    "a pair of curves; all flips are done by the disk, from both ends and in both orders",
    (
        "experiments/studies/pairs.py",
        "tests/morphing/incompatible/test_flow.py::test_every_flip_of_a_flow_is_strictly_convex_exactly",
    ),
    figure="figure_10_flips.png",
)
def flips_terminate(x: Numbers) -> Finding:
    slide = x.table("pairs").query("path == 'slide'")
    last = slide[["u", "v", "u_partial", "v_partial"]]
    done = (last <= 1).all(axis=1).sum()
    return Finding(
        f"{done} of {len(slide)} pairs; the last flip of all at {last.max(axis=None):.4f}, just before it",
        (every(done, len(slide)),),
    )
