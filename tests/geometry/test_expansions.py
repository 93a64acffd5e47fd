"""Signs without rounding, called by name from compiled code, and within the space that is set aside for them."""

from itertools import pairwise
from types import FunctionType
from typing import Any

import numpy as np
import oracle
import pytest
from numba import njit
from oracle import Fraction

from tween.geometry import expansions
from tween.geometry.expansions import incircle_exact, orient2d_exact, two_product, two_sum
from tween.geometry.predicates import EXACT_RANGE


@njit
def called_by_name(points, signs):
    for m in range(len(points)):
        a, b, c, d = points[m]
        signs[m, 0] = orient2d_exact(a[0], a[1], b[0], b[1], c[0], c[1])
        signs[m, 1] = incircle_exact(a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1])


@pytest.fixture
def plain() -> dict[str, Any]:
    """The module's functions as plain Python, where an index beyond an array is an error."""
    names = vars(expansions).copy()
    for name, value in vars(expansions).items():
        function = getattr(value, "py_func", value)
        if isinstance(function, FunctionType):
            names[name] = FunctionType(function.__code__, names, name)
    return names


def long_numbers(count: int, rng: np.random.Generator) -> Any:
    """Quadruples of points whose coordinates have all their bits and many orders of magnitude."""
    low, high = np.log2(EXACT_RANGE)
    size = np.exp2(rng.integers(low + 60, high - 1, (count, 1, 1)) - rng.integers(0, 55, (count, 4, 2)))
    return rng.choice([-1, 1], (count, 4, 2)) * rng.uniform(1, 2, (count, 4, 2)) * size


def test_sums_and_products_of_two_have_no_error() -> None:
    for a, b in (np.random.default_rng(0).normal(0, 1, (100, 2)) * [1, 2.0**30]).tolist():
        total, product = two_sum(a, b), two_product(a, b)
        assert Fraction(total[0]) + Fraction(total[1]) == Fraction(a) + Fraction(b)
        assert Fraction(product[0]) + Fraction(product[1]) == Fraction(a) * Fraction(b)
        assert (total[0], product[0]) == (a + b, a * b)


def test_kernels_get_the_signs_by_name() -> None:
    rng = np.random.default_rng(1)
    grids = rng.integers(0, 4, (300, 4, 2)).astype(float)
    points = np.concatenate([long_numbers(300, rng), grids, grids + 2.0**-50 * rng.integers(-2, 3, grids.shape)])
    signs = np.empty((len(points), 2), np.int64)
    called_by_name(points, signs)
    integers = [oracle.integers(quadruple) for quadruple in points]
    truth = [(oracle.orient2d(*q[:3]), oracle.incircle(*q)) for q in integers]
    assert set(truth) >= {(0, 1), (1, 0), (1, 1), (0, 0), (1, -1)}
    np.testing.assert_array_equal(signs, truth)


def test_the_space_suffices_for_as_many_terms_as_there_can_be(plain: dict[str, Any]) -> None:
    taken: list[int] = []

    def add_product(e: Any, size: int, a: float, b: float) -> int:
        """Add both terms of a product as if neither overlapped any other."""
        e[size : size + 2] = 1.0
        e[size + 1] = a * b
        taken.append(len(e))
        return size + 2

    plain["_add_product"] = add_product
    for name, points in (("_orient2d", 3), ("_incircle", 4)):
        taken.clear()
        plain[name](*range(1, 2 * points + 1))
        assert 2 * len(taken) == taken[-1], "room for every term, and for no more"


def test_expansions_do_not_overlap_and_have_no_zeros(plain: dict[str, Any]) -> None:
    rng = np.random.default_rng(3)
    for factors in rng.normal(0, 1, (20, 30, 2)) * np.exp2(rng.integers(-90, 90, (20, 30, 2))):
        e, size = np.empty(60), 0
        for a, b in factors.tolist():
            size = plain["_add_product"](e, size, a, b)
        terms = e[:size].tolist()
        assert sum(map(Fraction, terms)) == sum(Fraction(a) * Fraction(b) for a, b in factors.tolist())
        for small, large in pairwise(terms):
            over, under = Fraction(large).as_integer_ratio()
            assert 0 < abs(Fraction(small)) < Fraction(over & -over, under), "all below the last bit of the next"
