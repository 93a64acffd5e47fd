"""Recognition, exact counts and uniform samples, against all triangulations of small polygons."""

from collections import Counter
from typing import Any

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import Points, disks, grid_polygons, parabola, polygons, random_polygons

from tween import (
    Curve,
    CurveError,
    Triangulation,
    TweenError,
    decompose,
    gallery,
    remesh,
)
from tween.errors import NotSelfOverlappingError
from tween.gallery import curve, names
from tween.triangulating.flips import locally_delaunay

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]
KINDS = ("scatter", "winding", "grid", "disk", "strip")


def key(T: Triangulation) -> oracle.Triangles:
    return oracle.as_set(T.triangles)


# Answers


@pytest.mark.parametrize("n", [3, 4, 5, 6, 12, 37, 38, 39, 40, 100])
def test_a_convex_polygon_has_a_catalan_number_of_triangulations(n: int) -> None:
    d = decompose(parabola(n))
    assert d.count == oracle.catalan(n - 2)
    assert type(d.count) is int


@pytest.mark.slow
def test_a_convex_polygon_of_300_vertices_is_counted_exactly() -> None:
    assert decompose(parabola(300)).count == oracle.catalan(298)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_answer_and_count_are_those_of_brute_force(kind: str) -> None:
    seen = Counter()
    for points in random_polygons(kind, 500, seed=3):
        c = Curve(points)
        truth = oracle.valid_triangulations(c.points)
        d = decompose(c)
        assert (bool(d), d.count) == (bool(truth), len(truth))
        if truth:
            chosen = {key(d.arbitrary("first").validate()), key(d.arbitrary("last").validate())}
            assert chosen | {key(d.sample(np.random.default_rng(0)).validate())} <= truth
        seen[c.turning_number, bool(d)] += 1
        seen["crosses itself", bool(d)] += len(c.crossings) > 0
    wanted = {
        "scatter": [(0, False), (1, False), (1, True), (2, False), (3, False)],
        "winding": [(0, False), (1, False), (1, True), (2, False), (3, False), ("crosses itself", True)],
        "grid": [(0, False), (1, False), (1, True), (2, False)],
        "disk": [(1, True)],
        "strip": [(1, True), ("crosses itself", True)],
    }[kind]
    assert all(seen[what] >= 3 for what in wanted), seen
    assert not any(seen[turning, True] for turning in (0, 2, 3, 4))


@given(st.one_of(grid_polygons(3, 8, size=2), grid_polygons(3, 8), polygons.filter(lambda p: len(p) <= 8)))
def test_hard_polygons_are_answered_as_by_brute_force(points: Points) -> None:
    c = Curve(points)
    assert decompose(c).count == len(oracle.valid_triangulations(c.points))


@given(grid_polygons(3, 7))
def test_numbering_from_another_vertex_or_reflection_keeps_the_count(points: Points) -> None:
    count = decompose(points).count
    mirrored = np.array(points) * [-1, 1]
    for shift in range(len(points)):
        assert decompose(np.roll(points, shift, axis=0)).count == count
        assert decompose(np.roll(mirrored[::-1], shift, axis=0)).count == count


@pytest.mark.parametrize("name", ["five_disks", "horseshoe"])
def test_large_curves_are_counted_alike_from_every_start(name: str) -> None:
    points = curve(name).points
    counts = {decompose(np.roll(points, shift, axis=0)).count for shift in (0, 1, 17, len(points) - 1)}
    assert counts == {decompose(points[::-1] * [1, -1]).count}
    assert 0 not in counts


@given(disks())
def test_the_disk_that_a_curve_was_made_from_is_among_its_triangulations(T: Triangulation) -> None:
    joint = decompose(T, T.on_disk("uniform"))
    alone = decompose(T.curve)
    assert alone and joint
    assert 1 <= joint.count <= alone.count
    if joint.count == 1:  # valid on both: it is no other than T
        assert key(joint.arbitrary()) == key(T)
    assert decompose(T.points, *[T.points] * 2).count == alone.count


@given(disks(3, 10))
def test_small_disks_are_found_among_all_samples(T: Triangulation) -> None:
    assert key(T) in oracle.valid_triangulations(T.points)
    assert decompose(T).count == len(oracle.valid_triangulations(T.points))


