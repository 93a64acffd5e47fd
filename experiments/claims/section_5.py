"""Section 5: morphs between compatible triangulations, and the paths of third vertices.

Legend: ``T`` a triangulation, ``D`` the disk; ``a b c`` corners of a triangle, ab its base; ``z = (c-a)/(b-a)``.
"""

import numpy as np
from numpy.typing import NDArray

from experiments.claims.ledger import Finding, Numbers, claim
from experiments.claims.rules import every, more, more_pairs
from experiments.claims.shared import PARAMETERS
from experiments.lengths import beyond
from experiments.measures import hung, slid
from experiments.store import rng_for
from experiments.subjects import shape
from tween import Morph, Triangulation, area_matrix, paper_morph, triangulate
from tween.choices import Path
from tween.morphing.compatible.paths import slides, third_vertices


@claim(
    "5",
    '"This simple procedure also converges to the target shape when t = 1, despite the intermediate transformation D."',
    "every",
    "a curve to its disk; at t = 1 - 1e-9 within a millionth of the target's size",
    (
        "tests/morphing/test_strategy.py::test_it_leads_exactly_from_source_to_target",
        "tests/morphing/incompatible/test_flow.py::test_the_ends_are_exactly_the_shapes_that_were_given",
        "experiments/claims/section_5.py",
    ),
)
def reaches_the_target(x: Numbers) -> Finding:
    near = (x.curves.gap_before_end < 1e-6).sum()
    return Finding(f"{near} of {len(x.curves)} curves", (every(near, len(x.curves)),))


def at_the_end(m: Morph) -> dict[str, float]:
    """How near the target the shape is just before the end."""
    D = m.target.points
    return {"gap_before_end": float(np.abs(m.at([1 - 1e-9])[0] - D).max() / np.ptp(D))}


