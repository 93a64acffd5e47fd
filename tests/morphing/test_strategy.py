"""Morphs of compatible triangulations, and what `morph` and `paper_morph` make of curves."""

from dataclasses import replace
from itertools import product
from types import SimpleNamespace
from typing import Any

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from strategies import disks

from tween import (
    Curve,
    CurveError,
    Match,
    Morph,
    NotSelfOverlappingError,
    Triangulation,
    TweenError,
    certify,
    decompose,
    match,
    morph,
    paper_morph,
    remesh,
    triangulate,
)
from tween.choices import PATHS, Path, Root
from tween.errors import GuaranteeError, IncompatibleError
from tween.gallery import curve, fan, letter, names, random_disk
from tween.geometry.dual_tree import disk_center
from tween.geometry.predicates import orient2d
from tween.morphing import correspondence, strategy
from tween.morphing.strategy import morph_compatible

ELL = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]
# Each has one triangulation, of other degrees than the other's.
TRIPOD = [(4, 3), (4, 6), (2, 6), (4, 0), (4, 1), (6, 3)]
FAN = [(0, -10), (2, 4), (1, 1), (0, 0), (-1, 1), (-2, 4)]
TIMES = np.array([0.0, 0.1, 0.25, 0.5, 0.7, 0.9, 1.0])
ROOTS = ["disk-center", "tree-center", 0, 7]


def complex_of(points: NDArray[np.float64]) -> NDArray[np.complex128]:
    return points @ np.array([1, 1j])


def points_of(z: NDArray[np.complex128]) -> NDArray[np.float64]:
    return np.stack([z.real, z.imag], axis=-1)


def moved(T: Triangulation, factor: complex, shift: complex = 0) -> Triangulation:
    return Triangulation(points_of(factor * complex_of(T.points) + shift), T.triangles)


def same_shape(z: NDArray[np.complex128], k: int = 1) -> NDArray[np.complex128]:
    """Forget place, size and direction of each row: vertex 0 goes to 0, vertex k to 1."""
    return (z - z[..., :1]) / (z[..., k : k + 1] - z[..., :1])


def size(T: Triangulation) -> float:
    return float(np.ptp(T.points, axis=0).max())


def rooted(S: Triangulation, U: Triangulation, path: Path = "slide", root: Root = "disk-center") -> Morph:
    """The paper's morph along any path: no guarantee, placed by the root."""
    return morph_compatible(S, U, path, guarantee=False, placement="root", root=root)


def pairs(T: Triangulation) -> list[tuple[Triangulation, Triangulation]]:
    """Return shapes with the same triangles to morph between."""
    sheared = Triangulation(T.points @ [[1.0, 0.3], [-0.9, 1.4]], T.triangles)
    return [(T, T.on_disk()), (T, T.on_disk("uniform")), (sheared, moved(T, -2 + 0.5j, 3)), (T, moved(T, -1))]


some_disks = [remesh(random_disk(30, np.random.default_rng(seed))) for seed in range(6)]
some_curves = [triangulate(curve(name)) for name in ("arrow", "horseshoe", "five_disks", "spiral_2")]
SHAPES = [pytest.param(T, id=f"disk-{i}") for i, T in enumerate(some_disks)]
SHAPES += [
    pytest.param(T, id=name)
    for name, T in zip(("arrow", "horseshoe", "five_disks", "spiral_2"), some_curves, strict=True)
]

every_shape = pytest.mark.parametrize("T", SHAPES)
every_path = pytest.mark.parametrize("path", PATHS)
every_root = pytest.mark.parametrize("root", ROOTS)


# Frames


@every_path
@every_root
@every_shape
def test_it_leads_exactly_from_source_to_target(T: Triangulation, path, root) -> None:
    for S, U in pairs(T):
        m = rooted(S, U, path=path, root=root)
        frames = m.frames(7)
        assert frames.shape == (7, len(T), 2)
        np.testing.assert_array_equal(frames[0], S.points)
        np.testing.assert_array_equal(frames[-1], U.points)
        near = m.at([1e-12, 1 - 1e-12])
        np.testing.assert_allclose(near[0], S.points, atol=1e-8 * size(S))
        np.testing.assert_allclose(near[1], U.points, atol=1e-8 * size(U))


