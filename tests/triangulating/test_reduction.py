"""Reduced and whole curves bound the same disks, and a restored triangulation is one of the whole curve.

Reduction tests again only what may have changed, and removes what plain rounds remove.
"""

import numpy as np
import oracle
import pytest
from both_tables import both
from hypothesis import given, settings
from hypothesis import strategies as st

from tween import Curve, Decomposition, TweenError, certify, decompose, gallery, morph
from tween.geometry.predicates import orient2d
from tween.triangulating.flips import locally_delaunay
from tween.triangulating.reduction import reduce_curve

NAMES = [*gallery.names(), *gallery.letters()]
lattice = st.lists(st.tuples(st.integers(-4, 4), st.integers(-4, 4)), min_size=5, max_size=14)


def shape(name: str) -> Curve:
    return gallery.letter(name) if len(name) == 1 else gallery.curve(name)


def agree(whole: Decomposition, reduced: Decomposition) -> None:
    assert whole.reason == reduced.reason
    if not whole:
        return
    reduced.arbitrary().validate()
    disks = reduced.immersions()
    assert len(disks) == len(whole._full.delaunay())
    for T in disks:
        T.validate()
        assert locally_delaunay(T).all()


@pytest.mark.parametrize("name", NAMES)
def test_the_gallery_bounds_the_same_disks_when_reduced(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    agree(*both(shape(name), monkeypatch))


def test_two_hundred_random_disks_are_found_again(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(0)
    for _ in range(200):
        agree(*both(gallery.random_disk(int(rng.integers(5, 60)), rng).curve, monkeypatch))


@settings(max_examples=300)
@given(points=lattice)
def test_so_are_lattice_polygons_with_collinear_and_repeated_vertices(points: list[tuple[int, int]]) -> None:
    try:
        curve = Curve(points)
    except TweenError:
        return
    with pytest.MonkeyPatch.context() as patch:
        agree(*both(curve, patch))


@pytest.mark.parametrize("shift", [0, 1, 17])
def test_where_the_curve_starts_does_not_matter(shift: int, monkeypatch: pytest.MonkeyPatch) -> None:
    points = np.roll(gallery.curve("five_disks").points, shift, axis=0)
    whole, reduced = both(points, monkeypatch)
    assert len(reduced.immersions()) == 5 == len(whole._full.delaunay())


def test_what_is_removed_is_an_ear_or_a_dent_and_the_rest_keeps_its_order() -> None:
    curve = gallery.curve("horseshoe")
    kept, removed, dents = reduce_curve(curve)
    assert sorted([*kept, *removed[:, 1]]) == list(range(len(curve)))
    assert (np.diff(kept) > 0).all()
    a, v, b = (curve.points[removed[:, i]] for i in range(3))
    np.testing.assert_array_equal(orient2d(a, v, b) <= 0, dents)
    assert dents.any()
    assert not dents.all()


def test_what_is_crossed_may_be_an_ear_but_no_dent() -> None:
    rng = np.random.default_rng(0)
    crossed_ears = 0
    for _ in range(20):
        curve = gallery.random_disk(60, rng).curve
        meeting = set(curve.crossings.pairs.ravel().tolist())
        _, removed, dents = reduce_curve(curve)
        for (a, v, b), dent in zip(removed.tolist(), dents.tolist(), strict=True):
            if (v - a) % 60 == 1 and (b - v) % 60 == 1:  # the edges of the curve itself, not ones that came about
                crossed = a in meeting or v in meeting
                assert not (dent and crossed) or orient2d(*curve.points[[a, v, b]]) == 0
                crossed_ears += crossed
    assert crossed_ears > 100


def test_a_dent_through_which_an_edge_runs_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    pierced = [[-4, 0], [-1, 0], [0, 5], [1, 0], [4, 0], [4, 2], [-4, 2]]
    assert 2 in reduce_curve(Curve(pierced)).kept
    agree(*both(pierced, monkeypatch))
    assert not decompose(pierced)


def test_a_spike_that_an_ear_leaves_behind_is_not_smoothed_away(monkeypatch: pytest.MonkeyPatch) -> None:
    # (-2, 0) lies on the edge above (-2, -5), so cutting off (-5, -3) folds the curve back on itself.
    half = [[-4, 5], [-2, 0], [-5, -3], [-2, -5], [-2, 4]]
    curve = [[4, 5], *half, *([-x, y] for x, y in half[:0:-1])]
    agree(*both(curve, monkeypatch))
    assert not decompose(curve)


def test_a_spiral_of_twenty_thousand_vertices_needs_no_table() -> None:
    angle = np.linspace(0, 10 * np.pi, 10_000)
    line = (1 + 0.12 * angle)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    d = decompose(gallery.ribbon(line, 0.6))
    T = d.arbitrary()
    T.validate()
    assert len(d._reduction.kept) < 30
    assert "_full" not in vars(d)
    assert certify(morph(T, T.on_disk(), path="metric"), frames=3).frames_failed == 0


# Against plain rounds


def rounds(points: np.ndarray) -> tuple[list[int], list[tuple[int, int, int]], list[bool]]:
    """Remove vertices in rounds along the curve, every one tested in every round, in exact arithmetic."""
    p, n = oracle.integers(points), len(points)
    crossed = [False] * n
    for pair in oracle.crossings(points):
        for edge in pair:
            crossed[edge] = True
    ring, start, removed, dents = list(range(n)), 0, [], []
    while True:
        found, at = False, ring.index(start)
        visits = ring[at:] + ring[:at]
        skipped = -1
        for v in visits:
            if len(ring) == 3 or v == skipped:
                continue
            i = ring.index(v)
            a, b = ring[i - 1], ring[(i + 1) % len(ring)]
            side = oracle.orient2d(p[a], p[v], p[b])
            if may_go(p, crossed, a, v, b, side) and not any(
                in_triangle(p[w], p[a], p[v], p[b], side) for w in ring if w not in (a, v, b)
            ):
                removed.append((a, v, b))
                dents.append(side <= 0)
                crossed[a] |= crossed[v]
                ring.remove(v)
                found, start, skipped = True, b, b
        if not found:
            return sorted(ring), removed, dents


def may_go(p: list, crossed: list[bool], a: int, v: int, b: int, side: int) -> bool:
    if side:
        return side > 0 or not (crossed[a] or crossed[v])
    return all(min(p[a][x], p[b][x]) <= p[v][x] <= max(p[a][x], p[b][x]) for x in (0, 1))


def in_triangle(w: tuple, a: tuple, v: tuple, b: tuple, side: int) -> bool:
    signs = [oracle.orient2d(*edge, w) for edge in ((a, v), (v, b), (b, a))]
    if side:
        return all(s * side >= 0 for s in signs)
    return signs == [0, 0, 0] and all(min(a[x], v[x], b[x]) <= w[x] <= max(a[x], v[x], b[x]) for x in (0, 1))


def agrees(curve: Curve) -> None:
    kept, removed, dents = reduce_curve(curve)
    expected = rounds(curve.points)
    assert kept.tolist() == expected[0]
    assert list(map(tuple, removed.tolist())) == expected[1]
    assert dents.tolist() == expected[2]


@pytest.mark.parametrize("name", ["ell", "horseshoe", "two_disks"])
def test_the_gallery_is_reduced_as_by_plain_rounds(name: str) -> None:
    agrees(gallery.curve(name))


def test_random_disks_and_lattice_polygons_are_reduced_as_by_plain_rounds() -> None:
    rng = np.random.default_rng(0)
    for _ in range(20):
        agrees(gallery.random_disk(int(rng.integers(5, 70)), rng).curve)
    tried = 0
    while tried < 100:
        try:
            curve = Curve(rng.integers(-6, 7, (int(rng.integers(5, 40)), 2)))
        except TweenError:
            continue
        tried += 1
        agrees(curve)


def spiral(corners: int) -> np.ndarray:
    """A corridor along a rectangular spiral: only the two ends of it are ears."""
    ways = np.array([(1, 0), (0, 1), (-1, 0), (0, -1)])[np.arange(corners - 1) % 4]
    steps = 2.0 * (np.arange(corners - 1) // 2 + 1)
    return gallery.ribbon(np.concatenate([[[0.0, 0.0]], np.cumsum(steps[:, None] * ways, axis=0)]), 0.9).points


def comb(teeth: int) -> np.ndarray:
    x, high = np.arange(2.0 * teeth), np.resize([0, teeth, teeth, 0], 4 * teeth)
    p = np.concatenate([[[0, -1]], np.stack([np.repeat(x, 2), high], axis=1), [[2 * teeth - 1, -1]]])[::-1]
    return p @ np.array([[np.cos(0.7), np.sin(0.7)], [-np.sin(0.7), np.cos(0.7)]])


@pytest.mark.parametrize("make", [spiral, comb])
def test_spirals_and_combs_are_reduced_as_by_plain_rounds(make) -> None:
    agrees(Curve(make(10)))


@pytest.mark.parametrize(("make", "size"), [(spiral, 2_000), (comb, 1_000)])
def test_spirals_and_combs_of_thousands_of_vertices_reduce_to_a_triangle(make, size: int) -> None:
    d = decompose(make(size))
    assert len(d._reduction.kept) == 3
    d.arbitrary().validate()
