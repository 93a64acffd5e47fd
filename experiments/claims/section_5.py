"""Section 5: morphs between compatible triangulations, and the paths of third vertices.

Legend: ``T`` a triangulation, ``D`` the disk; ``a b c`` corners of a triangle, ab its base; ``z = (c-a)/(b-a)``.
"""

import numpy as np

from experiments.claims.ledger import CONDITION, FAILS, HOLDS, Finding, Numbers, claim, most
from experiments.claims.shared import PARAMETERS, Floats
from experiments.measures import hung, slid
from experiments.store import rng_for
from experiments.subjects import shape
from tween import Morph, Triangulation, area_matrix, paper_morph, triangulate
from tween.choices import Path
from tween.morphing.compatible.paths import slides, third_vertices


@claim(
    "5",
    'The procedure "converges to the target shape when t = 1"',
    HOLDS,
    (
        "tests/morphing/test_strategy.py::test_it_leads_exactly_from_source_to_target",
        "tests/morphing/incompatible/test_flow.py::test_the_ends_are_exactly_the_shapes_that_were_given",
        "experiments/claims/section_5.py",
    ),
)
def reaches_the_target(x: Numbers) -> Finding:
    near = (x.curves.gap_before_end < 1e-6).sum()
    return near == len(x.curves), (
        f"at t = 1 - 1e-9 within a millionth of the target's size on {near} of {len(x.curves)} curves"
    )


def at_the_end(m: Morph) -> dict[str, float]:
    """How near the target the shape is just before the end."""
    D = m.target.points
    return {"gap_before_end": float(np.abs(m.at([1 - 1e-9])[0] - D).max() / np.ptp(D))}


@claim(
    "5 (Figure 7)",
    'Slide "ensures that the length of the (propagation) edge ... is always between" those in source and target',
    CONDITION,
    (
        "tests/morphing/test_strategy.py::test_slide_keeps_propagation_edges_monotone_relative_to_their_base",
        "experiments/claims/section_5.py",
    ),
    "figure_07_paths.png",
    "the length in proportion to the triangle's base, which itself changes",
)
def slide_keeps_lengths_between(x: Numbers) -> Finding:
    slide, shrink = x.checks["slide"], x.curves.non_monotone.sum()
    edges, relative, outside = slide[["edges", "relative", "outside"]].sum()
    return relative == 0 and outside > 0, (
        f"in proportion {relative} of {edges:,} edges leave that range (along linear {shrink:,} shrink "
        f"and grow again); in absolute terms {outside:,} do by more than 1 %, up to {slide.farthest.max():.0f}-fold"
    )


def lengths_and_areas(name: str, path: Path) -> dict[str, float]:
    """How propagation edges and areas keep between their two ends, on the way to the disk."""
    T = triangulate(shape(name))
    D = T.on_disk()
    m = paper_morph(T, D, path=path)
    corners, propagates = hung(T, D.points)
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
        "uneven": float(np.abs(A - even).sum(axis=0).mean()),
    }


def beyond(x: Floats) -> tuple[Floats, Floats]:
    """By what factors columns exceed the larger of their two ends, and fall below the smaller."""
    return x.max(axis=0) / np.maximum(x[0], x[-1]), np.minimum(x[0], x[-1]) / x.min(axis=0)


@claim(
    "5",
    'Of two propagation edges "at most one ... will have non-monotonic changes in its length during linear morph"',
    FAILS,
    (
        "tests/morphing/compatible/test_paths.py::test_both_edges_can_be_non_monotone_and_both_are_kept",
        "experiments/claims/section_5.py",
    ),
    "figure_07_paths.png",
)
def at_most_one_non_monotone(x: Numbers) -> Finding:
    both = x.checks["thirds"].both / x.checks["thirds"].pairs
    two, found = x.curves.two_edges.sum(), x.curves.two_non_monotone.sum()
    return bool(both.min() > 0), (
        f"both have for {both['uniform']:.0%} of pairs of third vertices spread over the base, {both['normal']:.0%} of "
        f"pairs of triangles with normal coordinates; on our curves, remeshed, for {found} of {two}"
    )