@every_path
@every_root
@every_shape
def test_the_way_back_is_the_way_there(T: Triangulation, path, root) -> None:
    for S, U in pairs(T):
        there, back = (rooted(*ends, path=path, root=root).at(t) for ends, t in (((S, U), TIMES), ((U, S), 1 - TIMES)))
        np.testing.assert_allclose(there, back, atol=1e-9 * max(size(S), size(U)))


def shift_of_source_alone(S: Triangulation, U: Triangulation, shift: complex, **options) -> NDArray[np.float64]:
    """Return the shapes when the source starts elsewhere, minus what that should add to them."""
    z = complex_of(rooted(moved(S, 1, shift), U, **options).at(TIMES))
    return points_of(z - np.outer(1 - TIMES, np.full(len(S), shift)))


@every_path
@every_root
@every_shape
def test_a_source_that_starts_elsewhere_is_brought_evenly(T: Triangulation, path, root) -> None:
    # Which of the two shapes the motion is computed from depends on where they lie: both directions run here.
    for S, U in pairs(T):
        plain = rooted(S, U, path=path, root=root).at(TIMES)
        for shift in (-64, 64):
            other = shift_of_source_alone(S, U, shift, path=path, root=root)
            np.testing.assert_allclose(other, plain, atol=1e-9 * max(size(S), size(U), 64))


ROOT = [(0.0, 0.0), (2.0, 0.0), (0.0, 1.0)]


@pytest.mark.parametrize("vertex", range(3))
def test_a_root_that_turns_by_half_a_turn_turns_the_same_way_from_both_ends(vertex: int) -> None:
    T = Triangulation(np.roll(ROOT, vertex, axis=0), [(0, 1, 2)])
    ways = [shift_of_source_alone(T, moved(T, -3), shift) for shift in (0, 8)]
    np.testing.assert_allclose(ways[0], ways[1], atol=1e-12)


@pytest.mark.parametrize(
    ("tilt", "rounding"),
    [(0, 1e-16), (0, 1e-12), (1e-12, 1e-12), (-2.4e-9, 1.6e-9)],
)
def test_a_root_that_turns_by_half_a_turn_up_to_rounding_turns_the_same_way_from_both_ends(tilt, rounding) -> None:
    T = Triangulation([(0, 0), (2, tilt), (0, 1)], [(0, 1, 2)])
    U = Triangulation([(0, 0), (-2, rounding), (0, -1)], [(0, 1, 2)])
    ways = [shift_of_source_alone(T, U, shift) for shift in (0, 8)]
    np.testing.assert_allclose(ways[0], ways[1], atol=1e-9)


def steps(m: Morph) -> NDArray[np.float64]:
    """Root mean square of the ways of the vertices from frame to frame, over their mean."""
    ways = np.sqrt((np.diff(m.frames(200), axis=0) ** 2).sum(axis=2).mean(axis=1))
    return ways / ways.mean()


@every_path
@every_shape
def test_at_speed_the_vertices_of_a_morph_without_flips_are_always_equally_fast(T: Triangulation, path) -> None:
    own, even = (
        morph_compatible(T, T.on_disk(), path, guarantee=False, placement="root", pace=pace)
        for pace in ("auto", "speed")
    )
    assert np.abs(steps(even) - 1).max() < 0.1
    assert np.array_equal(even(0.0), own(0.0)) and np.array_equal(even(1.0), own(1.0))


def test_a_guarantee_holds_at_every_pace() -> None:
    T = triangulate(curve("horseshoe"))
    own, even = (morph(T, T.on_disk(), pace=pace) for pace in ("time", "speed"))
    assert own.proof == even.proof != "" and certify(even).valid
    assert np.abs(own.frames(9) - even.frames(9)).max() > 0.01


