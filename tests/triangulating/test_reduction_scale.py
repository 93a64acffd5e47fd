"""Reduction tests again only what may have changed, and removes what plain rounds remove."""

import numpy as np
import oracle
import pytest

from tween import Curve, TweenError, decompose, gallery
from tween.triangulating.reduction import reduce_curve


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
