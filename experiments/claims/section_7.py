"""Sections 7 and 8: what Table 1 says, where the motion starts, and when the flips happen."""

import numpy as np
import pandas as pd

from experiments.claims.ledger import CONDITION, FAILS, HOLDS, Finding, Numbers, claim, most
from experiments.claims.shared import PARAMETERS
from experiments.measures import MEASURES
from experiments.subjects import both
from tween import Triangulation, area_matrix, area_rank
from tween.choices import Order
from tween.morphing.alignment import align
from tween.morphing.incompatible.flip_sequence import flip_sequence
from tween.morphing.incompatible.flow import Flow
from tween.morphing.strategy import morph_compatible

BETTER = 'Remeshing "quantitatively produces a much better morph" than an arbitrary triangulation'


def against_median(x: Numbers) -> pd.DataFrame:
    """Signs of remeshed less the median of the random ones, to the disk, path slide: a row a curve."""
    slide = x.table("table_1_to_disk").query("path == 'slide'").set_index("curve")
    ours, random = (slide[slide.triangulation == t][MEASURES] for t in ("remeshed", "uniform_median"))
    return np.sign(ours - random)


@claim(
    "7 (2, Table 1)",
    f"{BETTER}: AR, to the disk",
    CONDITION,
    ("experiments/studies/to_disk.py",),
    "table_1_slide.png",
    "path slide and a tolerance of 1e-4; at 1e-6 and 1e-9 the other way round",
)
def smaller_rank_to_the_disk(x: Numbers) -> Finding:
    below = (against_median(x) < 0).sum()
    cases = len(against_median(x))
    return most(below["AR_1e-4"], cases) and not most(below["AR_1e-9"], cases), (
        f"below the median random one on {below['AR_1e-4']} of {cases} curves at 1e-4, on {below['AR_1e-6']} at 1e-6, "
        f"on {below['AR_1e-9']} at 1e-9"
    )


@claim(
    "7 (2, Table 1)",
    f"{BETTER}: Var, to the disk",
    FAILS,
    ("experiments/studies/to_disk.py",),
    "table_1_slide.png",
)
def smaller_variance_to_the_disk(x: Numbers) -> Finding:
    below = int((against_median(x)["Var"] < 0).sum())
    cases = len(against_median(x))
    return 2 * below < cases, f"below the median random one on {below} of {cases} curves, path slide"


def paper_columns(x: Numbers) -> tuple[pd.DataFrame, pd.DataFrame]:
    """The four columns of Table 1: measures by triangulation, and what the paper prints."""
    table = x.table("table_1_curve_to_curve")
    ours = table.pivot(index="row", columns="triangulation", values=["AR_1e-4", "Var", "flips"])
    return ours, table.groupby("row").first()


@claim(
    "7 (2, Table 1)",
    f"{BETTER}: AR, from curve to curve",
    CONDITION,
    ("experiments/studies/curve_to_curve.py",),
    "figure_11_pairs.png",
    "a tolerance of 1e-4, and arbitrary triangulations that have to be flipped into each other",
)
def smaller_rank_between_curves(x: Numbers) -> Finding:
    values, printed = paper_columns(x)
    AR, paper = values["AR_1e-4"], printed.paper_AR_arbitrary / printed.paper_AR_remeshed
    own, common = AR.own_median / AR.remeshed, (AR.common_median / AR.remeshed).dropna()
    return bool((own > 1).all() and (common <= 1).all()), (
        f"arbitrary to remeshed on stand-ins for the four rows: {phrase(own)} (paper: {phrase(paper)}); against common "
        f"triangulations, where there are any: {phrase(common)}"
    )


@claim(
    "7 (2, Table 1)",
    f"{BETTER}: Var, from curve to curve",
    CONDITION,
    ("experiments/studies/curve_to_curve.py",),
    "figure_11_pairs.png",
    "remeshed triangulations that are compatible where arbitrary ones have to be flipped",
)
def smaller_variance_between_curves(x: Numbers) -> Finding:
    values, printed = paper_columns(x)
    paper = printed.paper_Var_arbitrary / printed.paper_Var_remeshed
    ratios = values["Var"].own_median / values["Var"].remeshed
    free = values["flips"].remeshed == 0
    return bool((ratios[free] > 10).all() and (ratios[~free] < 2).all()), (
        f"arbitrary to remeshed: {phrase(ratios[free])} where the remeshed ones are compatible, "
        f"{phrase(ratios[~free])} where not (paper: {phrase(paper)})"
    )