@every_path
@every_root
@every_shape
def test_every_triangle_stays_counter_clockwise(T: Triangulation, path, root) -> None:
    for S, U in pairs(T):
        m = rooted(S, U, path=path, root=root)
        frames = m.frames(40)
        assert (orient2d(*np.moveaxis(frames[:, m.triangles_at(0.5)], 2, 0)) > 0).all()


@given(disks(3, 30), st.sampled_from(PATHS), st.floats(0, 1))
def test_any_frame_has_counter_clockwise_triangles_by_fractions(T: Triangulation, path, t: float) -> None:
    p = oracle.integers(rooted(T, T.on_disk(), path=path)(t))
    assert {oracle.orient2d(*(p[v] for v in triangle)) for triangle in T.triangles} == {1}


@every_path
@every_shape
def test_it_follows_a_similarity_of_both_shapes(T: Triangulation, path) -> None:
    for (S, U), factor in product(pairs(T)[:3], (0.01, 1j, 3 - 4j)):
        plain = complex_of(rooted(S, U, path=path).at(TIMES))
        other = complex_of(rooted(moved(S, factor, 5j), moved(U, factor, 5j), path=path).at(TIMES))
        np.testing.assert_allclose(other, factor * plain + 5j, atol=1e-8 * abs(factor) * max(size(S), size(U), 1))


@every_path
@every_shape
def test_a_similarity_of_the_target_alone_leaves_every_shape_on_the_way(T: Triangulation, path) -> None:
    S, U = T, T.on_disk()
    plain = same_shape(complex_of(rooted(S, U, path=path).at(TIMES)))
    for factor in (1j, -1, 0.8 - 0.6j if path in ("area", "metric") else 2 - 1j):  # those two know lengths
        other = same_shape(complex_of(rooted(S, moved(U, factor, 9), path=path).at(TIMES)))
        np.testing.assert_allclose(other, plain, atol=1e-7 * abs(plain).max())


@every_path
@every_root
@every_shape
def test_a_moved_copy_is_reached_by_a_rigid_motion(T: Triangulation, path, root) -> None:
    frames = rooted(T, moved(T, np.exp(2j), 4 + 1j), path=path, root=root).at(TIMES)
    z = complex_of(frames)
    np.testing.assert_allclose(
        same_shape(z), np.tile(same_shape(z[0]), (len(TIMES), 1)), atol=1e-8 * abs(same_shape(z[0])).max()
    )
    lengths = abs(z[:, 1] - z[:, 0])
    np.testing.assert_allclose(lengths, lengths[0], rtol=1e-9)
    areas = [Triangulation(frame, T.triangles).areas for frame in frames]
    np.testing.assert_allclose(areas, np.tile(T.areas, (len(TIMES), 1)), rtol=1e-8)


def propagation_ratios(T: Triangulation, frames: NDArray[np.float64], root: int) -> list[NDArray[np.float64]]:
    """Return, for each edge shared with a child, its length over that of its triangle's base, in each frame."""
    z, corners = complex_of(frames), [set(t) for t in T.triangles.tolist()]
    depth = oracle.distances(T.triangles, root)
    ratios = []
    for t, s in T.dual.tolist():
        child, parent = (t, s) if depth[t] > depth[s] else (s, t)
        if parent == root:
            continue
        grandparent = next(
            g for g in range(len(corners)) if len(corners[g] & corners[parent]) == 2 and depth[g] < depth[parent]
        )
        (a, b), (c, d) = corners[parent] & corners[child], corners[parent] & corners[grandparent]
        ratios.append(abs(z[:, a] - z[:, b]) / abs(z[:, c] - z[:, d]))
    return ratios


@every_shape
def test_slide_keeps_propagation_edges_monotone_relative_to_their_base(T: Triangulation) -> None:
    monotone = {}
    for path in PATHS:
        root = disk_center(T, T.on_disk())
        ratios = propagation_ratios(T, rooted(T, T.on_disk(), path=path, root=root).frames(60), root)
        assert len(ratios) > len(T) - 8
        steps = [np.diff(r) / r.max() for r in ratios]
        monotone[path] = [bool((s >= -1e-9).all() or (s <= 1e-9).all()) for s in steps]
    assert all(monotone["slide"])
    assert not all(monotone["linear"])