@claim(
    "5 (Figure 7)",
    'Slide "ensures that the length of the (propagation) edge that is the base edge of a child is always between the '
    'lengths of the corresponding source and target edges."',
    "every",
    "a propagation edge on the way to the disk; its length leaves the range by no more than 1 %",
    (
        "tests/morphing/test_strategy.py::test_slide_keeps_propagation_edges_monotone_relative_to_their_base",
        "experiments/claims/section_5.py",
    ),
    figure="figure_07_paths.png",
    condition="the length in proportion to the triangle's base, which itself changes",
)
def slide_keeps_lengths_between(x: Numbers) -> Finding:
    slide, shrink = x.checks["slide"], x.curves.non_monotone.sum()
    edges, relative, outside = slide[["edges", "relative", "outside"]].sum()
    return Finding(
        f"as printed, {outside:,} of {edges:,} edges leave the range by more than 1 %, up to "
        f"{slide.farthest.max():.0f}-fold; in proportion to the base {relative} do (along linear {shrink:,} shrink "
        f"and grow again)",
        (every(edges - outside, edges),),
        (every(edges - relative, edges),),
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


@claim(
    "5",
    '"The above method works even if both edges incident on the third vertex are propagation edges. In this case, at '
    'most one of these edges will have non-monotonic changes in its length during linear morph"',
    "every",
    "a random pair of third vertices, or a triangle of our curves with two propagation edges; one length at most is "
    "not monotone",
    (
        "tests/morphing/compatible/test_paths.py::test_both_edges_can_be_non_monotone_and_both_are_kept",
        "experiments/claims/section_5.py",
    ),
    figure="figure_07_paths.png",
)
def at_most_one_non_monotone(x: Numbers) -> Finding:
    both = x.checks["thirds"].both / x.checks["thirds"].pairs
    two, found = x.curves.two_edges.sum(), x.curves.two_non_monotone.sum()
    thirds = x.checks["thirds"]
    return Finding(
        f"both are not for {both['uniform']:.0%} of pairs of third vertices spread over the base, "
        f"{both['normal']:.0%} of pairs of triangles with normal coordinates; on our curves, remeshed, for {found} of "
        f"{two}",
        (
            every(thirds.pairs.sum() - thirds.both.sum(), thirds.pairs.sum(), "at random"),
            every(two - found, two, "our curves"),
        ),
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


def draw_thirds(spread: str) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Pairs of third vertices over a base from 0 to 1, at random: spread over it, or of triangles of normal corners."""
    rng, size = rng_for(PARAMETERS["seed"], spread), PARAMETERS["thirds"]
    if spread == "uniform":
        z1, z2 = (rng.uniform(-3, 4, size) + 1j * rng.exponential(1, size) for _ in range(2))
    else:
        a, b, c = rng.standard_normal((3, 2, size)) + 1j * rng.standard_normal((3, 2, size))
        z1, z2 = (z.real + 1j * np.abs(z.imag) for z in (c - a) / (b - a))
    return z1, z2


def third_vertices_at_random(spread: str) -> dict[str, int]:
    """Pairs of third vertices: how many lengths a straight path shortens and lengthens, and what "slide" spares."""
    z1, z2 = draw_thirds(spread)
    size = len(z1)
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
    '"Our method not only makes the length variation monotonic for the propagation edge that it is applied to, but '
    'also preserves monotonicity of the length of the other propagation edge."',
    "every",
    "a random pair of third vertices for which just one edge is not monotone; the other one stays monotone",
    (
        "tests/morphing/compatible/test_paths.py::test_slide_keeps_many_random_lengths_monotone",
        "experiments/claims/section_5.py",
    ),
    figure="figure_07_paths.png",
)
def slide_spares_the_other_edge(x: Numbers) -> Finding:
    one, kept = x.checks["thirds"].one.sum(), x.checks["thirds"].kept.sum()
    return Finding(f"{kept:,} of {one:,} pairs", (every(kept, one),))


@claim(
    "5",
    '"While a linear interpolation of the third vertex is better at preserving or smoothly interpolating the areas of '
    'the triangles, it can adversely affect the transformations of its children."',
    "more",
    "a curve to its disk; areas are nearer to linear change along linear than along slide",
    ("experiments/claims/section_5.py",),
    figure="figure_08_linear_slide.png",
)
def linear_preserves_areas(x: Numbers) -> Finding:
    linear, slide = (x.checks[path].uneven for path in ("linear", "slide"))
    nearer, farther = (linear < slide * (1 - 1e-6)).sum(), (slide < linear * (1 - 1e-6)).sum()
    by = (slide / linear - 1).median()
    return Finding(
        f"nearer on {nearer} of {len(linear)} curves, but only by {by:.0%} in the median: together areas are off by "
        f"{linear.median():.2f} (linear) and {slide.median():.2f} (slide) times the whole area",
        (more(nearer, farther),),
    )


@claim(
    "5 (Figure 8)",
    '"Our above modified path is better at achieving predictable variations of the edge lengths, and thus isolates the '
    'side-effects of transformation of the parent from propagating to the children"',
    "more",
    "a curve to its disk; fewer propagation edges leave the range of their two lengths along slide than along linear",
    ("experiments/claims/section_5.py",),
    figure="figure_08_linear_slide.png",
    condition='edges that shrink, as in Figure 8 ("the shrinkage in shape"), not edges that grow',
)
def slide_isolates(x: Numbers) -> Finding:
    linear, slide = (x.checks[path][["shorter", "outside"]] for path in ("linear", "slide"))
    signs = np.sign(slide - linear)
    fewer, more_of = (signs < 0).sum(), (signs > 0).sum()
    return Finding(
        f"edges shorter or longer than at both ends: fewer along slide on {fewer.outside} of {len(signs)} curves, "
        f"more on {more_of.outside}; shorter: fewer on {fewer.shorter}, more on {more_of.shorter}",
        (more(fewer.outside, more_of.outside),),
        (more(fewer.shorter, more_of.shorter),),
    )


@claim(
    "5",
    '"At the end of the morphing process, the entire source and target self-overlapping curves differ only by '
    "transformation D of the root node, which is also smoothly interpolated through the morphing sequence in order to "
    'become the target root triangle."',
    "every",
    "a pair of curves along slide, placed by the root; the whole area stays within 1 % of the larger end's",
    ("experiments/studies/pairs.py", "experiments/studies/matching.py"),
    figure="matching_study.png",
    condition="shapes are placed steadily, which makes the whole area change linearly, instead of by the root",
)
def root_keeps_sizes(x: Numbers) -> Finding:
    slide = x.table("pairs").query("path == 'slide'")
    steady = x.table("matching").query("method == 'paper_guaranteed'").swelling
    inside = slide.swelling <= 1.01
    return Finding(
        f"placed by the root, {(~inside).sum()} of {len(slide)} pairs swell beyond the larger end, to "
        f"{slide.swelling.median():.2f} times its area in the median, above 10 on {(slide.swelling > 10).sum()}; "
        f"placed steadily {(steady > 1.01).sum()} do",
        (every(inside.sum(), len(slide)),),
        (every((steady <= 1.01).sum(), len(steady)),),
    )


@claim(
    "5 (Figure 8)",
    '"The shrinkage in shape in the top row is highlighted with red circles, showing that rotation and sliding is '
    'better than simple interpolation."',
    "more",
    "a pair of curves, placed by the root; along slide the edge that shrinks most below both its ends shrinks less "
    "than along linear",
    ("experiments/studies/pairs.py",),
    figure="figure_08_linear_slide.png",
)
def slide_shrinks_less(x: Numbers) -> Finding:
    wide = x.table("pairs").pivot(index=["source", "target"], columns="path")
    shortest, longest = wide["shortest"], wide["longest"]
    less = np.sign(shortest.slide - shortest.linear)
    return Finding(
        f"less on {(less > 0).sum()} of {len(wide)} pairs, more on {(less < 0).sum()}; the edge that shrinks most "
        f"shrinks to {shortest.slide.median():.2g} of the smaller of its two final lengths along slide and to "
        f"{shortest.linear.median():.2g} along linear, the one that grows most grows "
        f"{longest.slide.median():.2g}-fold and {longest.linear.median():.2g}-fold, in the median; "
        f"placed steadily {wide['longest_steady'].slide.median():.2g}-fold and "
        f"{wide['longest_steady'].linear.median():.2g}-fold",
        (more_pairs(shortest.slide - shortest.linear),),
    )
