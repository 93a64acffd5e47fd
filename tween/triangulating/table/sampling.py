"""Uniform sampling: numbers of triangulations as doubles that do not overflow, and walks drawn by them.

Legend: a *pair* and its *splits* as in `.splits`; a count is ``mantissa * 2**exponent``.
"""

import math

import numpy as np
from numba import njit


@njit(cache=True)
def count_in_floats(first, left, right):
    """Count the triangulations of every pair as mantissa * 2**exponent."""
    pairs = first.size - 1
    # an edge of the curve counts once, as 0.5 * 2**1
    mantissas, exponents = np.full(pairs, 0.5), np.ones(pairs, np.int64)
    for pair in range(pairs):
        low, high = first[pair], first[pair + 1]
        if low == high:
            continue
        # in units of the largest term: none overflows, and one that underflows is far below rounding
        top = exponents[left[low]] + exponents[right[low]]
        for s in range(low + 1, high):
            top = max(top, exponents[left[s]] + exponents[right[s]])
        total = 0.0
        for s in range(low, high):
            shift = exponents[left[s]] + exponents[right[s]] - top
            total += math.ldexp(mantissas[left[s]] * mantissas[right[s]], shift)
        mantissas[pair], shift = math.frexp(total)
        exponents[pair] = top + shift
    return mantissas, exponents


@njit(cache=True)
def draw(whole, first, apex, left, right, ends, mantissas, exponents, uniforms):
    """Walk down from the whole curve once for every row of uniform numbers, one number a triangle."""
    samples, triangles_each = uniforms.shape
    triangles = np.empty((samples, triangles_each, 3), np.int64)
    stack = np.empty(2 * triangles_each + 2, np.int64)  # two pairs a triangle, and the first
    for row in range(samples):
        stack[0], size, t = whole, 1, 0
        while size > 0:
            size -= 1
            pair = stack[size]
            if first[pair] == first[pair + 1]:
                continue
            # a share of the pair's count, and its terms, in units of 2**exponents[pair]: of ordinary size
            rest = uniforms[row, t] * mantissas[pair]
            s = first[pair]  # rounding may leave a rest at the end: then s stays at the last split
            for s in range(first[pair], first[pair + 1]):
                shift = exponents[left[s]] + exponents[right[s]] - exponents[pair]
                rest -= math.ldexp(mantissas[left[s]] * mantissas[right[s]], shift)
                if rest < 0.0:
                    break
            triangles[row, t] = ends[pair, 0], apex[s], ends[pair, 1]
            t += 1
            stack[size], stack[size + 1] = right[s], left[s]
            size += 2
    return triangles
