"""Morphs of compatible triangulations."""

from itertools import product

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
    NotSelfOverlappingError,
    Triangulation,
    TweenError,
    decompose,
    morph,
    remesh,
    triangulate,
)
from tween.choices import PATHS
from tween.errors import IncompatibleError
from tween.gallery import curve, letter, names, random_disk
from tween.geometry.dual_tree import disk_center
from tween.geometry.predicates import orient2d
from tween.morphing import strategy

ELL = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]
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
        m = morph(S, U, path=path, root=root)
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
        there, back = (morph(*ends, path=path, root=root).at(t) for ends, t in (((S, U), TIMES), ((U, S), 1 - TIMES)))
        np.testing.assert_allclose(there, back, atol=1e-9 * max(size(S), size(U)))


def shift_of_source_alone(S: Triangulation, U: Triangulation, shift: complex, **options) -> NDArray[np.float64]:
    """Return the shapes when the source starts elsewhere, minus what that should add to them."""
    z = complex_of(morph(moved(S, 1, shift), U, **options).at(TIMES))
    return points_of(z - np.outer(1 - TIMES, np.full(len(S), shift)))


@every_path
@every_root
@every_shape
def test_a_source_that_starts_elsewhere_is_brought_evenly(T: Triangulation, path, root) -> None:
    # Which of the two shapes the motion is computed from depends on where they lie: both directions run here.
    for S, U in pairs(T):
        plain = morph(S, U, path=path, root=root).at(TIMES)
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


@every_path
@every_root
@every_shape
def test_every_triangle_stays_counter_clockwise(T: Triangulation, path, root) -> None:
    for S, U in pairs(T):
        m = morph(S, U, path=path, root=root)
        frames = m.frames(40)
        assert (orient2d(*np.moveaxis(frames[:, m.triangles_at(0.5)], 2, 0)) > 0).all()


@given(disks(3, 30), st.sampled_from(PATHS), st.floats(0, 1))
def test_any_frame_has_counter_clockwise_triangles_by_fractions(T: Triangulation, path, t: float) -> None:
    p = oracle.integers(morph(T, T.on_disk(), path=path)(t))
    assert {oracle.orient2d(*(p[v] for v in triangle)) for triangle in T.triangles} == {1}


@every_path
@every_shape
def test_it_follows_a_similarity_of_both_shapes(T: Triangulation, path) -> None:
    for (S, U), factor in product(pairs(T)[:3], (0.01, 1j, 3 - 4j)):
        plain = complex_of(morph(S, U, path=path).at(TIMES))
        other = complex_of(morph(moved(S, factor, 5j), moved(U, factor, 5j), path=path).at(TIMES))
        np.testing.assert_allclose(other, factor * plain + 5j, atol=1e-8 * abs(factor) * max(size(S), size(U), 1))


@every_path
@every_shape
def test_a_similarity_of_the_target_alone_leaves_every_shape_on_the_way(T: Triangulation, path) -> None:
    S, U = T, T.on_disk()
    plain = same_shape(complex_of(morph(S, U, path=path).at(TIMES)))
    for factor in (1j, -1, 0.8 - 0.6j if path in ("area", "metric") else 2 - 1j):  # those two know lengths
        other = same_shape(complex_of(morph(S, moved(U, factor, 9), path=path).at(TIMES)))
        np.testing.assert_allclose(other, plain, atol=1e-7 * abs(plain).max())


@every_path
@every_root
@every_shape
def test_a_moved_copy_is_reached_by_a_rigid_motion(T: Triangulation, path, root) -> None:
    frames = morph(T, moved(T, np.exp(2j), 4 + 1j), path=path, root=root).at(TIMES)
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
        ratios = propagation_ratios(T, morph(T, T.on_disk(), path=path, root=root).frames(60), root)
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
        centres = complex_of(morph(S, U, path=path, root=5).at(TIMES))[:, corners].mean(axis=1)
        np.testing.assert_allclose(centres, (1 - TIMES) * centres[0] + TIMES * centres[-1], atol=1e-9)


# Calls


def test_a_curve_stands_for_its_remeshed_triangulation() -> None:
    from_points, from_curves, from_triangulations = (
        morph(shape, triangulate(ELL).on_disk()) for shape in (ELL, Curve(ELL), remesh(decompose(ELL).arbitrary()))
    )
    for m in (from_curves, from_triangulations):
        np.testing.assert_array_equal(m.frames(5), from_points.frames(5))
    T = decompose(ELL).arbitrary()
    assert triangulate(T) is T
    assert morph(ELL, ELL).triangles_at(0).tolist() == triangulate(ELL).triangles.tolist()


@pytest.mark.parametrize("shift", [1, 11, 29])
def test_a_target_that_is_numbered_from_another_vertex_is_matched(shift: int) -> None:
    for T in some_disks[:3]:
        U = T.on_disk()
        plain, m = morph(T, U), morph(T, U.rolled(shift))
        np.testing.assert_array_equal(m.frames(5), plain.frames(5))
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


# Errors

# Each has one triangulation, of other degrees than the other's.
TRIPOD = [(4, 3), (4, 6), (2, 6), (4, 0), (4, 1), (6, 3)]
FAN = [(0, -10), (2, 4), (1, 1), (0, 0), (-1, 1), (-2, 4)]


@pytest.mark.parametrize(
    ("source", "target", "options", "error", "message"),
    [
        (ELL, EIGHT, {}, NotSelfOverlappingError, "the target bounds no immersed disk: turning number is 0, not 1"),
        (EIGHT, ELL, {}, NotSelfOverlappingError, "the source bounds no immersed disk: turning number is 0, not 1"),
        (TRIPOD, FAN, {"strategy": "common"}, IncompatibleError, "no common triangulation"),
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
        first = _distances(morph(T, D, path=path, root=0)(t))
        for root in (5, 17, "disk-center", "tree-center"):
            other = _distances(morph(T, D, path=path, root=root)(t))
            scale = 1.0 if path == "metric" else first.max() / other.max()
            np.testing.assert_allclose(scale * other, first, atol=1e-9 * first.max())


@pytest.mark.parametrize("path", ["linear", "slide", "area"])
def test_along_the_other_paths_the_root_matters(path) -> None:
    T = triangulate(curve("horseshoe"))
    D = T.on_disk()
    first, other = (_distances(morph(T, D, path=path, root=root)(0.5)) for root in (0, 17))
    scale = first.max() / other.max()
    assert np.abs(scale * other - first).max() > 1e-3 * first.max()


# What "auto" takes upon itself


def test_of_many_vertices_auto_tries_one_correspondence(monkeypatch: pytest.MonkeyPatch) -> None:
    pair = curve("arrow"), letter("c")  # common triangulations, but not as the pivots have it
    assert not morph(*pair).events
    monkeypatch.setattr(strategy, "_MOST_RENUMBERED", 20)
    assert morph(*pair).events
    assert not morph(*pair, strategy="common").events


def test_between_large_convex_polygons_auto_flips_rather_than_fills_the_memory() -> None:
    angle = 2 * np.pi * np.arange(600) / 600
    wide = np.stack([2 * np.cos(angle), np.sin(angle)], axis=1)
    egg = np.stack([np.cos(angle), 1.5 * np.sin(angle) + 0.1 * np.cos(3 * angle)], axis=1)
    m = morph(wide, egg)
    assert m.events
    np.testing.assert_array_equal(m(1.0), m.target.points)
