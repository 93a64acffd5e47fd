"""Exact counts of triangulations: against all triangulations of small polygons, and Catalan's numbers of large ones."""

from math import comb, prod

import numpy as np
import oracle
import pytest

from tween import Curve, TweenError, decompose, gallery
from tween.triangulating.table.counting import _combined, _primes


def convex(n: int) -> np.ndarray:
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


@pytest.mark.parametrize("n", [3, 4, 5, 17, 34, 35, 36, 100, 300])
def test_a_convex_polygon_has_a_catalan_number_of_triangulations(n: int) -> None:
    assert decompose(convex(n)).count == comb(2 * n - 4, n - 2) // (n - 1)


def test_small_polygons_have_as_many_triangulations_as_there_are() -> None:
    rng, counted = np.random.default_rng(0), 0
    while counted < 100:
        try:
            curve = Curve(rng.integers(-4, 5, (int(rng.integers(4, 10)), 2)))
        except TweenError:
            continue
        expected = len(oracle.valid_triangulations(curve.points))
        assert decompose(curve).count == expected
        counted += expected > 0


def test_curves_together_have_as_many_as_are_valid_in_both() -> None:
    rng = np.random.default_rng(1)
    for _ in range(50):
        n = int(rng.integers(4, 9))
        first, second = (gallery.random_disk(n, rng).points for _ in range(2))
        both = oracle.valid_triangulations(first) & oracle.valid_triangulations(second)
        assert decompose(first, second).count == len(both)


def test_a_polygon_of_many_vertices_may_have_one_triangulation() -> None:
    """A triangle with a long chain that bends inwards: its vertices see their neighbours and the apex only."""
    x = np.linspace(0, 1, 699)
    chain = np.stack([x, x * (1 - x)], axis=1)
    assert decompose(np.concatenate([chain, [[0.5, 10.0]]])).count == 1
    count = decompose(np.concatenate([chain, [[0.6, 10.0], [0.4, 10.0]]])).count
    assert count == 699  # where the chain changes from one apex to the other


def test_where_a_curve_starts_does_not_change_its_count() -> None:
    points = gallery.curve("five_disks").points
    assert len({decompose(np.roll(points, k, axis=0)).count for k in range(0, len(points), 5)}) == 1


def test_primes_are_prime_different_and_enough() -> None:
    primes = _primes(22, 10**500)
    assert prod(primes) > 10**500 >= prod(primes[:-1])
    assert len(set(primes)) == len(primes)
    assert all(p < 2**22 and all(p % q for q in range(2, 2**11 + 1)) for p in primes)


def test_residues_combine_to_the_number() -> None:
    number, primes = 3**200, _primes(27, 3**201)
    assert _combined(primes, [number % p for p in primes]) == number