@every_path
def test_the_root_triangle_moves_evenly(path) -> None:
    T = some_disks[0]
    for S, U in pairs(T)[:3]:
        corners = T.triangles[5]
        centres = complex_of(rooted(S, U, path=path, root=5).at(TIMES))[:, corners].mean(axis=1)
        np.testing.assert_allclose(centres, (1 - TIMES) * centres[0] + TIMES * centres[-1], atol=1e-9)


# Calls


def test_a_curve_stands_for_its_remeshed_triangulation() -> None:
    from_points, from_curves, from_triangulations = (
        paper_morph(shape, triangulate(ELL).on_disk())
        for shape in (ELL, Curve(ELL), remesh(decompose(ELL).arbitrary()))
    )
    for m in (from_curves, from_triangulations):
        np.testing.assert_array_equal(m.frames(5), from_points.frames(5))
    T = decompose(ELL).arbitrary()
    assert triangulate(T) is T
    assert paper_morph(ELL, ELL).triangles_at(0).tolist() == triangulate(ELL).triangles.tolist()


@pytest.mark.parametrize("shift", [1, 11, 29])
def test_a_target_that_is_numbered_from_another_vertex_is_matched(shift: int) -> None:
    for T in some_disks[:3]:
        U = T.on_disk()
        plain, m = morph(T, U), morph(T, U.rolled(shift))
        np.testing.assert_allclose(m.frames(5), plain.frames(5), rtol=0, atol=1e-12)
        np.testing.assert_array_equal(m.target_vertices, (np.arange(30) - shift) % 30)
        np.testing.assert_array_equal(U.rolled(shift).points[m.target_vertices], m.target.points)
        np.testing.assert_array_equal(m.source_vertices, np.arange(30))


def test_a_target_that_lists_its_triangles_in_another_order_is_matched() -> None:
    T = some_disks[0]
    U = Triangulation(T.on_disk().points, np.roll(T.triangles[::-1], 1, axis=1))
    np.testing.assert_array_equal(morph(T, U).frames(5), morph(T, T.on_disk()).frames(5))


@pytest.mark.parametrize("name", names())
def test_gallery_curves_morph_to_the_disk(name: str) -> None:
    T = triangulate(curve(name))
    m = morph(T, T.on_disk())
    assert (orient2d(*np.moveaxis(m.frames(20)[:, T.triangles], 2, 0)) > 0).all()


# The best morph there is


def drawn(n: int, seed: int) -> Curve:
    return random_disk(n, np.random.default_rng(seed)).curve


SMALL = [
    pytest.param(Curve(ELL), Curve(TRIPOD), id="ell-tripod"),
    pytest.param(Curve(TRIPOD), Curve(FAN), id="tripod-fan"),
    *(pytest.param(drawn(9, seed), drawn(14, 50 + seed), id=f"disks-{seed}") for seed in range(4)),
    pytest.param(drawn(36, 1), drawn(30, 2), id="by-levels"),
]
every_small_pair = pytest.mark.parametrize(("source", "target"), SMALL)


def check_ends(m: Morph, source: Curve, target: Curve) -> None:
    """Every vertex is where it was, in order, and what was inserted lies on an edge."""
    ends = ((m(0.0), m.source_vertices, source), (m(1.0), m.target_vertices, target))
    for shape, rows, given_curve in ends:
        own = rows >= 0
        np.testing.assert_array_equal(shape[own], given_curve.points[rows[own]])
        start = int(np.flatnonzero(rows == 0)[0])
        in_order = np.roll(rows, -start)
        assert in_order[in_order >= 0].tolist() == list(range(len(given_curve)))
        for v in np.flatnonzero(in_order < 0):
            before = int(in_order[:v].max())
            p, q = given_curve.points[before], given_curve.points[(before + 1) % len(given_curve)]
            z = np.roll(shape, -start, axis=0)[v]
            assert np.hypot(*(z - p)) + np.hypot(*(q - z)) == pytest.approx(np.hypot(*(q - p)), rel=1e-12)


