"""Section 4: swaps of edges, remeshing, and compatible triangulations."""

from itertools import pairwise

import numpy as np
from scipy.stats import spearmanr

from experiments.claims.ledger import Finding, Numbers, claim
from experiments.claims.rules import every, more, tracks
from experiments.claims.shared import PARAMETERS, Floats, sorted_angles, turns
from experiments.store import rng_for
from experiments.subjects import flip_graph, polygon
from tween import Morph, Triangulation, area_matrix, area_rank, decompose, frame_variance, paper_morph, verify
from tween.triangulating.costs import smallest_angle
from tween.triangulating.flips import flip, flippable, locally_delaunay


@claim(
    "4",
    '"For example, the presence of many sliver triangles degrades the quality of morph considerably."',
    "tracks",
    "a curve: the correlation of the number of slivers (angles below 5 degrees) with AR (1e-4), and with Var, over 40 "
    "random triangulations",
    ("experiments/claims/section_4.py",),
)
def slivers_degrade(x: Numbers) -> Finding:
    AR, Var = x.curves.slivers_AR, x.curves.slivers_Var
    strong = [(values > 0.3).sum() for values in (AR, Var)]
    return Finding(
        f"medians {AR.median():.2f} (AR) and {Var.median():.2f} (Var); above 0.3 on {strong[0]} and {strong[1]} of "
        f"{len(AR)} curves",
        (tracks(AR, "AR"), tracks(Var, "Var")),
    )


def slivers_and_places(remeshed: Morph, drawn: list[Triangulation]) -> dict[str, float]:
    """Random triangulations: do slivers go with AR and Var, and is change more local than when remeshed?"""
    values = []
    for S in drawn:
        m = paper_morph(S, S.moved(remeshed.target.points))
        A = area_matrix(m)
        slivers = (np.degrees(-smallest_angle(S.points)(S.triangles)) < PARAMETERS["sliver_degrees"]).sum()
        own = area_rank(A, 1e-4), frame_variance(A), in_a_tenth(A), in_a_tenth(turns(m))
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


@claim(
    "4",
    '"Note that, any number of valid edge swaps will still produce a valid triangulation of the interior of the '
    'curve."',
    "every",
    "a random valid swap, one after the other; the triangulation is valid after it",
    (
        "tests/triangulating/test_flips.py::test_a_flip_changes_one_pair_of_rows_and_its_inverse_restores_it",
        "experiments/claims/section_4.py",
    ),
    figure="figure_05_flip.png",
)
def swaps_stay_valid(x: Numbers) -> Finding:
    swaps, valid = len(x.curves) * PARAMETERS["swaps"], x.curves.swaps_valid.sum()
    return Finding(f"{valid:,} of {swaps:,} swaps on {len(x.curves)} curves", (every(valid, swaps),))


def swapped(T: Triangulation, rng: np.random.Generator) -> int:
    """How many of a series of random valid swaps leave a valid triangulation."""
    valid = 0
    for _ in range(PARAMETERS["swaps"]):
        T = flip(T, tuple(rng.choice(T.diagonals[flippable(T)]).tolist()))
        valid += verify(T.points, T.triangles).valid
    return valid


@claim(
    "4 (Algorithm 1)",
    '"Since a Delaunay Triangulation maximizes the minimal angle, A\' is lexicographically larger than A." "[T]he new '
    "angle vector is always lexicographically larger, upper bounded by A'. Hence the algorithm terminates.\"",
    "every",
    "a flip, after which the vector is larger; a curve, on which the result has the largest smallest angle of all "
    "triangulations",
    (
        "tests/triangulating/test_flips.py::test_flips_one_by_one_lead_to_the_same_result_and_each_enlarges_the_angles",
        "tests/triangulating/test_flips.py::test_a_remeshed_disk_is_valid_and_delaunay",
        "experiments/claims/section_4.py",
    ),
    figure="figure_05_flip.png",
)
def remeshing_ends(x: Numbers) -> Finding:
    larger, flips, best = x.curves.flips_larger.sum(), x.curves.flips.sum(), x.curves.smallest_angle_is_best.sum()
    return Finding(
        f"larger after {larger:,} of {flips:,} flips; the largest smallest angle on {best} of {len(x.curves)} curves",
        (every(larger, flips, "flips"), every(best, len(x.curves), "curves")),
    )


def remeshed_one_by_one(T: Triangulation) -> dict[str, int]:
    """Flip what is not locally Delaunay until nothing is left; how many flips enlarge the sorted angles."""
    flips, larger, before = 0, 0, sorted_angles(T)
    while not (fine := locally_delaunay(T)).all():
        T = flip(T, tuple(T.diagonals[~fine][0].tolist()))
        after = sorted_angles(T)
        change = (after - before)[np.abs(after - before) > 1e-14]
        flips, larger, before = flips + 1, larger + bool(len(change) and change[0] > 0), after
    return {"flips": flips, "flips_larger": larger}


@claim(
    "4 (Figure 3)",
    '"As Figure 3 shows, the triangulation obtained using the edge-swapping process clearly brings out the deformation '
    'pattern of the disk."',
    "more",
    "a curve; the remeshed dual tree has fewer branchings than the median of 40 random ones, which is how we read it",
    ("experiments/claims/section_4.py",),
    figure="figure_03_dual_graphs.png",
)
def pattern_shows(x: Numbers) -> Finding:
    ours, random = x.curves.branchings, x.curves.branchings_random
    fewer, rest = (ours < random).sum(), (ours > random).sum()
    return Finding(
        f"fewer branchings on {fewer} of {len(ours)} curves, typically {ours.median():.0f} against "
        f"{random.median():.0f}",
        (more(fewer, rest),),
    )