@pytest.mark.parametrize("name", names())
def test_every_gallery_curve_bounds_a_disk(name: str) -> None:
    d = decompose(curve(name))
    assert d and d.reason == ""
    first, last = d.arbitrary("first").validate(), d.arbitrary("last").validate()
    assert d.count >= 2 and key(first) != key(last)
    for T in d.sample(np.random.default_rng(0), 3):
        T.validate()


@pytest.mark.parametrize("winding", [2, 3])
def test_positive_triangles_do_not_suffice_where_the_curve_turns_more_than_once(winding: int) -> None:
    angles = np.radians(50) * np.arange(1 + int(360 * winding / 50))[: int(360 * (winding - 1) / 50) + 3]
    points = [(0.0, 0.0), *zip(np.cos(angles), np.sin(angles), strict=True)]
    d = decompose(points)
    assert d.reason == f"turning number is {winding}, not 1"
    assert (bool(d), d.count) == (False, 0)


# Reasons and errors


@pytest.mark.parametrize(
    ("curves", "reason"),
    [
        ([EIGHT], "turning number is 0, not 1"),
        ([SQUARE, EIGHT], "turning number of curve 2 is 0, not 1"),
        ([EIGHT, SQUARE], "turning number of curve 1 is 0, not 1"),
        ([[(0, 0), (4, 0), (4, 3), (1, 3), (1, -1), (3, -1), (3, 2), (0, 2)]], "turning number is 2, not 1"),
        ([[(0, 0), (3, 3), (6, 0), (6, 6), (3, 1), (0, 6)]], "no decomposition exists"),
        (
            [[(0, 0), (3, 1), (6, 0), (3, 6)], [(0, 0), (6, 0), (4, 2), (0, 6)]],
            "no decomposition is valid in all 2 curves",
        ),
    ],
)
def test_no_is_an_answer_with_a_reason(curves: list[Points], reason: str) -> None:
    d = decompose(*curves)
    assert (bool(d), d.count, d.reason) == (False, 0, reason)
    assert reason in repr(d)
    for ask in (d.arbitrary, lambda: d.sample(np.random.default_rng(0)), lambda: d.sample(np.random.default_rng(0), 2)):
        with pytest.raises(NotSelfOverlappingError, match=reason):
            ask()


def test_curves_of_different_sizes_are_refused() -> None:
    with pytest.raises(CurveError, match=r"4 and 5 vertices.*insert_vertices"):
        decompose(SQUARE, parabola(5))
    with pytest.raises(CurveError, match="at least one curve"):
        decompose()
    with pytest.raises(CurveError, match="zero length"):
        decompose([(0, 0), (0, 0), (1, 1)])


def test_an_unknown_split_is_refused() -> None:
    with pytest.raises(ValueError, match="middle"):
        decompose(SQUARE).arbitrary("middle")


# Several curves


@pytest.mark.parametrize("kind", KINDS)
def test_the_common_triangulations_are_those_that_brute_force_finds_in_both(kind: str) -> None:
    rng, sizes = np.random.default_rng(4), Counter()
    for points in random_polygons(kind, 60, seed=5):
        c = Curve(points)
        others = [Curve(points + 0.3 * rng.normal(size=points.shape)), Curve(parabola(len(points)))]
        for curves in ((c, others[0]), (c, others[1]), (c, *others)):
            truth = set.intersection(*(oracle.valid_triangulations(x.points) for x in curves))
            joint = decompose(*curves)
            assert joint.count == len(truth)
            sizes[len(truth) > 0] += 1
            if truth:
                T = joint.sample(np.random.default_rng(0)).validate()
                assert key(T) in truth
                np.testing.assert_array_equal(T.points, c.points)
                for other in curves:
                    Triangulation(other.points, joint.arbitrary().triangles).validate()
    assert sizes[True] > 5


# Samples


def test_the_same_seed_draws_the_same_triangulations() -> None:
    d = decompose(curve("horseshoe"))
    one, two, other = (d.sample(np.random.default_rng(seed), 3) for seed in (1, 1, 2))
    assert [key(T) for T in one] == [key(T) for T in two] != [key(T) for T in other]
    assert key(d.sample(np.random.default_rng(1))) == key(one[0])
    assert d.sample(np.random.default_rng(1), 0) == []


