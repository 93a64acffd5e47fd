r"""Signs of determinants without any rounding, for the few that doubles cannot decide.

A *floating-point expansion* is a sum of doubles that do not overlap, smallest first, whose sign is the sign of its last
term.  A determinant is multiplied out into products of coordinates; each product is a sum of doubles without error,
and these are added to an expansion one by one.  That takes more operations than an expansion for every factor would,
and much less code.

The two signs are compiled once, each to a native function with a name, and kernels call them by these names: what is
compiled into every kernel that takes a sign is the test in doubles of `tween.geometry.predicates` alone.  With numba's
compilation switched off they are plain functions.

Legend: ``a b c d`` points; ``e`` an expansion, the first ``size`` numbers of an array; ``hi lo`` a rounded value and
its rounding error.

References
----------
J. R. Shewchuk, *Adaptive precision floating-point arithmetic and fast robust geometric predicates*,
Discrete & Computational Geometry 18 (1997) 305-363, Section 2.
"""

import llvmlite.binding
import numpy as np
from numba import cfunc, config, njit, types

_SPLITTER = 2.0**27 + 1.0
_ORIENT_TERMS = 6 * 2  # products, and doubles of each
_INCIRCLE_TERMS = 48 * 8


@njit(cache=True, inline="always")
def two_sum(a, b):
    """a + b as (hi, lo) without error."""
    # exact in whatever order of magnitude a and b are, but under IEEE rounding only: never compile this with fastmath
    hi = a + b
    virtual = hi - a  # the part of b that arrived in hi
    return hi, (a - (hi - virtual)) + (b - virtual)


@njit(cache=True, inline="always")
def _split(a):
    """The number a as two halves of at most 26 bits each."""
    c = _SPLITTER * a  # overflows beyond 2**996 only, far above any term
    hi = c - (c - a)
    return hi, a - hi


@njit(cache=True, inline="always")
def two_product(a, b):
    """The product a * b as (hi, lo) without error."""
    hi = a * b
    a1, a0 = _split(a)
    b1, b0 = _split(b)
    # products of halves have 52 bits at most, so none is rounded, and in this order no difference is
    return hi, a0 * b0 - (((hi - a1 * b1) - a0 * b1) - a1 * b0)


@njit(cache=True)
def _add_product(e, size, a, b):
    """Add a * b to the expansion; returns its new size."""
    for x in two_product(a, b):
        # Shewchuk's Grow-Expansion; terms that become zero are left out, so that few have to be gone through
        kept = 0
        for i in range(size):
            x, lo = two_sum(x, e[i])
            if lo != 0.0:
                e[kept] = lo
                kept += 1
        if x != 0.0:
            e[kept] = x
            kept += 1
        size = kept
    return size


@njit(cache=True, inline="always")
def sign(x):
    """-1, 0 or 1."""
    return int(x > 0.0) - int(x < 0.0)


def _orient2d(ax, ay, bx, by, cx, cy):
    # the sum of a x b, b x c and c x a
    e, size = np.empty(_ORIENT_TERMS), 0
    for x, y in ((ax, by), (-ay, bx), (bx, cy), (-by, cx), (cx, ay), (-cy, ax)):
        size = _add_product(e, size, x, y)
    return sign(e[size - 1]) if size > 0 else 0


def _incircle(ax, ay, bx, by, cx, cy, dx, dy):
    # the sum of lift(a) orient(b, c, d), -lift(b) orient(c, d, a), lift(c) orient(d, a, b), -lift(d) orient(a, b, c)
    xs, ys = (ax, bx, cx, dx), (ay, by, cy, dy)
    e, size = np.empty(_INCIRCLE_TERMS), 0
    for p in range(4):
        for m in range(3):
            q, r = (p + 1 + m) % 4, (p + 1 + (m + 1) % 3) % 4
            for lifted in (xs[p], ys[p]):
                for right, other in ((xs[q], ys[r]), (-ys[q], xs[r])):
                    # lifted**2 and right * other as two terms each, and the four products of those
                    for x in two_product(lifted, -lifted if p % 2 else lifted):
                        for y in two_product(right, other):
                            size = _add_product(e, size, x, y)
    return sign(e[size - 1]) if size > 0 else 0


def _by_name(function, coordinates):
    """Compile a sign of so many coordinates, or load it, and let kernels call it by its name."""
    if vars(config)["DISABLE_JIT"]:
        return function
    signature = types.int64(*[types.float64] * coordinates)
    name = f"tween_exact{function.__name__}"
    llvmlite.binding.add_symbol(name, cfunc(signature, cache=True)(function).address)
    return types.ExternalFunction(name, signature)


orient2d_exact = _by_name(_orient2d, 6)
incircle_exact = _by_name(_incircle, 8)