def branchings(T: Triangulation, drawn: list[Triangulation]) -> dict[str, float]:
    """Branchings of the dual tree, remeshed and at the median of the random ones."""
    ours, *random = [int((np.bincount(S.dual.ravel()) == 3).sum()) for S in (T, *drawn)]
    return {"branchings": ours, "branchings_random": float(np.median(random))}


@claim(
    "4 (Figure 6)",
    '"Morphing using a random triangulation (top) shows all the changes happen in a small region, and using our '
    "re-triangulation method (bottom) shows that the morphing among the regions of the curve is more uniformly "
    'distributed."',
    "more",
    "a curve; the tenth of the vertices that bends most, and the tenth of the triangles whose areas change most, have "
    "a smaller share of all change when remeshed than at the median of 40 random triangulations",
    ("experiments/claims/section_4.py",),
    figure="figure_06_random_remeshed.png",
    condition="measured by how the curve bends, not by areas",
)
def random_changes_locally(x: Numbers) -> Finding:
    c, letter = x.curves, x.curves.index.str.startswith("letter ")
    areas, bends = (np.sign(c[f"{of}_tenth_random"] - c[f"{of}_tenth"]) for of in ("areas", "turns"))
    share = c[["turns_tenth", "turns_tenth_random"]].median()
    bending = more((bends > 0).sum(), (bends < 0).sum(), "bending")
    return Finding(
        f"the tenth that bends most does {share.turns_tenth:.0%} of the bending remeshed, "
        f"{share.turns_tenth_random:.0%} at random; less when remeshed on {(bends > 0).sum()} of {len(c)} curves, of "
        f"changes of area on {(areas > 0).sum()}: {(areas[~letter] > 0).sum()} of {(~letter).sum()} constructed ones "
        f"and {(areas[letter] > 0).sum()} of {letter.sum()} letters",
        (bending, more((areas > 0).sum(), (areas < 0).sum(), "areas")),
        (bending,),
    )


def in_a_tenth(values: Floats) -> float:
    """Share of all change from column to column that happens in the tenth of the rows that change most."""
    change = np.sort(np.abs(np.diff(values, axis=1)).sum(axis=1))
    return float(change[-max(1, round(len(change) / 10)) :].sum() / change.sum())


@claim(
    "4.1",
    '"We observe that, in our specific problem, two triangulations are compatible if and only if there exists a k" by '
    "which their degree sequences agree after a rotation",
    "every",
    "a pair of triangulations of a convex polygon; compatible by their triangles, and by their degrees, or by neither",
    (
        "tests/triangulating/test_compatibility.py::test_the_smallest_shift_is_found_for_all_pairs_of_triangulations",
        "tests/experiments/claims/test_measure.py::test_degrees_tell_triangulations_apart",
        "experiments/claims/section_4.py",
    ),
    figure="figure_02_compatible.png",
)
def compatible_iff_degrees(x: Numbers) -> Finding:
    rings = x.checks["degrees"]
    return Finding(
        f"{rings.disagree.sum()} exceptions in {rings.pairs.sum():,} pairs, all triangulations up to n = "
        f"{rings.index[-1]}; {rings.mirrored.sum():,} pairs are only mirror images, which a fixed orientation excludes",
        (every(rings.pairs.sum() - rings.disagree.sum(), rings.pairs.sum()),),
    )


@claim(
    "4.1 (3)",
    '"This compatibility can be checked by a simple O(n^2) method."',
    "every",
    "a pair of random triangulations of a polygon, compatible or not; comparing the degrees one by one, for each k, "
    "takes n^2 comparisons at most and finds the same as comparing all triangles",
    (
        "experiments/claims/section_4.py",
        "tests/triangulating/test_compatibility.py::test_the_smallest_shift_is_found_for_all_pairs_of_triangulations",
    ),
)
def compatibility_is_quadratic(x: Numbers) -> Finding:
    rings = x.checks["comparisons"]
    most = (rings.most_comparisons / rings.index.astype(int) ** 2).max()
    return Finding(
        f"{rings.compared_right.sum()} of {rings.compared.sum()} pairs, with {most:.2f} n^2 comparisons at most; "
        f"searching a string of degrees in the other one doubled, as done here, is linear in n",
        (every(rings.compared_right.sum(), rings.compared.sum()),),
    )


def comparisons(size: str) -> dict[str, int]:
    """The paper's check of random pairs, half of them renumbered copies: comparisons, and how often it is right."""
    n, rng = int(size), rng_for(PARAMETERS["seed"], f"comparisons {size}")
    drawn = decompose(polygon(n)).sample(rng, PARAMETERS["ring_pairs"])
    pairs = [*pairwise(drawn), *((T, T.rolled(int(rng.integers(n)))) for T in drawn)]
    found = [one_by_one(S.degrees.tolist(), T.degrees.tolist()) for S, T in pairs]
    right = [
        (k is not None) == equal_triangles(S, T) and c <= n * n for (k, c), (S, T) in zip(found, pairs, strict=True)
    ]
    most = max(count for _, count in found)
    return {"compared": len(pairs), "compared_right": sum(right), "most_comparisons": most}


def one_by_one(first: list[int], second: list[int]) -> tuple[int | None, int]:
    """The smallest k by which the degrees agree, if any does, and how many comparisons it takes."""
    n, count = len(first), 0
    for k in range(n):
        agree = 0
        while agree < n and first[agree] == second[(agree + k) % n]:
            agree += 1
        count += min(agree + 1, n)
        if agree == n:
            return k, count
    return None, count


def equal_triangles(S: Triangulation, T: Triangulation) -> bool:
    """Whether some renumbering makes the triangles the same."""
    wanted = S.canonical.tobytes()
    return any(T.rolled(k).canonical.tobytes() == wanted for k in range(len(T)))


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