@every_small_pair
def test_a_morph_leads_exactly_from_one_curve_to_the_other_and_says_which_vertex_is_which(source, target) -> None:
    m = morph(source, target)
    check_ends(m, source, target)
    assert ((m.source_vertices >= 0) | (m.target_vertices >= 0)).all()
    assert m.source_vertices[0] == 0


@every_small_pair
def test_a_matched_morph_flips_nothing_and_every_shape_is_certified(source, target) -> None:
    m = morph(source, target)
    assert m.events == [] and (m.u, m.v) == (None, None)
    np.testing.assert_array_equal(m.source.canonical, m.target.canonical)
    assert m.proof
    assert certify(m, frames=61).valid


@every_small_pair
def test_a_morph_is_symmetric(source, target) -> None:
    there, back = morph(source, target), morph(target, source)
    start = int(np.flatnonzero(back.target_vertices == 0)[0])
    returned = np.roll(back.at(1 - TIMES), -start, axis=1)
    np.testing.assert_allclose(there.at(TIMES), returned, rtol=0, atol=1e-9 * np.ptp(target.points))
    np.testing.assert_array_equal(np.roll(back.source_vertices, -start), there.target_vertices)


def test_auto_is_matched_where_that_needs_no_flips() -> None:
    source, target = SMALL[2].values
    first, other = (morph(source, target, strategy=s).frames(5) for s in ("auto", "matched"))
    np.testing.assert_array_equal(first, other)
    found = match(source, target)
    np.testing.assert_array_equal(first[[0, -1]], [found.source.points, found.target.points])


@pytest.mark.parametrize("strategy", ["auto", "matched"])
def test_vertices_that_have_to_correspond_do(strategy) -> None:
    source, target = drawn(9, 0), drawn(14, 50)
    plain = morph(source, target)
    both = np.flatnonzero((plain.source_vertices >= 0) & (plain.target_vertices >= 0))
    v = int(both[0]) if len(both) else 0
    pair = (max(0, int(plain.source_vertices[v])), max(0, int(plain.target_vertices[v])))
    m = morph(source, target, strategy=strategy, landmarks=[pair])
    assert m.target_vertices[m.source_vertices == pair[0]].tolist() == [pair[1]]
    check_ends(m, source, target)


def test_where_a_match_is_not_complete_flips_do_the_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    source, target = SMALL[2].values

    def incomplete(*shapes: Any) -> Match:
        found = match(*shapes)
        return replace(found, source=remesh(found.source), target=remesh(found.target), complete=False)

    monkeypatch.setattr(strategy, "match", incomplete)
    m = morph(source, target, strategy="matched")
    assert m.events
    check_ends(m, source, target)
    for t, shape in zip(TIMES, m.at(TIMES), strict=True):
        assert (orient2d(*np.moveaxis(shape[m.triangles_at(t)], 1, 0)) > 0).all()


def test_two_compatible_triangulations_keep_their_triangles() -> None:
    T = some_disks[0]
    m = morph(T, T.on_disk())
    np.testing.assert_array_equal(m.triangles_at(0.5), T.triangles)
    np.testing.assert_array_equal(m.source_vertices, np.arange(len(T)))


# The paper's morph


def test_the_paper_s_morph_asks_for_no_order_of_the_two_shapes(monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*_: Any) -> bool:
        raise AssertionError

    monkeypatch.setattr(strategy, "comes_later", refused)
    T = some_disks[0]
    for source, target in ((T, T.on_disk()), (curve("arrow"), curve("ell")), (curve("ell"), curve("arrow"))):
        m = paper_morph(source, target)
        np.testing.assert_array_equal(m.at([0.0, 1.0]), [m.source.points, m.target.points])


@every_shape
def test_the_paper_s_morph_is_symmetric_where_it_does_not_flip(T: Triangulation) -> None:
    for S, U in pairs(T):
        there, back = paper_morph(S, U), paper_morph(U, S)
        returned = np.roll(back.at(1 - TIMES), -there.alignment.shift, axis=1)
        np.testing.assert_allclose(there.at(TIMES), returned, atol=1e-9 * max(size(S), size(U)))