def non_monotone(T: Triangulation, D: Triangulation) -> dict[str, int]:
    """How many triangles have two propagation edges, and how many edges "linear" would make shrink and grow again."""
    propagates = hung(T, D.points)[1]
    found = slid(T, D.points)
    return {
        "two_edges": int(propagates.all(axis=1).sum()),
        "two_non_monotone": int(found.all(axis=1).sum()),
        "non_monotone": int(found.sum()),
    }


def third_vertices_at_random(spread: str) -> dict[str, int]:
    """Pairs of third vertices: how many lengths a straight path shortens and lengthens, and what "slide" spares."""
    rng, size = rng_for(PARAMETERS["seed"], spread), PARAMETERS["thirds"]
    if spread == "uniform":
        z1, z2 = (rng.uniform(-3, 4, size) + 1j * rng.exponential(1, size) for _ in range(2))
    else:
        a, b, c = rng.standard_normal((3, 2, size)) + 1j * rng.standard_normal((3, 2, size))
        z1, z2 = (z.real + 1j * np.abs(z.imag) for z in (c - a) / (b - a))
    both = np.ones((size, 2), dtype=bool)
    found = slides(z1, z2, both)
    one = found[:, 0] & ~found[:, 1]
    times = np.linspace(0, 1, PARAMETERS["frames"])
    z = third_vertices("slide", z1[one], z2[one], both[one], np.ones(one.sum()), times)
    steps = np.diff(np.abs(z - 1), axis=1)
    kept = (steps >= -1e-9).all(axis=1) | (steps <= 1e-9).all(axis=1)
    return {"pairs": size, "both": int(found.all(axis=1).sum()), "one": int(one.sum()), "kept": int(kept.sum())}


@claim(
    "5",
    'Slide "also preserves monotonicity of the length of the other propagation edge"',
    HOLDS,
    (
        "tests/morphing/compatible/test_paths.py::test_slide_keeps_many_random_lengths_monotone",
        "experiments/claims/section_5.py",
    ),
    "figure_07_paths.png",
)
def slide_spares_the_other_edge(x: Numbers) -> Finding:
    one, kept = x.checks["thirds"].one.sum(), x.checks["thirds"].kept.sum()
    return kept == one, f"in {kept:,} of {one:,} random cases in which just one edge is non-monotone"


@claim(
    "5",
    'Linear is "better at preserving or smoothly interpolating the areas of the triangles"',
    HOLDS,
    ("experiments/claims/section_5.py",),
    "figure_08_linear_slide.png",
)
def linear_preserves_areas(x: Numbers) -> Finding:
    linear, slide = (x.checks[path].uneven for path in ("linear", "slide"))
    nearer, by = (linear < slide * (1 - 1e-6)).sum(), (slide / linear - 1).median()
    return most(nearer, len(linear)), (
        f"areas nearer to linear change than along slide on {nearer} of {len(linear)} curves, but only by {by:.0%} in "
        f"the median: together they are off by {linear.median():.2f} and {slide.median():.2f} times the whole area"
    )


@claim(
    "5 (Figure 8)",
    'Slide "isolates the side-effects of transformation of the parent from propagating to the children"',
    CONDITION,
    ("experiments/claims/section_5.py",),
    "figure_08_linear_slide.png",
    "edges that shrink, as in Figure 8; not edges that grow",
)
def slide_isolates(x: Numbers) -> Finding:
    linear, slide = (x.checks[path][["shorter", "outside"]] for path in ("linear", "slide"))
    signs = np.sign(slide - linear)
    shorter, outside = signs.shorter, signs.outside
    fewer, more = (shorter < 0).sum(), (shorter > 0).sum()
    return fewer > 2 * more and not most((outside < 0).sum(), (outside != 0).sum()), (
        f"edges shorter than at both ends: fewer than along linear on {fewer} of {len(shorter)} curves, more on "
        f"{more}; shorter or longer: fewer on {(outside < 0).sum()}, more on {(outside > 0).sum()}"
    )
