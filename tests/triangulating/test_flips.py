"""Flips, and the remeshing to constrained Delaunay triangulations."""

from itertools import pairwise

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import Points, convex_triangulations, disks, grid_polygons, mirror_polygons, polygons

from tween import Triangulation, decompose, remesh
from tween.gallery import curve, names, random_disk
from tween.triangulating.flips import flip, flippable, flips_to_delaunay, locally_delaunay

DART = Triangulation([(0, 0), (2, 0), (0.5, 0.5), (0, 2)], [(0, 1, 2), (0, 2, 3)])


def key(T: Triangulation) -> oracle.Triangles:
    return oracle.as_set(T.triangles)


def bad_diagonals(T: Triangulation) -> list[tuple[int, int]]:
    """Return the diagonals that are not locally Delaunay, by fractions."""
    p = oracle.integers(T.points)
    across = oracle.quadrilaterals(T.triangles)
    return [(a, b) for (a, b), (c, d) in across.items() if oracle.incircle(p[a], p[b], p[c], p[d]) > 0]


def no_four_cocircular(T: Triangulation) -> bool:
    p = oracle.integers(T.points)
    return all(
        oracle.incircle(p[a], p[b], *(p[c] for c in cd)) for (a, b), cd in oracle.quadrilaterals(T.triangles).items()
    )


def sorted_angles(T: Triangulation) -> list[float]:
    z = (T.points @ np.array([1, 1j]))[T.triangles]
    return sorted(np.angle((np.roll(z, 1, axis=1) - z) / (np.roll(z, -1, axis=1) - z)).ravel().tolist())


def is_above(after: list[float], before: list[float]) -> bool:
    """Say whether one list of angles is lexicographically the larger, to twelve digits."""
    steps = [a - b for a, b in zip(after, before, strict=True) if abs(a - b) > 1e-12]
    return bool(steps) and steps[0] > 0


# Remeshing


@given(disks())
def test_a_remeshed_disk_is_valid_and_delaunay(T: Triangulation) -> None:
    R = remesh(T).validate()
    assert bad_diagonals(R) == []
    assert locally_delaunay(R).all()
    assert len(R.diagonals) == len(T) - 3
    assert key(remesh(R)) == key(R)


def test_step_by_step_each_flip_is_valid_and_the_end_is_that_of_remeshing() -> None:
    start = decompose(curve("pretzel")).sample(np.random.default_rng(3))
    steps = list(flips_to_delaunay(start))
    assert steps[0] is start
    assert len(steps) > 10
    for before, after in pairwise(steps):
        assert len(key(before.validate()) - key(after.validate())) == 2
        assert is_above(sorted_angles(after), sorted_angles(before))
    assert key(steps[-1]) == key(remesh(start))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
def test_the_result_does_not_depend_on_the_start(seed: int) -> None:
    c = random_disk(60, np.random.default_rng(seed)).curve
    remeshed = [remesh(T) for T in decompose(c).sample(np.random.default_rng(0), 200)]
    assert no_four_cocircular(remeshed[0])
    assert len({key(R) for R in remeshed}) == 1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "immersions"), [("two_disks", 2), ("five_disks", 5), ("horseshoe", 1), ("pretzel", 1)]
)
def test_the_starts_lead_to_one_result_for_each_disk_that_the_curve_bounds(name: str, immersions: int) -> None:
    remeshed = [remesh(T) for T in decompose(curve(name)).sample(np.random.default_rng(0), 200)]
    for R in remeshed[:5]:
        assert bad_diagonals(R.validate()) == []
    assert len({key(R) for R in remeshed}) == immersions


@pytest.mark.parametrize("name", names())
def test_gallery_curves_are_remeshed(name: str) -> None:
    T = decompose(curve(name)).arbitrary()
    R = remesh(T).validate()
    assert bad_diagonals(R) == []
    assert key(R) != key(T)


@given(st.one_of(grid_polygons(4, 10), mirror_polygons(5)))
def test_cocircular_quadruples_do_not_keep_it_from_ending(points: Points) -> None:
    d = decompose(points)
    if d:
        for T in (d.arbitrary("first"), d.arbitrary("last"), d.sample(np.random.default_rng(0))):
            assert bad_diagonals(remesh(T).validate()) == []


@given(convex_triangulations(16), st.integers(0, 3))
def test_regular_polygons_and_their_mirror_images_are_remeshed(T: Triangulation, digits: int) -> None:
    angles = 2 * np.pi * np.arange(len(T)) / len(T)
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    R = remesh(Triangulation(ring if digits == 3 else np.round(ring * 2.0 ** (8 * digits + 8)), T.triangles))
    assert bad_diagonals(R.validate()) == []