# Least cost


@pytest.mark.parametrize(
    ("cost", "combine", "message"),
    [
        (lambda t: np.where(t[:, 1] == 1, np.nan, 1.0), "sum", "expected .* numbers, none of them NaN"),
        (lambda t: np.ones(len(t) - 1), "sum", r"cost gave shape \(\d+,\), expected \d+ numbers"),
        (lambda t: np.ones((len(t), 1)), "max", r"cost gave shape \(\d+, 1\), expected \d+ numbers"),
        (lambda t: 1.0, "sum", r"cost gave shape \(\), expected \d+ numbers"),
        (lambda t: np.ones(len(t)), "mean", "combine is 'mean', expected 'sum' or 'max'"),
    ],
)
def test_costs_that_are_no_numbers_are_refused(cost: Any, combine: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        decompose(curve("arrow")).optimal(cost, combine)


def test_a_curve_without_a_triangulation_has_no_optimum() -> None:
    with pytest.raises(NotSelfOverlappingError, match="turning number is 0, not 1"):
        decompose(EIGHT).optimal(lambda triangles: np.ones(len(triangles)))


# Immersed disks


CURVES = {name: gallery.curve(name) for name in gallery.names()} | {f"letter {x}": gallery.letter(x) for x in "DJSeoz"}
DISKS = {"two_disks": 2, "five_disks": 5}


def regular(n: int) -> np.ndarray:
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


@pytest.mark.parametrize("name", CURVES)
def test_two_hundred_remeshed_samples_are_the_immersed_disks(name: str) -> None:
    d = decompose(CURVES[name])
    listed = d.immersions()
    assert len(listed) == DISKS.get(name, 1)
    assert all(locally_delaunay(T.validate()).all() for T in listed)
    remeshed = {remesh(T).canonical.tobytes() for T in d.sample(np.random.default_rng(3), 200)}
    assert remeshed == {T.canonical.tobytes() for T in listed}


@pytest.mark.parametrize("seed", range(40))
def test_a_small_disk_has_as_many_immersions_as_its_triangulations_fall_into_classes_by_flips(seed: int) -> None:
    curve = gallery.random_disk(11, np.random.default_rng(seed)).curve
    d = decompose(curve)
    rng, found = np.random.default_rng(seed), {}
    while len(found) < d.count:
        found |= {T.canonical.tobytes(): T for T in d.sample(rng, 100)}
    assert len({remesh(T).canonical.tobytes() for T in found.values()}) == len(d.immersions())


@pytest.mark.parametrize("n", [4, 5, 8, 12, 30, 200])
def test_cocircular_vertices_do_not_multiply_the_answer(n: int) -> None:
    d = decompose(regular(n))
    assert len(d.immersions()) == 1
    assert n > 30 or len(d._full.delaunay()) == 1


@pytest.mark.parametrize("side", [1, 2, 4])
def test_a_square_with_points_along_its_sides_bounds_one_disk(side: int) -> None:
    along = np.arange(side, dtype=float)
    zero, full = np.zeros(side), np.full(side, float(side))
    x = np.concatenate([along, full, full - along, zero])
    y = np.concatenate([zero, along, full, full - along])
    assert len(decompose(np.stack([x, y], axis=1)).immersions()) == 1


def test_the_answer_does_not_depend_on_where_the_curve_starts() -> None:
    points = CURVES["five_disks"].points
    for shift in (1, 17, 50):
        assert len(decompose(np.roll(points, -shift, axis=0)).immersions()) == 5


def test_the_immersions_of_a_curve_can_be_morphed_each_in_its_own_way() -> None:
    first, second = decompose(CURVES["two_disks"]).immersions()
    assert isinstance(first, Triangulation)
    assert first.canonical.tolist() != second.canonical.tolist()


def test_misuse_is_refused() -> None:
    with pytest.raises(NotSelfOverlappingError, match="turning number is 0"):
        decompose([[0, 0], [2, 2], [2, 0], [0, 2]]).immersions()
    with pytest.raises(TweenError, match="2 were decomposed together"):
        decompose(regular(5), regular(5)).immersions()