def phrase(ratios: pd.Series) -> str:
    """Numbers in a list, three digits each."""
    return ", ".join(f"{r:.3g}" if r < 1000 else f"{r:.0e}" for r in ratios)


@claim(
    "7",
    '"The rank of this matrix gives us a measure of the uniformity of areas"',
    CONDITION,
    (
        "tests/morphing/compatible/test_angle_budgets.py::test_without_budgets_the_path_of_areas_reaches_the_floor_of_both_measures",
        "experiments/studies/to_disk.py",
        "experiments/claims/section_7.py",
    ),
    condition="a tolerance is stated; the paper states none",
)
def rank_measures_uniformity(x: Numbers) -> Finding:
    signs, even = against_median(x), (x.curves.AR_along_area <= 2).sum()
    turned = ((signs["AR_1e-4"] < 0) & (signs["AR_1e-9"] > 0)).sum()
    return even == len(x.curves) and turned > 0, (
        f"where areas change linearly the rank is 2, on {even} of {len(x.curves)} curves; but which is the better, "
        f"remeshed or random, turns round between 1e-4 and 1e-9 on {turned} of {len(signs)}"
    )


def rank_along_area(T: Triangulation, D: Triangulation) -> dict[str, int]:
    """AR along "area", where every area changes linearly."""
    return {"AR_along_area": area_rank(area_matrix(morph_compatible(T, D, path="area", guarantee=False)), 1e-9)}


@claim(
    "7",
    'The starting triangle "closest to the center of the disk" has "the effect of uniformly propagating the '
    'transformation in all directions"',
    CONDITION,
    ("experiments/studies/roots.py",),
    "root_choice.png",
    "measured by AR or by how far vertices travel, scale apart; not by Var or by how evenly they travel",
)
def central_root_spreads(x: Numbers) -> Finding:
    rows = x.table("roots_summary").query("set == 'curves' and path == 'slide' and of == 'disk-center'")
    place = rows.set_index("measure").percentile
    low, high = place[["AR_1e-4", "way_scaled"]], place[["Var", "unevenness_scaled"]]
    return bool(low.max() < 1 / 3 < high.min()), (
        f"where it lies among all roots of a curve, 0 best, medians: AR (1e-4) {place['AR_1e-4']:.2f}, ways "
        f"{place['way_scaled']:.2f}, Var {place['Var']:.2f}, unevenness of the ways {place['unevenness_scaled']:.2f}"
    )


@claim(
    "7",
    '"It may so happen that most of the edge flips are possible when a shape is very near to a circle"',
    CONDITION,
    ("experiments/claims/section_7.py", "experiments/studies/pairs.py"),
    "figure_10_flips.png",
    "flips wait for each other in sequence, as the paper has it; and for most pairs, not all",
)
def flips_happen_near_the_circle(x: Numbers) -> Finding:
    flows = x.checks["flow"]
    late = {order: np.concatenate(flows[order].to_list()) for order in ("sequential", "partial")}
    share = {order: int((values > 0.5).sum()) for order, values in late.items()}
    cases = len(late["partial"])
    return cases < 2 * share["sequential"] < 2 * cases, (
        f"more than half of the flips come after {PARAMETERS['late']} of the way to the disk in "
        f"{share['sequential']} of {cases} flows, in {share['partial']} where independent flips need not wait"
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
    '"We need a better method to align multiple features, and retriangulate the curve based on this alignment"; it '
    '"can produce better morphing results"',
    HOLDS,
    ("experiments/studies/matching.py", "experiments/studies/matching_sample.py"),
    "matching_study.png",
)
def better_alignment(x: Numbers) -> Finding:
    table = x.table("matching_summary").set_index(["method", "measure"])
    paper, ours = table.loc["paper"], table.loc["matched"]
    names = {"AR_1e-4": "AR (1e-4)", "Var": "Var", "path_length": "paths"}
    better = paper.loc[[f"matched_better: {name}" for name in names]]
    free = int((x.table("matching").query("method == 'matched'").flips == 0).sum())
    medians = "; ".join(
        f"{word} {ours.loc[name, 'median']:.3g} instead of {paper.loc[name, 'median']:.3g}, better on {share:.0%} "
        f"({low:.0%} to {high:.0%})"
        for (name, word), (share, low, high) in zip(
            names.items(), better[["share", "low", "high"]].itertuples(index=False), strict=True
        )
    )
    return bool((better.share >= 2 / 3).all() and (better.low > 0.5).all()), (
        f"correspondence and common triangulation found together: no flips on {free} of {int(better.pairs.max())} "
        f"pairs; medians: {medians}"
    )