def test_cocircular_quadruples_are_left_as_they_are() -> None:
    for triangles in ([(0, 1, 2), (0, 2, 3)], [(0, 1, 3), (1, 2, 3)]):
        T = Triangulation([(0, 0), (1, 0), (1, 1), (0, 1)], triangles)
        assert locally_delaunay(T).all()
        assert key(remesh(T)) == key(T)


@given(disks(4, 25))
def test_flips_one_by_one_lead_to_the_same_result_and_each_enlarges_the_angles(T: Triangulation) -> None:
    T = decompose(T).arbitrary("last")
    route = [T]
    while bad := bad_diagonals(route[-1]):
        route.append(flip(route[-1], bad[0]).validate())
    assert all(is_above(sorted_angles(after), sorted_angles(before)) for before, after in pairwise(route))
    if no_four_cocircular(route[-1]):
        assert key(remesh(T)) == key(route[-1])


# Single flips


def convex_by_brute_force(T: Triangulation) -> list[bool]:
    """Say of each diagonal whether the other one of its quadrilateral crosses it inside both."""
    p, across = oracle.integers(T.points), oracle.quadrilaterals(T.triangles)
    rows = [(min(d), max(d)) for d in T.diagonals.tolist()]
    return [oracle.meet(p[a], p[b], *(p[c] for c in across[a, b])) == "cross" for a, b in rows]


@given(st.one_of(polygons, grid_polygons(4, 12, size=3)))
def test_flippable_and_locally_delaunay_are_exact(points: Points) -> None:
    d = decompose(points)
    if not d:
        return
    for T in d.sample(np.random.default_rng(0), 3):
        bad = bad_diagonals(T)
        assert flippable(T).tolist() == convex_by_brute_force(T)
        assert locally_delaunay(T).tolist() == [tuple(sorted(e)) not in bad for e in T.diagonals.tolist()]
        assert not (~locally_delaunay(T) & ~flippable(T)).any()  # else remeshing would fold a quadrilateral


@given(disks(4, 30))
def test_a_flip_changes_one_pair_of_rows_and_its_inverse_restores_it(T: Triangulation) -> None:
    before = {tuple(sorted(e)) for e in T.diagonals.tolist()}
    for (a, b), fits in zip(T.diagonals.tolist(), flippable(T), strict=True):
        if not fits:
            with pytest.raises(
                ValueError, match=r"diagonal .* cannot be flipped: quadrilateral .* not strictly convex"
            ):
                flip(T, (a, b))
            continue
        c, d = oracle.quadrilaterals(T.triangles)[min(a, b), max(a, b)]
        F = flip(T, (b, a)).validate()
        assert {tuple(sorted(e)) for e in F.diagonals.tolist()} == before - {(min(a, b), max(a, b))} | {
            (min(c, d), max(c, d))
        }
        changed = np.flatnonzero((np.sort(F.triangles, axis=1) != np.sort(T.triangles, axis=1)).any(axis=1))
        assert {v for row in changed for v in T.triangles[row]} == {a, b, c, d}
        assert len(changed) == 2
        assert key(flip(F, (c, d)).validate()) == key(T)
    np.testing.assert_array_equal(T.validate().canonical, Triangulation(T.points, T.triangles).canonical)


@pytest.mark.parametrize(
    ("diagonal", "message"),
    [
        ((0, 2), "diagonal .* cannot be flipped: quadrilateral 0-1-2-3 is not strictly convex|2-3-0-1"),
        ((1, 3), "1-3 is no diagonal"),
        ((0, 1), "0-1 is no diagonal"),
        ((0, 0), "0-0 is no diagonal"),
        ((0, 9), "0-9 is no diagonal"),
    ],
)
def test_what_cannot_be_flipped_is_named(diagonal: tuple[int, int], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        flip(DART, diagonal)


def test_a_quadrilateral_with_a_straight_angle_cannot_be_flipped() -> None:
    T = Triangulation([(0, 0), (1, 0), (2, 0), (1, 1)], [(0, 1, 3), (1, 2, 3)])
    assert flippable(T).tolist() == [False]
    with pytest.raises(ValueError, match="not strictly convex"):
        flip(T, (1, 3))


def test_a_triangle_has_nothing_to_flip() -> None:
    T = Triangulation([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)])
    assert flippable(T).shape == locally_delaunay(T).shape == (0,)
    assert key(remesh(T)) == key(T)
    with pytest.raises(ValueError, match="no diagonal"):
        flip(T, (0, 1))