def test_the_paper_s_morph_promises_nothing_and_breaks_the_fan() -> None:
    m = paper_morph(*fan())
    assert m.proof == ""
    assert not certify(m).valid
    assert certify(morph(*fan())).valid


@pytest.mark.parametrize("path", ["slide", "linear"])
def test_the_paper_s_morph_is_placed_by_the_root(path) -> None:
    T = some_disks[0]
    corners = T.triangles[5]
    centres = complex_of(paper_morph(T, T.on_disk(), path, 5).at(TIMES))[:, corners].mean(axis=1)
    np.testing.assert_allclose(centres, (1 - TIMES) * centres[0] + TIMES * centres[-1], atol=1e-9)


def test_the_paper_s_flips_wait_for_each_other_in_sequence() -> None:
    source, target = curve("arrow"), curve("ell")
    m = paper_morph(source, target)
    np.testing.assert_array_equal(m.frames(5), paper_morph(source, target, order="sequential").frames(5))
    assert m.events != paper_morph(source, target, order="partial").events


# A known correspondence


@every_path
def test_where_the_correspondence_is_known_it_is_the_same_morph(path) -> None:
    for T in some_disks[:2]:
        known, found = morph_compatible(T, T.on_disk(), path), morph(T, T.on_disk(), path)
        np.testing.assert_array_equal(known.frames(7), found.frames(7))
        assert known.proof == found.proof


def test_vertex_i_goes_to_vertex_i_where_the_curve_could_be_turned() -> None:
    square = Triangulation([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)])
    m = morph_compatible(square, moved(square, -1))
    assert m.alignment.shift == 0
    np.testing.assert_array_equal(m(1.0), -square.points)


def test_other_triangles_are_refused_where_the_correspondence_is_known() -> None:
    square = Triangulation([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)])
    with pytest.raises(IncompatibleError, match="have different triangles"):
        morph_compatible(square, square.rolled(1))


# Errors


@pytest.mark.parametrize(
    ("source", "target", "options", "error", "message"),
    [
        (ELL, EIGHT, {}, NotSelfOverlappingError, "the target bounds no immersed disk: turning number is 0, not 1"),
        (EIGHT, ELL, {}, NotSelfOverlappingError, "the source bounds no immersed disk: turning number is 0, not 1"),
        (TRIPOD, FAN, {"strategy": "common"}, IncompatibleError, "no common triangulation"),
        (
            ELL,
            ELL,
            {"strategy": "both"},
            ValueError,
            "strategy is 'both', expected one of auto, matched,",
        ),
        (ELL, ELL, {"placement": "even"}, ValueError, "placement is 'even', expected one of steady, root"),
        (ELL, ELL, {"pace": "even"}, ValueError, "pace is 'even', expected one of auto, time, speed"),
        (
            ELL,
            ELL,
            {"strategy": "paper", "landmarks": [(0, 0)]},
            ValueError,
            "landmarks are for the strategy",
        ),
        (ELL, [(0, 0), (0, 0), (1, 1)], {}, CurveError, "edge 0-1 has zero length"),
        (ELL, ELL, {"path": "spline"}, ValueError, "path is 'spline', expected one of"),
        (ELL, ELL, {"root": 4}, ValueError, r"root is 4, expected .* from 0 to 3"),
        (ELL, ELL, {"root": -1}, ValueError, "root is -1"),
        (ELL, ELL, {"root": 0.5}, ValueError, r"root is 0\.5"),
        (ELL, ELL, {"root": "middle"}, ValueError, "root is 'middle', expected 'disk-center'"),
    ],
)
def test_what_cannot_be_morphed_is_refused_with_the_reason(source, target, options, error, message: str) -> None:
    with pytest.raises(error, match=message) as caught:
        morph(source, target, **options)
    assert isinstance(caught.value, ValueError)
    if error is not ValueError:
        assert isinstance(caught.value, TweenError)


def _distances(shape: np.ndarray) -> np.ndarray:
    z = shape @ np.array([1, 1j])
    return np.abs(z[:, None] - z[None])