@claim(
    "7",
    '"Ordering of given set of edge flips ... such that all the edge flips can be completed as early as possible": '
    "there is an order that is earlier than the paper's",
    CONDITION,
    (
        "experiments/studies/flip_order.py",
        "tests/experiments/studies/test_flip_order.py::test_no_order_is_earlier_than_the_bound",
    ),
    condition="if any flip that removes crossings is made as soon as possible; an order of the given ones hardly helps",
)
def flips_can_be_early(x: Numbers) -> Finding:
    table = x.table("flip_order_summary").set_index(["path", "way"])
    slide, angle = table.loc["slide"], table.loc["angle"]
    median, pairs = slide["median"], int(slide.pairs.iloc[0])
    return most(slide.earlier["greedy"], pairs) and not most(slide.earlier["partial"], pairs), (
        f"how far a morph has to go to the disk, medians of {pairs} pairs along slide: {median['sequential']:.2f} in "
        f"the paper's sequence, {median['partial']:.2f} where independent flips need not wait, {median['divided']:.2f} "
        f"divided between both flows, {median['greedy']:.2f} greedy, earlier on {int(slide.earlier['greedy'])}; along "
        f"angle greedy is at a lower bound of all orders in {int(angle.flows_at_bound['greedy'])} of {2 * pairs} flows"
    )


@claim(
    "7",
    '"Deeper investigation is required to find the best possible starting triangle": the central one is a good one',
    HOLDS,
    ("experiments/studies/root_steady.py",),
    "root_choice.png",
)
def central_root_is_good(x: Numbers) -> Finding:
    table = x.table("root_steady_summary").set_index(["path", "measure"])
    few = table.loc[[("slide", "AR_1e-4"), ("slide", "Var"), ("linear", "AR_1e-4"), ("linear", "Var")]]
    told = "; ".join(
        f"{measure.replace('_', ' ')} along {path}: below the median root on {row.below_median}, above on "
        f"{row.above_median} of {row.curves} curves, best on {row.best:.0f}, worst over best {row.worst_over_best:.2f}"
        for (path, measure), row in zip(few.index, few.itertuples(), strict=True)
    )
    return bool((few.share_below > 2 / 3).all() and (few.sign_test < 0.05).all()), f"shapes placed steadily: {told}"


@claim(
    "8 (6)",
    '"Guaranteed to terminate": the circle allows every flip, so all are done by then',
    HOLDS,
    (
        "experiments/studies/pairs.py",
        "tests/morphing/incompatible/test_flow.py::test_every_flip_of_a_flow_is_strictly_convex_exactly",
    ),
    "figure_10_flips.png",
)
def flips_terminate(x: Numbers) -> Finding:
    slide = x.table("pairs").query("path == 'slide'")
    last = slide[["u", "v", "u_partial", "v_partial"]]
    return bool((last <= 1).all(axis=None)), (
        f"all flips done by the disk in {(last <= 1).all(axis=1).sum()} of {len(slide)} pairs, from both ends and in "
        f"both orders; the last one at {last.max(axis=None):.4f}, just before it"
    )
