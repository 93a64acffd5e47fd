"""Section 4: swaps of edges, remeshing, and compatible triangulations."""

import numpy as np
from scipy.stats import spearmanr

from experiments.claims.ledger import CONDITION, FAILS, HOLDS, Finding, Numbers, claim, most
from experiments.claims.shared import PARAMETERS, Floats, sorted_angles, turns
from experiments.subjects import flip_graph
from tween import Morph, Triangulation, area_matrix, area_rank, frame_variance, paper_morph, verify
from tween.triangulating.costs import smallest_angle
from tween.triangulating.flips import flip, flippable, locally_delaunay


@claim(
    "4",
    '"The presence of many sliver triangles degrades the quality of morph considerably"',
    FAILS,
    ("experiments/claims/section_4.py",),
)
def slivers_degrade(x: Numbers) -> Finding:
    AR, Var = x.curves.slivers_AR, x.curves.slivers_Var
    strong = [(values > 0.3).sum() for values in (AR, Var)]
    return bool(max(AR.median(), Var.median()) < 0.2), (
        f"rank correlation of slivers with AR (1e-4) and with Var over random triangulations: medians "
        f"{AR.median():.2f} and {Var.median():.2f}; above 0.3 on {strong[0]} and {strong[1]} of {len(AR)} curves"
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
    '"Any number of valid edge swaps will still produce a valid triangulation of the interior of the curve"',
    HOLDS,
    (
        "tests/triangulating/test_flips.py::test_a_flip_changes_one_pair_of_rows_and_its_inverse_restores_it",
        "experiments/claims/section_4.py",
    ),
    "figure_05_flip.png",
)
def swaps_stay_valid(x: Numbers) -> Finding:
    swaps, valid = len(x.curves) * PARAMETERS["swaps"], x.curves.swaps_valid.sum()
    return valid == swaps, f"{valid:,} of {swaps:,} random swaps, one after the other on {len(x.curves)} curves"


def swapped(T: Triangulation, rng: np.random.Generator) -> int:
    """How many of a series of random valid swaps leave a valid triangulation."""
    valid = 0
    for _ in range(PARAMETERS["swaps"]):
        T = flip(T, tuple(rng.choice(T.diagonals[flippable(T)]).tolist()))
        valid += verify(T.points, T.triangles).valid
    return valid


@claim(
    "4 (Algorithm 1)",
    'Each flip makes the sorted angles "lexicographically larger"; "hence the algorithm terminates", in a constrained '
    'Delaunay triangulation, which "maximizes the minimal angle"',
    HOLDS,
    (
        "tests/triangulating/test_flips.py::test_flips_one_by_one_lead_to_the_same_result_and_each_enlarges_the_angles",
        "tests/triangulating/test_flips.py::test_a_remeshed_disk_is_valid_and_delaunay",
        "experiments/claims/section_4.py",
    ),
    "figure_05_flip.png",
)
def remeshing_ends(x: Numbers) -> Finding:
    larger, flips, best = x.curves.flips_larger.sum(), x.curves.flips.sum(), x.curves.smallest_angle_is_best.sum()
    return larger == flips and best == len(x.curves), (
        f"larger after {larger:,} of {flips:,} flips; the largest smallest angle of all triangulations is that of a "
        f"remeshed one on {best} of {len(x.curves)} curves"
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
    'Remeshing "clearly brings out the deformation pattern of the disk"',
    HOLDS,
    ("experiments/claims/section_4.py",),
    "figure_03_dual_graphs.png",
)
def pattern_shows(x: Numbers) -> Finding:
    ours, random = x.curves.branchings, x.curves.branchings_random
    fewer = (ours < random).sum()
    return most(fewer, len(ours)), (
        f"read as branchings of the dual tree: fewer than the median random triangulation on {fewer} of {len(ours)} "
        f"curves, typically {ours.median():.0f} against {random.median():.0f}"
    )


def branchings(T: Triangulation, drawn: list[Triangulation]) -> dict[str, float]:
    """Branchings of the dual tree, remeshed and at the median of the random ones."""
    ours, *random = [int((np.bincount(S.dual.ravel()) == 3).sum()) for S in (T, *drawn)]
    return {"branchings": ours, "branchings_random": float(np.median(random))}


@claim(
    "4 (Figure 6)",
    'With a random triangulation "all the changes happen in a small region"; remeshed, they are "more uniformly '
    'distributed"',
    CONDITION,
    ("experiments/claims/section_4.py",),
    "figure_06_random_remeshed.png",
    "measured by how the curve bends; measured by areas, on the constructed curves alone",
)
def random_changes_locally(x: Numbers) -> Finding:
    c, letter = x.curves, x.curves.index.str.startswith("letter ")
    areas, bends = c.areas_tenth < c.areas_tenth_random, c.turns_tenth < c.turns_tenth_random
    share = c[["turns_tenth", "turns_tenth_random"]].median()
    supported = most(bends.sum(), len(c)) and most(areas[~letter].sum(), (~letter).sum())
    return supported and not most(areas[letter].sum(), letter.sum()), (
        f"the tenth of the vertices that bends most does {share.turns_tenth:.0%} of the bending remeshed, "
        f"{share.turns_tenth_random:.0%} at random, less when remeshed on {bends.sum()} of {len(c)} curves; of changes "
        f"of area, on {areas[~letter].sum()} of {(~letter).sum()} constructed curves and {areas[letter].sum()} of "
        f"{letter.sum()} letters"
    )


def in_a_tenth(values: Floats) -> float:
    """Share of all change from column to column that happens in the tenth of the rows that change most."""
    change = np.sort(np.abs(np.diff(values, axis=1)).sum(axis=1))
    return float(change[-max(1, round(len(change) / 10)) :].sum() / change.sum())


@claim(
    "4.1",
    'Two triangulations are compatible "if and only if" their degree sequences agree after a rotation',
    HOLDS,
    (
        "tests/triangulating/test_compatibility.py::test_the_smallest_shift_is_found_for_all_pairs_of_triangulations",
        "tests/experiments/claims/test_measure.py::test_degrees_tell_triangulations_apart",
        "experiments/claims/section_4.py",
    ),
    "figure_02_compatible.png",
)
def compatible_iff_degrees(x: Numbers) -> Finding:
    rings = x.checks["degrees"]
    return rings.disagree.sum() == 0, (
        f"{rings.disagree.sum()} exceptions in {rings.pairs.sum():,} pairs, all triangulations up to n = "
        f"{rings.index[-1]}; {rings.mirrored.sum():,} pairs are only mirror images, which a fixed orientation excludes"
    )


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
