"""The exact number of triangulations from a table, without a list of its splits and without long integers inside.

The numbers of all pairs are found modulo primes, which are small enough that as many products as a pair can have
splits fit into 64 bits, and combined by the Chinese remainder theorem.  How many primes that takes is told by the same
count in floating point: all terms are positive, so it is right but for a rounding error far below the factor 2 that is
added.

Legend: ``i < k < j`` vertices, a pair and its apex; ``left`` and ``right`` places of the pairs (i, k) and (k, j).
"""

from functools import cache
from math import isqrt

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.predicates import orient2d_sign
from tween.triangulating.table.pairs import left_turn

_MOST_PRIMES = 80  # at once
_MOST_RESIDUES = 2**26  # of all pairs at once, 4 bytes each
_EXACT = 2.0**53  # whole numbers below are doubles
_SPAN = 2048  # of numbers among which primes are looked for at once
_UNIT = 512  # bits: a number is a double within 2**-256 to 2**256, times a power of 2**512
_LARGE, _SMALL, _DOWN, _UP = 2.0**256, 2.0**-256, 2.0**-512, 2.0**512


def count_exactly(
    points: NDArray[np.float64], first: NDArray[np.int64], last: NDArray[np.int64], ends: NDArray[np.int32]
) -> int:
    """Count the triangulations of the whole curves.

    Parameters
    ----------
    points : ndarray of float64, shape (c, n, 2)
    first, last, ends : ndarray of int
        The pairs that hold, see `.find_pairs`; that of the whole curves, the last of row 0, among them.

    Returns
    -------
    int

    Notes
    -----
    In time the number of triples (i, k, j) times that of primes, of about 27 bits each; the triples are gone through
    once for every 80 primes.  In memory at most 80 times 4 bytes a pair, and where that is much, fewer primes at once.
    """
    n = points.shape[1]
    mantissa, exponent = _in_floats(points, first, last, ends)
    if exponent == 0 and mantissa < _EXACT:  # so are all that were added up to it
        return int(mantissa)
    needed = 2 * max(1, int(mantissa * 2.0**300)) << max(0, _UNIT * exponent)
    needed = (needed >> 300) + 2
    primes = _primes((64 - n.bit_length()) // 2, needed)
    at_once = max(1, min(_MOST_PRIMES, _MOST_RESIDUES // len(ends)))
    residues: list[int] = []
    for low in range(0, len(primes), at_once):
        moduli = np.array(primes[low : low + at_once], dtype=np.uint64)
        residues += _modulo(points, first, last, ends, moduli).tolist()
    return _combined(primes, residues)


def _primes(bits: int, product: int) -> list[int]:
    """The largest primes below 2**bits whose product exceeds the given one."""
    primes: list[int] = []
    reached, high = 1, 2**bits
    while reached <= product:
        for p in _primes_close_below(high):
            if reached <= product:
                primes.append(p)
                reached *= p
        high -= _SPAN
    return primes


@cache
def _primes_close_below(high: int) -> list[int]:
    """The primes below an even number, and not farther from it than the span, descending."""
    small = _sieve(isqrt(high) + 1)
    candidates = np.arange(high - 1, high - _SPAN, -2)
    found: list[int] = candidates[(candidates[:, None] % small != 0).all(axis=1)].tolist()
    return found


def _sieve(limit: int) -> NDArray[np.int64]:
    """All primes below a limit."""
    prime = np.ones(limit, dtype=np.bool_)
    prime[:2] = False
    for p in range(2, int(limit**0.5) + 1):
        if prime[p]:
            prime[p * p :: p] = False
    return np.flatnonzero(prime)


def _combined(primes: list[int], residues: list[int]) -> int:
    """The number below the product of the primes that has the residues."""
    number, modulus = 0, 1
    for p, residue in zip(primes, residues, strict=True):
        number += modulus * ((residue - number) * pow(modulus, -1, p) % p)
        modulus *= p
    return number


@njit(cache=True)
def _modulo(points, first, last, ends, moduli):
    """Residues of the number of triangulations of the whole curves.

    Row i takes up the splits of its pairs in the order of their apexes k: then (i, k) is known, as all its splits
    have smaller apexes, and so is row k.
    """
    n, width = points.shape[1], len(moduli)
    single, x, y = points.shape[0] == 1, points[0, :, 0].copy(), points[0, :, 1].copy()
    counts, sums = np.empty((len(ends), width), np.uint32), np.empty((n, width), np.uint64)
    for i in range(n - 2, -1, -1):
        sums[i + 1 :] = 0
        sums[i + 1] = 1
        for left in range(first[i], last[i]):
            k = ends[left]
            for w in range(width):
                counts[left, w] = sums[k, w] % moduli[w]
            for right in range(first[k], last[k]):
                j = ends[right]
                if orient2d_sign(x[k], y[k], x[j], y[j], x[i], y[i]) > 0 if single else left_turn(points, i, k, j):
                    for w in range(width):
                        sums[j, w] += np.uint64(counts[left, w]) * np.uint64(counts[right, w])
    return counts[last[0] - 1].copy()


@njit(cache=True)
def _in_floats(points, first, last, ends):
    """The same as (mantissa, exponent), in powers of 2**512.

    A sum is brought to size only when it is complete: products stay below 2**512, and n of them below infinity.
    """
    n = points.shape[1]
    single, x, y = points.shape[0] == 1, points[0, :, 0].copy(), points[0, :, 1].copy()
    mantissas, exponents = np.empty(len(ends)), np.empty(len(ends), np.int64)
    sums, tops = np.empty(n), np.empty(n, np.int64)
    for i in range(n - 2, -1, -1):
        for j in range(i + 1, n):
            sums[j], tops[j] = 0.0, 0
        sums[i + 1] = 1.0
        for left in range(first[i], last[i]):
            k = ends[left]
            mantissa, exponent = _scaled(sums[k], tops[k])
            mantissas[left], exponents[left] = mantissa, exponent
            for right in range(first[k], last[k]):
                j = ends[right]
                if orient2d_sign(x[k], y[k], x[j], y[j], x[i], y[i]) > 0 if single else left_turn(points, i, k, j):
                    term, top = mantissa * mantissas[right], exponent + exponents[right]
                    if top == tops[j]:
                        sums[j] += term
                    else:
                        sums[j], tops[j] = _added(sums[j], tops[j], term, top)
    return mantissas[last[0] - 1], exponents[last[0] - 1]


@njit(cache=True, inline="always")
def _scaled(mantissa, exponent):
    """The same number with a mantissa that is neither large nor small."""
    if mantissa >= _LARGE:
        return mantissa * _DOWN, exponent + 1
    if 0.0 < mantissa < _SMALL:
        return mantissa * _UP, exponent - 1
    return mantissa, exponent


@njit(cache=True, inline="always")
def _added(total, top, term, exponent):
    """The sum of two scaled numbers; what is 2**-512 of the other is left out."""
    if total == 0.0 or exponent > top + 1:
        return term, exponent
    if exponent == top:
        return total + term, top
    if exponent == top + 1:
        return term + total * _DOWN, exponent
    return (total + term * _DOWN, top) if exponent == top - 1 else (total, top)