@pytest.mark.parametrize("path", ["metric", "angle"])
def test_whatever_the_root_the_shapes_along_metric_are_congruent_and_along_angle_similar(path) -> None:
    T = triangulate(curve("horseshoe"))
    D = T.on_disk()
    for t in (0.25, 0.5, 0.9):
        first = _distances(rooted(T, D, path=path, root=0)(t))
        for root in (5, 17, "disk-center", "tree-center"):
            other = _distances(rooted(T, D, path=path, root=root)(t))
            scale = 1.0 if path == "metric" else first.max() / other.max()
            np.testing.assert_allclose(scale * other, first, atol=1e-9 * first.max())


@pytest.mark.parametrize("path", ["linear", "slide", "area"])
def test_along_the_other_paths_the_root_matters(path) -> None:
    T = triangulate(curve("horseshoe"))
    D = T.on_disk()
    first, other = (_distances(rooted(T, D, path=path, root=root)(0.5)) for root in (0, 17))
    scale = first.max() / other.max()
    assert np.abs(scale * other - first).max() > 1e-3 * first.max()


# What "auto" does where there is no match, or no guarantee for it


@pytest.fixture
def no_match(monkeypatch: pytest.MonkeyPatch) -> None:
    """As if two shapes had no common triangulation of all their vertices."""
    monkeypatch.setattr(strategy, "match", lambda *shapes: SimpleNamespace(complete=False))


@pytest.mark.usefixtures("no_match")
def test_of_many_vertices_auto_tries_one_correspondence(monkeypatch: pytest.MonkeyPatch) -> None:
    pair = curve("arrow"), letter("c")  # common triangulations, but not as the pivots have it
    assert not morph(*pair).events
    monkeypatch.setattr(correspondence, "_MOST_RENUMBERED", 20)
    assert morph(*pair).events
    assert not morph(*pair, strategy="common").events


@pytest.mark.usefixtures("no_match")
def test_between_large_convex_polygons_auto_flips_rather_than_fills_the_memory() -> None:
    angle = 2 * np.pi * np.arange(600) / 600
    wide = np.stack([2 * np.cos(angle), np.sin(angle)], axis=1)
    egg = np.stack([np.cos(angle), 1.5 * np.sin(angle) + 0.1 * np.cos(3 * angle)], axis=1)
    m = morph(wide, egg, path="slide", guarantee=False)
    assert m.events
    np.testing.assert_array_equal(m(1.0), m.target.points)


def refusing(kinds: int, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Refuse the guarantee of the first morphs that are made, so many; returns the words, to be filled."""
    said: list[str] = []
    given = Morph.guaranteed

    def guaranteed(m: Morph) -> Morph:
        if len(said) < kinds:
            said.append(f"refusal {len(said)}, {len(m.events)} flips")
            raise GuaranteeError(said[-1])
        return given(m)

    monkeypatch.setattr(Morph, "guaranteed", guaranteed)
    return said


@pytest.mark.parametrize("refused", [1, 2])
def test_auto_takes_the_next_strategy_where_a_guarantee_is_refused(
    refused: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    pair, strategies = (curve("arrow"), letter("c")), ["matched", "common", "paper"]
    expected = morph(*pair, strategy=strategies[refused])
    said = refusing(refused, monkeypatch)
    found = morph(*pair)
    assert len(said) == refused
    np.testing.assert_array_equal(found.frames(5), expected.frames(5))
    assert bool(found.events) == (refused == 2)


def test_where_every_strategy_is_refused_the_first_refusal_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    said = refusing(3, monkeypatch)
    with pytest.raises(GuaranteeError, match="refusal 0, 0 flips"):
        morph(curve("arrow"), letter("c"))
    assert len(said) == 3


def test_a_strategy_that_was_asked_for_is_not_left_for_another(monkeypatch: pytest.MonkeyPatch) -> None:
    said = refusing(1, monkeypatch)
    with pytest.raises(GuaranteeError):
        morph(curve("arrow"), letter("c"), strategy="matched")
    assert len(said) == 1
